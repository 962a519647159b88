"""What the struck instruments do: cymbals rock, wobble and shiver, drums shake, heads ripple, all flash.

A cymbal rocks on its felts as a pendulum whose rate falls with its size (HUMANS: 14″ .68–.92 Hz … 20″ .48–.66, decay
1–2 s), while the way it tips goes slowly round; right after a stroke on the edge it also shivers. A drum's shell shakes
quickly and little. Strokes are aimed at a piece at rest, so between two strokes it goes through whole half swings, a
little quicker or slower than by itself: at every stroke the struck surface lies exactly where the stick meets it. A
hand that chokes a cymbal, or a foot that shuts the hi-hat, ends the swing.
"""

import cmath
import math
from bisect import bisect_right
from dataclasses import dataclass
from math import exp, sin

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.motion.kit.kit import Kit
from station.motion.kit.piece import KitPiece
from station.motion.kit.swing_room import INCH_M, hardest_rad, swing_room
from station.music.score import Score

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True, slots=True)
class _Rocking:
    """How one kind of piece answers: its own rate and decay, and how fast the way it tips goes round."""

    hz: float
    decay_s: float
    round_rad_s: float = 0.0


_REFERENCE_M = 8 * INCH_M
_CYMBAL = _Rocking(0.70, 1.4, math.radians(35.0))
"""Of a 16″ cymbal: rate and decay the middles of HUMANS' ranges; how fast it goes round is our choice, by eye."""
_SLOWS = 0.95
"""The rate falls with this power of the size, which meets HUMANS' middles from 14″ to 20″ (calculated)."""
_SHIVER, _SHIVER_HZ, _SHIVER_DECAY_S = 0.10, 11.0, 0.10
"""The edge shivers by this share of the swing, so fast and so long (our choice, by eye)."""
_DRUM, _DRUM_RAD = _Rocking(9.0, 0.12), math.radians(0.8)
"""A rack tom shakes on its arm (our choice; the thesis, § 3.3.1, calls it very subtle)."""
_LOUDNESS = 2.0
"""Swing follows the stroke's sound, 40·log10(v/127) dB (HUMANS): the square of the velocity."""
_OFF_EDGE = 2.0
"""Nearer the middle the lever is shorter and the stick's tip pushes less than its shoulder: the share of the radius to
this power. So a ride's bow moves by a third of its edge (our choice)."""
_SHUT = 0.05
"""The share of an open hi-hat's swing that a shut one has (our choice)."""
_KEPT = 0.5
"""The share of its motion that a cymbal keeps under the next stroke (our choice)."""
_SOONEST_S = 1e-3
"""Strokes nearer to one another are one push after the other (our choice)."""

_FLASH_DECAY_S = 0.12
RIPPLE_M, _RIPPLE_DECAY_S = 0.008, 0.10
"""A head gives way by 8 mm under the hardest stroke, 5 m/s (HUMANS: calculated), and is quiet again after a
few pictures (our choice, by eye)."""

_DECAYS = 9.2
"""After so many decays a ten-thousandth is left: the piece is still."""
NUMBERS = 7
"""How many `Instrument.at` says."""
_STILL = (0.0,) * NUMBERS


@dataclass(frozen=True, eq=False)
class Instrument:
    """One piece's response, stroke by stroke.

    `times_s`; `tip` (radians about the right axis, and about the away axis as the imaginary part) and `turn_rad_s` of
    the swing after each, `shiver` and `shiver_rad_s` of its quick part; `force` 0–1; `spot_m` where it was struck, from
    the centre along both axes. `fades` the swing's decay and how fast it goes round, `rings_s` how long it lasts.
    """

    times_s: list[float]
    tip: list[complex]
    turn_rad_s: list[float]
    shiver: list[complex]
    shiver_rad_s: list[float]
    force: list[float]
    spot_m: list[tuple[float, float]]
    fades: complex
    drum: bool
    rings_s: float

    def at(self, time_s: float) -> tuple[float, ...]:
        """Tip about the piece's right and away axes; flash 0 … 1; how deep the head is pressed, where, since when."""
        i = bisect_right(self.times_s, time_s) - 1
        if i < 0:
            return _STILL
        ago = time_s - self.times_s[i]
        if ago > self.rings_s:
            return _STILL
        tip = self.tip[i] * cmath.exp(self.fades * ago) * sin(self.turn_rad_s[i] * ago)
        flash = self.force[i] * exp(-ago / _FLASH_DECAY_S)
        if self.drum:
            return (
                tip.real,
                tip.imag,
                flash,
                RIPPLE_M * self.force[i] * exp(-ago / _RIPPLE_DECAY_S),
                *self.spot_m[i],
                ago,
            )
        tip += self.shiver[i] * exp(-ago / _SHIVER_DECAY_S) * sin(self.shiver_rad_s[i] * ago)
        return tip.real, tip.imag, flash, 0.0, 0.0, 0.0, 0.0


@dataclass(frozen=True, eq=False)
class _Strokes:
    """What happens to one piece, in order: when (n,), how loud 0–127, where (n, 3), and the share that may swing."""

    time_s: Array
    velocity: Array
    point_m: Array
    free: Array


def instruments(score: Score, kit: Kit, onset_s: Array, strike_m: Array) -> list[Instrument]:
    """The response of every piece of `kit`, in its order, to the strokes at `strike_m` (n, 3)."""
    notes = score.notes
    played = np.array([kit.stand_in_table[p] for p in notes["piece"].tolist()], np.int64)
    ends = score.tempo_map.seconds_at(notes["tick"] + notes["choke_ticks"])
    room = swing_room(kit)
    result = []
    for piece in kit.pieces.values():
        rows = np.flatnonzero(played == piece.piece)
        choked = rows[score.is_choked[rows]]
        free = np.ones(len(rows))
        if piece.kind == "hihat":
            open_share = np.nan_to_num(notes["openness"][rows].astype(np.float64))
            free = _SHUT + (1 - _SHUT) * open_share
            free[notes["piece"][rows] == Piece.HIHAT_PEDAL] = 0.0
        strokes = _Strokes(
            np.concatenate((onset_s[rows], ends[choked])),
            np.concatenate((notes["velocity"][rows].astype(np.float64), np.zeros(len(choked)))),
            np.concatenate((strike_m[rows], strike_m[choked])),
            np.concatenate((free, np.zeros(len(choked)))),
        )
        order = np.argsort(strokes.time_s, kind="stable")
        ordered = _Strokes(*(getattr(strokes, name)[order] for name in ("time_s", "velocity", "point_m", "free")))
        result.append(_instrument(piece, ordered, room.get(piece.piece, _DRUM_RAD)))
    return result


def _instrument(piece: KitPiece, strokes: _Strokes, room_rad: float) -> Instrument:
    """The response of `piece`, which never tips farther than `room_rad`."""
    cymbal = piece.kind in ("cymbal", "hihat")
    rocking, size = (_CYMBAL, piece.radius_m / _REFERENCE_M) if cymbal else (_DRUM, 1.0)
    own_rad_s = 2 * math.pi * rocking.hz / size**_SLOWS
    fades = complex(-1 / rocking.decay_s, rocking.round_rad_s)
    x, y, way, lever = _lever(piece, strokes.point_m)
    force = strokes.velocity / 127
    share = strokes.free * force**_LOUDNESS * (lever**_OFF_EDGE if cymbal else 1.0)
    hardest = hardest_rad(piece) if cymbal else _DRUM_RAD
    gaps = np.maximum(np.diff(strokes.time_s, append=np.inf), _SOONEST_S)
    turn, halves = _whole_halves(own_rad_s, gaps)
    keeps = np.where(strokes.free[1:] > 0, _KEPT, 0.0) * np.exp(fades * gaps[:-1]) * (1 - 2 * (halves[:-1] % 2))
    most = room_rad / (1 + _SHIVER) / _first_swing(turn, rocking.decay_s) * turn
    pushes = hardest / float(_first_swing(np.array(own_rad_s), rocking.decay_s)) * own_rad_s * share * way
    shiver = _SHIVER * np.minimum(hardest * share, room_rad) * way
    return Instrument(
        strokes.time_s.tolist(),
        (_speeds(pushes.tolist(), keeps.tolist(), most.tolist()) / turn).tolist(),
        turn.tolist(),
        shiver.tolist(),
        _whole_halves(2 * math.pi * _SHIVER_HZ, gaps)[0].tolist(),
        force.tolist(),
        list(zip(x.tolist(), y.tolist(), strict=True)),
        fades,
        not cymbal,
        _DECAYS * rocking.decay_s,
    )


def _lever(piece: KitPiece, point_m: Array) -> tuple[Array, Array, Complex, Array]:
    """Points (n, 3) along both axes; which way a push down there tips, a unit; and how far out they are, 0–1."""
    right, away, _ = piece.axes
    x, y = (point_m - piece.centre) @ right, (point_m - piece.centre) @ away
    far = np.hypot(x, y)
    # a push down on the near side (−away) tips the near edge down: positive about the piece's right axis
    way = np.where(far > 0, (-y + 1j * x) / np.maximum(far, 1e-9), 1.0)
    return x, y, way, np.minimum(far / piece.radius_m, 1.0)


def _speeds(pushes: list[complex], keeps: list[complex], most: list[float]) -> Complex:
    """How fast the piece tips after each push, radians a second: the push and what it `keeps` from before."""
    speeds = []
    speed = 0j
    for push, keep, limit in zip(pushes, [0j, *keeps], most, strict=False):
        speed = push + keep * speed
        speed *= min(1.0, limit / max(abs(speed), 1e-12))
        speeds.append(speed)
    return np.array(speeds, np.complex128)


def _whole_halves(own_rad_s: float, gap_s: Array) -> tuple[Array, Array]:
    """The rates nearest to `own_rad_s` that bring a swing back through rest at the end of each gap, by whole halves."""
    halves = np.maximum(np.rint(gap_s * own_rad_s / math.pi), 1.0)
    endless = np.isinf(gap_s)
    return np.where(endless, own_rad_s, math.pi * np.where(endless, 0.0, halves) / gap_s), halves


def _first_swing(rad_s: Array, decay_s: float) -> Array:
    """The greatest value of e^(−t/decay) sin(rate·t), at its first crest."""
    phase = np.arctan(rad_s * decay_s)
    return np.asarray(np.exp(-phase / (rad_s * decay_s)) * np.sin(phase))
