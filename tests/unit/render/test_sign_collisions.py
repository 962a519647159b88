"""No sign of an engraved part lies on another: all shipped lessons as they are printed, and chords that could clash."""

from itertools import combinations

import numpy as np
import pytest

from station.core.pieces import HAND_PIECES, Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.music.grace_strokes import with_graces
from station.music.score import Note
from station.render.notation.staff import head_of, step_of
from tests.shipped_lesson import shipped_lessons
from tests.unit.render.scores import BAR, score_of
from tests.unit.render.sign_collisions import Inked, collisions, inked_lines, overlapping

_WAYS = {
    "drum": [
        (Zone.HEAD, Articulation.NORMAL),
        (Zone.RIM, Articulation.NORMAL),
        (Zone.RIM, Articulation.CROSS_STICK),
        (Zone.RIM, Articulation.RIM_SHOT),
    ],
    "cymbal": [(Zone.BOW, Articulation.NORMAL), (Zone.EDGE, Articulation.NORMAL), (Zone.BELL, Articulation.NORMAL)],
}
_DRUMS = {Piece.SNARE, Piece.TOM_1, Piece.TOM_2, Piece.TOM_3, Piece.TOM_4, Piece.FLOOR_TOM_1, Piece.FLOOR_TOM_2}
_CYMBALS = {Piece.HIHAT, Piece.RIDE, Piece.RIDE_2, Piece.CRASH_1, Piece.CRASH_2, Piece.SPLASH, Piece.CHINA}


def test_the_counter_sees_ink_on_ink_and_not_what_lies_beside_it() -> None:
    square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    corner = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    signs = [Inked("head", "", (square + shift,)) for shift in ((0.0, 0.0), (0.5, 0.5), (3.0, 0.0), (4.02, 0.0))]
    assert list(overlapping(signs)) == [(signs[0], signs[1])]
    diagonal = [Inked("head", "", (corner,)), Inked("rest", "", (1.2 - corner,))]
    assert not list(overlapping(diagonal)), "boxes that meet are no signs that do"


@pytest.mark.parametrize("part", range(8))
def test_nothing_collides_in_the_shipped_lessons(part: int) -> None:
    for lesson in shipped_lessons(part, 8):
        assert not collisions(lesson.played_once.as_written), lesson.title


def test_no_two_things_that_sound_differently_are_written_alike() -> None:
    found: dict[tuple[int, int], tuple[Piece, Zone, Articulation]] = {}
    for piece in Piece:
        kind = "drum" if piece in _DRUMS else "cymbal" if piece in _CYMBALS else ""
        for zone, how in _WAYS.get(kind, [(Zone.HEAD, Articulation.NORMAL)]):
            sign = step_of(piece), int(head_of(piece, zone, how))
            assert sign not in found, (found.get(sign), piece, zone, how)
            found[sign] = piece, zone, how
    assert len(found) == 7 * 4 + 7 * 3 + 6


def test_what_two_hands_and_a_foot_strike_at_once_stands_side_by_side() -> None:
    pairs = list(combinations(sorted(HAND_PIECES), 2))
    for first, second in pairs:
        for foot in (Piece.KICK, Piece.HIHAT_PEDAL):
            score = score_of(Note(0, first), Note(0, second), Note(0, foot))
            assert not collisions(score), (first, second, foot)


@pytest.mark.parametrize("soft", [Piece.SNARE, Piece.TOM_2, Piece.HIHAT])
def test_brackets_are_clear_of_every_other_head(soft: Piece) -> None:
    for other in sorted(HAND_PIECES - {soft}):
        score = score_of(Note(0, soft, dynamic=Dynamic.GHOST), Note(0, other), Note(0, Piece.KICK))
        assert not collisions(score), other


def test_a_bar_of_everything_at_once() -> None:
    """Flams and drags before accents and ghosts, hats that open and close, chokes, chicks and splashes of the foot."""
    right, left = Limb.RIGHT_HAND, Limb.LEFT_HAND
    notes: list[Note] = []
    for k, (ornament, dynamic) in enumerate((o, d) for o in (Ornament.FLAM, Ornament.DRAG) for d in Dynamic):
        tick = k * PPQ // 2
        notes += with_graces(Note(tick, Piece.SNARE, ornament=ornament, dynamic=dynamic, limb=left))
        notes.append(Note(tick, Piece.HIHAT, Zone.BOW, openness=(k % 3) / 2, dynamic=Dynamic.ACCENT, limb=right))
        foot = Articulation.SPLASH if k % 2 else Articulation.CHICK
        notes.append(Note(tick, Piece.HIHAT_PEDAL, Zone.PEDAL, articulation=foot, limb=Limb.LEFT_FOOT))
    notes.append(Note(3 * PPQ, Piece.CRASH_1, Zone.EDGE, choke_ticks=PPQ, dynamic=Dynamic.ACCENT, limb=right))
    notes += [Note(BAR + round(k * PPQ / 3), Piece.SNARE, dynamic=Dynamic(k % 3), limb=left) for k in range(12)]
    assert not collisions(score_of(*notes))


def test_rests_of_two_voices_keep_clear_of_the_other_s_heads() -> None:
    notes = [Note(PPQ // 4, Piece.TOM_4), Note(BAR // 2, Piece.FLOOR_TOM_2), Note(0, Piece.KICK)]
    notes += [Note(PPQ + PPQ // 8, Piece.SNARE), Note(PPQ, Piece.KICK), Note(BAR - PPQ // 4, Piece.KICK)]
    score = score_of(*notes)
    assert not collisions(score)
    heights = {sign.name: sign.box[1] for line in inked_lines(score) for sign in line if sign.kind == "rest"}
    assert heights, "there are rests to keep clear"


def test_a_dot_keeps_clear_of_its_flag() -> None:
    """A dotted eighth alone in its beat, on the top line or a ledger line, where its stem is shortest."""
    for piece in (Piece.RIDE, Piece.CRASH_1):
        score = score_of(Note(PPQ // 4, piece), Note(PPQ, Piece.SNARE))
        assert any(sign.name == "dot" for line in inked_lines(score) for sign in line)
        assert not collisions(score), piece


@pytest.mark.parametrize("piece", [Piece.SNARE, Piece.TOM_1, Piece.FLOOR_TOM_2])
@pytest.mark.parametrize("first", [PPQ // 4, PPQ // 2, 3 * PPQ // 4, 7 * PPQ // 8])
def test_a_buzz_keeps_clear_of_its_flags(piece: Piece, first: int) -> None:
    buzz = Note(first, piece, articulation=Articulation.BUZZ, ornament=Ornament.ROLL, duration_ticks=PPQ // 8)
    assert not collisions(score_of(buzz, Note(PPQ, Piece.KICK)))


@pytest.mark.parametrize("over", [Piece.RIDE, Piece.CRASH_1, Piece.SPLASH])
@pytest.mark.parametrize("step", [PPQ // 2, PPQ // 4])
def test_a_buzz_under_a_beam_keeps_clear_of_the_heads(over: Piece, step: int) -> None:
    notes = [Note(k * step, over) for k in range(PPQ // step)]
    notes.append(Note(step, Piece.SNARE, articulation=Articulation.BUZZ, ornament=Ornament.ROLL, duration_ticks=step))
    assert not collisions(score_of(*notes))
