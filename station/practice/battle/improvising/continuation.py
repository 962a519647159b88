"""Bars that go on from what was heard: the model asked step by step, and a generator that decides.

`continued` is the door. The same generator, in the same state, gives the same bars; log-odds are rounded to 1/1024
before a decision, so that the last bits of another computer's sums change one only by the rarest chance.
"""

from bisect import bisect_right
from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from itertools import accumulate
from math import exp

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Dynamic
from station.music.stroke_velocities import usual_velocity
from station.practice.battle.improvising.bar_memory import (
    EVIDENCE,
    contexts,
    given,
    heard_in,
    odds_of,
    weighed,
)
from station.practice.battle.improvising.beat_model import BeatModel, music_after
from station.practice.battle.improvising.beat_steps import (
    GRID,
    INSTRUMENTS,
    RECENT,
)
from station.practice.battle.improvising.played_beats import Beats, Instrument
from station.practice.battle.improvising.played_divisions import DIVISIONS, MOST_CELLS
from station.practice.battle.improvising.played_line import PlayedLine
from station.practice.battle.improvising.rows_ahead import RowsAhead
from station.practice.battle.improvising.wanted import Wanted

_ROUNDING = 1024.0
_SURE = 30.0
"""Log-odds beyond which there is nothing to decide: once in e^30."""


def continued(model: BeatModel, heard: Sequence[Beats], bars: int, wanted: Wanted, rng: np.random.Generator) -> Beats:
    """So many bars after what was `heard` (turns in order, any number), as `wanted`.

    `struck` and `division` are the model's; velocity is that of a normal stroke, lateness and ornament 0, but for
    strokes that were given. What is heard is listened to first; a bar takes a millisecond (docs/battle-model.md).
    """
    beats_a_bar = heard[0].beats_a_bar if heard else wanted.given.beats_a_bar if wanted.given else 4
    past, music = music_after(heard, wanted.music)
    line = PlayedLine.after(past, bars * beats_a_bar, beats_a_bar)
    rows = RowsAhead.of(line.steps, line.beat, bars * beats_a_bar, music)
    weights = model.mixing_at(wanted.memory)
    says = weighed(weights[1 : 1 + EVIDENCE])
    return _Chooser(model, line, rows, wanted, rng, weights.tolist(), says, _Coin.of(wanted)).play(bars * beats_a_bar)


@dataclass(frozen=True, slots=True)
class _Coin:
    """How odds become a choice, reckoned once from what is wanted."""

    temperature: float
    least: float

    @classmethod
    def of(cls, wanted: Wanted) -> "_Coin":
        """As wanted."""
        return cls(wanted.temperature, wanted.least_chance)

    def falls(self, odds: float, chance: float) -> bool:
        """Whether something of those log-odds is struck, by a number from 0 to 1."""
        bold = odds / self.temperature
        if not -_SURE < bold < _SURE:
            return bold > 0
        likely = 1 / (1 + exp(-round(bold * _ROUNDING) / _ROUNDING))
        if likely < self.least or likely > 1 - self.least:
            return likely > 0.5
        return chance < likely


@dataclass(frozen=True, eq=False)
class _Chooser:
    """Asks the model about the next of a line, and decides."""

    model: BeatModel
    line: PlayedLine
    rows: RowsAhead
    wanted: Wanted
    rng: np.random.Generator
    weights: list[float]
    says: list[list[list[float]]]
    coin: _Coin

    def play(self, beats: int) -> Beats:
        """So many beats, played on the line."""
        line, first = self.line, self.line.step
        played = Beats.silent(beats, line.steps.beats_a_bar)
        for beat in range(beats):
            known = self.rows.known_before(line.beat)
            division = self._division(beat, known)
            line.steps.division[line.beat] = division
            row, decided = self.rows.of_steps(line.beat, line.step, known), self._decided(beat)
            favour = self._favour(beat)
            for cell in range(division):
                place = cell * (GRID // division)
                keys = contexts(line.beat, place, line.steps.beats_a_bar, line.past)
                line.strike(place, keys, self._chord(row(cell), keys, favour, decided[cell]))
            played.division[beat] = division
            line.end_beat()
        cells = np.arange(MOST_CELLS) < played.division[:, None]
        played.struck[cells] = line.steps.struck[RECENT + first : RECENT + line.step] > 0
        played.velocity[played.struck] = usual_velocity(Dynamic.NORMAL)
        self._keep_given(played)
        return played

    def _division(self, beat: int, known: NDArray[np.float32]) -> int:
        wanted, line = self.wanted, self.line
        if wanted.given is not None and wanted.is_fixed(beat):
            return int(wanted.given.division[beat])
        counts = line.divisions[line.beat % line.steps.beats_a_bar]
        rows = self.rows.of_division(line.beat, known)
        likely = self.model.divisions_after(rows, counts[None], wanted.memory)[0].tolist()
        pairs = zip(DIVISIONS, likely, strict=True)
        bold = [p ** (1 / self.coin.temperature) if d in wanted.divisions else 0.0 for d, p in pairs]
        least = min(self.coin.least * sum(bold), max(bold))
        chances = [chance if chance >= least else 0.0 for chance in bold]
        whole = sum(chances)
        edges = [round(edge * _ROUNDING) / _ROUNDING for edge in accumulate(chance / whole for chance in chances)]
        return DIVISIONS[bisect_right(edges[:-1], self.rng.random())]

    def _chord(
        self,
        row: NDArray[np.float32],
        keys: Sequence[Hashable],
        favour: Sequence[float],
        decided: Sequence[bool | None],
    ) -> list[bool]:
        """What is struck (9,) at a step of that row and those contexts, but for what is `decided` (9,)."""
        network, weights = self.model.network, self.weights
        hidden, begun = network.begun(row)
        after = self.line.memory.after(keys) if self.wanted.memory else []
        heard, quiet = heard_in(after), None
        asked = (network.questions(hidden) + begun)[0].tolist()
        chances = self.rng.random(INSTRUMENTS).tolist()
        struck: list[bool] = []
        for k in range(INSTRUMENTS):
            is_struck = decided[k]
            if is_struck is None:
                odds = weights[0] * asked[k] + weights[1 + EVIDENCE + k]
                if heard >> k & 1:
                    odds += odds_of(after, k, self.says)
                else:
                    quiet = odds_of(after, k, self.says) if quiet is None else quiet
                    odds += quiet
                is_struck = self.coin.falls(odds + favour[k], chances[k])
            if is_struck or heard >> k & 1:
                after = given(after, k, is_struck)
                heard, quiet = heard_in(after), None
            struck.append(is_struck)
            if is_struck and k + 1 < INSTRUMENTS:
                hidden += network.struck[k]
                asked = (network.questions(hidden) + begun)[0].tolist()
        return struck

    def _favour(self, beat: int) -> list[float]:
        """What is added to the log-odds (9,) in a beat."""
        favour = self.wanted.favour
        none = favour is None or beat >= len(favour)
        return [0.0] * INSTRUMENTS if favour is None or none else favour[beat].tolist()

    def _decided(self, beat: int) -> list[list[bool | None]]:
        """What of a beat's cells (8, 9) is struck or not whatever the odds: as it was given, and what is not wanted."""
        wanted = self.wanted
        never = [None if Instrument(k) in wanted.instruments else False for k in range(INSTRUMENTS)]
        if wanted.given is None or not wanted.is_fixed(beat) or wanted.is_given is None:
            return [never] * MOST_CELLS
        fixed, struck = wanted.is_given[beat].tolist(), wanted.given.struck[beat].tolist()
        return [
            [given_so if is_fixed else no for is_fixed, given_so, no in zip(*cell, never, strict=True)]
            for cell in zip(fixed, struck, strict=True)
        ]

    def _keep_given(self, played: Beats) -> None:
        """Velocity, lateness and ornament of strokes that were given."""
        wanted = self.wanted
        if wanted.given is None or wanted.is_given is None:
            return
        count = min(len(wanted.is_given), len(played))
        kept = wanted.is_given[:count] & wanted.given.struck[:count]
        for mine, theirs in (
            (played.velocity, wanted.given.velocity),
            (played.late_ms, wanted.given.late_ms),
            (played.ornament, wanted.given.ornament),
        ):
            mine[:count][kept] = theirs[:count][kept]
