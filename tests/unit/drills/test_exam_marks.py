"""The marks of an exam: their ends, their direction, and who tries to cheat them."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.pieces import Piece
from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.drills.exam.exam_marks import ExamTake, asks_loudness, marks_of
from station.drills.exam.exam_piece import Unseen, reading_piece
from station.drills.exam.rubric import Criterion, Marks, rubric_of
from station.music.performance import HIT_DTYPE, Performance
from station.music.score import Score
from station.scoring.align import align
from station.scoring.matching.hit_windows import Level
from tests.fakes.scores import beat_and_fill, even_snare, rock_beat

Array = NDArray[np.generic]
SCORES = [rock_beat(4), beat_and_fill(2), even_snare(32, 500)]
PADS = (Piece.KICK, Piece.SNARE, Piece.HIHAT, Piece.CRASH_1, Piece.RIDE, Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1)


def marks(score: Score, at_ns: Array, piece: Array, velocity: Array | int = 80) -> Marks:
    hits = np.zeros(len(at_ns), HIT_DTYPE)
    hits["at_ns"], hits["piece"], hits["velocity"] = at_ns, piece, velocity
    performance = Performance.from_array(hits)
    rubric = rubric_of(Level.INTERMEDIATE, asks_loudness(score))
    return marks_of(rubric, ExamTake(score, score.bar, performance, align(score, performance, clocked=True)))


def of(found: Marks, criterion: Criterion) -> float:
    return next(mark.share for mark in found.lines if mark.line.criterion is criterion)


@pytest.mark.parametrize("score", SCORES)
def test_what_is_written_earns_everything(score: Score) -> None:
    found = marks(score, score.onset_ns, score.notes["piece"], score.notes["velocity"])
    assert found.total == pytest.approx(100.0)
    assert found.band.name == "distinction"


@pytest.mark.parametrize("score", SCORES)
def test_silence_earns_nothing(score: Score) -> None:
    found = marks(score, score.onset_ns[:0], score.notes["piece"][:0])
    assert found.total == 0.0
    assert found.band.name == "not yet"


@pytest.mark.parametrize("score", SCORES)
def test_leaving_a_note_out_that_would_have_counted_never_pays(score: Score) -> None:
    rng = np.random.default_rng(3)
    at_ns = score.onset_ns + np.rint(rng.normal(0, 15 * NS_PER_MS, len(score))).astype(np.int64)
    whole = marks(score, at_ns, score.notes["piece"], score.notes["velocity"]).total
    for left_out in range(len(score)):
        rest = np.arange(len(score)) != left_out
        fewer = marks(score, at_ns[rest], score.notes["piece"][rest], score.notes["velocity"][rest]).total
        assert fewer <= whole + 0.3, "the lean of a piece is its own, so that one stroke moves the others a little"


def test_hammering_all_pads_is_no_way_to_pass() -> None:
    score = beat_and_fill(2)
    slots_ns = np.arange(0, score.length_ns, int(score.tempo_map.ns_at(PPQ // 4)))
    found = marks(score, np.repeat(slots_ns, len(PADS)), np.tile([int(p) for p in PADS], len(slots_ns)))
    assert found.total < 20


def test_half_a_piece_is_at_most_half_of_the_marks() -> None:
    score = rock_beat(4)
    first = score.bar < 2
    found = marks(score, score.onset_ns[first], score.notes["piece"][first], score.notes["velocity"][first])
    assert found.total == pytest.approx(100 * first.mean(), abs=2)
    assert of(found, Criterion.FLOW) == pytest.approx(0.5)


def test_a_slip_costs_its_notes_and_not_the_flow() -> None:
    score = rock_beat(4)
    kept = np.flatnonzero(score.bar != 1).tolist() + np.flatnonzero(score.bar == 1)[2:].tolist()
    found = marks(score, score.onset_ns[kept], score.notes["piece"][kept], score.notes["velocity"][kept])
    assert of(found, Criterion.FLOW) == 1.0
    assert of(found, Criterion.NOTES) == pytest.approx(len(kept) / len(score))


def test_time_is_the_windows_of_the_level_worked_out_by_hand() -> None:
    """Intermediate: full marks to 15 ms, half of them at 35, none at 70: 25 ms early and late in turn lie half way."""
    score = even_snare(32, 500)
    off_ns = np.where(np.arange(32) % 2 == 0, -25, 25) * NS_PER_MS
    found = marks(score, score.onset_ns + off_ns, score.notes["piece"])
    assert of(found, Criterion.TIME) == pytest.approx(0.75, abs=0.01)


def test_a_steady_lean_costs_nothing() -> None:
    score = even_snare(32, 500)
    found = marks(score, score.onset_ns - 20 * NS_PER_MS, score.notes["piece"])
    assert of(found, Criterion.TIME) == pytest.approx(1.0)


def test_without_loudness_the_others_share_its_marks() -> None:
    for asks in (True, False):
        assert sum(line.worth for line in rubric_of(Level.STUDIO, asks).lines) == pytest.approx(100.0)
    assert Criterion.LOUDNESS not in {line.criterion for line in rubric_of(Level.STUDIO, asks_loudness=False).lines}


def test_a_seed_is_a_piece() -> None:
    text = reading_piece(Unseen(3, 7)).lesson.text
    assert reading_piece(Unseen(3, 7)).lesson.text == text
    assert reading_piece(Unseen(3, 8)).lesson.text != text


@pytest.mark.parametrize("level", range(1, 6))
def test_reading_is_on_the_snare_up_to_the_third_level(level: int) -> None:
    piece = reading_piece(Unseen(level, 1))
    hands = set(piece.lesson.score.notes["piece"].tolist()) - {int(Piece.KICK), int(Piece.HIHAT_PEDAL)}
    assert (hands == {int(Piece.SNARE)}) == (level <= 4)
    assert piece.lesson.score.length_ns < 60 * NS_PER_S


def test_a_level_that_is_none_is_refused() -> None:
    with pytest.raises(BadInput, match="--reading: 6"):
        reading_piece(Unseen(6, 1))
