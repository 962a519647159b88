"""Ghosts, normal strokes and accents from velocities; names and levels by hand."""

from collections.abc import Sequence
from random import Random

import pytest

from station.core.pieces import Dynamic, Piece
from station.drills.grid.stroke_settings import Velocities
from station.drills.transcription.strokes.loudness_levels import levels_of, with_dynamics
from station.music.score import Note

G, N, A = Dynamic


def dynamics(velocities: Sequence[int], piece: Piece = Piece.SNARE) -> list[Dynamic]:
    return [n.dynamic for n in with_dynamics([Note(i, piece, velocity=v) for i, v in enumerate(velocities)])[0]]


@pytest.mark.parametrize("velocity", [20, 64, 100, 110, 127])
def test_one_velocity_is_no_accent(velocity: int) -> None:
    assert set(dynamics([velocity] * 16)) == {N}


def test_one_velocity_a_piece_is_no_accent() -> None:
    """As sequencers write grooves: the snare at 120, the kick at 110, the hi-hat at 100."""
    pieces = ((Piece.SNARE, 120), (Piece.KICK, 110), (Piece.HIHAT, 100))
    notes = [Note(i, piece, velocity=v) for i in range(8) for piece, v in pieces]
    assert {n.dynamic for n in with_dynamics(notes)[0]} == {N}


def test_our_own_levels_are_what_they_are() -> None:
    assert dynamics([116, 32, 80, 32, 116, 80, 80, 32]) == [A, G, N, G, A, N, N, G]
    notes = [Note(i, p, velocity=v) for i in range(4) for p, v in ((Piece.SNARE, 116), (Piece.HIHAT, 80))]
    named, velocities = with_dynamics(notes)
    assert {(n.piece, n.dynamic) for n in named} == {(Piece.SNARE, A), (Piece.HIHAT, N)}
    assert velocities == Velocities()


def test_accents_alone_on_a_piece_are_accents_where_the_take_has_our_levels() -> None:
    """Eight strokes about 106 are no nearer to normal ones, for others of the take are those."""
    hihat = [70, 86, 74, 75, 84, 71, 89, 68, 73, 80, 77, 70, 85, 72, 69, 78]
    snare = [104, 99, 112, 103, 118, 102, 106, 101]
    notes = [Note(i, Piece.HIHAT, velocity=v) for i, v in enumerate(hihat)]
    notes += [Note(i, Piece.SNARE, velocity=v) for i, v in enumerate(snare)]
    named = [n for n in with_dynamics(notes)[0] if n.piece is Piece.SNARE]
    assert {n.dynamic for n in named} == {A}


def test_two_groups_are_named_by_what_they_are_nearest_to() -> None:
    assert dynamics([40, 96] * 8) == [G, N] * 8
    assert dynamics([68, 120] * 8) == [N, A] * 8
    assert dynamics([24, 122] * 8) == [G, A] * 8


def test_what_is_mostly_struck_is_no_accent() -> None:
    """A snare of loud backbeats with a few ghosts, and a hi-hat that is loud but on its upbeats."""
    assert dynamics([16, 127, 127, 127] * 4) == [G, N, N, N] * 4
    assert dynamics([60, 127, 127, 127] * 4, Piece.HIHAT) == [G, N, N, N] * 4


def test_one_stray_among_as_many_accents_as_other_strokes_makes_no_ghosts_of_those() -> None:
    """Eighths on a hi-hat, each quarter an accent, the last upbeat struck as loudly: no hi-hat of ghosts at 58."""
    eighths = [100, 58, 98, 61, 104, 56, 101, 60, 97, 55, 102, 59, 99, 57, 103, 96]
    assert dynamics(eighths, Piece.HIHAT) == [A, N] * 7 + [A, A]


def test_what_is_mostly_struck_is_a_ghost_on_drums_alone() -> None:
    assert dynamics([127, 18, 18, 18] * 4) == [A, G, G, G] * 4
    assert dynamics([127, 18, 18, 18] * 4, Piece.HIHAT) == [A, N, N, N] * 4
    assert dynamics([98, 48, 48, 48] * 4, Piece.KICK) == [A, N, N, N] * 4


def test_three_levels_whose_loudest_prevails_are_two() -> None:
    """Accents that are most strokes stand out from nothing: 64 and 95, nearest to each other, are one level."""
    assert dynamics([64, 95, 127, 127, 127, 127] * 4, Piece.HIHAT) == [G, G, N, N, N, N] * 4


def test_never_more_than_three() -> None:
    """Five exact levels, as a program might write: the nearest ones are one."""
    assert len(levels_of([20, 45, 70, 95, 120] * 6)) == 3


def test_people_spread_by_eight_are_still_heard() -> None:
    """A groove of ghosts, normal strokes and accents with a practised player's spread: 95 of 100 right."""
    random = Random(1)
    meant = [random.choice((G, G, N, A)) for _ in range(400)]
    played = [round(random.gauss(Velocities().usual[d], 8)) for d in meant]
    found = dynamics([min(max(v, 1), 127) for v in played])
    assert sum(a is b for a, b in zip(found, meant, strict=True)) >= 380


def test_one_way_to_strike_with_spread_is_one_level() -> None:
    random = Random(2)
    assert len(levels_of([round(random.gauss(74, 9)) for _ in range(300)])) == 1


def test_what_the_file_names_stays() -> None:
    notes = [Note(0, Piece.SNARE, velocity=70, dynamic=A), Note(1, Piece.SNARE, velocity=60)]
    named, velocities = with_dynamics(notes)
    assert [(n.dynamic, n.velocity) for n in named] == [(A, 70), (N, 60)]
    assert velocities.of(Piece.SNARE, A) == 70


def test_the_lesson_says_the_players_own_levels() -> None:
    notes = [Note(i, Piece.SNARE, velocity=v) for i, v in enumerate([22, 24, 26, 101, 102, 103] * 3)]
    velocities = with_dynamics(notes)[1]
    assert [velocities.of(Piece.SNARE, dynamic) for dynamic in Dynamic] == [24, 80, 102]
    assert not velocities.of_piece, "one piece alone needs no table of its own"


def test_what_pieces_share_is_said_once() -> None:
    levels = {Piece.KICK: 110, Piece.SNARE: 110, Piece.HIHAT: 110, Piece.RIDE: 64}
    velocities = with_dynamics([Note(i, piece, velocity=v) for i, (piece, v) in enumerate([*levels.items()] * 8)])[1]
    assert velocities.usual == (32, 110, 116)
    assert dict(velocities.of_piece) == {Piece.RIDE: (32, 64, 116)}
