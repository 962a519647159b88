"""Bars that go on from what was heard: the model asked step by step, and a generator that decides.

`continued` is the door. The same generator, in the same state, gives the same bars; log-odds are rounded to 1/1024
before a decision, so that the last bits of another computer's sums change one only by the rarest chance.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import exp
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Dynamic
from station.music.stroke_velocities import usual_velocity
from station.practice.battle.improvising.bar_memory import EVIDENCE, BarMemory, chord_of, contexts, given, said_of
from station.practice.battle.improvising.beat_model import BeatModel, music_after
from station.practice.battle.improvising.beat_steps import (
    GRID,
    INSTRUMENTS,
    LONGEST_LAG,
    RECENT,
    Music,
    Steps,
    step_rows,
    steps_of,
)
from station.practice.battle.improvising.played_beats import Beats, Instrument
from station.practice.battle.improvising.played_divisions import DIVISIONS, MOST_CELLS
from station.practice.battle.improvising.wanted import Wanted

_ROUNDING = 1024.0
_Number = TypeVar("_Number", bound=np.generic)


def continued(model: BeatModel, heard: Sequence[Beats], bars: int, wanted: Wanted, rng: np.random.Generator) -> Beats:
    """So many bars after what was `heard` (turns in order, any number), as `wanted`.

    `struck` and `division` are the model's; velocity is that of a normal stroke, lateness and ornament 0, but for
    strokes that were given. What is heard is listened to first, about a millisecond a bar, and so is what is played.
    """
    beats_a_bar = heard[0].beats_a_bar if heard else wanted.given.beats_a_bar if wanted.given else 4
    past, music = music_after(heard, wanted.music)
    line = _Line.after(past, bars * beats_a_bar, beats_a_bar)
    weights = model.mixing_at(wanted.memory).tolist()
    chooser = _Chooser(model, line, music, wanted, rng, weights)
    return chooser.play(bars * beats_a_bar)


@dataclass(eq=False)
class _Line:
    """What was heard and what is played, growing: `steps` has room for it all, `step` are there; with a memory."""

    steps: Steps
    memory: BarMemory
    chords: list[int]
    beat: int

    @classmethod
    def after(cls, past: Sequence[Beats], beats: int, beats_a_bar: int) -> "_Line":
        """What was heard, remembered, and room for so many beats."""
        known = steps_of(past[0]) if past else steps_of(Beats.silent(0, beats_a_bar))
        steps = _with_room(known, beats)
        memory, chords = BarMemory(), list[int]()
        for step, struck in enumerate(known.played > 0):
            keys = contexts(steps, step, chords)
            chords.append(chord_of(struck))
            memory.learn(keys, chords[-1])
        return cls(steps, memory, chords, len(known.division))

    @property
    def step(self) -> int:
        """The next step."""
        return len(self.chords)

    def cut(self, division: int) -> None:
        """Begin the next beat with so many cells."""
        self.steps.division[self.beat] = division
        cells = slice(self.step, self.step + division)
        self.steps.beat[cells] = self.beat
        self.steps.cell[cells] = np.arange(division)
        self.steps.at[cells] = self.beat * GRID + np.arange(division) * (GRID // division)

    def strike(self, struck: NDArray[np.float32]) -> None:
        """Play the next step (9,)."""
        steps, step = self.steps, self.step
        keys = contexts(steps, step, self.chords)
        steps.struck[RECENT + step] = struck
        steps.grid[LONGEST_LAG * GRID + steps.at[step]] = struck
        self.chords.append(chord_of(struck))
        self.memory.learn(keys, self.chords[-1])

    def end_beat(self) -> None:
        """Count what the beat had, and go on to the next."""
        steps = self.steps
        in_beat = steps.struck[RECENT + self.step - int(steps.division[self.beat]) : RECENT + self.step]
        steps.counts[self.beat + 1] = steps.counts[self.beat] + in_beat.sum(axis=0)
        self.beat += 1


def _with_room(known: Steps, beats: int) -> Steps:
    """The steps with room behind them for so many beats of the finest division."""
    room = beats * MOST_CELLS
    return Steps(
        known.beats_a_bar,
        division=_longer(known.division, beats),
        beat=_longer(known.beat, room),
        cell=_longer(known.cell, room),
        at=_longer(known.at, room),
        struck=_longer(known.struck, room),
        grid=_longer(known.grid, beats * GRID),
        counts=_longer(known.counts, beats),
    )


def _longer(values: NDArray[_Number], by: int) -> NDArray[_Number]:
    return np.concatenate([values, np.zeros((by, *values.shape[1:]), values.dtype)])


@dataclass(frozen=True, eq=False)
class _Chooser:
    """Asks the model about the next of a line, and decides."""

    model: BeatModel
    line: _Line
    music: Music
    wanted: Wanted
    rng: np.random.Generator
    weights: list[float]

    def play(self, beats: int) -> Beats:
        """So many beats, played on the line."""
        played = Beats.silent(beats, self.line.steps.beats_a_bar)
        for beat in range(beats):
            played.division[beat] = self._division(beat)
            self.line.cut(int(played.division[beat]))
            for cell in range(int(played.division[beat])):
                struck = self._chord(beat, cell)
                self.line.strike(struck)
                played.struck[beat, cell] = struck > 0
            self.line.end_beat()
        played.velocity[played.struck] = usual_velocity(Dynamic.NORMAL)
        self._keep_given(played)
        return played

    def _division(self, beat: int) -> int:
        wanted = self.wanted
        if wanted.given is not None and wanted.is_fixed(beat):
            return int(wanted.given.division[beat])
        at = np.array([self.line.beat])
        chance = self.model.divisions(self.line.steps, at, self.music, wanted.memory)[0]
        chance = np.where(np.isin(DIVISIONS, list(wanted.divisions)), chance, 0.0) ** (1 / wanted.temperature)
        chance = np.where(chance >= min(wanted.least_chance * chance.sum(), chance.max()), chance, 0.0)
        edges = np.round(np.cumsum(chance / chance.sum()) * _ROUNDING) / _ROUNDING
        return DIVISIONS[int(np.searchsorted(edges[:-1], self.rng.random(), side="right"))]

    def _chord(self, beat: int, cell: int) -> NDArray[np.float32]:
        """What is struck (9,) at the next step, `cell` of the beat."""
        line, wanted, network = self.line, self.wanted, self.model.network
        hidden, begun = network.begun(step_rows(line.steps, np.array([line.step]), self.music))
        after = line.memory.after(contexts(line.steps, line.step, line.chords)) if wanted.memory else []
        weights = self.weights
        chances = self.rng.random(INSTRUMENTS)
        struck = np.zeros(INSTRUMENTS, np.float32)
        for k in range(INSTRUMENTS):
            odds = weights[0] * float(network.question(k, hidden)[0] + begun[0, k]) + weights[1 + EVIDENCE + k]
            odds += sum(weights[1 + column] * said for column, said in said_of(after, k))
            is_struck = self._decided(beat, cell, k, odds, float(chances[k]))
            after = given(after, k, is_struck)
            if is_struck:
                struck[k] = 1.0
                hidden += network.struck[k]
        return struck

    def _decided(self, beat: int, cell: int, instrument: int, odds: float, chance: float) -> bool:
        """Whether an instrument is struck: as it was given, else by the odds and a number from 0 to 1."""
        wanted = self.wanted
        if wanted.given is not None and self._is_given(beat, cell, instrument):
            return bool(wanted.given.struck[beat, cell, instrument])
        if Instrument(instrument) not in wanted.instruments:
            return False
        if wanted.favour is not None and beat < len(wanted.favour):
            odds += float(wanted.favour[beat, instrument])
        odds = round(min(max(odds / wanted.temperature, -30.0), 30.0) * _ROUNDING) / _ROUNDING
        likely = 1 / (1 + exp(-odds))
        if likely < wanted.least_chance or likely > 1 - wanted.least_chance:
            return likely > 0.5
        return chance < likely

    def _is_given(self, beat: int, cell: int, instrument: int) -> bool:
        fixed = self.wanted.is_given
        return fixed is not None and beat < len(fixed) and bool(fixed[beat, cell, instrument])

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
