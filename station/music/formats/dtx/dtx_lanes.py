"""Which channel of a DTX chart is which drum, and which drums have none."""

from collections.abc import Mapping
from types import MappingProxyType

from station.core.note_map import GENERAL_MIDI, NoteMeaning
from station.core.pieces import Limb, Piece

BAR_LENGTH, TEMPO_HEX, TEMPO_NAMED = 0x02, 0x03, 0x08
LEFT_CRASH, CRASH, LEFT_BASS, HAT_OPEN = 0x1A, 0x16, 0x1C, 0x18

LANES: Mapping[int, NoteMeaning] = MappingProxyType(
    {
        0x11: GENERAL_MIDI[42],
        0x12: GENERAL_MIDI[38],
        0x13: GENERAL_MIDI[36],
        0x14: GENERAL_MIDI[50],
        0x15: GENERAL_MIDI[48],
        CRASH: GENERAL_MIDI[57],
        0x17: GENERAL_MIDI[43],
        HAT_OPEN: GENERAL_MIDI[46],
        0x19: GENERAL_MIDI[51],
        LEFT_CRASH: GENERAL_MIDI[49],
        0x1B: GENERAL_MIDI[44],
        LEFT_BASS: GENERAL_MIDI[36],
    }
)
"""What a chip of each channel strikes. A chart without a left crash has one crash: it is `crash_1`."""

LIMBS: Mapping[int, Limb] = MappingProxyType({LEFT_BASS: Limb.LEFT_FOOT})
"""The channels that say who plays."""

STAND_INS: Mapping[Piece, Piece] = MappingProxyType(
    {
        Piece.SPLASH: Piece.CRASH_1,
        Piece.CHINA: Piece.CRASH_2,
        Piece.RIDE_2: Piece.RIDE,
        Piece.TOM_3: Piece.TOM_2,
        Piece.TOM_4: Piece.TOM_2,
        Piece.FLOOR_TOM_2: Piece.FLOOR_TOM_1,
    }
)
"""What has no channel, and the nearest that has one; percussion has none."""

LANE_OF: Mapping[Piece, int] = MappingProxyType(
    {strike.piece: lane for lane, strike in LANES.items() if lane not in (HAT_OPEN, LEFT_BASS)}
)
