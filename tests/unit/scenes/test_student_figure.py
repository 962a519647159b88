"""The student's double: where its limbs are after hits that are known to the millisecond.

What is expected are the demonstrator's own poses, asked for by hand at the times that the hits imply.
"""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.events import Hit
from station.core.pieces import Limb, Piece, Zone
from station.core.units import NS_PER_S
from station.drills.library import find_lesson
from station.engine.messages import Started
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import Joint, figure_of
from station.motion.kinematics.pose import LEFT, RIGHT
from station.motion.kit.kit import load_kit
from station.music.judgement import Judgement, Label
from station.practice.session.plan import Phase, PlanOptions, plan_practice
from station.practice.session.session import Session
from station.render.snapshot import TimingCue
from station.scenes.session_scene import SessionView
from station.scenes.student_figure import PARTED_NS, WAITS_S, StudentFigure
from tests.unit.render.scores import rock

DRUMMER = Drummer(rock(2), load_kit(), figure_of())
"""120 beats a minute: the hi-hat every 0.25 s, the snare at 0.5, 1.5, 2.5, 3.5 s, the kick at 0, 1, 2, 3 s."""
EARLIER_NS = 7 * NS_PER_S
"""When the score began."""


def hit(piece: Piece, at_s: float) -> Hit:
    return Hit(EARLIER_NS + round(at_s * NS_PER_S), piece, Zone.HEAD, 90)


def double_at(at_s: float, *hits: Hit) -> StudentFigure:
    double = StudentFigure()
    double.heard(hits, DRUMMER, at_s, EARLIER_NS + round(at_s * NS_PER_S))
    return double


def tips(at_s: float, *hits: Hit) -> NDArray[np.float64]:
    found = double_at(at_s, *hits).double(DRUMMER, at_s, EARLIER_NS + round(at_s * NS_PER_S))
    return found.pose.tip_m


def test_a_late_stroke_lands_when_it_is_heard() -> None:
    """The left hand's stroke of 0.5 s is heard 60 ms late: its tip is on the head then, and goes on 60 ms late."""
    late = hit(Piece.SNARE, 0.56)
    snare = load_kit().pieces[Piece.SNARE]
    assert abs((tips(0.56, late)[LEFT] - snare.centre) @ snare.normal) < 0.003
    assert tips(0.66, late)[LEFT] == pytest.approx(DRUMMER.pose(0.60).tip_m[LEFT])


def test_the_pedals_go_with_his_feet_and_nothing_that_he_did_not_strike_moves() -> None:
    """The kick of 1.0 s is heard 80 ms early: the beater is at its head then. At 1.12 s the demonstrator's crash-free
    hi-hat has been struck, not by the student."""
    early = hit(Piece.KICK, 0.92)
    found = double_at(0.92, early).double(DRUMMER, 0.92, EARLIER_NS + round(0.92 * NS_PER_S)).pose
    assert found.beater_rad == DRUMMER.pose(1.0).beater_rad != DRUMMER.pose(0.92).beater_rad
    assert DRUMMER.pose(1.02).swing_rad.any()
    still = double_at(1.02).double(DRUMMER, 1.02, EARLIER_NS + round(1.02 * NS_PER_S)).pose
    assert not still.swing_rad.any()
    assert not still.flash.any()


def test_an_early_stroke_lands_before_it_is_written() -> None:
    snare = load_kit().pieces[Piece.SNARE]
    assert abs((tips(0.45, hit(Piece.SNARE, 0.45))[LEFT] - snare.centre) @ snare.normal) < 0.003


def test_a_limb_that_is_not_heard_waits_before_its_stroke() -> None:
    waiting = DRUMMER.pose(0.5 - WAITS_S).tip_m[LEFT]
    for at_s in (0.5, 0.6, 1.2):
        assert tips(at_s)[LEFT] == pytest.approx(waiting)
    assert tips(0.3)[LEFT] == pytest.approx(DRUMMER.pose(0.3).tip_m[LEFT]), "until then it prepares as written"


def test_limbs_move_by_themselves_on_the_demonstrator_s_trunk() -> None:
    hats = [hit(Piece.HIHAT, 0.25 * k) for k in range(5)]
    found = double_at(1.1, *hats).double(DRUMMER, 1.1, EARLIER_NS + round(1.1 * NS_PER_S)).pose
    now = DRUMMER.pose(1.1)
    assert found.tip_m[RIGHT] == pytest.approx(now.tip_m[RIGHT], abs=1e-6)
    assert np.abs(found.tip_m[LEFT] - now.tip_m[LEFT]).max() > 0.02
    assert found.joints_m[: Joint.RIGHT_SHOULDER] == pytest.approx(now.joints_m[: Joint.RIGHT_SHOULDER])


def test_a_piece_that_is_not_written_moves_nobody() -> None:
    assert np.array_equal(tips(0.4, hit(Piece.CRASH_1, 0.38)), tips(0.4))


def test_what_was_played_before_the_score_is_forgotten() -> None:
    assert np.array_equal(tips(0.1, hit(Piece.SNARE, -2.0)), tips(0.1))


def test_a_limb_that_parted_glows_for_a_while() -> None:
    double = StudentFigure()
    double.parted(Limb.LEFT_HAND, TimingCue.LATE, 0)
    double.parted(Limb.RIGHT_FOOT, TimingCue.ON_TIME, 0)

    def partings(now_ns: int) -> dict[Limb, tuple[TimingCue, float]]:
        found = double.double(DRUMMER, 1.0, now_ns).partings
        return {limb: (parting.cue, round(parting.strength, 6)) for limb, parting in found.items()}

    assert partings(0) == {Limb.LEFT_HAND: (TimingCue.LATE, 1.0)}
    assert partings(PARTED_NS // 2) == {Limb.LEFT_HAND: (TimingCue.LATE, 0.5)}
    assert partings(PARTED_NS) == {}
    double.parted(Limb.LEFT_HAND, TimingCue.ON_TIME, 10)
    assert partings(20) == {}, "the next stroke was together"


def test_the_session_shows_it_in_the_passes_and_tells_it_what_was_judged() -> None:
    plan = plan_practice(find_lesson("rock-2"), PlanOptions(loops=1, demonstrations=1))
    view, session = SessionView(plan), Session(plan)
    session.handle(Started(0, None))
    begun = {segment.phase: segment.start_ns for segment in plan.segments}

    def seen(now_ns: int) -> object:
        session.advance(now_ns)
        return view.snapshot(session, now_ns).double

    assert seen(begun[Phase.DEMONSTRATION] + 10) is None
    now_ns = begun[Phase.PASS] + NS_PER_S
    assert seen(now_ns) is not None
    snare = int(np.flatnonzero(plan.score.notes["piece"] == Piece.SNARE)[0])
    missed = Judgement(Label.MISS, snare, None)
    view.judged((missed,), (), now_ns, session.plan.level.windows)
    double = view.snapshot(session, now_ns).double
    assert double is not None
    assert {limb: parting.cue for limb, parting in double.partings.items()} == {Limb.LEFT_HAND: TimingCue.MISSED}
