"""Listening to kits from the terminal: what they bring, poll by poll, and their events in words."""

import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from queue import SimpleQueue

from station.cli.console import say
from station.cli.options.device_option import devices_option, sticks_option, wanted_kits, wanted_sticks
from station.cli.options.option_fields import option, unread
from station.core.clock import monotonic_ns
from station.core.errors import DeviceError
from station.core.events import Choke, DeviceEvent, DeviceFound, DeviceLost, Hit, PedalMoved, Switched
from station.core.labels import piece_name
from station.core.pieces import word
from station.core.settings import load_settings
from station.core.units import NS_PER_S, ns_from_s
from station.devices.port_watch import ClaimedPorts, PortPoll, PortWatch

POLL_S = 0.0005
"""Pause between two looks at the kit: the engine's own pace."""
NAMED_WITHIN_S = 3.0
"""So long a kit is awaited that is asked for by name: a USB kit announces itself within two seconds (our choice)."""
LONGEST_S = 7 * 24 * 3_600.0
"""The longest that ends by itself: a week (our choice)."""


def _length_s(text: str) -> float:
    try:
        seconds = float(text)
    except ValueError:
        seconds = 0.0
    if not 0.0 < seconds <= LONGEST_S:
        raise unread(f"seconds above 0, {LONGEST_S:.0f} at most", text)
    return seconds


@dataclass(frozen=True, slots=True, kw_only=True)
class ListenOptions:
    """Which kits are listened to, and for how long."""

    device: tuple[str, ...] = devices_option()
    seconds: float | None = option("S", "end by itself after so long", _length_s, None)


@dataclass(frozen=True, slots=True, kw_only=True)
class HearOptions(ListenOptions):
    """Which kits and which motion sensors are listened to; where sensors alone are named, they alone."""

    sticks: tuple[str, ...] = sticks_option()

    @property
    def are_sticks_alone(self) -> bool:
        """Whether no kit is meant."""
        return bool(self.sticks) and not self.device


class TypedLines:
    """What a person types, line by line, read in a thread of its own; `ended` once there is no more to come."""

    def __init__(self) -> None:
        self._lines: SimpleQueue[str] = SimpleQueue()
        self.ended = False
        threading.Thread(target=self._run, name="keys", daemon=True).start()

    def _run(self) -> None:
        with suppress(OSError, ValueError):  # there is no standard input, or it was closed
            for line in sys.stdin or ():
                self._lines.put(line.strip())
        self.ended = True

    def pop(self) -> list[str]:
        """The lines since the last call."""
        return [self._lines.get() for _ in range(self._lines.qsize())]


@contextmanager
def listening_to_sticks(options: HearOptions, claims: ClaimedPorts | None = None) -> Iterator[tuple[PortWatch, ...]]:
    """The chosen sensors, those of the settings where nothing is chosen; Ctrl-C, wherever it falls, ends the block.

    `claims` are those of the kits' watches. Raises `DeviceError` where sensors alone are meant and none can be heard.
    """
    from station.devices.stick_ports import parse_sticks, watch_sticks

    otherwise = "" if options.device else load_settings().sticks
    watches = watch_sticks(parse_sticks(wanted_sticks(options.sticks, otherwise)), claims)
    if watches.fault is not None:
        if options.are_sticks_alone and not watches.sticks:
            raise DeviceError(watches.fault)
        say(f"station: {watches.fault}")
    try:
        yield watches.sticks
    except KeyboardInterrupt:
        pass
    finally:
        watches.close()


@contextmanager
def listening(options: ListenOptions, claims: ClaimedPorts | None = None) -> Iterator[tuple[PortWatch, ...]]:
    """The chosen kits, none where sensors alone are named; Ctrl-C, wherever it falls, ends the block.

    `claims` are shared with the watches over sensors. Raises `DeviceError` where none can be heard.
    """
    from station.devices.device_ports import no_device, parse_devices, watch_devices

    if isinstance(options, HearOptions) and options.are_sticks_alone:
        yield ()
        return
    requests = parse_devices(wanted_kits(options.device, load_settings().kit))
    watches = watch_devices(requests, claims=claims)
    if not watches.kits:
        raise DeviceError(no_device(requests))
    if watches.fault is not None:
        say(f"station: {watches.fault}")
    try:
        yield watches.kits
    except KeyboardInterrupt:
        pass
    finally:
        watches.close()


def polls(kits: tuple[PortWatch, ...], seconds: float | None, sticks: tuple[PortWatch, ...] = ()) -> Iterator[PortPoll]:
    """What kits and sensors bring, poll by poll, until the time is up; each is looked at once at the least.

    Raises `DeviceError` where none comes: any kit is awaited to the end, what has a name not long.
    """
    begun_ns, found, watches = monotonic_ns(), False, (*kits, *sticks)
    end_ns = None if seconds is None else begun_ns + ns_from_s(seconds)
    names = [f"a kit called {kit.wanted!r}" if kit.wanted else "a kit" for kit in kits]
    names += [f"a motion sensor at {stick.wanted!r}" if stick.wanted else "a motion sensor" for stick in sticks]
    say(f"waiting for {' and '.join(names)}; Ctrl-C ends")
    is_named = all(watch.wanted for watch in watches)
    while True:
        for watch in watches:
            findings = watch.poll(monotonic_ns())
            found = found or findings.found
            if findings.fault and not found and is_named and len(watches) == 1:
                raise DeviceError(findings.fault)
            if findings.fault:
                say(f"station: {findings.fault}")
            yield findings
        now_ns = monotonic_ns()
        if end_ns is not None and now_ns >= end_ns:
            break
        if not found and is_named and now_ns - begun_ns > ns_from_s(NAMED_WITHIN_S):
            break
        time.sleep(POLL_S)
    if not found:
        raise DeviceError(_nothing_came(kits, sticks))


def _nothing_came(kits: tuple[PortWatch, ...], sticks: tuple[PortWatch, ...]) -> str:
    from station.devices.device_ports import DeviceRequest, no_device
    from station.devices.stick_ports import no_stick

    if kits:
        return no_device(tuple(DeviceRequest(kit.wanted) for kit in kits))
    return no_stick(tuple(DeviceRequest(stick.wanted) for stick in sticks))


def event_line(event: DeviceEvent, start_ns: int) -> str:
    """One event in words, its time in seconds from `start_ns`."""
    return f"{(event.at_ns - start_ns) / NS_PER_S:10.4f}  {_words(event)}"


def _words(event: DeviceEvent) -> str:
    match event:
        case Hit():
            openness = "" if event.openness is None else f"  openness {event.openness:.2f}"
            how = f"{word(event.zone)}, {word(event.articulation)}"
            fraction = f"{event.velocity_fraction:.2f}"[1:] if event.velocity_fraction else ""
            return f"{piece_name(event.piece):16} {how:18} velocity {event.velocity:3}{fraction}{openness}"
        case Choke():
            return f"{piece_name(event.piece):16} choked"
        case PedalMoved():
            return f"hi-hat pedal  openness {event.openness:.2f}"
        case Switched():
            return f"switch           {event.switch}"
        case DeviceLost():
            return f"{event.device} is gone"
        case DeviceFound():
            return f"{event.device} is here"
