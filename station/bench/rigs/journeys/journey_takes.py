"""Takes: what somebody plays on a way through a score, and the truth of it.

Playing time is the written time of all legs one after the other; the player's speed makes real time of it.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.bench.rigs.journeys.journey_ways import Leg, Rng
from station.core.pieces import Limb, Piece
from station.core.units import NS_PER_MS, NS_PER_S
from station.music.performance import HIT_DTYPE, Performance
from station.music.score import Score

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]
Flags = NDArray[np.bool_]

_AR_LAG_1 = 0.3
"""HUMANS: lag-1 of professionals' asynchronies about .21 to .37."""
_GRACE_SD_MS, _CLOSEST_GRACE_MS = 4.0, 8.0
"""A grace stroke leads its main stroke by the written time, near enough, and always leads (HUMANS: 15-40 ms)."""
_DRIFT_PERIOD_S = 60.0
_VELOCITY_SD = 8.0
"""HUMANS: a coefficient of variation of 6-10 % for professionals."""
_BOUNCE_S, _BOUNCE_LOUD = (0.05, 0.11), 0.6
"""A stick that bounces strikes again so much later (HUMANS: 50-90 ms) and softer; our choice."""


@dataclass(frozen=True, slots=True)
class Player:
    """How they play.

    `speed` of the written tempo; `drift` depth of a slow sine (or, `ramps`, of a change from one end to the other);
    `sd_ms`, and shares of strokes that are missing, extra, on another piece, or doubled by a bounce.
    """

    speed: float = 1.0
    drift: float = 0.0
    ramps: bool = False
    sd_ms: float = 15.0
    missing: float = 0.03
    extra: float = 0.03
    wrong_piece: float = 0.02
    doubled: float = 0.0


@dataclass(frozen=True, eq=False)
class Journey:
    """Who plays what on which way; the first of the `legs` begins at `start_s`. `passes` of a lesson, else 0.

    `own_s` (n,) the asynchronies of the drummer who played the score's notes, instead of noise, else None.
    """

    name: str
    score: Score
    legs: tuple[Leg, ...]
    player: Player
    clocked: bool
    start_s: float
    passes: int = 0
    own_s: Floats | None = None


@dataclass(frozen=True, eq=False, kw_only=True)
class Take(Journey):
    """What was played on a journey and the truth of it.

    `meant` (m,) the note that each hit was for, −1 for an extra; `is_wrong` (m,) on another piece; `leg` (m,) of each
    hit; `true_ns` (m,) the hit brought to score time by the true path and tempo.
    """

    performance: Performance
    meant: Indices
    is_wrong: Flags
    leg: Indices
    true_ns: Indices

    @property
    def right_note(self) -> Indices:
        """The note that each hit plays rightly (m,), −1 where there is none."""
        return np.where(self.is_wrong, -1, self.meant)


@dataclass(frozen=True, eq=False)
class Warp:
    """Playing time and real time, in seconds, on one fine grid of both (k,)."""

    playing_s: Floats
    real_s: Floats

    @classmethod
    def of(cls, player: Player, ends_s: Floats, speeds: Floats) -> "Warp":
        """The warp of a player over legs that end at these instants of playing time, at speeds of their own."""
        length_s = float(ends_s[-1])
        grid = np.arange(-2.0, length_s + 2.0, 0.02)
        share = np.clip(grid / length_s, 0.0, 1.0)
        lean = 2 * share - 1 if player.ramps else np.sin(2 * np.pi * grid / _DRIFT_PERIOD_S)
        of_leg = speeds[np.minimum(np.searchsorted(ends_s, grid, side="right"), len(speeds) - 1)]
        slowness = 1 / (player.speed * of_leg * (1 + player.drift * lean))
        real = np.concatenate([[0.0], np.cumsum((slowness[1:] + slowness[:-1]) / 2 * np.diff(grid))])
        return cls(grid, real - np.interp(0.0, grid, real))

    def real(self, playing_s: Floats) -> Floats:
        """Real time of playing time."""
        return np.interp(playing_s, self.playing_s, self.real_s)

    def playing(self, real_s: Floats) -> Floats:
        """Playing time of real time."""
        return np.interp(real_s, self.real_s, self.playing_s)


def ar_noise(rng: Rng, count: int, sd: float) -> Floats:
    """A stationary first-order series of `count` values with this standard deviation and lag-1 `_AR_LAG_1`."""
    steps = rng.normal(0.0, sd * np.sqrt(1 - _AR_LAG_1**2), count)
    values = np.empty(count)
    last = rng.normal(0.0, sd)
    for i, step in enumerate(steps):
        last = _AR_LAG_1 * last + step
        values[i] = last
    return values


@dataclass(frozen=True, eq=False)
class Course:
    """A journey in time: of each leg the written start, the length and the start in playing time, and its silences."""

    firsts_s: Floats
    lengths_s: Floats
    begins_s: Floats
    waited_s: Floats
    warp: Warp

    @classmethod
    def of(cls, way: Journey) -> "Course":
        """Where the legs of a journey lie in time."""
        tick_s = way.score.tempo_map.seconds_at
        firsts = np.array([float(tick_s(leg.first)) for leg in way.legs])
        lengths = np.array([float(tick_s(leg.last)) for leg in way.legs]) - firsts
        ends = np.cumsum(lengths)
        waited = way.start_s + np.cumsum([leg.wait_s for leg in way.legs])
        warp = Warp.of(way.player, ends, np.array([leg.speed for leg in way.legs]))
        return cls(firsts, lengths, ends - lengths, waited, warp)

    def real_s(self, leg: Indices, into_leg_s: Floats) -> Floats:
        """The real time of what is written so long after the beginning of its leg."""
        return self.warp.real(self.begins_s[leg] + into_leg_s) + self.waited_s[leg]

    def score_s(self, leg: Indices, real_s: Floats) -> Floats:
        """The written time of what is played then."""
        return self.warp.playing(real_s - self.waited_s[leg]) - self.begins_s[leg] + self.firsts_s[leg]


def perform(rng: Rng, way: Journey) -> Take:
    """What is played on the way."""
    score, player, course = way.score, way.player, Course.of(way)
    tick = score.notes["tick"]
    inside = [np.flatnonzero((tick >= leg.first) & (tick < leg.last)) for leg in way.legs]
    meant, leg = np.concatenate(inside), np.repeat(np.arange(len(inside)), [len(rows) for rows in inside])
    due_s = course.real_s(leg, score.tempo_map.seconds_at(tick[meant]) - course.firsts_s[leg])
    late_s = _asynchrony_s(rng, score, meant, due_s, player.sd_ms) if way.own_s is None else way.own_s[meant]

    kept = rng.random(len(meant)) >= player.missing
    meant, leg, at_s = meant[kept], leg[kept], (due_s + late_s)[kept]
    piece = score.notes["piece"][meant].copy()
    is_wrong = rng.random(len(meant)) < player.wrong_piece
    piece[is_wrong] = [_other_piece(rng, score, int(p)) for p in piece[is_wrong]]
    velocity = score.notes["velocity"][meant] + rng.normal(0.0, _VELOCITY_SD, len(meant))

    bounced = np.flatnonzero(rng.random(len(meant)) < player.doubled)
    bounce_s = at_s[bounced] + rng.uniform(*_BOUNCE_S, len(bounced))
    extras = int(rng.binomial(len(meant), player.extra))
    extra_leg = rng.choice(len(way.legs), extras, p=course.lengths_s / course.lengths_s.sum())
    extra_s = course.real_s(extra_leg, rng.random(extras) * course.lengths_s[extra_leg])
    extra_piece = rng.choice(np.unique(score.notes["piece"]), extras)

    hits = np.zeros(len(at_s) + len(bounced) + extras, HIT_DTYPE)
    at_s, leg = np.concatenate([at_s, bounce_s, extra_s]), np.concatenate([leg, leg[bounced], extra_leg])
    hits["at_ns"] = np.rint(at_s * NS_PER_S).astype(np.int64)
    hits["piece"] = np.concatenate([piece, piece[bounced], extra_piece])
    loud = np.concatenate([velocity, _BOUNCE_LOUD * velocity[bounced], rng.uniform(30, 100, extras)])
    hits["velocity"] = np.clip(np.rint(loud), 1, 127)
    hits["openness"] = hits["position"] = np.nan
    hits["limb"] = Limb.UNKNOWN
    order, unmeant = np.argsort(hits["at_ns"], kind="stable"), len(hits) - len(meant)
    return Take(
        **vars(way),
        performance=Performance.from_array(hits),
        meant=np.concatenate([meant, np.full(unmeant, -1, np.int64)])[order],
        is_wrong=np.concatenate([is_wrong, np.zeros(unmeant, bool)])[order],
        leg=leg[order],
        true_ns=np.rint(course.score_s(leg, at_s) * NS_PER_S).astype(np.int64)[order],
    )


def _asynchrony_s(rng: Rng, score: Score, meant: Indices, due_s: Floats, sd_ms: float) -> Floats:
    """Played − due of each stroke (k,), a grace stroke's lead within it: it goes with its main stroke."""
    noise = ar_noise(rng, len(meant), sd_ms)
    lead = score.notes["lead_ms"][meant].astype(np.float64)
    order = np.lexsort((-lead, due_s))
    noise[order] = noise.copy()
    main = np.full(len(meant), np.nan)
    group = np.unique(np.rint(due_s * 1e6), return_inverse=True)[1] * 32 + score.notes["piece"][meant]
    _, spot = np.unique(group, return_inverse=True)
    main[lead == 0] = noise[lead == 0]
    of_main = np.zeros(int(spot.max(initial=0)) + 1)
    of_main[spot[lead == 0]] = main[lead == 0]
    led = np.maximum(lead + rng.normal(0.0, _GRACE_SD_MS, len(lead)), _CLOSEST_GRACE_MS)
    return np.where(lead > 0, of_main[spot] - led, noise) * NS_PER_MS / NS_PER_S


def _other_piece(rng: Rng, score: Score, piece: int) -> int:
    """Another piece of the score's kit; where it has one alone, what stands beside a snare."""
    others = [int(p) for p in np.unique(score.notes["piece"]) if p != piece]
    return int(rng.choice(others or [Piece.TOM_1, Piece.HIHAT]))
