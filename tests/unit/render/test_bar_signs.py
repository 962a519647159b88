"""Bar lines where time rolls by: repeat signs where a loop comes again, brackets over endings, by counting shapes."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Ornament, Piece
from station.core.units import PPQ
from station.drills.library import find_lesson
from station.music.grace_strokes import with_graces
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.render.notation.engraving import Engraver
from station.render.palette import BRAND
from station.render.snapshot import BarNumbers
from station.render.text.atlas import Atlas
from station.render.text.draw_list import DrawList, ShapeKind
from station.render.text.fonts import Face
from tests.unit.render.scores import BAR

ATLAS = Atlas()
Shapes = NDArray[np.void]


def song(bars: str) -> Score:
    """A bar of a stroke for each letter, on another beat for another letter; two seconds a bar."""
    strokes = [Note(k * BAR + "ABCD".index(name) * PPQ, Piece.SNARE) for k, name in enumerate(bars)]
    return Score.from_notes(strokes, TempoMap.constant(120), len(bars) * BAR)


def dots_beside_line(shapes: Shapes) -> list[int]:
    """On which sides of a bar's line dots stand, each −1 or 1."""
    dots = shapes[(shapes["kind"] == ShapeKind.ELLIPSE) & (np.abs(shapes["centre"][:, 1]) == 0.5)]
    return sorted(np.sign(dots["centre"][:, 0] + 1.25).astype(int).tolist())


def test_a_loop_has_repeat_signs_between_its_passes_and_none_after_the_last() -> None:
    score = song("ABABABA")  # three passes of two bars, and a bar in which they land
    engraver = Engraver(score, ATLAS, numbers=BarNumbers(0, 2, 3))
    assert [dots_beside_line(engraver.bar(bar)) for bar in range(8)] == [
        [1, 1],
        [],
        [-1, -1, 1, 1],
        [],
        [-1, -1, 1, 1],
        [],
        [],
        [],
    ]
    for_ever = Engraver(song("ABAB"), ATLAS, numbers=BarNumbers(0, 2))
    assert dots_beside_line(for_ever.bar(4)) == [-1, -1], "who loops without an end comes back there too"
    assert [dots_beside_line(Engraver(score, ATLAS).bar(bar)) for bar in range(8)] == [[]] * 8, "played once"


def volta(shapes: Shapes) -> tuple[list[float], list[int]]:
    """How long the brackets over a bar are, in seconds, and which figures stand in the colour of signs."""
    is_brand = (shapes["colour"] == np.array([round(255 * part) for part in BRAND])).all(axis=1)
    spans = shapes[is_brand & (shapes["time_s"][:, 1] > 0)]["time_s"][:, 1].tolist()
    uvs = {figure: np.array(ATLAS.letter(str(figure), Face.BOLD).uv, np.float32) for figure in range(1, 5)}
    figures = [k for k, uv in uvs.items() if (shapes["uv"][is_brand] == uv).all(axis=1).any()]
    return spans, figures


def test_an_ending_has_its_bracket_and_its_pass_over_its_bars_each_time() -> None:
    engraver = Engraver(song("ABCDABCC" * 2), ATLAS, numbers=BarNumbers(0, 8, 2, ((0, "a"), (4, "a"))))
    found = [volta(engraver.bar(bar)) for bar in range(16)]
    bracketed = {bar: figures for bar, (spans, figures) in enumerate(found) if spans}
    assert bracketed == {3: [1], 7: [2], 11: [1], 15: [2]}
    assert all(spans == [2.0] for spans, _ in found if spans), "over the whole bar"


@pytest.mark.parametrize("name", ["jazz-ride-1", "hip-hop-1", "half-time-shuffle-1", "rock-endings-1"])
def test_no_word_leaves_the_panel(name: str) -> None:
    """The staff's reach holds the mark of a swing of 2 : 1, whose triplet stands under a bracket."""
    score = find_lesson(name).score
    engraver = Engraver(score, ATLAS, numbers=BarNumbers(0, score.bar_count))
    for bar in range(score.bar_count):
        shapes = engraver.bar(bar)
        letters = shapes[shapes["kind"] != ShapeKind.BOX]
        assert (letters["centre"][:, 1] - letters["half"][:, 1]).min() >= engraver.rows_y.top - 0.05


def test_the_names_of_sections_stand_over_their_first_bars_in_every_pass() -> None:
    """Three passes of four bars, a landing after them: a Z over the third bar of each, and nowhere else."""
    engraver = Engraver(song("ABCD" * 3 + "A"), ATLAS, numbers=BarNumbers(0, 4, 3, ((2, "Z"),)))
    uv = np.array(ATLAS.letter("Z", Face.BOLD).uv, np.float32)
    found = [bar for bar in range(13) if (engraver.bar(bar)["uv"] == uv).all(axis=1).any()]
    assert found == [2, 6, 10]
    assert BarNumbers(0, 0, None, ((0, "Z"),)).section_of(0) == "Z", "played once"


@pytest.mark.parametrize(("ornament", "graces_left"), [(None, 0.0), (Ornament.FLAM, -1.87), (Ornament.DRAG, -2.87)])
def test_a_bar_line_stands_before_the_grace_notes_of_the_first_beat(
    ornament: Ornament | None, graces_left: float
) -> None:
    """Bravura's head is 1.18 spaces wide: a grace note, 0.62 as large and 0.91 before it, reaches to 1.87 spaces."""
    main = Note(BAR, Piece.SNARE)
    rows = [main] if ornament is None else with_graces(replace(main, ornament=ornament))
    score = Score.from_notes([Note(0, Piece.SNARE), *rows], TempoMap.constant(120), 2 * BAR)
    pen = DrawList(ATLAS)
    Engraver(score, ATLAS).signs.draw_line(pen, 1)
    (x,) = set(pen.shapes()["centre"][:, 0].tolist())
    assert graces_left - 1.0 < x < graces_left - 0.3 if ornament else x == pytest.approx(-1.25)
