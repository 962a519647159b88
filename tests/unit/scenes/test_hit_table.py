"""Dots of a session by hand: bars of four quarters on the snare at 120 bpm, the loop played twice."""

import numpy as np
import pytest

from station.core.events import Choke, Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.drills.lesson import Lesson
from station.engine.messages import Bus, Started
from station.music.judgement import Label
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.practice.demonstration.compare_by_ear import BREATH_NS, bar_by_ear, students_bar
from station.practice.session.cues.listening import RING_NS
from station.practice.session.plan import TAIL_NS, PlanOptions, plan_practice
from station.practice.session.session import Session, SessionResult
from station.scenes.hit_table import dot_label, every_hit, nearest
from station.scenes.wrong_pads import wrong_pads

BAR_NS, BEAT_NS = 2 * NS_PER_S, NS_PER_S // 2


def result(*strokes: tuple[float, Piece]) -> SessionResult:
    """Two passes of bars 2 and 3 of a lesson, played by `strokes` in ms of the score."""
    score = Score.from_notes([Note(i * PPQ, Piece.SNARE) for i in range(12)], TempoMap.constant(120))
    lesson = Lesson(name="quarters", title="Quarters", score=score, loop=(1, 2))
    session = Session(plan_practice(lesson, PlanOptions(demonstrations=0, loops=2)))
    session.start()
    session.handle(Started(0))
    for at_ms, piece in strokes:
        session.handle(Hit(BAR_NS + round(at_ms * NS_PER_MS), piece, Zone.HEAD, 90))
    session.handle(Choke(BAR_NS + 2 * BAR_NS + BEAT_NS, Piece.CRASH_1))
    session.advance(BAR_NS + 4 * BAR_NS + TAIL_NS)
    return session.result()


S, T = Piece.SNARE, Piece.TOM_1
PLAYED = [(beat * 500.0 + 10.0, S) for beat in range(16) if beat not in (5, 6)]
RESULT = result(*PLAYED, (3000.0, T), (750.0, Piece.RIDE))
"""Everything 10 ms late; of the second bar beat 2 is left out and beat 3 struck on the tom; a ride between."""


def test_passes_lie_over_each_other_and_bars_are_the_lesson_s() -> None:
    hits = every_hit(RESULT)
    assert hits.bars == (2, 3)
    assert hits.pieces == [Piece.SNARE, Piece.RIDE]
    notes = hits.dots[:16]
    assert notes["pass"].tolist() == [1] * 8 + [2] * 8
    assert notes["bar"].tolist() == [2, 2, 2, 2, 3, 3, 3, 3] * 2
    assert notes["row_bar"].tolist() == [bar for bar in range(4) for _ in range(4)]
    assert notes["place"][:8].tolist() == [2.0, 2.25, 2.5, 2.75, 3.0, 3.25, 3.5, 3.75]
    assert notes["late_ms"][0] == pytest.approx(10.0)
    assert np.isnan(notes["late_ms"][5])


def test_what_is_told_of_a_dot() -> None:
    dots = every_hit(RESULT).dots
    assert dot_label(dots[1], 5.0) == "Bar 2, beat 2, snare: 10 ms late (pass 1)"
    assert dot_label(dots[1], 10.0) == "Bar 2, beat 2, snare: on time (10 ms late) (pass 1)", "as its dot is drawn"
    assert dot_label(dots[5], 5.0) == "Bar 3, beat 2, snare: missed (pass 1)"
    assert dot_label(dots[6], 5.0) == "Bar 3, beat 3, snare: on time, on a wrong pad (pass 1)"
    assert dot_label(dots[16], 5.0) == "Bar 2, beat 2.5, ride: not written (pass 1)"
    assert dots["label"][16] == Label.EXTRA
    early = dots[1].copy()
    early["late_ms"] = -7.4
    assert dot_label(early, 5.0) == "Bar 2, beat 2, snare: 7 ms early (pass 1)"


def test_one_piece_alone() -> None:
    hits = every_hit(RESULT)
    assert len(hits.of(None)) == 17
    assert len(hits.of(Piece.RIDE)) == 1


def test_nothing_played_and_nothing_judged_has_no_dots() -> None:
    score = Score.from_notes([Note(0, Piece.SNARE)], TempoMap.constant(120))
    session = Session(plan_practice(Lesson(name="one", title="One", score=score), PlanOptions(demonstrations=0)))
    assert len(every_hit(session.result()).dots) == 0


def test_the_dot_under_the_mouse() -> None:
    at = np.array([[0.0, 0.0], [30.0, 40.0]])
    assert nearest(at, (27.0, 36.0), 6.0) == 1  # 5 away
    assert nearest(at, (27.0, 36.0), 4.9) is None
    assert nearest(np.empty((0, 2)), (0.0, 0.0), 10.0) is None


def test_the_teacher_s_bar_sounds_as_written() -> None:
    heard = bar_by_ear(RESULT, 1, None)
    assert heard.from_ns == BAR_NS - BREATH_NS
    assert heard.length_ns == BREATH_NS + BAR_NS + RING_NS
    for bus in (Bus.DEMONSTRATION, Bus.CLICK):
        mine = heard.cues[heard.cues["bus"] == bus]
        assert mine["at_ns"].tolist() == [BREATH_NS + beat * BEAT_NS for beat in range(4)]


def test_the_student_s_bar_has_what_belongs_to_it() -> None:
    """Of bar 2: beats 1 and 4 on the snare, 10 ms late, beat 3 on the tom."""
    heard = bar_by_ear(RESULT, 1, students_bar(RESULT, 1))
    mine = heard.cues[heard.cues["bus"] == Bus.DEMONSTRATION]
    late_ns = 10 * NS_PER_MS
    assert mine["at_ns"].tolist() == [
        BREATH_NS + late_ns,
        BREATH_NS + 2 * BEAT_NS,
        BREATH_NS + 3 * BEAT_NS + late_ns,
    ]
    assert mine["piece"].tolist() == [S, T, S]


def test_an_early_downbeat_belongs_to_its_bar_and_a_choke_to_the_bar_of_its_time() -> None:
    played = result(*((beat * 500.0 - 40.0, S) for beat in range(16)))
    mine = bar_by_ear(played, 2, students_bar(played, 2)).cues
    mine = mine[mine["bus"] == Bus.DEMONSTRATION]
    assert mine["at_ns"][0] == BREATH_NS - 40 * NS_PER_MS
    assert len(mine) == 5
    grabbed = mine[mine["velocity"] == 0]
    assert grabbed["at_ns"].tolist() == [BREATH_NS + BEAT_NS]
    assert grabbed["piece"].tolist() == [Piece.CRASH_1]


def test_what_was_struck_for_what() -> None:
    """The tom for the snare once in bar 3; then twice more in the second pass, and a ride for the snare."""
    assert [pad.words for pad in wrong_pads(RESULT)] == ["high tom for snare, 1×"]
    pieces = {1: T, 5: T, 9: Piece.RIDE, 13: T}
    made = result(*[(beat * 500.0, pieces.get(beat, S)) for beat in range(16)])
    tom, ride = wrong_pads(made)
    assert (tom.times, tom.bar, tom.pass_number) == (3, 3, 2), "most in bar 3, the last in the second pass"
    assert (ride.struck, ride.written, ride.times, ride.bar) == (Piece.RIDE, S, 1, 2)
    assert wrong_pads(result(*[(beat * 500.0, S) for beat in range(16)])) == ()
