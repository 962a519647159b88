"""A pick-up under the meter of the piece and without a number, on paper, on the screen and in MusicXML."""

from xml.etree.ElementTree import fromstring

import numpy as np
import pytest

from station.core.pieces import Piece
from station.core.units import PPQ
from station.music.drum_part import DrumPart
from station.music.formats.music_xml.music_xml_format import MUSIC_XML
from station.music.formats.music_xml.writing.music_xml_writer import write_music_xml
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoMap
from station.render.notation.engraving import Engraver
from station.render.notation.page.sheet_bars import sheet_bars
from station.render.snapshot import BarNumbers
from station.render.text.fonts import Face
from tests.parts_alike import kept_differences
from tests.unit.render.test_engraving import ATLAS

WHOLE = 4 * PPQ


def map_of(*meters: tuple[int, int, int]) -> TempoMap:
    """Meters as (tick in quarters, beats, unit)."""
    return TempoMap.build([], [MeterChange(at * PPQ, beats, unit) for at, beats, unit in meters])


def with_pickup(beats: int = 1, bars: int = 3) -> Score:
    """So many quarters before whole bars of four, each with a stroke on its beats."""
    notes = [Note(k * PPQ, Piece.SNARE) for k in range(beats + 4 * bars)]
    return Score.from_notes(notes, map_of((0, beats, 4), (beats, 4, 4)), (beats + 4 * bars) * PPQ)


@pytest.mark.parametrize(
    ("meters", "quarters", "expected"),
    [
        ([(0, 1, 4), (1, 4, 4)], 13, 1),
        ([(0, 3, 4), (3, 4, 4)], 19, 3),
        ([(0, 4, 4), (1, 4, 4)], 13, 1),  # a bar that the meter's new start cuts
        ([(0, 1, 4), (1, 4, 4), (9, 3, 4)], 12, 1),  # the last bar makes up for it
        ([(0, 2, 4), (2, 4, 4), (10, 2, 4)], 12, 2),
        ([(0, 3, 4), (3, 4, 4), (7, 3, 4), (10, 4, 4)], 14, 0),  # three and four in turn
        ([(0, 4, 4), (4, 2, 4)], 8, 0),
        ([(0, 4, 4)], 8, 0),
        ([(0, 1, 4), (1, 4, 4)], 1, 0),
    ],
)
def test_what_a_pickup_is(meters: list[tuple[int, int, int]], quarters: int, expected: int) -> None:
    assert map_of(*meters).pickup_ticks(quarters * PPQ) == expected * PPQ


def test_seven_eighths_before_four_quarters_are_a_meter_of_their_own() -> None:
    tempo_map = TempoMap.build([], [MeterChange(0, 7, 8), MeterChange(7 * PPQ // 2, 4, 4)])
    assert tempo_map.pickup_ticks(7 * PPQ // 2 + 2 * WHOLE) == 0


def test_on_paper_it_has_the_meter_of_the_piece_and_no_number() -> None:
    bars = sheet_bars(with_pickup(), {})
    assert [str(bar.meter) if bar.meter else "" for bar in bars[:3]] == ["4/4", "", ""]
    assert [bar.number for bar in bars] == ["", "2", "3", "4"], "those that the screen counts"
    in_the_middle = sheet_bars(with_pickup(), {}, first_number=5)
    assert [str(bar.meter) if bar.meter else "" for bar in in_the_middle[:2]] == ["1/4", "4/4"]


def test_on_the_screen_too_in_every_pass() -> None:
    engraver = Engraver(with_pickup().repeated(2), ATLAS, numbers=BarNumbers(0, 4, 2))
    assert [str(engraver.signs.meter_of(bar)) for bar in range(8)] == ["4/4"] * 8
    one, slash = (np.array(ATLAS.letter(sign, Face.BOLD).uv, np.float32) for sign in "1/")
    for bar in (0, 1, 4, 5):
        shown = engraver.bar(bar)["uv"]
        assert not (shown == slash).all(axis=1).any(), "no meter is new"
        assert not (shown == one).all(axis=1).any(), "nor is there a bar 1"


@pytest.mark.parametrize("beats", [1, 2, 3])
def test_music_xml_calls_it_implicit_and_reads_it_back(beats: int) -> None:
    """MusicXML 4.0, `measure`: `implicit` yes where the number is not printed, as for a pick-up, which is number 0."""
    part = DrumPart(with_pickup(beats))
    data = write_music_xml(part).data
    measures = fromstring(data).findall("part/measure")
    assert [(m.get("number"), m.get("implicit")) for m in measures[:2]] == [("0", "yes"), ("1", None)]
    assert [[t.text for t in m.iterfind("attributes/time/beats")] for m in measures] == [["4"], [], [], []]
    back = MUSIC_XML.read(data, "x.musicxml")
    assert back.score.tempo_map.meters == part.score.tempo_map.meters
    assert not kept_differences(MUSIC_XML, part)


def test_music_xml_keeps_a_first_meter_that_would_come_back_as_another() -> None:
    """Two eighths would be read as a quarter: then it stays a bar in its own meter."""
    tempo_map = TempoMap.build([], [MeterChange(0, 2, 8), MeterChange(PPQ, 4, 4)])
    part = DrumPart(Score.from_notes([Note(0, Piece.SNARE)], tempo_map, PPQ + 2 * WHOLE))
    data = write_music_xml(part).data
    assert fromstring(data).findall("part/measure")[0].get("implicit") is None
    assert MUSIC_XML.read(data, "x.musicxml").score.tempo_map.meters == tempo_map.meters
