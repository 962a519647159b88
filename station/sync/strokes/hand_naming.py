"""Which hand struck each hit, by the strokes that the sticks' sensors felt. The written sticking plays no part.

Three steps: candidates of each stick's offset (`stick_offsets`), each weighed by all it explains; the probability of
each stick for each hit (`stroke_matching`); and once more with what the sure ones taught: how a tip's speed becomes a
pad's velocity, how each stick lies when it strikes a piece, and which hand mostly plays it. The last three decide
only what time leaves open, such as two hands at once. A hit is named where the probability is high; else nobody
can tell. Works on whole sessions and on a window of recent hits.
"""

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import fmean, median, pstdev

import numpy as np

from station.core.events import Hit, StickStroke
from station.core.pieces import HAND_PIECES, USUAL_FEET, Limb, Piece
from station.core.units import NS_PER_MS
from station.sync.strokes.stick_offsets import offset_candidates
from station.sync.strokes.stroke_matching import GATE_MS, Matching, Stroke, Weigh, match

SURE = 0.97
"""From this probability on a hand is named: 99 % of the named shall be right, and most are far surer; our choice."""
WIDEST_MS, NARROWEST_MS = 6.0, 0.7
"""Jitter between pads and sensors: a MIDI byte takes 0.3 ms, a sensor's sample 1–10; our choice of bounds."""
USUAL_MS = 2.0
"""Jitter before it is known: HUMANS.md's scan and wire, and half a millisecond's onset; our choice."""
SAMPLE_HITS = 200
"""So many hits weigh the candidates before all do; our choice."""
CLEARLY = 25.0
"""A candidate this much less likely (natural logarithm) on the sample is given up; our choice: e⁻²⁵."""
USUAL_OFFSET_MS = 25.0
"""Spread of the offsets that sensors have before anything is heard; our choice, a guide where all else is equal."""
USUAL_APART_MS = 15.0
"""Spread of the difference between the two sticks' offsets: sensors of one make, a link each; our choice. It decides
only where hands alternate like a machine, so that either may have begun."""
ENOUGH = 8
"""So many sure strokes teach a mean; our choice."""
LEAST_HABIT = 0.05
"""However rarely a hand plays a piece, it may do so now: never surer than 19 to 1; our choice."""


def name_hands(hits: Sequence[Hit], strokes: Sequence[StickStroke]) -> tuple[Limb, ...]:
    """The limb of each hit, `UNKNOWN` where nobody can tell; hits that have one keep it, feet are feet.

    Hits and strokes in any order, in the same time base; strokes in the air and of sticks whose hand is unknown count
    for nothing.
    """
    found = strokes_of_hits(hits, strokes)
    return tuple(limb_of(hit, stroke) for hit, stroke in zip(hits, found, strict=True))


def limb_of(hit: Hit, stroke: StickStroke | None) -> Limb:
    """Who played a hit that `stroke` made, None where nobody can tell."""
    if hit.limb is not Limb.UNKNOWN:
        return hit.limb
    return USUAL_FEET.get(hit.piece, Limb.UNKNOWN) if stroke is None else stroke.limb


def strokes_of_hits(hits: Sequence[Hit], strokes: Sequence[StickStroke]) -> tuple[StickStroke | None, ...]:
    """The stroke that made each hit, None where nobody can tell; hits and strokes as `name_hands` takes them."""
    order = sorted((k for k, hit in enumerate(hits) if hit.piece in HAND_PIECES), key=lambda k: hits[k].at_ns)
    felt = sorted((s for s in strokes if not s.in_air and s.limb.is_hand), key=lambda s: s.at_ns)
    made: list[StickStroke | None] = [None] * len(hits)
    if order and felt:
        for k, stroke in zip(order, _Played([hits[k] for k in order], felt).strokes(), strict=True):
            made[k] = stroke
    return tuple(made)


@dataclass(frozen=True, slots=True)
class _Offsets:
    """One way to lay sensors and pads over each other: an offset a stick, in ms, and how likely (logarithm)."""

    ms: tuple[float, ...]
    log_prior: float


class _Played:
    """Hits of hands and strokes of sticks, each sorted by time."""

    def __init__(self, hits: list[Hit], strokes: list[StickStroke]) -> None:
        self._hits, self._strokes = hits, strokes
        self._zero_ns = min(hits[0].at_ns, strokes[0].at_ns)
        self._hits_ms = [(hit.at_ns - self._zero_ns) / NS_PER_MS for hit in hits]
        self._strokes_ms = [(stroke.at_ns - self._zero_ns) / NS_PER_MS for stroke in strokes]
        self._devices = sorted({stroke.device for stroke in strokes})
        self._stick = [self._devices.index(stroke.device) for stroke in strokes]

    def strokes(self) -> list[StickStroke | None]:
        """The stroke that made each hit, None where no stick is likely enough."""
        weights = self._weighed(self._candidates())
        likeliest = max(weights, key=lambda one: one[0])[1]
        sums: list[dict[int, float]] = [{} for _ in self._hits]
        for weight, found in weights:
            for hit, by_stick in found.by_stick.items():
                for stick, share in by_stick.items():
                    sums[hit][stick] = sums[hit].get(stick, 0.0) + weight * share
        return [self._sure_stroke(of, likeliest.stroke.get(hit)) for hit, of in enumerate(sums)]

    def _sure_stroke(self, of_stick: dict[int, float], likeliest: int | None) -> StickStroke | None:
        if likeliest is None or of_stick.get(self._stick[likeliest], 0.0) < SURE:
            return None
        return self._strokes[likeliest]

    # --- offsets ------------------------------------------------------------------------------------------------------

    def _candidates(self) -> list[_Offsets]:
        """All ways to combine the sticks' candidates."""
        hits = np.array(self._hits_ms)
        found = []
        for stick in range(len(self._devices)):
            own = np.array([at for at, of in zip(self._strokes_ms, self._stick, strict=True) if of == stick])
            found.append(offset_candidates(hits, own) or [0.0])
        return [_Offsets(ms, _log_prior(ms)) for ms in itertools.product(*found)]

    def _weighed(self, candidates: list[_Offsets]) -> list[tuple[float, Matching]]:
        """The candidates that stay, each with its probability and its final matching."""
        until_ms = self._hits_ms[min(SAMPLE_HITS, len(self._hits)) - 1]
        if len(candidates) > 1 and len(self._hits) > SAMPLE_HITS:
            trials = [self._match(c, USUAL_MS, _any, until_ms).log_likelihood + c.log_prior for c in candidates]
            candidates = [c for c, trial in zip(candidates, trials, strict=True) if trial > max(trials) - CLEARLY]
        found = [self._learnt(candidate) for candidate in candidates]
        # The spread of n residuals is itself uncertain, by 1/√2n: so much of the likelihood is chance, and worth less.
        worth = 1.0 / max(1.0, math.sqrt(len(self._hits) / 2) / 2)
        logs = [worth * one.log_likelihood + c.log_prior for one, c in zip(found, candidates, strict=True)]
        shares = [math.exp(log - max(logs)) for log in logs]
        return [(share / sum(shares), one) for share, one in zip(shares, found, strict=True)]

    # --- matching -----------------------------------------------------------------------------------------------------

    def _match(self, offsets: _Offsets, jitter_ms: float, weigh: Weigh, until_ms: float = math.inf) -> Matching:
        strokes = [
            Stroke(at + offsets.ms[stick], k, stick)
            for k, (at, stick) in enumerate(zip(self._strokes_ms, self._stick, strict=True))
        ]
        near = sorted(stroke for stroke in strokes if stroke.at_ms <= until_ms + GATE_MS)
        return match([at for at in self._hits_ms if at <= until_ms], near, jitter_ms, weigh)

    def _learnt(self, offsets: _Offsets) -> Matching:
        """The matching once more, with jitter, offsets and habits as the first one shows them."""
        first = self._match(offsets, USUAL_MS, _any)
        sure = self._sure(first)
        if len(sure) < ENOUGH:
            return first
        moved = []
        for stick, offset in enumerate(offsets.ms):
            own = [self._hits_ms[h] - self._strokes_ms[s] for h, s in sure if self._stick[s] == stick]
            moved.append(median(own) if own else offset)
        apart = [abs(self._hits_ms[h] - self._strokes_ms[s] - moved[self._stick[s]]) for h, s in sure]
        jitter_ms = min(max(1.4826 * median(apart), NARROWEST_MS), WIDEST_MS)
        weigh = _Habits.of([(self._hits[h], self._strokes[s]) for h, s in sure])
        return self._match(
            _Offsets(tuple(moved), offsets.log_prior),
            jitter_ms,
            lambda hit, stroke: weigh.ratio(self._hits[hit], self._strokes[stroke]),
        )

    def _sure(self, found: Matching) -> list[tuple[int, int]]:
        """The hits, each with its stroke, that the matching is sure of."""
        return [
            (hit, stroke)
            for hit, stroke in found.stroke.items()
            if found.by_stick[hit].get(self._stick[stroke], 0.0) >= SURE
        ]


def _log_prior(offsets_ms: Sequence[float]) -> float:
    far = sum((one / USUAL_OFFSET_MS) ** 2 for one in offsets_ms)
    apart = sum(((a - b) / USUAL_APART_MS) ** 2 for a, b in itertools.pairwise(offsets_ms))
    return -0.5 * (far + apart)


def _any(hit: int, stroke: int) -> float:
    return 1.0


# --- what the sure ones teach -----------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Normal:
    mean: float
    sd: float

    @classmethod
    def of(cls, values: Sequence[float], least_sd: float) -> "_Normal":
        return cls(fmean(values), max(pstdev(values), least_sd))

    def density(self, value: float) -> float:
        x = (value - self.mean) / self.sd
        return math.exp(-0.5 * min(x * x, 16.0)) / self.sd  # no single figure rules anything out


LEAST_SD_LOG, LEAST_SD_RAD = 0.08, 0.03
"""Spreads are no narrower: a step of velocity in 127 at mf is 1.5 %, a stick's angle is known to 2°; our choice."""


@dataclass(frozen=True, slots=True)
class _Habits:
    """What a stroke's speed, angle and stick say of its hit, as densities over those of any hit."""

    slope: float
    of_piece: dict[Piece, tuple[float, _Normal, _Normal]]
    """Of each piece: mean of log velocity − slope · log speed; that difference's spread; log velocity's."""
    angle: dict[tuple[str, Piece], _Normal]
    any_angle: dict[str, _Normal]
    hand: dict[tuple[str, Piece], float]

    @classmethod
    def of(cls, pairs: Sequence[tuple[Hit, StickStroke]]) -> "_Habits":
        pieces = {hit.piece for hit, _ in pairs}
        devices = {stroke.device for _, stroke in pairs}
        slope = _slope(pairs)
        of_piece, angle, hand = {}, {}, {}
        for piece in pieces:
            own = [(hit, stroke) for hit, stroke in pairs if hit.piece is piece]
            both = [(v, s) for hit, stroke in own if (s := _log_speed(stroke)) is not None for v in [_log_of(hit)]]
            if len(both) >= ENOUGH:
                left = [v - slope * s for v, s in both]
                spread = _Normal.of(left, LEAST_SD_LOG)
                of_piece[piece] = (spread.mean, spread, _Normal.of([v for v, _ in both], LEAST_SD_LOG))
            for device in devices:
                mine = [stroke.angle_rad for _, stroke in own if stroke.device == device]
                hand[device, piece] = max((len(mine) + 1) / (len(own) + len(devices)), LEAST_HABIT)
                angles = [angle for angle in mine if angle is not None]
                if len(angles) >= ENOUGH:
                    angle[device, piece] = _Normal.of(angles, LEAST_SD_RAD)
        any_angle = {
            device: _Normal.of(angles, LEAST_SD_RAD)
            for device in devices
            if len(angles := [s.angle_rad for _, s in pairs if s.device == device and s.angle_rad is not None])
            >= ENOUGH
        }
        return cls(slope, of_piece, angle, any_angle, hand)

    def ratio(self, hit: Hit, stroke: StickStroke) -> float:
        """How much better the stroke fits the hit than any other stroke does."""
        ratio = 2.0 * self.hand.get((stroke.device, hit.piece), 0.5)
        log_speed, known = _log_speed(stroke), self.of_piece.get(hit.piece)
        if log_speed is not None and known is not None:
            _, spread, anything = known
            ratio *= spread.density(_log_of(hit) - self.slope * log_speed) / anything.density(_log_of(hit))
        own, usual = self.angle.get((stroke.device, hit.piece)), self.any_angle.get(stroke.device)
        if stroke.angle_rad is not None and own is not None and usual is not None:
            ratio *= own.density(stroke.angle_rad) / usual.density(stroke.angle_rad)
        return ratio


def _log_speed(stroke: StickStroke) -> float | None:
    return math.log(max(stroke.speed_m_s, 0.05)) if stroke.speed_m_s is not None and not stroke.clipped else None


def _log_of(hit: Hit) -> float:
    return math.log(hit.fine_velocity)


def _slope(pairs: Sequence[tuple[Hit, StickStroke]]) -> float:
    """How log velocity grows with log speed; 0 where nothing says."""
    both = [(_log_of(hit), s) for hit, stroke in pairs if (s := _log_speed(stroke)) is not None]
    if len(both) < ENOUGH:
        return 0.0
    velocity, speed = np.array(both).T
    spread = float(np.var(speed))
    return float(np.mean((velocity - velocity.mean()) * (speed - speed.mean()))) / spread if spread > 1e-6 else 0.0
