"""Journeys: takes of people who begin anywhere, skip, repeat, stop and go on, at tempi of their own.

Everything is seeded by kind and seed, and nothing is shared with what judges: neither words nor tables nor sizes. A
take with a click is on the click's time throughout: who skips two bars is two bars ahead of it, and who stops comes in
again on one of its beats.
"""

import zlib
from dataclasses import replace

import numpy as np

from station.bench.rigs.journeys.journey_music import families, music
from station.bench.rigs.journeys.journey_takes import Journey, Player, Take, perform
from station.bench.rigs.journeys.journey_ways import TURNS, Leg, Places, Rng, beginning, on_click, resumed, way
from station.core.units import NS_PER_MS, NS_PER_S
from station.drills.library import find_lesson, lesson_names
from station.music.score import Score

_QUICKEST_S = 0.085
"""No hand strikes a piece quicker (HUMANS: one hand 5-7 Hz, two hands in turn 12): music is not doubled beyond it."""
_LOOSEST = 0.2
"""No SD is more than this share of the shortest wait: a hand's strokes do not overtake one another (HUMANS: novices
6-10 % of the interval)."""
_SD_MS = 10.0, 15.0, 20.0
_AS_PLAYED = 0.5
"""The share of the dataset's takes that keep their drummer's own timing: no model of noise is a drummer."""

"""How a player leaves the written way."""
TEMPI = ("steady", "half", "double", "tempo", "drift3", "drift12")
"""What a player without a click does to the tempo."""
KINDS = ("straight", "begin", *TURNS, *TEMPI, "many")
"""The kinds of journeys; `passes` stands apart."""
CLICK_KINDS = ("straight", "begin", "elsewhere", *TURNS, "many")
"""Who begins late with a click comes in where it is; who begins elsewhere plays another bar at its first beat."""


def journey(kind: str, seed: int, clocked: bool = False) -> Take:
    """The take of this kind and seed; see `KINDS`, `CLICK_KINDS` and `passes_journey` for "passes"."""
    if kind == "passes":
        return passes_journey(seed)
    own = [zlib.crc32(kind.encode()), seed, int(clocked)]
    rng = np.random.default_rng(own)
    piece = music(families()[seed % len(families())], own)
    score, places = piece.score, Places.of(piece.score)
    own_s = piece.own_s if rng.random() < _AS_PLAYED else None
    begins = kind in {"begin", "elsewhere"} or (kind == "many" and rng.random() < 0.5)
    first = beginning(rng, places) if begins else 0
    turns = [kind] if kind in TURNS else []
    if kind == "many":
        turns = [str(turn) for turn in rng.choice(list(TURNS), int(rng.integers(2, 5)), replace=False)]
    legs = way(rng, places, first, turns)
    sd_ms = float(rng.choice(_SD_MS)) if own_s is None else float(own_s.std()) * NS_PER_S / NS_PER_MS
    if clocked:
        start_s = 0.0 if kind == "elsewhere" else float(score.tempo_map.seconds_at(first))
        return perform(
            rng, Journey(piece.name, score, on_click(places, legs), Player(sd_ms=sd_ms), True, start_s, own_s=own_s)
        )
    player, start_s = _at_own_tempo(rng, kind, score, Player(sd_ms=sd_ms)), _start_s(rng)
    return perform(rng, Journey(piece.name, score, resumed(rng, legs), player, False, start_s, own_s=own_s))


def _start_s(rng: Rng) -> float:
    """When a take without a click begins in its file."""
    return float(rng.uniform(0.3, 3.0))


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
    sd_ms = min(player.sd_ms, _loosest_ms(score, speed))
    drift *= float(rng.choice([-1, 1]))
    return replace(player, speed=speed, drift=drift, ramps=bool(rng.random() < 0.5), sd_ms=sd_ms)


def _loosest_ms(score: Score, speed: float) -> float:
    """The largest SD at which a hand's strokes keep their order."""
    return _LOOSEST * _quickest_s(score) / speed * NS_PER_S / NS_PER_MS


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
        sd_ms=min(float(rng.choice(_SD_MS)), _loosest_ms(score, speed)),
        missing=float(rng.uniform(0.0, 0.2)),
        extra=0.0,
        wrong_piece=0.0,
        doubled=float(rng.uniform(0.0, 0.05)),
    )
    return perform(rng, Journey(name, score, (Leg(0, score.end_tick),), player, False, _start_s(rng), passes))
