"""Every shipped lesson comes back from its `.chart` as the table of the format promises."""

from collections.abc import Iterator

import pytest

from station.core.pieces import Piece
from station.drills.library import lessons_dir
from station.drills.reading.lesson_file import read_lesson
from station.drills.writing.lesson_part import part_of
from station.music.drum_part import DrumPart
from station.music.formats.clone_hero.clone_hero_format import CHART
from station.music.formats.music_format import Feature
from tests.parts_alike import kept_differences

_COLOURS = {
    Piece.KICK: "kick",
    Piece.SNARE: "red",
    Piece.HIHAT: "yellow",
    Piece.TOM_1: "yellow",
    Piece.RIDE: "blue",
    Piece.TOM_2: "blue",
    Piece.CRASH_1: "green",
    Piece.FLOOR_TOM_1: "green",
}
"""What pro drums has lanes for, by the documentation: no cymbal and tom of one colour at once."""


def _fits(part: DrumPart) -> bool:
    """Whether the part stays on the games' kit and strikes no colour twice at once."""
    main = part.score.notes[~part.score.is_grace]
    pieces = [Piece(number) for number in main["piece"].tolist()]
    strokes = list(zip(main["tick"].tolist(), map(_COLOURS.get, pieces), strict=True))
    return set(pieces) <= set(_COLOURS) and len(set(strokes)) == len(strokes)


def _parts() -> Iterator[tuple[str, DrumPart]]:
    for path in sorted(lessons_dir().rglob("*.toml")):
        if path.parent.name != "courses":
            yield path.stem, part_of(read_lesson(path))


@pytest.fixture(scope="module")
def parts() -> dict[str, DrumPart]:
    return dict(_parts())


def test_what_the_table_promises_is_kept_of_every_lesson(parts: dict[str, DrumPart]) -> None:
    assert {name: found for name, part in parts.items() if (found := kept_differences(CHART, part))} == {}


def test_a_lesson_on_the_games_kit_loses_no_stroke(parts: dict[str, DrumPart]) -> None:
    """A writer that told losses at every turn would pass the test above and keep nothing."""
    assert CHART.write is not None
    fitting = {name: CHART.write(part).lost for name, part in parts.items() if _fits(part)}
    assert len(fitting) > 100, "of 375 lessons; most of the others play the hi-hat with the foot"
    losses = {Feature.TIMES, Feature.PIECES, Feature.METERS, Feature.BUZZES, Feature.TITLE, Feature.AUTHOR}
    assert {name: lost for name, lost in fitting.items() if {loss.feature for loss in lost} & losses} == {}
