"""An exam from its plan to what is kept of it."""

from dataclasses import replace
from pathlib import Path

import pytest

from station.core.settings import Settings
from station.drills.exam.exam_piece import ExamPiece, Unseen, prepared_piece, reading_piece
from station.drills.library import find_lesson
from station.music.performance import Performance
from station.practice.exam.exam_record import exam_document, keep_exam, marks_text, rubric_text, was_seen
from station.practice.exam.exam_sitting import Sitting
from station.practice.exam.exam_take import exam_marks, exam_plan, exam_runner
from station.practice.headless.virtual_session import practise_virtually
from station.practice.session.device_latency import Latency
from station.practice.session.plan import Phase
from station.practice.session.session import SessionResult
from station.simulation.student_spec import parse_spec
from tests.fakes.known_students import one_student, take_all_in


@pytest.fixture(scope="module")
def piece() -> ExamPiece:
    return reading_piece(Unseen(2, 11))


@pytest.fixture(scope="module")
def result(piece: ExamPiece) -> SessionResult:
    return practise_virtually(exam_plan(piece, Settings()), parse_spec("seed=1,sd_ms=5")).result


def test_nothing_is_demonstrated_and_it_is_played_once(piece: ExamPiece) -> None:
    plan = exam_plan(piece, Settings())
    assert [segment.phase for segment in plan.segments] == [Phase.COUNT_IN, Phase.PASS]
    assert plan.bars == (0, piece.lesson.score.bar_count - 1)


def test_nothing_is_shown_while_it_is_played(piece: ExamPiece) -> None:
    session = exam_runner(exam_plan(piece, Settings()), Latency()).session
    assert session.shown(session.verdicts.values()) == ()
    assert not session.waits


def test_a_lesson_is_played_at_its_goal() -> None:
    lesson = find_lesson("rock-1")
    assert prepared_piece(lesson).tempo_bpm == lesson.target_tempo_bpm
    assert prepared_piece(lesson).preview_s == 0


def test_a_steady_student_reads_with_distinction(piece: ExamPiece, result: SessionResult) -> None:
    assert exam_marks(piece, result).band.name == "distinction"


def test_who_stops_half_way_is_marked_over_the_whole(piece: ExamPiece, result: SessionResult) -> None:
    half_ns = result.score.length_ns // 2
    hits = result.performance.hits
    played = Performance.from_array(hits[hits["at_ns"] < half_ns])
    early = replace(result, score=result.score.until_ns(half_ns), performance=played, complete=False)
    assert exam_marks(piece, early).total < 60


def test_computer_keys_are_not_marked_for_loudness() -> None:
    accents = prepared_piece(find_lesson("baiao-1"))
    played = practise_virtually(exam_plan(accents, Settings()), parse_spec("pro,seed=1")).result
    keys = replace(played, device="keyboard")
    criteria = [{str(mark.line.criterion) for mark in exam_marks(accents, one).lines} for one in (played, keys)]
    assert criteria[0] - criteria[1] == {"loudness"}


def test_a_piece_that_was_shown_is_unseen_no_more(piece: ExamPiece, tmp_path: Path) -> None:
    ada = one_student(tmp_path, "Ada L.")
    assert not was_seen(ada, piece.unseen or Unseen(0, 0))
    folder, broken = (ada.folder / f"2026-01-0{day}T10-00-00_reading" for day in (1, 2))
    folder.mkdir(parents=True)
    keep_exam(folder, exam_document(piece, None, seen_before=False))
    broken.mkdir()
    (broken / "exam.json").write_text("[[[")
    take_all_in(ada)
    assert was_seen(ada, Unseen(2, 11))
    assert not was_seen(ada, Unseen(2, 12))
    assert not was_seen(one_student(tmp_path, "Grace"), Unseen(2, 11))


def test_a_piece_is_seen_as_soon_as_it_is_looked_at(piece: ExamPiece, tmp_path: Path) -> None:
    ada = one_student(tmp_path, "Ada L.")
    Sitting.begin(piece, ada.settings)
    assert was_seen(ada, Unseen(2, 11))
    assert Sitting.begin(piece, ada.settings).seen_before


def test_the_rubric_says_before_what_the_marks_say_after(piece: ExamPiece, result: SessionResult) -> None:
    before, after = rubric_text(piece), marks_text(exam_marks(piece, result), seen_before=True)
    for line in piece.rubric.lines:
        assert line.title in before
        assert line.words in before
        assert line.title in after
    assert "90 seconds" in before
    assert "met this piece before" in after
