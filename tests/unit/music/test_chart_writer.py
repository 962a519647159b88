"""What a `.chart` of ours says, line by line as the documentation has it, and what it says is lost."""

from collections.abc import Sequence

import pytest

from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.music.drum_part import DrumPart, PartSection
from station.music.formats.clone_hero.clone_hero_format import CHART
from station.music.formats.music_format import Feature, WrittenFile
from station.music.grace_strokes import with_graces
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap
from tests.parts_alike import kept_differences


def _part(*notes: Note, tempo_map: TempoMap | None = None, sections: Sequence[PartSection] = ()) -> DrumPart:
    rows = [row for note in notes for row in with_graces(note)]
    return DrumPart(Score.from_notes(rows, tempo_map or TempoMap(), title="Song"), "Band", sections=tuple(sections))


def _written(part: DrumPart) -> WrittenFile:
    assert CHART.write is not None
    return CHART.write(part)


def _lines(part: DrumPart, section: str) -> list[str]:
    text = _written(part).data.decode()
    return [line.strip() for line in text.split(f"[{section}]\r\n{{\r\n")[1].split("}")[0].split("\r\n") if line]


def test_a_bar_is_written_as_the_documentation_has_it() -> None:
    part = _part(
        Note(0, Piece.KICK),
        Note(0, Piece.HIHAT, Zone.BOW, openness=0.0),
        Note(PPQ, Piece.SNARE, dynamic=Dynamic.ACCENT),
        Note(3 * PPQ // 2, Piece.SNARE, dynamic=Dynamic.GHOST),
        Note(2 * PPQ, Piece.TOM_1, ornament=Ornament.FLAM),
        Note(3 * PPQ, Piece.CRASH_1, Zone.EDGE, dynamic=Dynamic.ACCENT),
        Note(3 * PPQ, Piece.KICK, limb=Limb.LEFT_FOOT),
        tempo_map=TempoMap.build([TempoChange(0, 500_000)], [MeterChange(0, 4, 4)]),
        sections=[PartSection("groove", 0, 0)],
    )
    assert _lines(part, "Song") == ['Name = "Song"', 'Artist = "Band"', "Resolution = 192"]
    assert _lines(part, "SyncTrack") == ["0 = TS 4 2", "0 = B 120000"]
    assert _lines(part, "Events") == ['0 = E "section groove"', '768 = E "end"']
    assert _lines(part, "ExpertDrums") == [
        *("0 = N 0 0", "0 = N 2 0", "0 = N 66 0"),
        *("192 = N 1 0", "192 = N 34 0"),
        *("288 = N 1 0", "288 = N 40 0"),
        "384 = N 2 0",
        *("576 = N 32 0", "576 = N 4 0", "576 = N 68 0", "576 = N 37 0"),
        "384 = N 109 0",
    ]
    assert _written(part).lost == ()
    assert kept_differences(CHART, part) == []


@pytest.mark.parametrize(("ticks", "resolution"), [(PPQ // 3, 192), (PPQ // 5, 480), (PPQ // 7, 26_880), (1, PPQ)])
def test_the_resolution_is_as_fine_as_the_music(ticks: int, resolution: int) -> None:
    part = _part(Note(ticks, Piece.SNARE))
    assert f"Resolution = {resolution}" in _lines(part, "Song")
    assert kept_differences(CHART, part) == []


def test_a_buzz_roll_is_a_roll_lane() -> None:
    buzz = Note(0, Piece.SNARE, articulation=Articulation.BUZZ, ornament=Ornament.ROLL, duration_ticks=2 * PPQ)
    part = _part(buzz, Note(PPQ, Piece.HIHAT, Zone.BOW), Note(2 * PPQ, Piece.SNARE))
    assert "0 = S 65 384" in _lines(part, "ExpertDrums")
    assert _written(part).lost == ()
    assert kept_differences(CHART, part) == []


@pytest.mark.parametrize(
    ("notes", "features"),
    [
        ([Note(0, Piece.HIHAT_PEDAL, Zone.PEDAL), Note(0, Piece.KICK)], {Feature.TIMES, Feature.PIECES}),
        ([Note(0, Piece.CHINA, Zone.EDGE)], {Feature.PIECES}),
        ([Note(0, Piece.CRASH_1, Zone.EDGE), Note(0, Piece.CRASH_2, Zone.EDGE)], {Feature.TIMES, Feature.PIECES}),
        ([Note(0, Piece.KICK, dynamic=Dynamic.ACCENT)], {Feature.DYNAMICS}),
        ([Note(0, Piece.SNARE, ornament=Ornament.FLAM), Note(0, Piece.TOM_1)], {Feature.FLAMS}),
    ],
)
def test_what_a_chart_cannot_say_is_told(notes: list[Note], features: set[Feature]) -> None:
    part = _part(*notes)
    lost = _written(part).lost
    assert features <= {loss.feature for loss in lost}
    assert all(loss.text.startswith("bar 1: ") for loss in lost)
    assert kept_differences(CHART, part) == []


def test_tempos_between_thousandths_are_told() -> None:
    part = _part(Note(0, Piece.KICK), tempo_map=TempoMap.build([TempoChange(0, 500_001)]))
    assert {loss.feature for loss in _written(part).lost} == {Feature.TEMPO}
