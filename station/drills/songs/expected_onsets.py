"""What a score lets one expect of a sound: in which band each moment of it starts, and how surely."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import CYMBALS, TOMS, Piece
from station.core.units import PPQ
from station.music.score import Score
from station.music.sound_onsets import OnsetBand

Floats = NDArray[np.float64]

_LOW, _MID, _HIGH = OnsetBand
_CYMBAL = MappingProxyType({_HIGH: 1.0})
_TOM = MappingProxyType({_LOW: 0.4, _MID: 0.6})
BANDS_OF: Mapping[Piece, Mapping[OnsetBand, float]] = MappingProxyType(
    {
        **dict.fromkeys(Piece, MappingProxyType({_MID: 0.5, _HIGH: 0.5})),
        **dict.fromkeys(CYMBALS | {Piece.HIHAT, Piece.HIHAT_PEDAL}, _CYMBAL),
        **dict.fromkeys(TOMS, _TOM),
        Piece.KICK: MappingProxyType({_LOW: 1.0, _MID: 0.4}),
        Piece.SNARE: MappingProxyType({_MID: 0.8, _HIGH: 0.7}),
        Piece.HIHAT_PEDAL: MappingProxyType({_HIGH: 0.4}),
    }
)
"""How surely a stroke starts each band (our choice, by where these instruments sound; see `OnsetBand`)."""

_SOFT = 0.4
"""Of a stroke's weight at velocity 40 and below, a ghost note: it hides under the band (our choice)."""

_SOFT_VELOCITY, _FULL_VELOCITY = 40, 80

_HALF_BEAT = PPQ // 2

_PULSES = (0.2, 0.1)
"""What the rest of the band is expected to start on a beat, and between two: so it is followed where the drums rest
(our choice: a fifth of a stroke, so that it never outvotes the drums)."""

PULSE = len(Piece)
"""The source of what nobody has written."""

_PULSE_BANDS = (_LOW, _MID)


@dataclass(frozen=True, eq=False)
class ExpectedOnsets:
    """`tick` (n,) rising, `band` (n,) and `weight` (n,): how much an attack there, in that band, is expected.

    `source` (n,) tells apart what may lean to another side of the beat: the pieces, and `PULSE`, the rest of the band.
    """

    tick: NDArray[np.int64]
    band: NDArray[np.int64]
    weight: Floats
    source: NDArray[np.int64]


def expected_onsets(score: Score, end_tick: int, first_tick: int = 0) -> ExpectedOnsets:
    """What is expected of the sound from `first_tick` to before `end_tick`: one value for each tick and band.

    Grace strokes are left out.
    """
    found: dict[tuple[int, int], tuple[float, int]] = {}
    main = score.notes[~score.is_grace & (score.notes["tick"] < end_tick) & (score.notes["tick"] >= first_tick)]
    for tick, piece, velocity in zip(*(main[name].tolist() for name in ("tick", "piece", "velocity")), strict=True):
        loud = float(np.interp(velocity, (_SOFT_VELOCITY, _FULL_VELOCITY), (_SOFT, 1.0)))
        for band, weight in BANDS_OF[Piece(piece)].items():
            found[tick, band] = max(found.get((tick, band), _NOTHING), (loud * weight, piece))
    for half_beat in range(-(-first_tick // _HALF_BEAT), -(-end_tick // _HALF_BEAT)):
        for band in _PULSE_BANDS:
            found.setdefault((half_beat * _HALF_BEAT, band), (_PULSES[half_beat % 2], PULSE))
    keys = sorted(found)
    ticks, bands = np.array(keys, np.int64).reshape(-1, 2).T
    weights, sources = np.array([found[key] for key in keys], np.float64).reshape(-1, 2).T
    return ExpectedOnsets(ticks, bands, weights, sources.astype(np.int64))


_NOTHING = (0.0, -1)


_SHRINK = 20
"""A lean of so few attacks is believed by half (our choice)."""


def leans(expected: ExpectedOnsets, late_s: Floats) -> Floats:
    """How much later than the drums together each expected onset's source sounds in its band, in s: (n,).

    `late_s` (n,) is what each attack that was found is later than the beat, NaN where none was. A guitar is strummed
    after the kick, a drummer's hats run ahead: where only some of them play, the beat stays where it is with all.
    """
    beat = expected.tick // PPQ
    is_drum = expected.source != PULSE
    is_seen = np.isfinite(late_s) & np.isin(beat, np.unique(beat[is_drum]))
    kind = expected.source * _KINDS + expected.band
    lean = np.zeros((PULSE + 1) * _KINDS)
    for one in np.unique(kind[is_seen]).tolist():
        late = late_s[is_seen & (kind == one)]
        lean[one] = float(np.median(late)) * len(late) / (len(late) + _SHRINK)
    leaning = lean[kind]
    weight = expected.weight * (is_seen & is_drum)
    common = float(np.sum(weight * leaning) / np.sum(weight)) if weight.any() else 0.0
    return np.asarray(np.where(is_seen.any(), leaning - common, 0.0)) if weight.any() else np.zeros(len(beat))


_KINDS = len(OnsetBand)
