"""A bar of a result to be seen as it is heard: the demonstrator, and over it the student as they played it.

The student's sticks are those of their double (`student_figure`): a limb shows the demonstrator's stroke when the
student struck, and glows where that was early or late. What became of each stroke stands on the staff from the
beginning, by the same judgements (`judged_bar`). Times are those of the result's score.
"""

from dataclasses import dataclass, replace

from station.core.events import Hit
from station.core.pieces import Limb
from station.core.units import NS_PER_S
from station.engine.engine import KEYBOARD
from station.motion.drummer import Drummer
from station.motion.style.automation_lanes import in_passes
from station.music.performance import Performance
from station.practice.now.tempo_now import replay_tempo
from station.practice.now.whereabouts import replay_place
from station.practice.session.session import SessionResult
from station.render.snapshot import BarNumbers, Hud, Snapshot, StudentShown
from station.scenes.demonstrator import Demonstrator
from station.scenes.judged_bar import extras_of, marks_of, own_bar, played_bar
from station.scenes.session_scene import cue_of, strikes
from station.scenes.student_figure import StudentFigure


@dataclass(frozen=True, slots=True)
class Replayed:
    """Who is heard, in `words`; at how many beats a minute they played, None for the tempo at which it is heard."""

    words: str
    beats_a_minute: float | None = None


class Comparison:
    """One bar, from 0, of `result`, demonstrated by `demonstrator`; `played` by `whose` lies over it, None: nothing.

    `is_own`: it was played in that session, whose report has judged it.
    """

    def __init__(
        self,
        result: SessionResult,
        bar: int,
        played: Performance | None,
        demonstrator: Demonstrator,
        whose: Replayed,
        is_own: bool = False,
    ) -> None:
        plan, tempo_map = result.plan, result.score.tempo_map
        self._lesson_bar, self._beat_ticks = plan.bar_names[bar], plan.lesson.beat_ticks
        self._start_ns = int(tempo_map.ns_at(tempo_map.bar_start(bar)))
        style = in_passes(demonstrator.style, self._lesson_bar, 1, 1)
        self._drummer = Drummer(result.score.bars(bar, bar), plan.kit, demonstrator.figure, style)
        hits = () if played is None else tuple(played)
        self._hits = [replace(hit, at_ns=hit.at_ns - self._start_ns) for hit in hits]
        self._is_alone, self._windows, score = played is None, plan.level.windows, self._drummer.score
        tempo = replay_tempo(result.score, bar, self._beat_ticks, whose.beats_a_minute)
        self._judged = own_bar(result, bar) if is_own else []
        if played is not None and not is_own:
            self._judged = played_bar(score, played.shifted(-self._start_ns))
        self._marks = None if played is None else marks_of(score, self._judged, is_own and result.device != KEYBOARD)
        self._extras = extras_of(self._judged)
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
            marks=self._marks,
            extras=self._extras,
            is_replay=True,
            on_time_ms=self._windows.on_time_ms,
            strikes=strikes(past, now_ns),
            hud=self._hud,
            bar_numbers=BarNumbers(self._lesson_bar, 1),
            beat_ticks=self._beat_ticks,
            double=None if self._is_alone else self._double(past, now_ns),
        )

    def _double(self, past: list[Hit], now_ns: int) -> StudentShown:
        """The student as they stand after the strokes of the `past`."""
        double, drummer = StudentFigure(), self._drummer
        double.heard(past, drummer, now_ns / NS_PER_S, now_ns)
        for stroke in self._judged:
            row, at_ns = stroke.judgement.note_index, stroke.at_ns
            if row is not None and at_ns is not None and at_ns <= now_ns:
                double.parted(Limb(drummer.assignment.limbs[row]), cue_of(stroke.judgement, self._windows), at_ns)
        return replace(double.double(drummer, now_ns / NS_PER_S, now_ns), is_compared=True)
