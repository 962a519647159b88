"""Sets the same bars twice, as the station engraves them and as verovio does: `python docs/pictures/beside_verovio.py`.

verovio (`pip install -e .[peers]`) gets them as our MusicXML and nothing else, at the same staff space. Both are drawn
by `rsvg-convert` (librsvg), which must be installed. The pictures lie beside this file as `beside-verovio-N.png`;
`docs/engraving.md` compares them sign by sign.
"""

import re
import subprocess
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import verovio

from station.drills.library import find_lesson
from station.drills.writing.lesson_part import part_of
from station.music.drum_part import DrumPart
from station.music.formats.music_xml.writing.music_xml_writer import write_music_xml
from station.render.notation.page.sheet import MARGIN, SPACES, SheetWords, sheet
from station.render.text.paper import Filled
from station.scenes.sheets import lesson_labels

HERE = Path(__file__).parent
WIDTH = 540.0
"""Points, of both; A4 leaves as much between its margins."""
_TALLEST = 2000.0
"""A page on which all is engraved as large as the station does."""
_GAP = 60.0
"""Points of white that part the music from the key at the page's foot, which is left out (our choice)."""
_ZOOM = 2.5
"""Pixels a point (our choice: a staff space of 17 or 20)."""
_HEADING = 18.0
_VEROVIO_SPACE = 18
"""Units of verovio's page between two staff lines: twice its `unit` of 9."""


@dataclass(frozen=True, slots=True)
class Excerpt:
    """Bars `first` to `last` of a lesson, from 0, and what they are here for."""

    lesson: str
    first: int
    last: int
    shows: str


EXCERPTS: Sequence[Excerpt] = (
    Excerpt("hip-hop-1", 0, 1, "swing of sixteenths, ghost strokes, accents"),
    Excerpt("reggae-one-drop", 0, 1, "swing of eighths, cross-stick, open hi-hat, half a bar of rest"),
    Excerpt("flam-paradiddle", 0, 0, "flams, sticking"),
    Excerpt("double-ratamacue", 0, 1, "drags, triplets"),
    Excerpt("dragadiddle-toms", 0, 0, "diddles, toms"),
    Excerpt("press-roll-swell", 0, 1, "buzz rolls, loudness, a hairpin"),
    Excerpt("jazz-ride-1", 0, 1, "triplets with a gap, ride, foot hi-hat"),
    Excerpt("stops-1", 2, 3, "crashes and chokes"),
    Excerpt("second-line-1", 0, 1, "two voices against each other, a held buzz"),
    Excerpt("meter-change-1", 0, 1, "a change of meter, a meter in groups"),
    Excerpt("splashes-off-the-beat", 0, 0, "splashes of the foot"),
    Excerpt("cha-cha-1", 0, 0, "bells"),
    Excerpt("motown-1", 0, 0, "rim shots"),
)
"""Twenty bars that have every sign between them."""


def main() -> None:
    """Draw every excerpt."""
    for number, excerpt in enumerate(EXCERPTS, 1):
        path = HERE / f"beside-verovio-{number}.png"
        svg = beside(excerpt)
        subprocess.run(
            ["rsvg-convert", f"--zoom={_ZOOM}", "-b", "white", "-o", str(path)], input=svg.encode(), check=True
        )
        sys.stdout.write(f"{path.name}: {excerpt.shows}\n")


def beside(excerpt: Excerpt) -> str:
    """Both engravings of the bars, one below the other, as SVG."""
    lesson = find_lesson(excerpt.lesson)
    whole = part_of(lesson)
    bars = (excerpt.first, min(excerpt.last, whole.score.bar_count - 1))
    part = replace(whole, score=whole.score.bars(*bars), sections=())
    words = replace(lesson_labels(lesson, bars), about="")
    areas, our_height = _ours(part, words)
    theirs, their_height = _theirs(part)
    above = _HEADING - MARGIN / 2
    below = above + our_height + _HEADING
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{below + their_height}">'
        f"{_heading('the station', _HEADING - 5)}"
        f'<g transform="translate(0 {above})">{_paths(areas)}</g>'
        f"{_heading('verovio ' + verovio.toolkit(False).getVersion().partition('-')[0], below - 5)}"
        f'<g transform="translate(0 {below})">{theirs}</g></svg>'
    )


def _heading(text: str, y: float) -> str:
    return f'<text x="4" y="{y}" font-family="sans-serif" font-size="9" fill="#777">{text}</text>'


def _ours(part: DrumPart, words: SheetWords) -> tuple[Sequence[Filled], float]:
    """What stands on the page above its key, from the top margin on, and how far down it reaches."""
    (page,) = sheet(part.score, words, (WIDTH, _TALLEST))
    reaches = [(top(area), bottom(area), area) for area in page]
    end, kept = MARGIN, []
    for above, below, area in sorted(reaches, key=lambda each: each[0]):
        if above > end + _GAP:
            break
        kept.append(area)
        end = max(end, below)
    return kept, end + _HEADING


def top(area: Filled) -> float:
    """The highest point of an area."""
    return float(min(contour[:, 1].min() for contour in area.contours))


def bottom(area: Filled) -> float:
    """The lowest point of an area."""
    return float(max(contour[:, 1].max() for contour in area.contours))


def _paths(areas: Iterable[Filled]) -> str:
    found = []
    for area in areas:
        steps = " ".join(
            "M" + " L".join(f"{x:.2f} {y:.2f}" for x, y in contour.tolist()) + " Z" for contour in area.contours
        )
        grey = round(255 * area.grey)
        found.append(f'<path d="{steps}" fill="rgb({grey},{grey},{grey})"/>')
    return "".join(found)


def _theirs(part: DrumPart) -> tuple[str, float]:
    """Verovio's page as nested SVG, scaled so that its staff space is ours, and its height in points."""
    toolkit = verovio.toolkit()
    scale = SPACES[0] / _VEROVIO_SPACE
    toolkit.setOptions(
        {"pageWidth": round(WIDTH / scale), "adjustPageHeight": True, "header": "none", "footer": "none", "scale": 100,
         "pageMarginLeft": 50, "pageMarginRight": 50, "smuflTextFont": "none"}
    )  # fmt: skip
    if not toolkit.loadData(write_music_xml(part).data.decode()):
        raise SystemExit(f"verovio refuses our MusicXML: {toolkit.getLog()}")
    svg = toolkit.renderToSVG(1)
    size = re.search(r'width="([0-9.]+)px" height="([0-9.]+)px"', svg)
    assert size is not None, "verovio says how large its page is"
    return f'<g transform="scale({scale})">{_NOTE_SIGN.sub(_as_text, svg)}</g>', float(size[2]) * scale


_NOTE_SIGN = re.compile(r'font-family="Leipzig"([^>]*)>(.)</tspan>')
_NOTES = {"\ueca5": "\u2669", "\ueca7": "\u266a"}
"""SMuFL's notes of metronome marks, which verovio sets as letters of a font that is not installed, and Unicode's."""


def _as_text(found: re.Match[str]) -> str:
    return f'font-family="DejaVu Sans"{found[1]}>{_NOTES.get(found[2], found[2])}</tspan>'


if __name__ == "__main__":
    main()
