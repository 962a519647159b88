"""Which HID devices the station knows, and which byte and bit of their reports means what: tables.

A drum kit's report has 27 bytes: buttons in 0 and 1, the hat in 2 (0 up, clockwise, 8 at rest), pressures in 7–18. Raw
Windows puts a 00 before them. A pad that is struck sets its bit for some milliseconds; the pressure of a button is how
hard. A lane is what can be struck; it goes by a MIDI note of its own, so that all else (what it means, learning it,
its threshold and curve, a capture's replay) is as with any kit.

Sources: TheNathannator/PlasticBand, Docs/Instruments "4-Lane Drums/PS3 and Wii", "4-Lane Drums/General Notes",
"5-Lane Drums/PS3", "5-Lane Drums/General Notes" (the notes of Guitar Hero kits) and Docs/Other "MIDI Pro Adapters";
RPCS3 RB3MidiDrums.cpp (velocity, second pedal). USB HID 1.11, appendix B.1 (keyboard report), and HID Usage Tables.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import NamedTuple

SQUARE, CROSS, CIRCLE, TRIANGLE, L1, R1 = (1 << bit for bit in range(6))
SELECT, START, L3, R3, PS = (1 << bit for bit in range(8, 13))
UP, DOWN = 1 << 16, 1 << 17
"""The hat as two bits of its own; see `DrumReader`."""
HAT_UP, HAT_DOWN = frozenset({7, 0, 1}), frozenset({3, 4, 5})
"""The hat's values that count as up and as down."""

DRUM_REPORT_BYTES = 27
"""Of every drum kit's report."""


class Lane(NamedTuple):
    """What can be struck: the `note` it goes by, the `bits` that it sets, and the byte that says how hard.

    `velocity_at` is None where nothing does.
    """

    note: int
    bits: int
    velocity_at: int | None = None


@dataclass(frozen=True, slots=True)
class DrumLayout:
    """The lanes of one kind of kit.

    `plain` lanes have a bit of their own. Of `colours` each says which colour was struck, while `pad_flag`
    and `cymbal_flag` say which kind: `pads` and `cymbals` are the lanes by colour, `unflagged` those of a kit that has
    no flags. `marks` says which colour's cymbal each position of the hat means (0: the hat rests). Velocities from
    `hardest` to `softest`, in either direction. `stomp` is the lane of a foot that a MIDI message in the report tells
    from the lane `stomps_on`, None where there is none.
    """

    plain: tuple[Lane, ...]
    hardest: int
    softest: int
    pads: Mapping[int, Lane] = field(default_factory=lambda: MappingProxyType({}))
    cymbals: Mapping[int, Lane] = field(default_factory=lambda: MappingProxyType({}))
    unflagged: Mapping[int, Lane] = field(default_factory=lambda: MappingProxyType({}))
    marks: Mapping[int, int] = field(default_factory=lambda: MappingProxyType({}))
    pad_flag: int = 0
    cymbal_flag: int = 0
    stomp: Lane | None = None
    stomps_on: int = 0


RED, YELLOW, BLUE, GREEN = CIRCLE, TRIANGLE, SQUARE, CROSS

ROCK_BAND = DrumLayout(
    plain=(Lane(36, L1), Lane(35, R1)),
    hardest=0,
    softest=255,
    pads=MappingProxyType(
        {
            RED: Lane(38, RED | L3, 12),
            YELLOW: Lane(48, YELLOW | L3, 11),
            BLUE: Lane(45, BLUE | L3, 14),
            GREEN: Lane(43, GREEN | L3, 13),
        }
    ),
    cymbals=MappingProxyType(
        {
            YELLOW: Lane(46, YELLOW | R3 | UP, 11),
            BLUE: Lane(51, BLUE | R3 | DOWN, 14),
            GREEN: Lane(49, GREEN | R3, 13),
        }
    ),
    unflagged=MappingProxyType(
        {RED: Lane(38, RED), YELLOW: Lane(2, YELLOW), BLUE: Lane(3, BLUE), GREEN: Lane(4, GREEN)}
    ),
    marks=MappingProxyType({UP: YELLOW, DOWN: BLUE, 0: GREEN}),
    pad_flag=L3,
    cymbal_flag=R3,
)
"""Notes 2 to 4 are the coloured pads of first-generation kits, which tell neither pad from cymbal nor how hard."""

GUITAR_HERO = DrumLayout(
    plain=(
        Lane(36, L1, 15),
        Lane(38, CIRCLE, 12),
        Lane(46, TRIANGLE, 11),
        Lane(48, SQUARE, 14),
        Lane(49, R1, 16),
        Lane(45, CROSS, 13),
    ),
    hardest=127,
    softest=0,
    stomp=Lane(100, L1, 15),
    stomps_on=36,
)

STOMP_MESSAGE = ((5, 0x99), (19, 100))
"""Byte and value: beside the kick's bit, a hi-hat pedal has the beginning of its own MIDI message (99 64) there."""

LAYOUTS: Mapping[str, DrumLayout] = MappingProxyType({"rock-band": ROCK_BAND, "guitar-hero": GUITAR_HERO})
"""The drum kits' tables by the name that a `DeviceMap` calls them by."""

KEYS = "keys"
"""What a `DeviceMap` calls the report of a keyboard, which foot switches send."""

BUTTONS: Mapping[int, int] = MappingProxyType({SELECT: 9, START: 10, PS: 13})
"""A drum kit's buttons that no pad shares, by their numbers on the HID button page: the report's bits, from 1."""


class HidDevice(NamedTuple):
    """A device that is known: its `title`, from which its preset follows, and the usage (page, number) it speaks as.

    `usage` is None where the device has but one.
    """

    title: str
    usage: tuple[int, int] | None = None


KEYBOARD_USAGE = (1, 6)
"""Generic desktop, keyboard (HID Usage Tables): a pedal is a mouse and a thing to be programmed besides."""
_PEDAL = HidDevice("Foot switch (PCsensor)", KEYBOARD_USAGE)

HID_DEVICES: Mapping[tuple[int, int], HidDevice] = MappingProxyType(
    {
        (0x12BA, 0x0210): HidDevice("Rock Band drums (PS3)"),
        (0x12BA, 0x0218): HidDevice("Rock Band MIDI Pro (PS3)"),
        (0x1BAD, 0x0005): HidDevice("Rock Band drums 1 (Wii)"),
        (0x1BAD, 0x3110): HidDevice("Rock Band drums (Wii)"),
        (0x1BAD, 0x3138): HidDevice("Rock Band MIDI Pro (Wii)"),
        (0x12BA, 0x0120): HidDevice("Guitar Hero drums (PS3)"),
        (0x0C45, 0x7403): _PEDAL,
        (0x0C45, 0x7404): _PEDAL,
        (0x413D, 0x2107): _PEDAL,
        (0x1A86, 0xE026): _PEDAL,
        (0x3553, 0xB001): _PEDAL,
    }
)
"""By vendor and product; no other HID device is ever opened."""
