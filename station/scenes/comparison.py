"""A bar of a result to be seen as it is heard: the demonstrator, and over it the student as they played it.

The student's sticks are those of their double (`student_figure`): a limb shows the demonstrator's stroke when the
student struck, and glows where that was early or late. Times are those of the result's score.
"""

from dataclasses import dataclass, replace

import numpy as np

from station.core.events import Hit
from station.core.pieces import Limb
from station.core.units import NS_PER_MS, NS_PER_S
from station.motion.drummer import Drummer
from station.motion.style.automation_lanes import in_passes
from station.music.performance import Performance
from station.practice.now.tempo_now import replay_tempo
from station.practice.now.whereabouts import replay_place
from station.practice.session.session import SessionResult
from station.render.snapshot import BarNumbers, Hud, Snapshot, StudentShown, TimingCue
from station.scenes.demonstrator import Demonstrator
from station.scenes.session_scene import CUE_OF_LEAN, strikes
from station.scenes.student_figure import StudentFigure, nearest_note

FAR_NS = 150 * NS_PER_MS
"""A stroke so far from every note of its piece was meant for another (our choice: a sixteenth at 100 a minute)."""


@dataclass(frozen=True, slots=True)
class Replayed:
    """Who is heard, in `words`; at how many beats a minute they played, None for the tempo at which it is heard."""

    words: str
    beats_a_minute: float | None = None


class Comparison:
    """One bar, from 0, of `result`, demonstrated by `demonstrator`; `played` by `whose` lies over it, None: nothing."""

    def __init__(
        self, result: SessionResult, bar: int, played: Performance | None, demonstrator: Demonstrator, whose: Replayed
    ) -> None:
        plan, tempo_map = result.plan, result.score.tempo_map
        self._lesson_bar, self._beat_ticks = plan.bar_names[bar], plan.lesson.beat_ticks
        self._start_ns = int(tempo_map.ns_at(tempo_map.bar_start(bar)))
        style = in_passes(demonstrator.style, self._lesson_bar, 1, 1)
        self._drummer = Drummer(result.score.bars(bar, bar), plan.kit, demonstrator.figure, style)
        hits = () if played is None else tuple(played)
        self._hits = [replace(hit, at_ns=hit.at_ns - self._start_ns) for hit in hits]
        self._is_alone, self._windows = played is None, plan.level.windows
        tempo = replay_tempo(result.score, bar, self._beat_ticks, whose.beats_a_minute)
        self._hud = Hud(
            plan.lesson.title,
            replay_place(whose.words, self._lesson_bar + 1).words,
            bar=self._lesson_bar + 1,
            bar_count=plan.lesson.score.bar_count,
            beats=tempo_map.meter_at(tempo_map.bar_start(bar)).beats,
            beats_a_minute=tempo.now,
            tempo_words=tempo.words,
        )

    def snapshot(self, at_ns: int) -> Snapshot:
        """The picture at a time of the result's score."""
        drummer, now_ns = self._drummer, at_ns - self._start_ns
        past = [hit for hit in self._hits if hit.at_ns <= now_ns] if len(drummer.score) else []
        return Snapshot(
            score=drummer.score,
            position_s=now_ns / NS_PER_S,
            kit=drummer.kit,
            figure=drummer.figure,
            pose=drummer.pose(now_ns / NS_PER_S),
            limbs=drummer.assignment.limbs,
            strikes=strikes(past, now_ns),
            hud=self._hud,
            bar_numbers=BarNumbers(self._lesson_bar, 1),
            beat_ticks=self._beat_ticks,
            double=None if self._is_alone else self._double(past, now_ns),
        )

    def _parting(self, hit: Hit) -> tuple[int, TimingCue]:
        """The note that `hit` was meant for, and how it parts from it; far from all of its piece it is a wrong pad."""
        onset_ns = self._drummer.score.onset_ns
        row = nearest_note(hit.piece, self._drummer, hit.at_ns / NS_PER_S)
        if row is not None and abs(hit.at_ns - int(onset_ns[row])) <= FAR_NS:
            return row, CUE_OF_LEAN[self._windows.lean((hit.at_ns - int(onset_ns[row])) / NS_PER_MS)]
        return int(np.argmin(np.abs(onset_ns - hit.at_ns))), TimingCue.WRONG_PIECE

    def _double(self, past: list[Hit], now_ns: int) -> StudentShown:
        """The student as they stand after the strokes of the `past`."""
        double, drummer = StudentFigure(), self._drummer
        double.heard(past, drummer, now_ns / NS_PER_S, now_ns)
        for hit in past:
            row, cue = self._parting(hit)
            double.parted(Limb(drummer.assignment.limbs[row]), cue, hit.at_ns)
        return replace(double.double(drummer, now_ns / NS_PER_S, now_ns), is_compared=True)
