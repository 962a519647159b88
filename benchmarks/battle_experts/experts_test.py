"""The experts' test by proxy: how well a classifier with an expert's features tells a human's phrases from others.

The classifier is first shown to be able: it tells human phrases from shuffled ones. Then it is trained on human phrases
and the drummer's, and asked about those of a human drummer whom neither it nor the drummer's model has heard. Two
classifiers, boosted trees and logistic regression, so that neither's weakness flatters.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

from benchmarks.battle_experts.boosted_trees import BoostedTrees, auc, logistic_scores
from benchmarks.battle_experts.phrase_features import phrase_features
from benchmarks.battle_experts.phrase_pairs import (
    Heard,
    Knowledge,
    Player,
    by_the_drummer,
    by_the_model,
    knowledge_of,
    places,
    shuffled,
    with_knowledge,
)
from station.practice.battle.improvising.beat_model import BeatModel
from station.practice.battle.improvising.played_beats import Beats
from station.practice.battle.opponents.opponent import ANY_DRUMMER, OPPONENTS
from tools.battle_training.takes import GrooveTake

Floats = NDArray[np.float64]
SEED = 14


@dataclass(frozen=True, slots=True)
class Told:
    """How well each classifier tells two kinds of phrase apart: area under the curve, and share right."""

    tree_auc: float
    tree_right: float
    line_auc: float
    line_right: float

    def __str__(self) -> str:
        return f"{self.tree_auc:.2f} | {self.line_auc:.2f} | {self.tree_right:.0%} | {self.line_right:.0%}"


def experts_tables(takes: Sequence[GrooveTake], models: Mapping[str, BeatModel]) -> str:
    """A line for each kind of phrase beside the humans' own."""
    heard = places(takes, tuple(models))
    known = _known(takes, models)
    human = [place.human for place in heard]
    rng = np.random.default_rng(SEED)
    at_random = [shuffled(beats, rng) for beats in human]
    mixed = dict.fromkeys(models, at_random)
    notes = _played(heard, known, by_the_model)
    lines = [f"{len(heard)} human phrases of four bars, and as many of each other kind.", ""]
    lines += ["| human against | AUC trees | AUC logistic | right, trees | right, logistic |", "|---|---|---|---|---|"]
    lines += [f"| shuffled, notes alone | {told(heard, human, mixed, False)} |"]
    lines += [f"| shuffled, notes, velocity and timing | {told(heard, human, mixed, True)} |"]
    lines += [f"| the model's notes | {told(heard, human, notes, False)} |"]
    for opponent in (ANY_DRUMMER, *OPPONENTS.values()):
        played = _played(heard, known, by_the_drummer(opponent))
        lines += [f"| {opponent.name}, notes alone | {told(heard, human, played, False)} |"]
        lines += [f"| {opponent.name}, notes, velocity and timing | {told(heard, human, played, True)} |"]
    return "\n".join(lines)


def _known(takes: Sequence[GrooveTake], models: Mapping[str, BeatModel]) -> dict[tuple[str, str], Knowledge]:
    """By the drummer who is asked about and the one in whose stead is played: what neither has played.

    A touch borrowed of the one who is asked about would be trained on as a machine's. The notes' model has left out
    the second alone.
    """
    with TemporaryDirectory() as folder:
        return {
            (asked, own): knowledge_of([t for t in takes if t.drummer not in {asked, own}], models[own], Path(folder))
            for asked in models
            for own in models
        }


def _played(
    heard: Sequence[Heard], known: Mapping[tuple[str, str], Knowledge], player: Player
) -> dict[str, list[Beats]]:
    """What is played at each place, by the drummer who is asked about."""
    found: dict[str, list[Beats]] = {}
    for asked in sorted({asked for asked, _ in known}):
        rng = np.random.default_rng(SEED)
        found[asked] = [_one(place, known[asked, place.take.drummer], player, rng) for place in heard]
    return found


def _one(place: Heard, knowledge: Knowledge, player: Player, rng: np.random.Generator) -> Beats:
    with with_knowledge(knowledge):
        return player(place, knowledge.model, rng)


def told(
    heard: Sequence[Heard], human: Sequence[Beats], other: Mapping[str, Sequence[Beats]], with_playing: bool
) -> Told:
    """How well a human drummer's phrases are told from the others, the drummer left out of training; mean of all."""
    drummers = np.array([place.take.drummer for place in heard])
    of_human, found = _features(human, with_playing), []
    for drummer in np.unique(drummers).tolist():
        features = of_human, _features(other[drummer], with_playing)
        known, asked = ((drummers != drummer), (drummers == drummer))
        train, label = _both(features, known)
        test, truth = _both(features, asked)
        trees = BoostedTrees.fitted(train, label, SEED).scores(test)
        line = logistic_scores(train, label, test)
        found.append([auc(trees, truth), _right(trees, truth), auc(line, truth), _right(line, truth)])
    return Told(*np.mean(found, axis=0).tolist())


def _features(phrases: Sequence[Beats], with_playing: bool) -> Floats:
    return np.array([list(phrase_features(beats, with_playing).values()) for beats in phrases])


def _both(features: Sequence[Floats], chosen: NDArray[np.bool_]) -> tuple[Floats, NDArray[np.bool_]]:
    """The chosen rows of both kinds, and which are human."""
    rows = np.concatenate([kind[chosen] for kind in features])
    return rows, np.arange(len(rows)) < chosen.sum()


def _right(scores: Floats, truth: NDArray[np.bool_]) -> float:
    return float(((scores > 0) == truth).mean())
