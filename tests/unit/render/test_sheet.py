"""Sheets: areas by geometry, places on the staff by hand, PDF by the specification's own rules."""

import re
import zlib
from collections.abc import Iterable
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Articulation, Piece, Zone
from station.core.units import PPQ
from station.drills.library import find_lesson
from station.drills.reading.lesson_file import parse_lesson
from station.music.loudness_marks import LoudnessMark
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap
from station.render.files.pdf_file import pdf
from station.render.notation.page.sheet import MARGIN, PAPERS, SPACES, SheetWords, sheet
from station.render.notation.page.sheet_key import draw_key, notes_used, signs_used
from station.render.palette import INK, INK_FAINT
from station.render.text.draw_list import DrawList, TypeStyle
from station.render.text.fonts import Face
from station.render.text.paper import Filled, Ink, OutlineAtlas, PaperSpot, filled
from station.render.text.sign_outlines import HAIRPIN_LINE
from station.scenes.sheets import lesson_labels

A4 = PAPERS["a4"]
WORDS = SheetWords("Title", "Author", 80.0)


def area(shape: Filled) -> float:
    """By the shoelace formula; holes run the other way round."""
    total = 0.0
    for x, y in (contour.T for contour in shape.contours):
        total += float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)) / 2
    return abs(total)


def drawn(draw_list: DrawList, unit: float = 1.0) -> list[Filled]:
    assert isinstance(draw_list.atlas, OutlineAtlas)
    return list(filled(draw_list.shapes(), draw_list.atlas, PaperSpot((0.0, 0.0), unit)))


def points(areas: Iterable[Filled]) -> NDArray[np.float64]:
    return np.concatenate([contour for shape in areas for contour in shape.contours])


def test_areas_are_those_of_the_shapes() -> None:
    draw_list = DrawList(OutlineAtlas())
    draw_list.box((1.0, 2.0), (3.0, 4.0), INK)
    draw_list.line((0.0, 0.0), (3.0, 4.0), 0.5, INK)
    draw_list.ellipse((0.0, 0.0), (2.0, 1.0), INK, 0.4)
    draw_list.ellipse((0.0, 0.0), (2.0, 2.0), INK, 0.0, (0.0, 0.5, 0.0))
    draw_list.triangle((0.0, 0.0), (1.0, 0.5), INK)
    draw_list.cross((0.0, 0.0), (3.0, 4.0), 0.2, INK_FAINT)
    found = [area(shape) for shape in drawn(draw_list, 2.0)]
    ring = np.pi * (2.25**2 - 1.75**2)
    expected = [12.0, 2.5, 2 * np.pi, ring, 1.0, 0.0]
    assert found[:5] == pytest.approx([4 * a for a in expected[:5]], rel=0.01), "four times as much at twice the size"
    assert len(drawn(draw_list)[5].contours) == 2
    assert drawn(draw_list)[0].grey == 0.0
    assert 0.2 < drawn(draw_list)[5].grey <= 0.5, "soft ink is still read"


def test_a_shape_that_spans_a_time_reaches_from_one_place_to_the_other() -> None:
    draw_list = DrawList(OutlineAtlas())
    draw_list.time_s, draw_list.span_s = 2.0, 3.0
    draw_list.box((-0.5, 0.0), (1.0, 1.0), INK)
    shapes = list(filled(draw_list.shapes(), draw_list.atlas, PaperSpot((10.0, 0.0), 1.0, lambda s: 4.0 * s)))  # type: ignore[arg-type]
    assert (points(shapes)[:, 0].min(), points(shapes)[:, 0].max()) == (10 + 8 - 0.5, 10 + 20 + 0.5)


def test_letters_and_signs_lie_where_their_outlines_do() -> None:
    draw_list = DrawList(OutlineAtlas())
    width = draw_list.text("HH", (5.0, 7.0), TypeStyle(10.0, INK, Face.BOLD))
    found = points(drawn(draw_list))
    assert found[:, 1].max() == pytest.approx(7.0), "an H stands on the base line"
    assert 6.5 < 7.0 - found[:, 1].min() < 7.6, "capitals are 0.71 em high in Roboto"
    assert 5.0 < found[:, 0].min() < found[:, 0].max() < 5.0 + width
    for mirrored, low, high in ((False, -0.04, 3.24), (True, -3.24, 0.04)):
        flag = DrawList(draw_list.atlas)
        flag.sign("flag_8", (0.0, 0.0), INK, mirrored=mirrored)
        y = points(drawn(flag))[:, 1]
        assert (y.min(), y.max()) == pytest.approx((low, high), abs=0.01), "the font's metadata: from 0.035 to -3.241"


@pytest.fixture(scope="module")
def groove() -> Score:
    return find_lesson("rock-1").score


@pytest.mark.parametrize("name", ["rock-1", "six-eight-fill-1", "single-ratamacue", "funk-2", "bossa-fill-1"])
@pytest.mark.parametrize("paper", sorted(PAPERS))
def test_all_is_on_the_paper(name: str, paper: str) -> None:
    score, (width, height) = find_lesson(name).score, PAPERS[paper]
    words = replace(WORDS, title="A title that is long " * 6, about="word " * 200, repeat=(0, score.bar_count - 1))
    pages = sheet(score, words, PAPERS[paper])
    assert len(pages) == 1
    found = points(pages[0])
    assert found.min() >= MARGIN - 3 * SPACES[0]
    assert found[:, 0].max() <= width - MARGIN + 1.0
    assert found[:, 1].max() <= height - MARGIN


def test_notes_lie_on_their_lines(groove: Score) -> None:
    """A sheet of one bar: its five lines are the widest areas; the kick's heads fill the lowest gap between them."""
    (page,) = sheet(groove.bars(0, 0), WORDS, A4)
    widest = sorted(page, key=lambda shape: -float(np.ptp(shape.contours[0][:, 0])))[:5]
    assert np.ptp([np.ptp(shape.contours[0][:, 0]) for shape in widest]) < 1e-6
    lines = sorted(float(shape.contours[0][:, 1].mean()) for shape in widest)
    space = lines[1] - lines[0]
    assert space == pytest.approx(SPACES[0]), "one bar is set as large as it goes"
    low = (lines[3] + lines[4]) / 2
    heads = [shape for shape in page if len(shape.contours) == 1 and _is_head_at(shape, low, space)]
    assert len(heads) == 2, "kick on one and three"
    first, third = sorted(float(head.contours[0][:, 0].mean()) for head in heads)
    assert lines[0] < min(head.contours[0][:, 1].min() for head in heads)
    assert third - first > 6 * space


def _is_head_at(shape: Filled, middle: float, space: float) -> bool:
    """Whether it is as large as a head, one space high and 1.18 wide, and lies so high."""
    (left, top), (right, bottom) = shape.contours[0].min(axis=0), shape.contours[0].max(axis=0)
    as_large = (right - left, bottom - top) == pytest.approx((1.18 * space, space), rel=0.02)
    return as_large and abs((top + bottom) / 2 - middle) < 0.05 * space


def test_a_long_score_goes_on_over_pages_that_are_numbered() -> None:
    bars = [Note(bar * 4 * PPQ + k * PPQ // 4, Piece.SNARE) for bar in range(80) for k in range(16) if bar >> k % 8 & 1]
    pages = sheet(Score.from_notes(bars, TempoMap.constant(80)), replace(WORDS, title="Ø"), A4)
    assert len(pages) > 1
    for page in pages:
        assert points(page)[:, 1].max() > A4[1] - 1.6 * MARGIN, "its number below"
        assert points(page)[:, 1].min() < MARGIN + 12.0, "the title above"


def signs_of(score: Score, with_sticking: bool) -> list[str]:
    """What the key says of a score whose bars all stand on the sheet."""
    return [words for _, words in signs_used(score, range(score.bar_count), with_sticking)]


def test_the_key_names_what_is_used_and_no_more() -> None:
    names = [name for _, _, name in notes_used(find_lesson("rock-1").score)]
    assert names == ["kick", "snare", "hi-hat"]
    assert "ride, bell" in [name for _, _, name in notes_used(find_lesson("ride-bell-1").score)]
    signs = signs_of(find_lesson("funk-2").score, with_sticking=False)
    assert signs == ["accent: loud", "ghost: very soft", "hi-hat open"], "nothing closes it before the end"
    assert "closed again" in signs_of(find_lesson("disco-1").score, with_sticking=False)
    drags = signs_of(find_lesson("drag").score, with_sticking=True)
    assert drags == ["drag", "above: right and left hand"]
    feet = parse_lesson('title = "T"\n[grid]\nkick = "o---"\nsnare = "--o-"\n', "t", "t").lesson
    assert feet
    assert signs_of(feet.score, with_sticking=True) == [], "the foot's limb is known, and no letter stands below"
    silence = Score.from_notes([], TempoMap.build([TempoChange.from_bpm(0, 80)], [MeterChange(0, 4, 4)]), 4 * PPQ)
    assert list(notes_used(silence)) == []
    assert len(sheet(silence, WORDS, A4)) == 1


def test_the_file_is_a_pdf_whose_table_points_at_its_objects() -> None:
    draw_list = DrawList(OutlineAtlas())
    draw_list.box((10.0, 20.0), (20.0, 10.0), INK)
    draw_list.ellipse((50.0, 60.0), (3.0, 4.0), INK)
    assert isinstance(draw_list.atlas, OutlineAtlas)
    page = filled(draw_list.shapes(), draw_list.atlas, PaperSpot((0.0, 0.0), 1.0))
    data = pdf([page, page], (200.0, 100.0), "Größe", "A")
    assert data.startswith(b"%PDF-1.7\n")
    assert data.endswith(b"%%EOF\n")
    table = int(re.search(rb"startxref\n(\d+)\n", data).group(1))  # type: ignore[union-attr]
    rows = data[table:].split(b"\n")
    assert rows[1] == b"0 11", "catalogue, pages, title, forms, two pages of two, two forms"
    for number, row in enumerate(rows[3:13], 1):
        assert len(row) == 19
        assert data[int(row[:10]) :].startswith(f"{number} 0 obj\n".encode())
    assert data.count(b"/Type /Page ") == 2
    assert b"/Count 2" in data
    assert "\ufeffGröße".encode("utf-16-be").hex().encode() in data
    start, length = data.index(b"stream\n") + 7, int(re.search(rb"/Length (\d+)", data).group(1))  # type: ignore[union-attr]
    said = zlib.decompress(data[start : start + length]).decode().split("\n")
    assert said == [
        "1 0 0 -1 0 100 cm",
        f"{page.greys[0]:.3g} g",
        "10.00 20.00 20.00 10.00 re",
        "f",
        "q 3 0 -0 4 50.00 60.00 cm /F1 Do Q",
    ]


def test_a_new_meter_stands_before_its_notes_and_at_the_end_of_a_line_before_it() -> None:
    def nines(*counts: int) -> int:
        """Bars of so many sixteenths, each another one, then as many in nine."""
        start = len(counts) * 4 * PPQ
        first = [Note(bar * 4 * PPQ + k * PPQ // 4, Piece.SNARE) for bar, n in enumerate(counts) for k in range(n)]
        late = [
            Note(start + (9 * bar + k) * PPQ // 2, Piece.SNARE) for bar, n in enumerate(counts) for k in range(n - 8)
        ]
        tempo_map = TempoMap.build([], [MeterChange(0, 4, 4), MeterChange(start, 9, 8)])
        pages = sheet(Score.from_notes([*first, *late], tempo_map), SheetWords("T", sections=((len(counts), "B"),)), A4)
        return sum(figures(page, "meter_9") for page in pages)

    assert nines(9) == 1, "within the only line"
    assert nines(13, 14, 15, 16) == 2, "a courtesy at the end of the second line"


def figures(page: Ink, name: str) -> int:
    """How often a sign of the music font is on the page."""
    return len(sign_places(page, name))


def sign_places(page: Ink, name: str) -> list[tuple[float, float]]:
    """How large a sign of the music font is on the page, in points, and how far right, wherever it stands."""
    atlas = OutlineAtlas()
    shape = np.concatenate(atlas.outlines[round(atlas.sign(name).uv[0])])
    forms = [k for k, contours in enumerate(page.outlines) if contours and len(np.concatenate(contours)) == len(shape)]
    same = [k for k in forms if np.allclose(np.concatenate(page.outlines[k]), shape)]
    return sorted((m[0], m[4]) for m in page.matrices[np.isin(page.numbers, same)].tolist())


def test_a_hairpin_goes_on_over_a_bar_line_and_a_new_meter() -> None:
    strokes = [Note(k * PPQ, Piece.SNARE) for k in range(8)]
    tempo_map = TempoMap.build([], [MeterChange(0, 4, 4), MeterChange(4 * PPQ, 9, 8)])
    score = replace(Score.from_notes(strokes, tempo_map), loudness=(LoudnessMark(PPQ, "<"), LoudnessMark(7 * PPQ, "f")))
    (page,) = sheet(score, SheetWords("T"), A4)
    space = max(SPACES)
    lines = [
        shape.contours[0] for shape in page if np.ptp(shape.contours[0][:, 1]) == pytest.approx(space * HAIRPIN_LINE)
    ]
    spans = sorted((float(line[:, 0].min()), float(line[:, 0].max())) for line in lines)
    assert len(spans) > 32, "its level steps, two at a time"
    reached = spans[0][1]
    for left, right in spans:
        assert left <= reached + 0.01
        reached = max(reached, right)


def swung_at(ratio: float) -> Score:
    late = round(PPQ * ratio / (ratio + 1))
    return Score.from_notes(
        [Note(0, Piece.SNARE), Note(late, Piece.SNARE, swing_ticks=late - PPQ // 2)], TempoMap.constant(120)
    )


@pytest.mark.parametrize(("ratio", "heads"), [(1.5, 2), (2.0, 4), (3.0, 2)])
def test_swing_is_printed_straight_under_its_mark(ratio: float, heads: int) -> None:
    """The heads of the staff and of its key stand where straight ones do; those of the mark are smaller."""
    straight, swung = (
        sign_places(sheet(score, SheetWords(title="T"), A4)[0], "head_round")
        for score in (swung_at(1), swung_at(ratio))
    )
    assert swung[heads:] == pytest.approx(straight)
    assert all(size < 0.75 * straight[0][0] for size, _ in swung[:heads])


def test_a_swing_of_two_is_a_triplet_in_its_mark() -> None:
    def notes(ratio: float) -> int:
        return figures(sheet(swung_at(ratio), SheetWords(title="T"), A4)[0], "flag_8")

    assert (notes(2.0), notes(1.5)) == (1, 0), "the flag of its short note"


def test_a_section_is_called_by_its_name_alone() -> None:
    text = 'title = "T"\n[[grid]]\nname = "a"\nsnare = "oo -- -- --"\n[[grid]]\nswing_ratio = 1.5\n'
    lesson = parse_lesson(f'{text}snare = "oo -- -- --"', "t", "t").lesson
    assert lesson
    assert lesson_labels(lesson, (0, 1)).sections == ((0, "a"),)


def test_the_key_is_of_the_bars_that_are_written() -> None:
    """A hat that is open at a loop's end is closed where the loop begins again, a bar that a fold does not write."""
    bar = [Note(k * PPQ, Piece.HIHAT, openness=float(k == 3)) for k in range(4)]
    score = Score.from_notes(bar, TempoMap.constant(80), 4 * PPQ).repeated(8)
    assert signs_of(score, with_sticking=False) == ["hi-hat open", "closed again"]
    page = sheet(score, WORDS, A4)[0]
    assert (figures(page, "hat_open"), figures(page, "hat_closed")) == (2, 0), "one in the bar, one in the key"


def test_an_even_change_of_tempo_at_the_start_is_told_after_the_tempo_that_it_leaves() -> None:
    changes = [TempoChange.from_bpm(k * PPQ, 60 + 2 * k) for k in range(16)]
    score = Score.from_notes(
        [Note(k * PPQ, Piece.SNARE) for k in range(16)], TempoMap.build(changes, [MeterChange(0, 4, 4)]), 16 * PPQ
    )
    page = sheet(score, SheetWords("T", beats_a_minute=60.0), A4)[0]
    assert figures(page, "beat_4") == 2, "from this tempo to that"


@pytest.mark.parametrize("space", SPACES)
def test_no_name_in_the_key_is_cut(space: float) -> None:
    """However many there are: all pieces, and a cross-stick, whose name is among the longest words."""
    notes = [Note(k * PPQ, piece) for k, piece in enumerate(Piece)]
    notes.append(Note(0, Piece.SNARE, Zone.RIM, articulation=Articulation.CROSS_STICK))
    atlas = OutlineAtlas()
    ellipsis = round(atlas.letter("…", Face.REGULAR).uv[0])
    for count in range(4, len(notes)):
        draw_list = DrawList(atlas)
        score = Score.from_notes(notes[-count:], TempoMap.constant(80))
        draw_key(draw_list, score, range(score.bar_count), (A4[0] - 2 * MARGIN) / space, with_sticking=False)
        shapes = draw_list.shapes()
        assert not (shapes["uv"][:, 0] == ellipsis).any(), count


def test_no_staff_is_so_large_that_a_line_holds_one_bar_of_two() -> None:
    """Two bars of sixteenths with ghosts, one of which fills a line of the largest staff."""
    lesson = find_lesson("second-line-1")
    page = sheet(lesson.played_once, SheetWords("T"), A4)[0]
    assert figures(page, "clef") == 1
