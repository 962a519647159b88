"""Takes of people who begin anywhere, skip, repeat, stop and go on, at tempi of their own; the truth is known.

A journey is a list of legs: each is played from `first` to `last` tick after a silence. Playing time is the written
time of all legs one after the other; the player's speed makes real time of it. Everything is seeded by kind and seed,
and nothing is shared with what judges: neither words nor tables nor sizes.

A take with a click is on the click's time throughout: who skips two bars is two bars ahead of it, and who stops comes
in again on one of its beats.
"""

import zlib
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.bench.rigs.journey_music import families, music
from station.core.pieces import Limb, Piece
from station.core.units import NS_PER_MS, NS_PER_S
from station.drills.library import find_lesson, lesson_names
from station.music.performance import HIT_DTYPE, Performance
from station.music.score import Score

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]
Flags = NDArray[np.bool_]

LATE_START_S = 12.0
"""Who begins in the middle begins so late in the written music, at least: the sizes that the part names."""
_ALONE_S, _ALONE_BARS = 5.0, 2
"""Nobody changes place twice within so much music, so that an ear has something to go by."""
_QUICKEST_S = 0.085
"""No hand strikes a piece quicker (HUMANS: one hand 5-7 Hz, two hands in turn 12): music is not doubled beyond it."""
_LOOSEST = 0.2
"""No SD is more than this share of the shortest wait: a hand's strokes do not overtake one another (HUMANS: novices
6-10 % of the interval)."""
_AR_LAG_1 = 0.3
"""HUMANS: lag-1 of professionals' asynchronies about .21 to .37."""
_GRACE_SD_MS, _CLOSEST_GRACE_MS = 4.0, 8.0
"""A grace stroke leads its main stroke by the written time, near enough, and always leads (HUMANS: 15-40 ms)."""
_DRIFT_PERIOD_S = 60.0
_RESUMED = 0.92, 1.08
"""After a silence nobody without a click finds their tempo again but for some percent; our choice."""
_AS_PLAYED = 0.5
"""The share of the dataset's takes that keep their drummer's own timing: no model of noise is a drummer."""


@dataclass(frozen=True, slots=True)
class Leg:
    """What is played without a break: ticks `first` to `last` (without), after `wait_s` of silence.

    `speed` is that of the leg against the player's own.
    """

    first: int
    last: int
    wait_s: float = 0.0
    speed: float = 1.0


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


# --- the way through the score ----------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class Places:
    """Where a path may turn: the ticks of all bars and beats of a score, the end among them."""

    score: Score
    bars: Indices
    beats: Indices

    @classmethod
    def of(cls, score: Score) -> "Places":
        """Bars and counted beats (a dotted quarter in 6/8 and 12/8)."""
        bars = [score.tempo_map.bar_start(bar) for bar in range(score.bar_count)]
        meter = score.tempo_map.meter_at(0)
        by = 3 if meter.unit == 8 and meter.beats % 3 == 0 else 1
        beats = [tick for tick, index in score.tempo_map.beats_between(0, score.end_tick) if index % by == 0]
        return cls(score, np.array([*bars, score.end_tick]), np.array([*beats, score.end_tick]))

    @property
    def beat_s(self) -> float:
        """Length of a counted beat."""
        return self.seconds(int(self.beats[0]), int(self.beats[1]))

    def seconds(self, first: int, last: int) -> float:
        """Written time between two ticks."""
        at = self.score.tempo_map.seconds_at(np.array([first, last]))
        return float(at[1] - at[0])

    def after(self, tick: int, seconds: float, bars: int = 0) -> int:
        """The first tick that is so long, and so many bars, after `tick`."""
        by_time = int(self.score.tempo_map.ticks_at(self.score.tempo_map.seconds_at(tick) + seconds))
        return max(by_time, tick + bars * int(self.bars[1] - self.bars[0]))

    def alone_after(self, tick: int) -> int:
        """The first tick at which a player who came to `tick` may turn again."""
        return self.after(tick, _ALONE_S, _ALONE_BARS)


Rng = np.random.Generator
Turn = Callable[[Rng, Places, int], tuple[int, int, float] | None]
"""From the tick at which the player may turn on: where they turn, where they go, and how long they wait; None where the
score is too short for it."""


def _pick(rng: Rng, places: Indices, low: int, high: int) -> int | None:
    """One of `places` within [low, high]."""
    near = places[(places >= low) & (places <= high)]
    return int(rng.choice(near)) if len(near) else None


def _last_turn(places: Places) -> int:
    """The last tick after which there is music enough to tell where a player went."""
    ends = places.beats[[places.alone_after(int(b)) <= places.score.end_tick for b in places.beats]]
    return int(ends[-1]) if len(ends) else 0


def _turn_at(rng: Rng, places: Places, among: Indices, low: int) -> int | None:
    """Where to turn: soon after `low`, so that several turns find room."""
    return _pick(rng, among, low, min(places.after(low, 15.0), _last_turn(places)))


def _skip(rng: Rng, places: Places, low: int) -> tuple[int, int, float] | None:
    at = _turn_at(rng, places, places.bars, low)
    to = None if at is None else _pick(rng, places.bars, at + 1, places.after(at, 0.0, 4))
    return None if at is None or to is None or to > _last_turn(places) else (at, to, 0.0)


def _skip_beats(rng: Rng, places: Places, low: int) -> tuple[int, int, float] | None:
    at = _turn_at(rng, places, places.beats, low)
    to = None if at is None else _pick(rng, places.beats, at + 1, places.after(at, 0.0, 1) - 1)
    return None if at is None or to is None or to > _last_turn(places) else (at, to, 0.0)


def _repeat(rng: Rng, places: Places, low: int) -> tuple[int, int, float] | None:
    at = _turn_at(rng, places, places.bars, low)
    to = None if at is None else _pick(rng, places.bars, max(0, 2 * at - places.after(at, 0.0, 4)), at - 1)
    return None if at is None or to is None else (at, to, 0.0)


def _restart(rng: Rng, places: Places, low: int) -> tuple[int, int, float] | None:
    at = _turn_at(rng, places, places.beats, max(low, 1))
    return None if at is None else (at, 0, 0.0)


def _stop_to(where: Callable[[Places, int], int]) -> Turn:
    def stop(rng: Rng, places: Places, low: int) -> tuple[int, int, float] | None:
        at = _turn_at(rng, places, places.beats, max(low, 1))
        return None if at is None else (at, where(places, at), float(rng.uniform(1.5, 6.0)))

    return stop


def _bar_back(places: Places, at: int) -> int:
    return int(places.bars[max(0, int(np.searchsorted(places.bars, at, side="right")) - 2)])


TURNS: dict[str, Turn] = {
    "skip": _skip,
    "skip_beats": _skip_beats,
    "repeat": _repeat,
    "restart": _restart,
    "stop_go_on": _stop_to(lambda _, at: at),
    "stop_bar_back": _stop_to(_bar_back),
    "stop_beginning": _stop_to(lambda _, at: 0),
}
"""How a player leaves the written way."""
TEMPI = ("steady", "half", "double", "tempo", "drift3", "drift12")
"""What a player without a click does to the tempo."""
KINDS = ("straight", "begin", *TURNS, *TEMPI, "many")
"""The kinds of journeys; `passes` stands apart."""
CLICK_KINDS = ("straight", "begin", *TURNS, "many")


def _legs(rng: Rng, places: Places, first: int, turns: list[str]) -> list[Leg]:
    """The legs of a player who begins at `first` and turns so, in this order, as far as there is room."""
    legs, at, wait = [], first, 0.0
    for name in turns:
        turn = TURNS[name](rng, places, places.alone_after(at))
        if turn is None:
            continue
        legs.append(Leg(at, turn[0], wait))
        at, wait = turn[1], turn[2]
    return [*legs, Leg(at, places.score.end_tick, wait)]


def _beginning(rng: Rng, places: Places) -> int:
    """Somewhere in the middle: on a bar mostly, on any beat sometimes."""
    among = places.bars if rng.random() < 0.6 else places.beats
    low = places.after(0, LATE_START_S)
    return _pick(rng, among, low, max(low, _last_turn(places))) or 0


def _on_click(places: Places, leg: Leg) -> Leg:
    """The leg after a silence of whole beats."""
    return replace(leg, wait_s=round(leg.wait_s / places.beat_s) * places.beat_s)


def _resumed(rng: Rng, legs: list[Leg]) -> tuple[Leg, ...]:
    """The legs of a player without a click: whoever stopped goes on at nearly the same tempo."""
    return tuple(replace(leg, speed=float(rng.uniform(*_RESUMED))) if leg.wait_s else leg for leg in legs)


# --- playing ----------------------------------------------------------------------------------------------------------


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


def perform(rng: Rng, way: Journey) -> Take:
    """What is played on the way."""
    score, legs, player = way.score, way.legs, way.player
    notes, tick_s = score.notes, score.tempo_map.seconds_at
    firsts = np.array([float(tick_s(leg.first)) for leg in legs])
    lengths = np.array([float(tick_s(leg.last)) for leg in legs]) - firsts
    begins = np.concatenate([[0.0], np.cumsum(lengths)])[:-1]
    waits = way.start_s + np.cumsum([leg.wait_s for leg in legs])
    warp = Warp.of(player, np.cumsum(lengths), np.array([leg.speed for leg in legs]))

    inside = [np.flatnonzero((notes["tick"] >= leg.first) & (notes["tick"] < leg.last)) for leg in legs]
    meant = np.concatenate(inside)
    leg_of = np.repeat(np.arange(len(legs)), [len(rows) for rows in inside])
    due_s = warp.real(tick_s(notes["tick"][meant]) - firsts[leg_of] + begins[leg_of]) + waits[leg_of]
    at_s = due_s + (_asynchrony_s(rng, score, meant, due_s, player.sd_ms) if way.own_s is None else way.own_s[meant])

    kept = rng.random(len(meant)) >= player.missing
    meant, leg_of, at_s = meant[kept], leg_of[kept], at_s[kept]
    piece = notes["piece"][meant].copy()
    is_wrong = rng.random(len(meant)) < player.wrong_piece
    piece[is_wrong] = [_other_piece(rng, score, int(p)) for p in piece[is_wrong]]
    velocity = notes["velocity"][meant] + rng.normal(0.0, 8.0, len(meant))

    bounced = np.flatnonzero(rng.random(len(meant)) < player.doubled)
    bounce_s = at_s[bounced] + rng.uniform(0.05, 0.11, len(bounced))
    extras = int(rng.binomial(len(meant), player.extra))
    extra_leg = rng.choice(len(legs), extras, p=lengths / lengths.sum())
    extra_s = warp.real(begins[extra_leg] + rng.random(extras) * lengths[extra_leg]) + waits[extra_leg]
    extra_piece = rng.choice(np.unique(notes["piece"]), extras)

    at = np.concatenate([at_s, bounce_s, extra_s])
    legs_of_hits = np.concatenate([leg_of, leg_of[bounced], extra_leg])
    count = len(at) - len(at_s)
    order = np.argsort(np.rint(at * NS_PER_S).astype(np.int64), kind="stable")
    hits = np.zeros(len(at), HIT_DTYPE)
    hits["at_ns"] = np.rint(at * NS_PER_S).astype(np.int64)
    hits["piece"] = np.concatenate([piece, piece[bounced], extra_piece])
    loud = np.concatenate([velocity, 0.6 * velocity[bounced], rng.uniform(30, 100, extras)])
    hits["velocity"] = np.clip(np.rint(loud), 1, 127)
    hits["openness"] = hits["position"] = np.nan
    hits["limb"] = Limb.UNKNOWN
    true_s = warp.playing(at - waits[legs_of_hits]) - begins[legs_of_hits] + firsts[legs_of_hits]
    none = np.full(count, -1, np.int64)
    return Take(
        **vars(way),
        performance=Performance.from_array(hits),
        meant=np.concatenate([meant, none])[order],
        is_wrong=np.concatenate([is_wrong, np.zeros(count, bool)])[order],
        leg=legs_of_hits[order],
        true_ns=np.rint(true_s * NS_PER_S).astype(np.int64)[order],
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


# --- the kinds --------------------------------------------------------------------------------------------------------


def journey(kind: str, seed: int, clocked: bool = False) -> Take:
    """The take of this kind and seed; see `KINDS`, `CLICK_KINDS` and `passes_journey` for "passes"."""
    if kind == "passes":
        return passes_journey(seed)
    own = [zlib.crc32(kind.encode()), seed, int(clocked)]
    rng = np.random.default_rng(own)
    piece = music(families()[seed % len(families())], own)
    name, score = piece.name, piece.score
    own_s = piece.own_s if rng.random() < _AS_PLAYED else None
    places = Places.of(score)
    begins = kind == "begin" or (kind == "many" and rng.random() < 0.5)
    first = _beginning(rng, places) if begins else 0
    turns = [kind] if kind in TURNS else []
    if kind == "many":
        turns = [str(turn) for turn in rng.choice(list(TURNS), int(rng.integers(2, 5)), replace=False)]
    legs = _legs(rng, places, first, turns)
    sd_ms = float(rng.choice([10.0, 15.0, 20.0])) if own_s is None else float(own_s.std()) * NS_PER_S / NS_PER_MS
    player = Player(sd_ms=sd_ms)
    if clocked:
        in_place = not begins or rng.random() < 0.5
        start_s = float(score.tempo_map.seconds_at(first)) if in_place else 0.0
        on_click = tuple(_on_click(places, leg) for leg in legs)
        return perform(rng, Journey(name, score, on_click, player, True, start_s, own_s=own_s))
    player = _at_own_tempo(rng, kind, score, player)
    start_s = float(rng.uniform(0.3, 3.0))
    return perform(rng, Journey(name, score, _resumed(rng, legs), player, False, start_s, own_s=own_s))


def _at_own_tempo(rng: Rng, kind: str, score: Score, player: Player) -> Player:
    """A player without a click: near the written tempo with ±3 % of drift, unless the kind says otherwise.

    Who is steady had a metronome that the recording does not know of.
    """
    speed, drift = float(rng.uniform(0.92, 1.08)), 0.03
    if kind == "steady":
        speed, drift = 1.0, 0.0
    elif kind == "half":
        speed = 0.5
    elif kind == "double":
        speed = 2.0 if _quickest_s(score) / 2 >= _QUICKEST_S else 0.5
    elif kind == "tempo" or (kind == "many" and rng.random() < 0.5):
        speed = float(rng.uniform(0.7, 1.3))
    if kind == "drift12" or (kind == "many" and rng.random() < 0.3):
        drift = 0.12
    sd_ms = min(player.sd_ms, _LOOSEST * 1e3 * _quickest_s(score) / speed)
    drift *= float(rng.choice([-1, 1]))
    return replace(player, speed=speed, drift=drift, ramps=bool(rng.random() < 0.5), sd_ms=sd_ms)


def _quickest_s(score: Score) -> float:
    """The shortest wait between two strokes of one piece, graces left out."""
    rows = score.notes[~score.is_grace]
    waits = [
        np.diff(score.tempo_map.seconds_at(np.unique(rows["tick"][rows["piece"] == p]))) for p in set(rows["piece"])
    ]
    return float(min(np.concatenate(waits).min(initial=9.0), 9.0))


def passes_journey(seed: int) -> Take:
    """A lesson played 1 to 16 times through without a click, up to 20 % left out and up to 5 % doubled."""
    rng = np.random.default_rng([zlib.crc32(b"passes"), seed])
    name = str(rng.choice(lesson_names()))
    passes = int(rng.integers(1, 17))
    score = find_lesson(name).score.repeated(passes)
    speed = float(rng.uniform(0.8, 1.2))
    player = Player(
        speed=speed,
        drift=0.03,
        sd_ms=min(float(rng.choice([10.0, 15.0, 20.0])), _LOOSEST * 1e3 * _quickest_s(score) / speed),
        missing=float(rng.uniform(0.0, 0.2)),
        extra=0.0,
        wrong_piece=0.0,
        doubled=float(rng.uniform(0.0, 0.05)),
    )
    start_s = float(rng.uniform(0.3, 3.0))
    return perform(rng, Journey(name, score, (Leg(0, score.end_tick),), player, False, start_s, passes))
