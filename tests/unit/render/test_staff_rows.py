"""Rows above and below the staff: beyond every sign of a score, and no farther than its fullest bar asks."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Dynamic, Limb, Piece, Zone
from station.core.units import PPQ
from station.music.score import Note, Score
from station.render.notation.engraving import Engraver
from station.render.notation.staff_rows import staff_rows, stem_end
from station.render.text.paper import OutlineAtlas
from station.render.text.sign_outlines import SIGNS
from tests.shipped_lesson import shipped_lessons
from tests.unit.render.scores import rock, score_of

ATLAS = OutlineAtlas()
NUMBERS = [round(ATLAS.sign(name).uv[0]) for name in SIGNS if not name.startswith(("beat", "loud"))]


def signs_reach(shapes: NDArray[np.void]) -> tuple[float, float]:
    """How far up and down the music signs go; outlines on paper have no margin."""
    signs = shapes[np.isin(np.rint(shapes["uv"][:, 0]), NUMBERS) & (shapes["uv"][:, 3] > 0)]
    y, half = signs["centre"][:, 1], signs["half"][:, 1]
    return float((y - half).min()), float((y + half).max())


@pytest.mark.parametrize("part", range(3))
def test_words_and_letters_stand_beyond_every_sign(part: int) -> None:
    for lesson in shipped_lessons(part, 24):
        score = lesson.played_once
        rows, engraver = staff_rows(score), Engraver(score, ATLAS)
        for bar in range(min(score.bar_count, 4)):
            top, bottom = signs_reach(engraver.bar(bar, with_line=False))
            assert rows.words <= rows.hands < top, lesson.title
            assert bottom < rows.bottom, lesson.title
        assert rows.top < rows.words


def test_a_voice_that_is_silent_takes_no_room() -> None:
    hands, both = (staff_rows(score_of(Note(0, Piece.SNARE), *more)) for more in ((), (Note(0, Piece.KICK),)))
    assert hands.bottom < 3.5 < both.bottom, "the staff ends two spaces below its middle line"
    assert hands.top == both.top


def test_rows_of_some_bars_are_those_of_their_signs() -> None:
    loud = [Note(4 * PPQ, Piece.HIHAT, Zone.BOW, openness=1.0, dynamic=Dynamic.ACCENT)]
    score = Score.from_notes([*rock(), *loud], rock().tempo_map)
    plain, full, whole = (staff_rows(score, None, bars) for bars in (range(1), range(1, 2), None))
    assert full.hands < plain.hands
    assert whole.hands == full.hands


def test_letters_take_their_rows_only_where_they_are() -> None:
    def words(*limbs: Limb) -> float:
        notes = [Note(0, piece, limb=limb) for piece, limb in zip((Piece.SNARE, Piece.TOM_1), limbs, strict=True)]
        return staff_rows(score_of(*notes)).words

    none, one, two = (
        words(*limbs)
        for limbs in (
            (Limb.UNKNOWN, Limb.UNKNOWN),
            (Limb.UNKNOWN, Limb.RIGHT_HAND),
            (Limb.LEFT_HAND, Limb.RIGHT_HAND),
        )
    )
    assert two < one < none, "each line of letters lifts the words"


def test_stems_clear_heads_beams_flags_and_rests() -> None:
    hat = -2.5  # G5
    assert stem_end([hat], is_up=True) == pytest.approx(-5.5), "level at least three spaces over the hi-hat"
    assert stem_end([hat], is_up=True, flag_room=0.0) <= hat - 3.24 - 0.5, "flag8thUp reaches 3.24 down to the head"
    beams = [stem_end([-4.0], is_up=True, beams=count) for count in (1, 2, 3, 4)]
    assert beams == sorted(beams, reverse=True)
    assert beams[3] == pytest.approx(-4.0 - 3 * 0.75 - 0.5 - 1.0), "four beams, and a space over the head"
    assert stem_end([1.5], is_up=False, rests=[6.0]) == pytest.approx(6.0 + 0.5 + 0.3), "a beam below a long rest"
