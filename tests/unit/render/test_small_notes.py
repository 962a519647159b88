"""Strokes beyond the player on the staff: heads seven tenths as large (within what Gould has for cue notes)."""

from dataclasses import replace

import numpy as np
import pytest

from station.core.pieces import Limb, Piece
from station.core.units import PPQ
from station.music.repeats import Passage, folded
from station.music.score import NOTE_DTYPE, Note, Score
from station.music.tempo import TempoMap
from station.render.notation.engraving import Engraver
from station.render.notation.head_places import heads_x
from station.render.notation.page.sheet_key import notes_used, signs_used
from tests.unit.render.scores import BAR
from tests.unit.render.test_engraving import ATLAS, letters, of_sign


def song(*beyond: Note, bars: int = 1) -> Score:
    """Quarters of the right hand on the snare, and what more hands play."""
    own = [Note(k * PPQ, Piece.SNARE, limb=Limb.RIGHT_HAND) for k in range(4 * bars)]
    return Score.from_notes(own, TempoMap.constant(120), bars * BAR, beyond=beyond)


def test_the_rows_beyond_go_where_the_bars_go() -> None:
    score = song(Note(0, Piece.TOM_1), Note(BAR + PPQ, Piece.TOM_2, swing_ticks=60), bars=2)
    assert score.bars(1, 1).beyond["tick"].tolist() == [PPQ]
    assert score.repeated(2).beyond["tick"].tolist() == [0, BAR + PPQ, 2 * BAR, 3 * BAR + PPQ]
    assert score.as_written.beyond["tick"].tolist() == [0, BAR + PPQ - 60]
    landing = np.zeros(1, NOTE_DTYPE)
    assert score.landing_on(landing).beyond["tick"].tolist() == [0, BAR + PPQ]
    assert len(score) == 8, "never asked"


def test_the_whole_music_has_both_in_order() -> None:
    whole, is_beyond = song(Note(PPQ, Piece.TOM_1), Note(PPQ // 2, Piece.KICK)).whole
    assert whole.notes["tick"].tolist() == [0, PPQ // 2, PPQ, PPQ, 2 * PPQ, 3 * PPQ]
    assert [Piece(p) for p in whole.notes["piece"][is_beyond]] == [Piece.KICK, Piece.TOM_1]


def test_they_are_heads_of_seven_tenths_without_a_letter() -> None:
    engraver = Engraver(song(Note(PPQ, Piece.TOM_1, limb=Limb.LEFT_HAND)), ATLAS)
    heads = of_sign(engraver.bar(0), "head_round")["half"][:, 0]
    assert sorted((heads / heads.max()).tolist()) == pytest.approx([0.7, 1, 1, 1, 1])
    assert (letters(engraver.bar(0), "R"), letters(engraver.bar(0), "L")) == (4, 0)


def test_a_small_head_touches_the_stem_of_its_chord() -> None:
    """Both end at the same x on the stem's side: half of 1.18 spaces, Bravura's width of a black head."""
    shapes = of_sign(Engraver(song(Note(PPQ, Piece.TOM_1)), ATLAS).bar(0), "head_round")
    both = shapes[np.isclose(shapes["time_s"][:, 0], 0.5)]
    edges = both["centre"][:, 0] + np.array(
        [0.59 if h == both["half"][:, 0].max() else 0.413 for h in both["half"][:, 0]]
    )
    assert edges == pytest.approx([0.59, 0.59], abs=0.01)


def test_the_judged_strokes_keep_their_places() -> None:
    """Marks hang on the player's own rows: one head beside another that is a second away is not at 0."""
    assert heads_x(song()).tolist() == pytest.approx([0, 0, 0, 0])
    assert len(heads_x(song(Note(0, Piece.TOM_1), Note(10, Piece.TOM_1)))) == 4


def test_bars_with_other_strokes_beyond_are_not_folded() -> None:
    assert folded(song(bars=8)) == [Passage(0, 0, 8)]
    assert folded(song(Note(7 * BAR, Piece.TOM_1), bars=8)) == [Passage(0, 0, 7), Passage(7, 7)]
    own = song(bars=8)
    more = Score.from_notes([*own, Note(7 * BAR, Piece.TOM_1)], own.tempo_map, own.end_tick)
    again = replace(song(*(Note(k * BAR, Piece.TOM_1) for k in range(7)), bars=8), notes=more.notes)
    assert folded(again)[-1] == Passage(7, 7), "once it is asked, once it is not"


def test_the_key_says_what_small_is_and_names_its_drum() -> None:
    score = song(Note(0, Piece.COWBELL))
    assert [name for _, _, name in notes_used(score.whole[0])] == ["snare", "cowbell"]
    assert "small: beyond two hands and two feet" in [words for _, words in signs_used(score, [0], with_sticking=False)]
    assert not [words for _, words in signs_used(song(), [0], with_sticking=False)]
