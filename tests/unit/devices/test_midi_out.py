"""Through a real JACK server: what is sent to a port arrives there, byte for byte."""

import subprocess
import sys
import textwrap

import pytest

from station.core.errors import BadInput
from station.devices.midi.midi_out import open_midi_output
from tests.fakes.jack_server import JackServer, jackd_is_installed


def test_an_unknown_driver_is_refused() -> None:
    with pytest.raises(BadInput, match="no such MIDI driver"):
        open_midi_output("carrier pigeon", "module")


@pytest.mark.jack
@pytest.mark.skipif(not jackd_is_installed(), reason="jackd is not installed")
def test_what_is_sent_arrives() -> None:
    program = """
        import time, rtmidi
        from station.core.errors import DeviceError
        from station.devices.midi.midi_out import open_midi_output
        module = rtmidi.MidiIn(rtmidi.API_UNIX_JACK, "module")
        module.open_virtual_port("in")
        try:
            open_midi_output("auto", "nobody")
        except DeviceError as fault:
            assert "module" in str(fault), fault
            assert str(fault).startswith("no MIDI output is called 'nobody'; there are "), fault
        else:
            raise AssertionError("opened nobody")
        port = open_midi_output("auto", "MODULE")
        time.sleep(0.1)
        for velocity in (1, 64, 127):
            port.send(bytes((0x99, 38, velocity)))
        heard, until_s = [], time.monotonic() + 50.0
        while len(heard) < 3 and time.monotonic() < until_s:
            item = module.get_message()
            if item is not None:
                heard.append(bytes(item[0]).hex(" "))
            time.sleep(0.001)
        port.close()
        port.close()
        try:
            port.send(b"\\x99\\x26\\x40")
        except DeviceError as fault:
            assert "closed" in str(fault)
        else:
            raise AssertionError("sent to a closed port")
        print("|".join(heard), flush=True)
    """
    with JackServer(48_000, 64) as server:
        told = subprocess.run(
            [sys.executable, "-c", textwrap.dedent(program)],
            env=server.env,
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )
    assert told.stdout.strip() == "99 26 01|99 26 40|99 26 7f", told.stderr
