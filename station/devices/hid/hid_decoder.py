"""HID reports to events of the drum kit: pure, no clock, no port.

A report says how all buttons stand. A lane is struck when it stands in this report, did not in the one before, and one
of its bits has risen: a report in which bits only fall brings no stroke, however what is left may be read. A report of
another length than the table's is nothing.

A Rock Band kit has one bit a colour for pad and cymbal alike, a flag for pads, one for cymbals, and the hat for the
yellow (up) and the blue cymbal (down). Both flags and several colours at once: the hat says which colour's cymbal was
struck (none: green), the other colours are pads. Both flags and one colour: pad and cymbal of that colour, whose
velocity is in the red pad's byte then. No flag: a kit of the first generation. (PlasticBand, "4-Lane Drums".)

Strokes go as MIDI notes (`hid_reports`) through a `MidiDecoder`, which knows what they mean; switches are named after
the HID usage tables: `key=5` (keyboard page; b), `button=10` (button page; Start).
"""

from collections.abc import Mapping
from typing import NamedTuple, Protocol

from station.core.events import DeviceEvent, Switched
from station.devices.hid.hid_reports import (
    BUTTONS,
    DOWN,
    DRUM_REPORT_BYTES,
    HAT_DOWN,
    HAT_UP,
    KEYS,
    LAYOUTS,
    RED,
    STOMP_MESSAGE,
    UP,
    DrumLayout,
    Lane,
)
from station.devices.mapping.device_map import DeviceMap
from station.devices.midi.midi_decoder import MidiDecoder

UNTOLD_VELOCITY = 80
"""Of a stroke whose kit does not say how hard it was; our choice: what lessons write for a plain note."""

_NOTE_ON = 0x99
_GREATEST = 127
_STANDS = b"\xff"
"""Before a report that says only how things stood when a capture began: no report of our devices begins so and is a
byte longer than its table says."""
_RAW_WINDOWS = b"\x00"

_KEYBOARD_BYTES = 8
_KEYBOARD_ID = b"\x01"
_MODIFIERS, _FIRST_MODIFIER = 8, 0xE0
_FIRST_KEY = 4
"""Below it the keyboard page has no keys but errors (HID Usage Tables, keyboard page)."""


class ReportNews(NamedTuple):
    """What a report tells that the one before did not: notes that were struck, as MIDI, and switches now pressed."""

    messages: list[bytes]
    switches: list[str]


_NOTHING = ReportNews([], [])


class ReportReader(Protocol):
    """Reads one device's reports."""

    def read(self, report: bytes) -> ReportNews:
        """What `report` brings."""
        ...

    def stands(self) -> bytes:
        """Bytes that bring a new reader to this one's state and are no news; empty where there is none."""
        ...


class DrumReader:
    """Reads a drum kit's reports by its table."""

    def __init__(self, layout: DrumLayout) -> None:
        self._layout = layout
        self._report = b""
        self._bits = 0
        self._struck: Mapping[Lane, int | None] = {}

    def read(self, report: bytes) -> ReportNews:
        """What `report` brings."""
        body, is_news = _body(report, DRUM_REPORT_BYTES, _RAW_WINDOWS)
        if not body:
            return _NOTHING
        bits = _bits_of(body)
        risen = bits & ~self._bits
        struck = _struck(self._layout, bits, body)
        new = [lane for lane in struck if lane not in self._struck and risen & lane.bits] if is_news else []
        switches = [f"button={number}" for bit, number in BUTTONS.items() if risen & bit and is_news]
        self._report, self._bits, self._struck = body, bits, struck
        return ReportNews([bytes((_NOTE_ON, lane.note, self._velocity(struck[lane]))) for lane in new], switches)

    def stands(self) -> bytes:
        """See `ReportReader`."""
        return _STANDS + self._report if self._report else b""

    def _velocity(self, value: int | None) -> int:
        """The velocity 1–127 of a report's byte."""
        if value is None:
            return UNTOLD_VELOCITY
        softest, hardest = self._layout.softest, self._layout.hardest
        share = (value - softest) / (hardest - softest)
        return max(1, min(_GREATEST, int(share * _GREATEST + 0.5)))


class KeyReader:
    """Reads a keyboard's reports: `[01] modifiers 00 k1 … k6`, where k are the keys that are down."""

    def __init__(self) -> None:
        self._report = b""
        self._down: frozenset[int] = frozenset()

    def read(self, report: bytes) -> ReportNews:
        """What `report` brings."""
        body, is_news = _body(report, _KEYBOARD_BYTES, _KEYBOARD_ID)
        if not body:
            return _NOTHING
        keys = {key for key in body[2:] if key >= _FIRST_KEY}
        keys |= {_FIRST_MODIFIER + bit for bit in range(_MODIFIERS) if body[0] >> bit & 1}
        new = sorted(keys - self._down) if is_news else []
        self._report, self._down = body, frozenset(keys)
        return ReportNews([], [f"key={key}" for key in new])

    def stands(self) -> bytes:
        """See `ReportReader`."""
        return _STANDS + self._report if self._report else b""


def reader_of(reports: str) -> ReportReader:
    """A reader for the table that a `DeviceMap` calls `reports`."""
    return KeyReader() if reports == KEYS else DrumReader(LAYOUTS[reports])


class ReportMessages:
    """The strokes in a device's reports as MIDI messages: what a `MidiTokenizer` is to a MIDI kit."""

    def __init__(self, reports: str) -> None:
        self._reader = reader_of(reports)

    def feed(self, data: bytes) -> list[bytes]:
        """The messages that the report `data` brings."""
        return self._reader.read(data).messages


class HidDecoder:
    """One HID device's state, and what its reports mean."""

    def __init__(self, preset: DeviceMap, device: str = "") -> None:
        self.preset = preset
        self.device = device
        self._notes = MidiDecoder(preset, device)
        self._reader = reader_of(preset.reports)

    def reset(self) -> None:
        """Start afresh, as after it was unplugged."""
        self._notes.reset()
        self._reader = reader_of(self.preset.reports)

    def restart_state(self) -> bytes:
        """Bytes that bring a new decoder to this one's state, as a capture begins."""
        return self._reader.stands()

    def feed(self, data: bytes, at_ns: int) -> list[DeviceEvent]:
        """The events in the report `data`, come at `at_ns`."""
        news = self._reader.read(data)
        events = self._notes.feed(b"".join(news.messages), at_ns)
        return [*events, *(Switched(at_ns, switch, self.device) for switch in news.switches)]


# --- one report -------------------------------------------------------------------------------------------------------


def _body(report: bytes, size: int, prefix: bytes) -> tuple[bytes, bool]:
    """The `size` bytes of `report` without what may stand before them, empty where it is none; and whether it is news.

    `prefix` is the report's number that some systems pass on.
    """
    if len(report) == size:
        return report, True
    if len(report) == size + 1 and report[:1] in (prefix, _STANDS):
        return report[1:], report[:1] != _STANDS
    return b"", False


def _bits_of(report: bytes) -> int:
    """The buttons, with the hat as two bits more."""
    hat = report[2]
    return report[0] | report[1] << 8 | (UP if hat in HAT_UP else 0) | (DOWN if hat in HAT_DOWN else 0)


def _struck(layout: DrumLayout, bits: int, report: bytes) -> dict[Lane, int | None]:
    """The lanes that stand in a report, each with the byte of its velocity, None where there is none."""
    coloured = _coloured(layout, bits)
    lanes = [*(lane for lane in layout.plain if bits & lane.bits), *coloured]
    struck = {lane: None if lane.velocity_at is None else report[lane.velocity_at] for lane in lanes}
    for colour in layout.cymbals:
        if {layout.pads[colour], layout.cymbals[colour]} <= set(coloured) and not bits & RED:
            struck[layout.cymbals[colour]] = report[layout.pads[RED].velocity_at or 0]
    if layout.stomp is not None and all(report[at] == value for at, value in STOMP_MESSAGE):
        return {layout.stomp if lane.note == layout.stomps_on else lane: hard for lane, hard in struck.items()}
    return struck


def _coloured(layout: DrumLayout, bits: int) -> list[Lane]:
    """The pads and cymbals that a colour and its flags tell."""
    colours = [colour for colour in layout.pads if bits & colour]
    has_pads, has_cymbals = bool(bits & layout.pad_flag), bool(bits & layout.cymbal_flag)
    if not (has_pads or has_cymbals):
        return [layout.unflagged[colour] for colour in colours]
    pads, cymbals = colours if has_pads else [], colours if has_cymbals else []
    if has_pads and has_cymbals:
        marked = layout.marks[bits & (UP | DOWN)]
        cymbals = [colour for colour in colours if colour == marked]
        pads = [colour for colour in colours if colour != marked] or cymbals
    return [
        *(layout.pads[colour] for colour in pads),
        *(layout.cymbals[colour] for colour in cymbals if colour in layout.cymbals),
    ]
