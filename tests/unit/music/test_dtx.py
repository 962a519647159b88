"""DTX charts: written by hand after the format's own description, and the station's own both ways."""

from itertools import pairwise

import pytest

from station.core.errors import BadInput
from station.core.pieces import Limb, Piece
from station.core.units import PPQ
from station.drills.library import find_lesson
from station.drills.writing.lesson_part import part_of
from station.music.drum_part import DrumPart
from station.music.formats.dtx.dtx_reader import read_dtx
from station.music.formats.dtx.dtx_writer import write_dtx
from station.music.formats.music_format import Feature
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap

CHART = """
; a chart
#TITLE: 夜 ; this is a comment
#ARTIST Someone
#BPM: 150
#BPM0A: 75.5
#WAV01: hat.ogg
#VOLUME01: 50
#00011: 0101010101010101
#00012: 00010001
#00013: 01_00_01_00
#00102: 0.75
#00111: 010101
#00108: 0A
#0021A: 01
#00216: 0001
"""


def test_a_chart_is_read_as_its_description_says() -> None:
    part = read_dtx(CHART.encode("cp932"), "chart.dtx")
    score = part.score
    assert (score.title, part.author) == ("夜", "Someone")
    hats = [n.tick for n in score if n.piece is Piece.HIHAT]
    assert hats[:8] == [k * PPQ // 2 for k in range(8)]
    assert [n.tick for n in score if n.piece is Piece.SNARE] == [PPQ, 3 * PPQ]
    assert [n.tick for n in score if n.piece is Piece.KICK] == [0, 2 * PPQ]
    assert hats[8:] == [4 * PPQ, 5 * PPQ, 6 * PPQ], "three quarters of a whole note, cut in three"
    assert [str(m) for m in score.tempo_map.meters] == ["4/4", "3/4"], "a length holds until the next"
    assert [t.us_per_quarter for t in score.tempo_map.tempos] == [400_000, round(60e6 / 75.5)]
    assert score.end_tick == 10 * PPQ
    assert {n.velocity for n in score} == {round(127 * 0.5)}
    crashes = [(n.tick, n.piece) for n in score if n.piece in (Piece.CRASH_1, Piece.CRASH_2)]
    assert crashes == [(7 * PPQ, Piece.CRASH_1), (7 * PPQ + 3 * PPQ // 2, Piece.CRASH_2)]


def test_one_crash_is_the_first() -> None:
    assert read_dtx(b"#00016: 01", "a.dtx").score[0].piece is Piece.CRASH_1


def test_the_left_pedal_of_two_is_the_left_foot() -> None:
    assert read_dtx(b"#0001C: 01", "a.dtx").score[0].limb is Limb.LEFT_FOOT


def test_of_random_the_first_way_is_taken() -> None:
    text = b"#RANDOM 2\n#IF 1\n#00012: 01\n#ENDIF\n#IF 2\n#00013: 01\n#ENDIF\n#00019: 01"
    part = read_dtx(text, "a.dtx")
    assert {n.piece for n in part.score} == {Piece.SNARE, Piece.RIDE}
    assert part.lost


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("nothing", ""),
        ("#00011: 0000", ""),
        ("#BPM: fast\n#00011: 01", "line 1"),
        ("#BPM: 0\n#00011: 01", "line 1"),
        ("#00002: 99999\n#00011: 01", "line 1"),
        ("#00002: x\n#00011: 01", "line 1"),
        ("#00011: 01\n#00003: 0Z", "line 2"),
    ],
)
def test_faults_name_the_file_and_the_line(text: str, place: str) -> None:
    with pytest.raises(BadInput) as fault:
        read_dtx(text.encode(), "chart.dtx")
    assert str(fault.value).startswith(f"chart.dtx: {place}")


def test_a_semicolon_that_would_begin_a_comment_is_told() -> None:
    part = DrumPart(Score.from_notes([Note(0, Piece.KICK)], TempoMap(), 4 * PPQ, "Slow; slower"), "Me", "One; two")
    written = write_dtx(part)
    back = read_dtx(written.data, "a.dtx")
    assert (back.score.title, back.author, back.about) == ("Slow, slower", "Me", "One, two")
    assert {loss.feature for loss in written.lost} == {Feature.TITLE, Feature.ABOUT}


def test_two_toms_of_one_lane_at_once_are_told() -> None:
    toms = [Note(0, Piece.TOM_2), Note(0, Piece.TOM_3), Note(PPQ, Piece.COWBELL)]
    written = write_dtx(DrumPart(Score.from_notes(toms, TempoMap(), 4 * PPQ)))
    assert [note.piece for note in read_dtx(written.data, "a.dtx").score] == [Piece.TOM_2]
    told = {loss.text for loss in written.lost if loss.feature is Feature.TIMES}
    assert told == {"bar 1: strokes of one lane at once are one", "cowbell has no lane and is left out"}


def test_a_line_is_cut_no_finer_than_its_own_strokes() -> None:
    lines = [f"#000{lane}" for lane in ("11", "12", "13")]
    text = write_dtx(part_of(find_lesson("rock-1"))).data.decode()
    data = {row[:6]: row.partition(": ")[2] for row in text.splitlines() if row[:6] in lines}
    assert set(data) == set(lines)
    assert all(len(a) <= 16 for a, _ in pairwise([*data.values(), ""]))


def test_more_tempos_than_two_places_can_name_are_refused() -> None:
    tempos = [TempoChange(i * PPQ, 500_000 + i) for i in range(1297)]
    score = Score.from_notes([Note(0, Piece.SNARE)], TempoMap.build(tempos), 1300 * PPQ)
    with pytest.raises(BadInput, match="no more than 1295 tempos"):
        write_dtx(DrumPart(score))


def test_the_longest_bar_of_a_lesson_comes_back() -> None:
    longest = MeterChange(0, 32, 1)
    score = Score.from_notes([Note(0, Piece.SNARE)], TempoMap.build([], [longest]), longest.bar_ticks)
    assert read_dtx(write_dtx(DrumPart(score)).data, "a.dtx").score.end_tick == longest.bar_ticks
