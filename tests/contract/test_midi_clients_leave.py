"""A JACK server waits for every client that is gone without a word: whoever listened to kits takes leave of it."""

from pathlib import Path

import pytest

from station.app.equipment.diagnostics import check_midi
from station.core.clock import monotonic_ns
from station.devices.device_ports import DeviceRequest, devices_there, no_device, watch_devices
from station.devices.midi.midi_clients import CLIENT_NAME
from tests.fakes.jack_server import JackServer, jackd_is_installed, joined
from tests.fakes.kit_player import KitPlayer

KIT = "TD-17 fake kit"

pytestmark = [pytest.mark.jack, pytest.mark.skipif(not jackd_is_installed(), reason="jackd is not installed")]


def is_there(server: JackServer, name: str) -> bool:
    """Whether a client of that name, with ports or without, is on the server."""
    import jack  # needs JACK's library, which a machine may lack

    with jack.Client("asks", servername=server.name, no_start_server=True) as client:
        try:
            client.get_uuid_for_client_name(name)
        except jack.JackError:
            return False
    return True


def test_whoever_listened_to_a_kit_leaves_no_client_behind(tmp_path: Path) -> None:
    with JackServer() as server, joined(server), KitPlayer(server, KIT, [], tmp_path):
        watches = watch_devices((DeviceRequest(KIT),), "jack")
        (kit,) = watches.kits
        while not kit.poll(monotonic_ns()).found:
            pass
        assert is_there(server, f"{CLIENT_NAME} kit")
        watches.close()
        assert not is_there(server, f"{CLIENT_NAME} kit")
        assert devices_there((DeviceRequest(KIT),)) == [f"{KIT}:out"]
        assert KIT in no_device((DeviceRequest("another"),))
        assert KIT in check_midi().finding
        assert not is_there(server, f"{CLIENT_NAME} kit"), "a look at the ports is no stay"
