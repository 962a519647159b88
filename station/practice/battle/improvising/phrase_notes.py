"""What is struck in an improvised phrase: bars that stand, taken up or quoted, and the model's about them.

What the opponent's idiom strikes and what the plan wants is added to the model's log-odds; a draft that is much too
dense or too thin is played once more.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import log

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.practice.battle.ground import Ground
from station.practice.battle.improvising.beat_model import BeatModel
from station.practice.battle.improvising.beat_steps import PHRASE_BARS, Music, styles_of
from station.practice.battle.improvising.continuation import continued
from station.practice.battle.improvising.human_playing import human_playing
from station.practice.battle.improvising.motif import motif_of, turned
from station.practice.battle.improvising.phrase_plan import Part, PlannedBar
from station.practice.battle.improvising.played_beats import Beats, Instrument
from station.practice.battle.improvising.strokes_on_grid import beats_of_lesson
from station.practice.battle.improvising.wanted import Wanted
from station.practice.battle.opponents.opponent import Opponent
from station.practice.battle.vocabulary.lesson_bars import known_bars


@dataclass(frozen=True, eq=False)
class Scene:
    """Who improvises upon what: the opponent, the ground, the plan, the bars that were `heard` and `said`."""

    opponent: Opponent
    ground: Ground
    plan: tuple[PlannedBar, ...]
    heard: tuple[Beats, ...]
    said: tuple[Beats, ...]


def phrase_notes(scene: Scene, rng: Generator) -> Beats:
    """The beats of the phrase; velocities and timing are yet to come."""
    return _again(_drafted(scene, rng), scene.plan)


def _drafted(scene: Scene, rng: Generator) -> Beats:
    """What is struck: bars that stand, and the model's between them, about as dense as the opponent plays."""
    given, is_given = _standing(scene, rng)
    manner, ground = scene.opponent.manner, scene.ground
    styles = frozenset(scene.opponent.styles) or styles_of(ground.style)
    phrase_bar = (PHRASE_BARS - len(scene.plan)) % PHRASE_BARS  # whatever its length, it ends as a phrase of four does
    music = Music(styles, ground.feel, ground.beats_a_minute, phrase_bar)
    favour = _favour(scene)
    wanted = Wanted(music, manner.boldness, manner.memory, given=given, is_given=is_given, favour=favour)
    context = [*_quotes(scene, 2, rng), *_in_turn(scene)] or [Beats.silent(0, ground.beats_a_bar)]
    model = BeatModel.load()
    draft = continued(model, context, len(scene.plan), wanted, rng)
    off = _density_off(draft, scene)
    if abs(off) <= _DENSITY_OFF:
        return draft
    shifted = favour + np.clip(off * _SHIFTED, -_MOST_SHIFT, _MOST_SHIFT)
    other = continued(model, context, len(scene.plan), replace(wanted, favour=shifted), rng)
    return min(draft, other, key=lambda beats: abs(_density_off(beats, scene)))


def _density_off(beats: Beats, scene: Scene) -> float:
    """The logarithm of how many times as many strokes the opponent would play."""
    return log(_strokes_a_beat(scene) * len(beats) / max(float(beats.struck.sum()), 0.1))


def _strokes_a_beat(scene: Scene) -> float:
    """How many strokes a beat the opponent plays at this tempo."""
    slower: float = (_HUMAN_BPM / scene.ground.beats_a_minute) ** _TEMPO_POWER
    return human_playing().strokes_a_beat * scene.opponent.manner.density * slower


_HUMAN_BPM = 105.0
"""The middle tempo of the Groove MIDI Dataset's takes."""
_TEMPO_POWER = 0.5
"""Beats that are twice as quick have seven tenths of the strokes (our choice, between as many and half as many)."""
_DENSITY_OFF, _SHIFTED, _MOST_SHIFT = 0.5, 0.6, 1.5
"""Where a draft's density is off by more than e^0.5, two thirds, another is played with its log-odds shifted by 0.6 of
that, at most 1.5, and the nearer stays: a model that listens to its own silence falls silent (our choice)."""


def _in_turn(scene: Scene) -> list[Beats]:
    """What was said and heard as it came, the student's last turn last."""
    pairs = [pair for one in zip(reversed(scene.heard), reversed(scene.said), strict=False) for pair in one]
    left = [*scene.heard[: len(scene.heard) - len(pairs) // 2], *scene.said[: len(scene.said) - len(pairs) // 2]]
    return [*left, *reversed(pairs)]


def _quotes(scene: Scene, most: int, rng: Generator) -> list[Beats]:
    """Up to so many runs of one or two bars out of the opponent's lessons, for the ground."""
    if not scene.opponent.manner.quotes:
        return []
    known = [one for one in known_bars(scene.ground, scene.opponent.vocabulary) if one.bars <= 2]
    chosen = rng.permutation(len(known))[:most].tolist()
    return [beats_of_lesson(known[at], scene.ground) for at in chosen]


def _standing(scene: Scene, rng: Generator) -> tuple[Beats, NDArray[np.bool_]]:
    """The bars that are not the model's: motifs taken up, and quotes; and which cells they fix."""
    a_bar = scene.ground.beats_a_bar
    given = Beats.silent(len(scene.plan) * a_bar, a_bar)
    is_given = np.zeros(given.struck.shape, np.bool_)
    heard = scene.heard[-1] if scene.heard else None
    motif = motif_of(heard, rng) if heard is not None else None
    for bar, planned in enumerate(scene.plan):
        stands: Beats | None = None
        if planned.turning is not None and motif is not None:
            stands = turned(motif, planned.turning, rng)
        elif planned.part is not Part.RETURN and rng.random() < scene.opponent.manner.quotes:
            stands = next((one.of_bars(0, 1) for one in _quotes(scene, 1, rng)), None)
        if stands is not None:
            rows = slice(bar * a_bar, (bar + 1) * a_bar)
            given.division[rows], given.struck[rows] = stands.division, stands.struck
            given.velocity[rows] = stands.velocity
            is_given[rows] = True
    return given, is_given


_TIME = (Instrument.CLOSED_HIHAT, Instrument.OPEN_HIHAT, Instrument.RIDE)
_TALK = (Instrument.SNARE, Instrument.HIGH_TOM, Instrument.MID_TOM, Instrument.FLOOR_TOM)
_OTHER_TIME, _OWN_TIME = -0.8, 0.4
"""Log-odds that the cymbal of the idiom gains over the others (our choice)."""
_FILL_TALK, _FILL_TIME = 1.1, -1.6
"""Log-odds of drums and timekeepers where a phrase goes home: hands leave the cymbal (our choice)."""
_RING = -4.0
"""Log-odds of all where air is left."""
_USUAL_KICKS, _USUAL_TOMS = 0.26, 0.25
"""Shares of the kick and of the toms at which an idiom plays as drummers in general do."""


def _favour(scene: Scene) -> NDArray[np.float64]:
    """What the opponent's idiom and the plan add to the log-odds of each instrument, (beats, 9)."""
    manner, idiom, a_bar = scene.opponent.manner, scene.opponent.idiom, scene.ground.beats_a_bar
    favour = np.zeros((len(scene.plan) * a_bar, len(Instrument)))
    on_ride = idiom.time_on is Piece.RIDE
    favour[:, Instrument.RIDE] += _OWN_TIME if on_ride else _OTHER_TIME
    favour[:, Instrument.CLOSED_HIHAT] += _OTHER_TIME / 2 if on_ride else _OWN_TIME / 2
    favour[:, Instrument.KICK] += log(idiom.kick_share / _USUAL_KICKS)
    toms = 1 - idiom.voices[Piece.SNARE]
    favour[:, _TALK[1:]] += log(max(toms, 0.05) / _USUAL_TOMS)
    favour *= idiom.strength
    for bar, planned in enumerate(scene.plan):
        rows = slice(bar * a_bar, (bar + 1) * a_bar)
        favour[rows] += log(manner.density * planned.density)
        if planned.part is Part.RETURN:
            late = slice(rows.start + (a_bar + 1) // 2, rows.stop)
            favour[late, _TALK] += _FILL_TALK * manner.fills
            favour[late, _TIME] += _FILL_TIME * manner.fills
        if planned.air:
            favour[rows.stop - 1] += _RING
    return favour


def _again(beats: Beats, plan: Sequence[PlannedBar]) -> Beats:
    """The statement comes again with another end where the plan says so."""
    a_bar = beats.beats_a_bar
    statement = next((bar for bar, one in enumerate(plan) if one.part in (Part.STATEMENT, Part.ANSWER)), None)
    division, struck, velocity = beats.division.copy(), beats.struck.copy(), beats.velocity.copy()
    for bar, planned in enumerate(plan):
        if planned.part is Part.AGAIN and planned.turning is None and statement is not None:
            here, there = (slice(at * a_bar, (at + 1) * a_bar - 1) for at in (bar, statement))
            division[here], struck[here], velocity[here] = division[there], struck[there], velocity[there]
    return replace(beats, division=division, struck=struck, velocity=velocity)
