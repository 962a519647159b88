"""`station devices`: list kits and sound outputs, watch a kit live, record it, replay a capture."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from enum import IntEnum
from pathlib import Path
from typing import TYPE_CHECKING

from station.cli.console import print_json, say, write
from station.cli.device_pages import devices_calibrate, devices_setup_stick
from station.cli.device_pages.devices_learn_pad import LearnOptions, learn_kit_or_pad
from station.cli.device_pages.devices_monitor import monitor
from station.cli.device_pages.devices_monitor_sticks import sensors_now
from station.cli.input.device_listening import HearOptions, event_line, listening, listening_to_sticks, polls
from station.cli.options.device_option import sticks_option
from station.cli.options.option_fields import Command, Verbs, argument, flag
from station.core.clock import monotonic_ns
from station.core.errors import BadInput, DeviceError
from station.core.events import DeviceEvent, DeviceFound, DeviceLost, Hit
from station.core.pieces import word
from station.devices.port_watch import PortPoll

if TYPE_CHECKING:
    from station.engine.engine import Engine

SCHEMA = "drum-station/devices/1"
REPLAY_SCHEMA = "drum-station/replay/1"


@dataclass(frozen=True, slots=True, kw_only=True)
class PortsOptions:
    """How the ports are listed."""

    sticks: tuple[str, ...] = sticks_option()
    json: bool = flag("print one JSON document")


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordOptions(HearOptions):
    """Where what is heard is kept."""

    file: Path = argument("FILE", "the capture to write; one that is there goes on", Path)


@dataclass(frozen=True, slots=True, kw_only=True)
class ReplayOptions:
    """Which capture, and how its hits are printed."""

    file: Path = argument("FILE", "a capture", Path)
    json: bool = flag("print one JSON document")


def _list(options: PortsOptions) -> int:
    from station.sound.output.sound_output import list_outputs

    kits, faults = _ports()
    outputs: list[dict[str, object]] = []
    try:
        outputs = [asdict(output) for output in list_outputs()]
    except DeviceError as fault:
        faults.append(str(fault))
    sticks: list[dict[str, object]] = []
    try:
        sticks = sensors_now(options.sticks) if options.sticks else []
    except DeviceError as fault:
        faults.append(str(fault))
    if options.json:
        print_json({"schema": SCHEMA, "kits": kits, "outputs": outputs, "sticks": sticks, "faults": faults})
        return 0
    rows = [f"  {kit['port']}  [{kit['preset']}]" for kit in kits]
    write("\n".join(["Kits (MIDI inputs, game drums, serial ports)", *(rows or ["  none"])]))
    write("\n".join(["Sound outputs", *([f"  {output['name']}" for output in outputs] or ["  none"])]))
    if options.sticks:
        write("\n".join(["Motion sensors", *([f"  {_sensor_line(each)}" for each in sticks] or ["  none"])]))
    for text in faults:
        say(f"station: {text}")
    return 0


def _sensor_line(sensor: Mapping[str, object]) -> str:
    rate = "" if sensor["rate_hz"] is None else f", {sensor['rate_hz']:.1f} Hz"
    from station.devices.imu.imu_protocols import PROTOCOLS

    protocol = str(sensor["protocol"])
    speaks = PROTOCOLS[protocol].title if protocol else "nothing readable: another baud?"
    return f"{sensor['device']}  [{speaks}{rate}]"


def _ports() -> tuple[list[dict[str, str]], list[str]]:
    """A row a port, MIDI before HID before serial, and why some cannot be listed or opened."""
    from station.devices.device_ports import midi_now
    from station.devices.hid.hid_ports import HidDirectory
    from station.devices.mapping.device_file import own_kit
    from station.devices.mapping.presets import preset_for
    from station.devices.serial.serial_ports import SerialDirectory, no_access

    faults: list[str] = []
    names: list[tuple[str, str]] = []
    with midi_now() as (midi, fault):
        if midi is None:
            faults.append(f"{fault}")
        else:
            names = [(port, "midi") for port in midi.names()]
    hid = HidDirectory()
    for port in hid.names():
        names.append((port, "hid"))
        if (denied := hid.no_access(port)) is not None:
            faults.append(f"{port}: {denied}")
    for address in SerialDirectory().addresses():
        names.append((address.port, "serial"))
        if (denied := no_access(address.path)) is not None:
            faults.append(f"{address.port}: {denied}")
    rows = []
    for port, wire in names:
        try:
            own = own_kit(port)
        except BadInput as broken:
            faults.append(str(broken))
            own = None
        title = preset_for(port).title if own is None else f"{own.title}, as you taught it"
        rows.append({"port": port, "preset": title, "wire": wire})
    return rows, faults


# --- record ----------------------------------------------------------------------------------------------------------


def _record(options: RecordOptions) -> int:
    from station.devices.mapping.device_file import own_kit
    from station.devices.mapping.stick_file import own_stick
    from station.devices.port_watch import ClaimedPorts
    from station.engine.engine import Engine
    from station.engine.messages import RecordCapture

    engine, hits, records, claims = Engine(own_kit=own_kit, own_stick=own_stick), 0, False, ClaimedPorts()
    with listening(options, claims) as kits, listening_to_sticks(options, claims) as sticks:
        try:
            for findings in polls(kits, options.seconds, sticks):
                if findings.found and not records:  # no sooner: where nothing can be heard, no file is left behind
                    engine.advance(monotonic_ns())
                    engine.handle(RecordCapture(options.file))
                    records = True
                _feed(engine, findings, any(stick.device == findings.device for stick in sticks))
                hits += _print_events(engine)
        finally:
            engine.handle(RecordCapture(None))
    hits += _print_events(engine)
    say(f"{hits} hits in {options.file}" if records else "nothing came: nothing was recorded")
    return 0


def _feed(engine: "Engine", findings: PortPoll, is_stick: bool) -> None:
    if findings.found:
        (engine.sensor_found if is_stick else engine.device_found)(findings.device, monotonic_ns())
    for packet in findings.packets:
        engine.feed(findings.device, packet.data, packet.at_ns)
    if findings.lost:
        engine.device_lost(findings.device, monotonic_ns())


def _print_events(engine: "Engine") -> int:
    """Say what happened and count the hits; raises `DeviceError` where the capture did not begin or end well."""
    from station.engine.messages import CaptureSaved, Notice

    hits = 0
    for event in engine.advance(monotonic_ns()):
        match event:
            case Hit():
                hits += 1
            case DeviceFound() | DeviceLost():
                say(f"{event.device} {'is here' if isinstance(event, DeviceFound) else 'is gone'}")
            case CaptureSaved(fault=str(fault)):
                raise DeviceError(fault)
            case Notice(text):
                say(text)
            case _:
                pass
    return hits


# --- replay ----------------------------------------------------------------------------------------------------------


def _replay(options: ReplayOptions) -> int:
    from station.devices.capture.capture import read_capture
    from station.devices.capture.replay import replay
    from station.practice.records.rejudge import judge_again, session_document, session_line

    capture = read_capture(options.file)
    if capture.good_bytes == capture.lost_bytes == 0:
        raise BadInput(options.file, "", "the file is empty")
    events = list(replay(capture))
    try:
        sessions = judge_again(capture)
    except BadInput as fault:  # the strokes are there all the same
        sessions = []
        say(f"{options.file}: {fault.place}: {fault.fault}; its sessions are not judged again")
    start_ns = capture.records[0].at_ns if capture.records else 0
    if not capture.complete:
        say(f"{options.file}: was not closed in order; {capture.lost_bytes} bytes at its end cannot be read")
    if options.json:
        rows = [{"event": type(event).__name__, **_plain(event)} for event in events]
        judged = [session_document(session.result()) for session in sessions]
        print_json({"schema": REPLAY_SCHEMA, "complete": capture.complete, "events": rows, "sessions": judged})
    else:
        for event in events:
            write(event_line(event, start_ns))
        for session in sessions:
            say(session_line(session.result()))
    return 0


def _plain(event: DeviceEvent) -> dict[str, object]:
    return {name: word(value) if isinstance(value, IntEnum) else value for name, value in asdict(event).items()}


COMMAND = Verbs(
    (
        ("list", "the kits and sound outputs that this computer sees", Command(PortsOptions, _list)),
        (
            "monitor",
            "every hit with its raw bytes, and what looks like a false trigger, or how motion sensors do; Ctrl-C ends",
            Command(HearOptions, monitor),
        ),
        ("learn", "teach the station your kit: strike what is asked for", Command(LearnOptions, learn_kit_or_pad)),
        (
            "record",
            "keep every byte of a kit and of motion sensors with its time; Ctrl-C ends",
            Command(RecordOptions, _record),
        ),
        (
            "calibrate",
            "measure the latency of a kit or a sound output",
            Command(devices_calibrate.CalibrateOptions, devices_calibrate.run),
        ),
        (
            "setup-stick",
            "set a WitMotion motion sensor to what the station has use for",
            Command(devices_setup_stick.SetupStickOptions, devices_setup_stick.run),
        ),
        ("replay", "the hits of a capture, as they were, and a session's judgements", Command(ReplayOptions, _replay)),
    )
)
