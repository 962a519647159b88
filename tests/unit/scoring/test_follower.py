"""Live judgement: what is said at once, and what is taken back."""

import pytest

from station.core.events import Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS, PPQ
from station.music.judgement import Judgement, Label
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.scoring.following.follower import Follower


def snares(count: int, other: Piece | None = None) -> Score:
    """Eighths on the snare at 120 bpm, 250 ms apart; `other` sounds with each."""
    notes = [Note(i * PPQ // 2, piece) for i in range(count) for piece in (Piece.SNARE, other) if piece is not None]
    return Score.from_notes(notes, TempoMap.constant(120))


def strike(follower: Follower, at_ms: float, piece: Piece = Piece.SNARE, velocity: int = 80) -> tuple[Judgement, ...]:
    at_ns = round(at_ms * NS_PER_MS)
    return follower.hit(Hit(at_ns, piece, Zone.HEAD, velocity), at_ns)


def test_a_hit_is_judged_at_once() -> None:
    (said,) = strike(Follower(snares(2)), 262, velocity=70)
    assert said == Judgement(Label.MATCH, 1, 0, 12 * NS_PER_MS, -10)


def test_a_velocity_is_judged_as_finely_as_it_was_sent() -> None:
    hit = Hit(0, Piece.SNARE, Zone.HEAD, 70, velocity_fraction=0.25)
    (said,) = Follower(snares(1)).hit(hit, 0)
    assert said == Judgement(Label.MATCH, 0, 0, 0, -9.75)


REACH_MS = 150.0
"""Of eighths at 120 bpm, 250 ms apart, before anything is known of the player: .6 of the way to the next; of a lone
note a third of a quarter."""
LONE_REACH_MS = 500 / 3


def test_reach_is_inclusive() -> None:
    reach_ms = round(LONE_REACH_MS * NS_PER_MS) / NS_PER_MS
    (inside,) = strike(Follower(snares(1)), -reach_ms)
    (outside,) = strike(Follower(snares(1)), -reach_ms - 1e-6)
    assert (inside.label, outside.label) == (Label.MATCH, Label.EXTRA)


def test_a_better_hit_takes_the_note_and_frees_the_first() -> None:
    follower = Follower(snares(2))
    (first,) = strike(follower, 170)
    said = strike(follower, 252)
    assert (first.label, first.note_index) == (Label.MATCH, 1)
    assert {(j.label, j.note_index, j.hit_index) for j in said} == {(Label.MATCH, 1, 1), (Label.EXTRA, None, 0)}


def test_an_early_hit_moves_to_the_note_before_when_the_next_one_comes() -> None:
    """Notes 100 ms apart: a hit 55 ms after the first is nearer the second until the second's own hit comes."""
    score = Score.from_notes([Note(i * PPQ // 5, Piece.SNARE) for i in range(2)], TempoMap.constant(120))
    follower = Follower(score)
    (first,) = strike(follower, 55)
    said = strike(follower, 101)
    assert first.note_index == 1
    assert {(j.label, j.note_index, j.hit_index) for j in said} == {(Label.MATCH, 0, 0), (Label.MATCH, 1, 1)}


def test_misses_are_said_when_it_is_too_late() -> None:
    follower = Follower(snares(2))
    reach = round(REACH_MS)
    assert follower.advance(reach * NS_PER_MS) == ()
    assert follower.advance((reach + 1) * NS_PER_MS) == (Judgement(Label.MISS, 0, None),)
    assert follower.advance((reach + 2) * NS_PER_MS) == ()


def test_a_hit_delivered_late_takes_the_miss_back() -> None:
    follower = Follower(snares(2))
    follower.advance(1_000 * NS_PER_MS)
    (said,) = strike(follower, 20)
    assert (said.label, said.note_index) == (Label.MATCH, 0)


def test_wrong_piece_until_the_right_one_comes() -> None:
    follower = Follower(snares(2))
    (wrong,) = strike(follower, 245, Piece.TOM_1)
    said = strike(follower, 270)
    assert (wrong.label, wrong.note_index) == (Label.WRONG_PIECE, 1)
    assert {(j.label, j.note_index, j.hit_index) for j in said} == {(Label.MATCH, 1, 1), (Label.EXTRA, None, 0)}


def test_a_hit_that_loses_its_own_note_answers_the_other_piece_that_it_met() -> None:
    """Snare at 200, tom at 300: a tom stroke at 205 waits for the tom until a better one comes."""
    score = Score.from_notes([Note(2 * PPQ // 5, Piece.SNARE), Note(3 * PPQ // 5, Piece.TOM_1)], TempoMap.constant(120))
    follower = Follower(score)
    (first,) = strike(follower, 205, Piece.TOM_1)
    said = strike(follower, 301, Piece.TOM_1)
    assert (first.label, first.note_index) == (Label.MATCH, 1)
    assert {(j.label, j.note_index, j.hit_index) for j in said} == {(Label.MATCH, 1, 1), (Label.WRONG_PIECE, 0, 0)}


def test_what_stands_is_not_said_again() -> None:
    follower = Follower(snares(3))
    strike(follower, 195, Piece.TOM_1)
    strike(follower, 250)
    assert len(strike(follower, 500)) == 1


def test_simultaneous_notes_in_any_order() -> None:
    for order in ((Piece.SNARE, Piece.CRASH_1), (Piece.CRASH_1, Piece.SNARE)):
        follower = Follower(snares(2, other=Piece.CRASH_1))
        said = [judgement for piece in order for judgement in strike(follower, 3, piece)]
        assert {j.label for j in said} == {Label.MATCH}


@pytest.mark.parametrize(
    ("piece", "velocity", "label"),
    [
        (Piece.HIHAT_PEDAL, 80, Label.IGNORED),
        (Piece.SNARE, 30, Label.IGNORED),
        (Piece.SNARE, 80, Label.EXTRA),
        (Piece.TOM_1, 30, Label.EXTRA),
    ],
)
def test_what_nobody_counts(piece: Piece, velocity: int, label: Label) -> None:
    """A backbeat: a snare with a hat on it, in a bar of its own groove."""
    follower = Follower(snares(2, other=Piece.HIHAT))
    strike(follower, 0)
    said = [*strike(follower, 125, piece, velocity), *strike(follower, 250)]
    assert [verdict.label for verdict in said if verdict.hit_index == 1][-1] is label


def test_quiet_strokes_beside_a_snare_alone_are_extras() -> None:
    """An exercise of the snare has no backbeat to put ghosts beside."""
    follower = Follower(snares(2))
    strike(follower, 0)
    said = [*strike(follower, 125, Piece.SNARE, 30), *strike(follower, 250)]
    assert [verdict.label for verdict in said if verdict.hit_index == 1][-1] is Label.EXTRA


def test_pieces_that_the_score_lacks() -> None:
    (said,) = strike(Follower(snares(2)), 125, Piece.COWBELL)
    assert (said.label, said.note_index) == (Label.EXTRA, None)
