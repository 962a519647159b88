"""Human phrases of four bars, and beside each what the drummer improvised upon the same bars before it.

For each take of a drummer who was left out: bars are heard, the four bars after them are the human's phrase, and the
drummer plays four bars in their stead, at the same tempo and in the same style, with a model, a table of how drummers
weight their strokes, and phrases to borrow a touch from, that have not heard that drummer either. Both are then read
from their hits by the same function.
"""

import json
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from unittest.mock import patch

import numpy as np

from station.practice.battle.improvising import borrowed_touch, human_playing, improvise
from station.practice.battle.improvising.beat_model import BeatModel
from station.practice.battle.improvising.continuation import continued
from station.practice.battle.improvising.human_phrases import HumanPhrases
from station.practice.battle.improvising.human_playing import HumanPlaying
from station.practice.battle.improvising.played_beats import Beats, beats_of
from station.practice.battle.improvising.wanted import Wanted
from station.practice.battle.opponents.opponent import Opponent
from station.practice.battle.phrase_as_turn import phrase_as_turn
from tools.battle_training.takes import GrooveTake, turn_of
from tools.human_playing import table as tools_table

HEARD_BARS, PHRASE_BARS = 8, 4
LEAST_STROKES = 12
"""A phrase with fewer is hardly one."""


@dataclass(frozen=True, eq=False)
class Heard:
    """A place in a take: what came before it, and the human's phrase; whose they are."""

    take: GrooveTake
    bar: int

    @property
    def human(self) -> Beats:
        """What the human played."""
        return beats_of(turn_of(self.take, self.bar, PHRASE_BARS))


def places(takes: Sequence[GrooveTake], drummers: Sequence[str]) -> list[Heard]:
    """All phrases in 4/4 of those drummers that have enough before them."""
    return [
        Heard(take, bar)
        for take in takes
        if take.drummer in drummers and take.ground.beats == 4 and take.ground.unit == 4
        for bar in range(HEARD_BARS, take.beats.bars - PHRASE_BARS + 1, PHRASE_BARS)
        if take.beats.of_bars(bar, bar + PHRASE_BARS).struck.sum() >= LEAST_STROKES
    ]


Player = Callable[[Heard, BeatModel, np.random.Generator], Beats]


def by_the_model(heard: Heard, model: BeatModel, rng: np.random.Generator) -> Beats:
    """The model's notes alone."""
    before = heard.take.beats.of_bars(heard.bar - HEARD_BARS, heard.bar)
    music = replace(heard.take.music, phrase_bar=0)
    return continued(model, [before], PHRASE_BARS, Wanted(music), rng)


def by_the_drummer(opponent: Opponent) -> Player:
    """What the whole drummer improvises, with timing and velocity, read from its strokes."""

    def played(heard: Heard, model: BeatModel, rng: np.random.Generator) -> Beats:
        turns = [turn_of(heard.take, heard.bar - back, PHRASE_BARS) for back in (HEARD_BARS, PHRASE_BARS)]
        ground = heard.take.ground
        phrase = improvise.improvised(opponent, ground, PHRASE_BARS, turns, (), rng)
        return beats_of(phrase_as_turn(phrase, ground))

    return played


@dataclass(frozen=True, eq=False)
class Knowledge:
    """What the drummer knows of playing: the model of notes, the table of how drummers play, whose touch it borrows."""

    model: BeatModel
    table: HumanPlaying
    phrases: HumanPhrases


def knowledge_of(takes: Sequence[GrooveTake], model: BeatModel, folder: Path) -> Knowledge:
    """What can be known from these takes; `model` is trained on them."""
    phrases = HumanPhrases.of([(take.ground.beats_a_minute, take.beats) for take in takes])
    return Knowledge(model, table_of(tools_table(takes), folder), phrases)


@contextmanager
def with_knowledge(knowledge: Knowledge) -> Iterator[None]:
    """The drummer improvises with this instead of what ships."""
    with ExitStack() as stack:
        stack.enter_context(patch.object(BeatModel, "load", lambda: knowledge.model))
        stack.enter_context(patch.object(borrowed_touch, "human_phrases", lambda: knowledge.phrases))
        shipped = human_playing.human_playing
        for module in [m for m in list(sys.modules.values()) if getattr(m, "human_playing", None) is shipped]:
            stack.enter_context(patch.object(module, "human_playing", lambda: knowledge.table))
        yield


def table_of(document: dict[str, object], folder: Path) -> HumanPlaying:
    """The table that a document of `tools.human_playing` is, read as the one that ships is read."""
    path = folder / "human_playing.json"
    path.write_text(json.dumps(document), encoding="utf-8")
    with patch.object(human_playing, "HUMAN_PLAYING", path):
        return human_playing.human_playing.__wrapped__()


def shuffled(beats: Beats, rng: np.random.Generator) -> Beats:
    """The phrase with its chords in another order, each with its velocities and lateness, over the same cells."""
    beat, cell = np.nonzero(np.arange(8) < beats.division[:, None])
    order = rng.permutation(len(beat))
    found = Beats.silent(len(beats), beats.beats_a_bar)
    found.division[:] = beats.division
    for name in ("struck", "velocity", "late_ms", "ornament"):
        getattr(found, name)[beat, cell] = getattr(beats, name)[beat[order], cell[order]]
    return found
