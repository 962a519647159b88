"""`station devices`: list kits and sound outputs, watch a kit live, record it, replay a capture."""

import argparse
import time
from collections.abc import Iterator
from dataclasses import asdict
from enum import IntEnum
from pathlib import Path

from station.app.commands.output import print_json, say
from station.core.errors import DeviceError
from station.core.events import Choke, DeviceEvent, DeviceFound, DeviceLost, Hit, PedalMoved
from station.core.pieces import word
from station.core.settings import load_settings
from station.core.units import NS_PER_S, ns_from_s, s_from_ns
from station.devices.watch import Findings, KitWatch

SCHEMA = "drum-station/devices/1"
POLL_S = 0.0005
"""Pause between two looks at the kit: the engine's own pace."""


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add this command's words."""
    verbs = parser.add_subparsers(dest="verb", required=True, metavar="VERB")
    listing = verbs.add_parser("list", help="the kits and sound outputs that this computer sees")
    listing.add_argument("--json", action="store_true", help="print one JSON document")
    monitor = verbs.add_parser("monitor", help="every hit as it comes, with its raw bytes; Ctrl-C ends")
    record = verbs.add_parser("record", help="keep every byte of a kit with its time; Ctrl-C ends")
    record.add_argument("file", metavar="FILE", type=Path, help="the capture to write")
    for verb in (monitor, record):
        verb.add_argument("--kit", metavar="PORT", help="part of the MIDI port's name (the first kit found)")
        verb.add_argument("--seconds", type=float, metavar="S", help="end by itself after so long")
    replay = verbs.add_parser("replay", help="the hits of a capture, as they were")
    replay.add_argument("file", metavar="FILE", type=Path, help="a capture")
    replay.add_argument("--json", action="store_true", help="print one JSON document")


def run(arguments: argparse.Namespace) -> int:
    """Do what the verb says."""
    verbs = {"list": _list, "monitor": _monitor, "record": _record, "replay": _replay}
    return verbs[arguments.verb](arguments)


def _list(arguments: argparse.Namespace) -> int:
    from station.devices.midi_ports import MidiDirectory
    from station.devices.presets import preset_for
    from station.sound.output import list_outputs

    faults: list[str] = []
    kits: list[dict[str, str]] = []
    outputs: list[dict[str, object]] = []
    try:
        kits = [{"port": port, "preset": preset_for(port).title} for port in MidiDirectory().names()]
    except DeviceError as fault:
        faults.append(str(fault))
    try:
        outputs = [asdict(output) for output in list_outputs()]
    except DeviceError as fault:
        faults.append(str(fault))
    if arguments.json:
        print_json({"schema": SCHEMA, "kits": kits, "outputs": outputs, "faults": faults})
        return 0
    print("Kits (MIDI inputs)", *[f"  {kit['port']}  [{kit['preset']}]" for kit in kits] or ["  none"], sep="\n")
    print("Sound outputs", *[f"  {output['name']}" for output in outputs] or ["  none"], sep="\n")
    for text in faults:
        say(f"station: {text}")
    return 0


# --- live ------------------------------------------------------------------------------------------------------------


def _polls(arguments: argparse.Namespace) -> Iterator[Findings]:
    """What the chosen kit brings, poll by poll, until the time is up or Ctrl-C."""
    from station.devices.midi_ports import MidiDirectory

    wanted = load_settings().kit if arguments.kit is None else arguments.kit
    watch = KitWatch(MidiDirectory(), wanted)
    end_ns = None if arguments.seconds is None else time.monotonic_ns() + ns_from_s(arguments.seconds)
    say(f"waiting for {f'a kit called {wanted!r}' if wanted else 'a kit'}; Ctrl-C ends")
    try:
        while end_ns is None or time.monotonic_ns() < end_ns:
            yield watch.poll(time.monotonic_ns())
            time.sleep(POLL_S)
    except KeyboardInterrupt:
        return
    finally:
        watch.close()


def _monitor(arguments: argparse.Namespace) -> int:
    from station.devices.decoders import DecoderBank

    decoders = DecoderBank()
    start_ns = time.monotonic_ns()
    for findings in _polls(arguments):
        now_ns = time.monotonic_ns()
        if findings.found:
            print(_line(decoders.found(findings.device, now_ns), start_ns), flush=True)
        for packet in findings.packets:
            events = list(decoders.feed(findings.device, packet.data, packet.at_ns))
            raw = packet.data.hex(" ")
            for event in events:
                print(f"{_line(event, start_ns):72}  {raw}", flush=True)
            if not events and packet.data[:1] not in _CHATTER:
                print(f"{s_from_ns(packet.at_ns - start_ns):10.4f}  {'':60}  {raw}", flush=True)
        if findings.lost:
            print(_line(decoders.lost(findings.device, now_ns), start_ns), flush=True)
    return 0


_CHATTER = (b"\xf8", b"\xfe")
"""MIDI clock and active sensing: several a second, and nothing that a drummer did."""


def _record(arguments: argparse.Namespace) -> int:
    from station.engine.engine import Engine
    from station.engine.messages import Notice
    from station.engine.messages import Record as RecordTo

    engine, hits = Engine(), 0
    engine.advance(time.monotonic_ns())
    engine.handle(RecordTo(arguments.file))
    faults = [event.text for event in engine.advance(time.monotonic_ns()) if isinstance(event, Notice)]
    if faults:
        raise DeviceError(faults[0])
    for findings in _polls(arguments):
        if findings.found:
            engine.device_found(findings.device, time.monotonic_ns())
        for packet in findings.packets:
            engine.feed(findings.device, packet.data, packet.at_ns)
        if findings.lost:
            engine.device_lost(findings.device, time.monotonic_ns())
        for event in engine.advance(time.monotonic_ns()):
            hits += isinstance(event, Hit)
            if isinstance(event, DeviceFound | DeviceLost):
                say(f"{event.device} {'is here' if isinstance(event, DeviceFound) else 'is gone'}")
            if isinstance(event, Notice):
                say(event.text)
    engine.close()
    say(f"{hits} hits in {arguments.file}")
    return 0


# --- replay ----------------------------------------------------------------------------------------------------------


def _replay(arguments: argparse.Namespace) -> int:
    from station.devices.capture import read_capture
    from station.devices.replay import replay

    capture = read_capture(arguments.file)
    events = list(replay(capture))
    start_ns = capture.records[0].at_ns if capture.records else 0
    if not capture.complete:
        say(f"{arguments.file}: was not closed in order; {capture.lost_bytes} bytes at its end cannot be read")
    if arguments.json:
        rows = [{"event": type(event).__name__, **_plain(event)} for event in events]
        print_json({"schema": "drum-station/replay/1", "complete": capture.complete, "events": rows})
    else:
        for event in events:
            print(_line(event, start_ns))
    return 0


def _plain(event: DeviceEvent) -> dict[str, object]:
    return {name: word(value) if isinstance(value, IntEnum) else value for name, value in asdict(event).items()}


def _line(event: DeviceEvent, start_ns: int) -> str:
    """One event in words, its time in seconds from `start_ns`."""
    return f"{(event.at_ns - start_ns) / NS_PER_S:10.4f}  {_words(event)}"


def _words(event: DeviceEvent) -> str:
    match event:
        case Hit():
            openness = "" if event.openness is None else f"  openness {event.openness:.2f}"
            how = f"{word(event.zone)}, {word(event.articulation)}"
            return f"{word(event.piece):13} {how:18} velocity {event.velocity:3}{openness}"
        case Choke():
            return f"{word(event.piece):13} choked"
        case PedalMoved():
            return f"hi-hat pedal  openness {event.openness:.2f}"
        case DeviceLost():
            return f"{event.device} is gone"
        case DeviceFound():
            return f"{event.device} is here"
