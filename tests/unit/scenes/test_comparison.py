"""A bar of a result that is seen as it is heard: the student's sticks strike when they did, and glow where
they were off.

Rock 1 at 80 beats a minute: a beat is 0.75 s. A drummer who is made for the bar from nothing says where sticks are.
"""

from dataclasses import replace

import numpy as np
import pytest

from station.core.pieces import Limb, Piece
from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.drills.library import find_lesson
from station.engine.messages import Started
from station.motion.drummer import Drummer
from station.music.judgement import Label
from station.music.performance import Performance
from station.practice.session.plan import TAIL_NS, PlanOptions, plan_practice
from station.practice.session.session import Session, SessionResult
from station.render.snapshot import TimingCue
from station.scenes.comparison import Comparison, Replayed
from station.scenes.demonstrator import Demonstrator
from station.simulation.student_spec import parse_spec
from station.simulation.virtual_student import play

PLAN = plan_practice(find_lesson("rock-1"), PlanOptions(tempo_bpm=80.0, loops=2, demonstrations=0))
BAR_NS = 3 * NS_PER_S
BAR = 3
"""The second bar of the second pass."""
KICK_NS = BAR * BAR_NS


def result() -> SessionResult:
    session = Session(PLAN)
    session.handle(Started(0))
    session.advance(PLAN.end_ns + TAIL_NS)
    return session.result()


def played(late_ms: float) -> Performance:
    """The bar by a student without a fault, all of it so late."""
    exact = play(
        PLAN.score, parse_spec("seed=1,sd_ms=0,bias_ms=0,miss_pct=0,extra_pct=0,wrong_piece_pct=0")
    ).performance
    hits = [hit for hit in exact if KICK_NS - 1000 <= hit.at_ns < KICK_NS + BAR_NS - 1000]
    return Performance.from_hits([replace(hit, at_ns=hit.at_ns + round(late_ms * NS_PER_MS)) for hit in hits])


@pytest.fixture(scope="module")
def late() -> Comparison:
    return Comparison(result(), BAR, played(40.0), Demonstrator(), Replayed("you"))


def test_the_student_s_sticks_are_on_the_drum_when_he_struck(late: Comparison) -> None:
    """The snare on the second beat, 40 ms late: the stick is where the demonstrator's was 40 ms before."""
    teacher = Drummer(PLAN.score.bars(BAR, BAR), PLAN.kit)
    seen = late.snapshot(KICK_NS + 750 * NS_PER_MS + 40 * NS_PER_MS)
    assert seen.double is not None
    assert seen.double.is_compared
    left = Limb.LEFT_HAND
    struck = teacher.pose(0.75).tip_m[left % 2]
    assert seen.double.pose.tip_m[left % 2] == pytest.approx(struck, abs=1e-6)
    assert seen.pose is not None
    assert not np.allclose(seen.pose.tip_m[left % 2], struck, atol=1e-3)


def test_a_limb_that_was_late_glows_and_one_in_time_does_not(late: Comparison) -> None:
    at_ns = KICK_NS + 100 * NS_PER_MS
    seen = late.snapshot(at_ns).double
    assert seen is not None
    assert {limb: parting.cue for limb, parting in seen.partings.items()} == {
        Limb.RIGHT_HAND: TimingCue.LATE,
        Limb.RIGHT_FOOT: TimingCue.LATE,
    }
    in_time = Comparison(result(), BAR, played(0.0), Demonstrator(), Replayed("you")).snapshot(at_ns).double
    assert in_time is not None
    assert not in_time.partings


def test_only_what_was_struck_by_then_is_seen_and_lights_its_drum(late: Comparison) -> None:
    assert {strike.piece for strike in late.snapshot(KICK_NS + 50 * NS_PER_MS).strikes} == {Piece.KICK, Piece.HIHAT}
    assert not late.snapshot(KICK_NS + 30 * NS_PER_MS).strikes


def test_the_teacher_is_seen_alone_with_the_lesson_s_own_bar() -> None:
    seen = Comparison(result(), BAR, None, Demonstrator(), Replayed("the teacher")).snapshot(KICK_NS)
    assert seen.double is None
    assert (seen.hud.phase, seen.hud.bar, seen.position_s) == ("Replay of bar 2: the teacher", 2, 0.0)


def test_the_arm_that_struck_a_wrong_pad_glows() -> None:
    """The floor tom for the snare on the second beat; the snare is the left hand's."""
    hits = [replace(hit, piece=Piece.FLOOR_TOM_1) if hit.piece is Piece.SNARE else hit for hit in played(0.0)]
    seen = Comparison(result(), BAR, Performance.from_hits(hits), Demonstrator(), Replayed("you"))
    double = seen.snapshot(KICK_NS + 800 * NS_PER_MS).double
    assert double is not None
    assert double.partings[Limb.LEFT_HAND].cue is TimingCue.WRONG_PIECE


def test_what_was_played_stands_on_the_staff_from_the_beginning(late: Comparison) -> None:
    """Every stroke 40 ms late: each note of the bar bears that mark, whatever the play line has reached."""
    seen = late.snapshot(KICK_NS)
    assert seen.marks is not None
    assert seen.is_replay
    assert (seen.marks["label"] == Label.MATCH).all()
    assert seen.marks["asynchrony_ms"] == pytest.approx(np.full(len(seen.score), 40.0), abs=0.01)
    assert not seen.extras


def test_misses_wrong_pads_and_strokes_too_many_stand_there_too() -> None:
    """Without the kick on one, the floor tom for the snare on two, a crash between two and three."""
    hits = [hit for hit in played(0.0) if hit.at_ns > KICK_NS + 1000 or hit.piece is not Piece.KICK]
    beat_ns = 750 * NS_PER_MS
    wrong = [
        replace(hit, piece=Piece.FLOOR_TOM_1)
        if hit.piece is Piece.SNARE and abs(hit.at_ns - KICK_NS - beat_ns) < NS_PER_MS
        else hit
        for hit in hits
    ]
    extra = replace(hits[0], piece=Piece.CRASH_1, at_ns=KICK_NS + beat_ns + beat_ns // 4)
    performance = Performance.from_hits(sorted([*wrong, extra], key=lambda hit: hit.at_ns))
    seen = Comparison(result(), BAR, performance, Demonstrator(), Replayed("you")).snapshot(KICK_NS)
    assert seen.marks is not None
    notes = seen.score.notes
    labels = {
        (int(n["tick"]) // PPQ, Piece(int(n["piece"]))): Label(int(m))
        for n, m in zip(notes, seen.marks["label"], strict=True)
        if n["tick"] % PPQ == 0
    }
    assert labels[0, Piece.KICK] is Label.MISS
    assert labels[1, Piece.SNARE] is Label.WRONG_PIECE
    assert labels[3, Piece.SNARE] is Label.MATCH
    assert [extra.piece for extra in seen.extras] == [Piece.CRASH_1]
    assert seen.extras[0].time_s == pytest.approx(0.9375)


def test_the_teacher_s_bar_bears_no_marks() -> None:
    seen = Comparison(result(), BAR, None, Demonstrator(), Replayed("the teacher")).snapshot(KICK_NS)
    assert seen.marks is None
    assert not seen.extras


def test_one_s_own_bar_is_judged_as_the_report_has_it() -> None:
    """Nobody has played in this session: all its notes were missed, whatever is laid over the bar."""
    seen = Comparison(result(), BAR, played(0.0), Demonstrator(), Replayed("you"), is_own=True).snapshot(KICK_NS)
    assert seen.marks is not None
    assert (seen.marks["label"] == Label.MISS).all()
