"""Fills snapshots: what the drummer, the score and the words over them show at one instant of a session.

The drummer demonstrates, then plays along: by the clock, or by the student's own phase where sensors tell it. The score
shown is the demonstration's, then that of all passes in a row.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from station.core.events import Hit
from station.core.pieces import Limb
from station.core.units import NS_PER_MS, NS_PER_S
from station.drills.mastery.feedback_fading import Feedback
from station.engine.engine import KEYBOARD
from station.motion.drummer import Drummer
from station.motion.style.style import Style
from station.music.judgement import Judgement, Label
from station.music.score import Score
from station.practice.now.directions_now import direction_of
from station.practice.now.entry_now import entry_words
from station.practice.now.tempo_now import session_tempo
from station.practice.now.whereabouts import Doing, whereabouts
from station.practice.session.plan import Phase, Plan
from station.practice.session.session import Session, SessionResult
from station.render.snapshot import ExtraHit, Hud, SeenStrike, Snapshot, TimingCue, mark, no_marks
from station.scenes.curves import ScoreCurves, played_of_marks, played_of_result
from station.scenes.demonstrator import Demonstrator
from station.scenes.session_part import SessionPart
from station.scenes.student_figure import StudentFigure
from station.scoring.matching.hit_windows import Windows
from station.scoring.matching.right import is_right

STRIKE_SHOWN_NS = 600 * NS_PER_MS
"""How long a stroke may show on the kit; our choice."""
WAITING_S = -2.0
"""A time before the score at which the drummer does nothing yet; our choice."""
CUE_SHOWN_NS = 1200 * NS_PER_MS
"""How long the coarse cue stays after what caused it; our choice."""

CUE_OF_LEAN = {-1: TimingCue.EARLY, 0: TimingCue.ON_TIME, 1: TimingCue.LATE}
"""The cue of a stroke that leans so (`Windows.lean`)."""
_WAITED_FOR = "play on: the score goes on with you"
MARKS_OF = {Feedback.TIMING: "", Feedback.PADS: ", early and late not shown", Feedback.NONE: ", blind: no marks"}
"""What is said of a pass in which marks are held back on purpose: else it looks as if nothing was heard."""
_CUE_OF = {Label.MISS: TimingCue.MISSED, Label.WRONG_PIECE: TimingCue.WRONG_PIECE}


class SessionView:
    """One session's pictures: that of `demonstrator` on the plan's kit."""

    def __init__(
        self,
        plan: Plan,
        demonstrator: Demonstrator | None = None,
        before: "SessionView | None" = None,
        demonstrates: bool = True,
        goes_on: bool = False,
    ) -> None:
        """`before` is the view that was shown last: its drummer sits there while this one's is made.

        Where nobody `demonstrates` they sit still, and hands are those that the score writes. Where practice `goes_on`
        more passes follow those of the plan.
        """
        self._goes_on = goes_on
        self.plan, self._demonstrates = plan, demonstrates
        self._demonstrator = demonstrator or Demonstrator()
        self._sits = None if before is None else before.sitting
        demonstrations = [s for s in plan.segments if s.phase is Phase.DEMONSTRATION]
        self._passes = SessionPart(plan, plan.score, plan.passes_start_ns, self._demonstrator)
        self._demonstration = (
            SessionPart(plan, plan.in_a_row(len(demonstrations)), demonstrations[0].start_ns, self._demonstrator)
            if demonstrations
            else self._passes
        )
        self._marks = no_marks(plan.score)
        self._cue: TimingCue = TimingCue.NONE
        self._cue_ns = 0
        self._double = StudentFigure()
        self._student_s: float | None = None

    @property
    def style(self) -> Style:
        """How the demonstrator moves."""
        return self._demonstrator.style

    def move_as(self, style: Style, hands_stay: bool = False) -> None:
        """Let the demonstrator move in another style from now on; with `hands_stay` they hold what they held."""
        self._demonstrator = replace(self._demonstrator, style=style.holding_as(self.style) if hands_stay else style)

    def follow(self, place_s: float | None) -> None:
        """In the passes let the drummer be where the student is, `place_s` in their score; None to go by the clock."""
        self._student_s = place_s

    def pass_place_s(self, session: Session) -> float | None:
        """Where the session's clock is in the passes' score; None while none is played."""
        state = session.state()
        if state.transport_ns is None or state.segment.phase is not Phase.PASS:
            return None
        return self._passes.position_s(state.transport_ns)

    def judged(self, verdicts: tuple[Judgement, ...], hits: Sequence[Hit], now_ns: int, windows: Windows) -> None:
        """Take in judgements of `hits` that the student may see; marks that older snapshots hold stay as they were."""
        if not verdicts:
            return
        self._marks = self._marks.copy()
        limbs = self.plan.score.notes["limb"]
        for verdict in verdicts:
            if verdict.note_index is not None:
                self._double.parted(Limb(limbs[verdict.note_index]), cue_of(verdict, windows), now_ns)
            mark(self._marks, verdict, loudness=not _by_key(verdict, hits))
            cue = cue_of(verdict, windows)
            if cue is not TimingCue.NONE:
                self._cue, self._cue_ns = cue, now_ns

    def judged_anew(self, session: Session) -> None:
        """Some of the session was taken back: show what is left of its judgements."""
        self._marks, self._cue = no_marks(self.plan.score), TimingCue.NONE
        for verdict in session.shown(session.verdicts.values()):
            mark(self._marks, verdict, loudness=not _by_key(verdict, session.hits))

    def snapshot(self, session: Session, now_ns: int, way_on: str = "") -> Snapshot:
        """The picture at session time `now_ns`; `way_on` says how to go on out of a pause."""
        state = session.state()
        if state.transport_ns is None:
            return self._ready(session)
        part, position_s = self._part_at(state.transport_ns)
        if not part.is_ready and self._sits is not None:
            return replace(
                self._waiting(part, self._sits),
                position_s=position_s,
                strikes=strikes(session.heard.recent, now_ns),
                hud=self._hud(session, now_ns, way_on),
            )
        drummer = part.drummer(self._demonstrator.style)
        double, drummer_s = None, position_s if self._demonstrates else WAITING_S
        if part is self._passes and self._demonstrates:
            if self._student_s is not None and state.segment.phase is Phase.PASS:
                drummer_s = self._student_s
            self._double.heard(session.heard.recent, drummer, drummer_s, now_ns)
            double = self._double.double(drummer, drummer_s, now_ns)
        return Snapshot(
            score=part.score,
            position_s=position_s,
            kit=drummer.kit,
            figure=drummer.figure,
            pose=drummer.pose(drummer_s),
            limbs=drummer.assignment.limbs if self._demonstrates else part.score.notes["limb"],
            marks=self._marks if part is self._passes else None,
            extras=self._extras(session) if part is self._passes and session.feedback is not Feedback.NONE else (),
            strikes=strikes(session.heard.recent, now_ns),
            hud=self._hud(session, now_ns, way_on),
            bar_numbers=part.bar_numbers,
            beat_ticks=self.plan.lesson.beat_ticks,
            double=double,
            comes_again=self._comes_again(part),
            before=self._before(part),
            on_time_ms=session.plan.level.windows.on_time_ms,
            view=direction_of(session).view,
        )

    def curves(self, session: Session) -> ScoreCurves | None:
        """The drummer who is seen, and what the student is shown of their own strokes; None while a drummer is made."""
        transport_ns = session.state().transport_ns
        part, position_s = (self._demonstration, 0.0) if transport_ns is None else self._part_at(transport_ns)
        if not part.is_ready:
            return None
        on_time_ms = self.plan.level.windows.on_time_ms
        played = played_of_marks(part.score, self._marks, on_time_ms) if part is self._passes else None
        return ScoreCurves(part.drummer(self._demonstrator.style), position_s, part.bar_numbers, played)

    def make_ahead(self) -> None:
        """Let whoever plays be made while nobody waits."""
        self._demonstration.ahead()
        self._passes.ahead()

    @property
    def sitting(self) -> Drummer | None:
        """A drummer who is made, to sit there before anything is played; None while there is none."""
        part = next((part for part in (self._demonstration, self._passes) if part.is_made), None)
        return self._sits if part is None else part.drummer(self._demonstrator.style)

    def _part_at(self, transport_ns: int) -> tuple[SessionPart, float]:
        """Who plays at a transport time, and where in their score they are."""
        part = self._passes if transport_ns >= self.plan.demonstrations_end_ns else self._demonstration
        return part, part.position_s(transport_ns)

    def _ready(self, session: Session) -> Snapshot:
        """The picture before anything runs: the drummer waits, the score stands at its first bar."""
        part, plan, drummer = self._demonstration, self.plan, self._sits
        if drummer is None or part.is_ready:
            drummer = part.drummer(self._demonstrator.style)
        tempo = session_tempo(session)
        hud = Hud(plan.lesson.title, whereabouts(session).words, beats_a_minute=tempo.now, tempo_words=tempo.words)
        return replace(self._waiting(part, drummer), hud=hud)

    def _waiting(self, part: SessionPart, drummer: Drummer) -> Snapshot:
        """Somebody sits there, and the score of `part` stands at its first bar."""
        return Snapshot(
            score=part.score,
            position_s=0.0,
            kit=self.plan.kit,
            figure=drummer.figure,
            pose=drummer.pose(WAITING_S),
            limbs=part.score.notes["limb"],
            bar_numbers=part.bar_numbers,
            beat_ticks=self.plan.lesson.beat_ticks,
            comes_again=self._comes_again(part),
            before=self._before(part),
        )

    def _comes_again(self, part: SessionPart) -> bool:
        """Whether the bars of `part` are played once more after it: passes follow a demonstration."""
        return part is not self._passes or self._goes_on

    def _before(self, part: SessionPart) -> Score | None:
        """What was played before `part`."""
        return self._demonstration.score if part is self._passes and part is not self._demonstration else None

    def _extras(self, session: Session) -> tuple[ExtraHit, ...]:
        hits = [session.hits[index] for index in session.extras()]
        return tuple(ExtraHit(hit.at_ns / NS_PER_S, hit.piece) for hit in hits)

    # --- words -------------------------------------------------------------------------------------------------------

    def _hud(self, session: Session, now_ns: int, way_on: str) -> Hud:
        plan, segment = self.plan, session.state().segment
        where, tempo = whereabouts(session), session_tempo(session)
        is_counted_in = where.doing is Doing.COUNT_IN
        right, judged = self._counts(session, segment.index) if segment.phase is Phase.PASS else (0, 0)
        age_ns = now_ns - self._cue_ns
        return Hud(
            title=plan.lesson.title,
            phase=where.words + (MARKS_OF[session.feedback] if segment.phase is Phase.PASS else ""),
            bar=where.bar,
            beat=where.beat,
            beats=_beats_of(plan, where.bar),
            bar_count=max(plan.lesson.score.bar_count, where.bar or 0),
            beats_a_minute=tempo.now,
            count_in=where.beat if is_counted_in else None,
            right=right,
            judged=judged,
            message=session.message if is_counted_in else entry_words(session) if where.doing is Doing.PASS else "",
            cue=self._cue if age_ns < CUE_SHOWN_NS else TimingCue.NONE,
            cue_age_s=age_ns / NS_PER_S,
            say=direction_of(session).say,
            tempo_words=tempo.words,
            reason="" if is_counted_in else session.message,
            halt=where.halt,
            way_on=way_on if where.doing is Doing.PAUSED else _WAITED_FOR if where.doing is Doing.WAITING else "",
        )

    def _counts(self, session: Session, pass_index: int) -> tuple[int, int]:
        """Notes right and notes judged of one pass, of those whose marks are shown."""
        first = pass_index * len(self.plan.section)
        end = first + len(self.plan.section) if pass_index + 1 < self.plan.passes else len(self.plan.score)
        shown = first + np.flatnonzero(self._marks["label"][first:end] >= 0)
        verdicts, is_grace = session.verdicts, self.plan.score.is_grace
        judged = [note for note in shown.tolist() if note in verdicts]
        right = sum(is_right(verdicts[note], bool(is_grace[note]), session.plan.level.windows) for note in judged)
        return right, len(judged)


def result_curves(result: SessionResult, demonstrator: Demonstrator) -> ScoreCurves:
    """The whole of a session that is over: who demonstrated it, and every stroke of the student."""
    plan = result.plan
    part = SessionPart(plan, result.score, 0, demonstrator)
    return ScoreCurves(part.drummer(demonstrator.style), None, part.bar_numbers, played_of_result(result))


def strikes(hits: Iterable[Hit], now_ns: int) -> tuple[SeenStrike, ...]:
    """What of `hits` still shows on the kit at `now_ns`."""
    ages = ((hit, now_ns - hit.at_ns) for hit in hits)
    return tuple(SeenStrike(h.piece, h.velocity, age / NS_PER_S) for h, age in ages if 0 <= age < STRIKE_SHOWN_NS)


def _by_key(verdict: Judgement, hits: Sequence[Hit]) -> bool:
    """Whether a key of the computer was struck: it cannot tell how hard."""
    return verdict.hit_index is not None and hits[verdict.hit_index].device == KEYBOARD


def _beats_of(plan: Plan, bar: int | None) -> int:
    """How many beats the lesson's `bar`, from 1, has as it is practised; None: the first."""
    tempo_map = plan.section.tempo_map
    return tempo_map.meter_at(tempo_map.bar_start(0 if bar is None else bar - 1 - plan.first_bar)).beats


def cue_of(verdict: Judgement, windows: Windows) -> TimingCue:
    """The coarse cue that a judgement gives; hits that answer no note give none."""
    if verdict.label is Label.MATCH and verdict.asynchrony_ns is not None:
        return CUE_OF_LEAN[windows.lean(verdict.asynchrony_ns / NS_PER_MS)]
    return _CUE_OF.get(verdict.label, TimingCue.NONE)
