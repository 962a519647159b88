"""The letter *: a stroke that the music has and the player cannot make besides."""

from station.core.pieces import Articulation, Dynamic, Limb, Piece, Zone
from station.drills.writing.lesson_part import part_of
from station.drills.writing.lesson_text import show
from tests.unit.drills.reading import EIGHTH, QUARTER, WHOLE, faults, read, text_of

THREE_HANDS = 'hihat = "x - x -"\ntom_1 = "* - - -"\nsnare = "o - o -"\nsticking = "B - B -"\nkick = "o - - -"'


def test_what_is_beyond_the_player_is_kept_and_not_asked() -> None:
    lesson = read(THREE_HANDS)
    assert [(int(r["tick"]), Piece(r["piece"])) for r in lesson.beyond] == [(0, Piece.TOM_1)]
    assert Piece.TOM_1 not in {note.piece for note in lesson.score}
    assert len(lesson.score) == 5


def test_it_is_a_plain_stroke_of_its_line() -> None:
    row = read('hihat = "x *"\nhihat_pedal = "- *"\nsnare = "o -"\nkick = "- *"').beyond
    assert [(Piece(r["piece"]), Articulation(r["articulation"]), Zone(r["zone"])) for r in row] == [
        (Piece.KICK, Articulation.NORMAL, Zone.HEAD),
        (Piece.HIHAT, Articulation.NORMAL, Zone.BOW),
        (Piece.HIHAT_PEDAL, Articulation.CHICK, Zone.PEDAL),
    ]
    assert set(row["dynamic"].tolist()) == {Dynamic.NORMAL}
    assert set(row["velocity"].tolist()) == {80}
    assert Limb.RIGHT_FOOT in row["limb"]


def test_it_is_repeated_with_its_bar_and_its_grid() -> None:
    lesson = read('times = 2\nsnare = "| o* -- -- -- | % |"')
    assert lesson.beyond["tick"].tolist() == [EIGHTH + i * WHOLE for i in range(4)]


def test_the_sticking_line_says_nothing_of_it() -> None:
    assert read('snare = "o *"\nsticking = "R -"').score[0].limb is Limb.RIGHT_HAND
    assert "no hand strikes here" in faults(text_of('snare = "o *"\nsticking = "R L"'))[0].text


def test_a_lesson_of_nothing_else_has_nothing_to_play() -> None:
    assert "nothing to play" in faults(text_of('snare = "* *"'))[0].text


def test_no_landing_is_beyond_the_player() -> None:
    assert faults('title = "T"\n[grid]\nsnare = "o"\n[landing]\ncrash = "*"\n')


def test_its_text_is_kept() -> None:
    text = show(text_of(THREE_HANDS))
    assert "*" in text
    assert show(text) == text


def test_exports_have_it() -> None:
    part = part_of(read(THREE_HANDS))
    assert [(n.tick, n.piece) for n in part.score if n.piece is Piece.TOM_1] == [(0, Piece.TOM_1)]
    assert part.score.end_tick == 4 * QUARTER
