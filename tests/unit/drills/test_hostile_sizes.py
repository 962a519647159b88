"""Files and parts at the limits of what music has: refused in one line before anything takes long, or kept whole."""

from pathlib import Path
from time import process_time

import pytest

from station.core.errors import BadInput
from station.core.pieces import Piece
from station.core.units import PPQ
from station.drills.transcription.timing.whole_bars import at_bar_starts
from station.drills.transcription.transcribe import transcribe
from station.music.drum_part import DrumPart
from station.music.formats.ascii_tab.tab_writer import ASCII_TAB
from station.music.formats.clone_hero.clone_hero_format import CHART
from station.music.formats.dtx.dtx_reader import read_dtx
from station.music.formats.dtx.dtx_writer import DTX
from station.music.formats.format_table import read_part
from station.music.formats.hydrogen.hydrogen_formats import HYDROGEN_SONG
from station.music.formats.music_format import MusicFormat
from station.music.score import Note, Score
from station.music.tempo import TempoChange, TempoMap
from tests.unit.music.hydrogen_xml import note, pattern, song

_LIMIT_S = 2.0
"""The time that an importer may take for any file."""


def _snares(count: int, title: str = "") -> DrumPart:
    notes = [Note(k * PPQ // 4, Piece.SNARE) for k in range(count)]
    return DrumPart(Score.from_notes(notes, TempoMap.constant(120), title=title))


def test_a_song_of_more_columns_than_music_has_bars() -> None:
    with pytest.raises(BadInput, match=r"^a\.h2song: plays more than 5,000 columns$"):
        HYDROGEN_SONG.read(song([pattern("a", note(0))], [["a"]] * 5_001), "a.h2song")


def test_a_song_of_more_notes_than_its_columns_let_guess() -> None:
    busy = pattern("a", *(note(k % 192) for k in range(1_000)))
    with pytest.raises(BadInput, match="more than 40,000 notes"):
        HYDROGEN_SONG.read(song([busy], [["a"]] * 40), "a.h2song")


def test_a_curve_of_many_points_is_sorted_once() -> None:
    points = "".join(f'<point x="{k}" y="1"/>' for k in range(20_000))
    curve = f'<automationPaths><path adjust="velocity">{points}</path></automationPaths>'
    data = song([pattern("a", *(note(k % 192) for k in range(1_000)))], [["a"]], curve)
    before = process_time()
    HYDROGEN_SONG.read(data, "a.h2song")
    assert process_time() - before < _LIMIT_S


@pytest.mark.parametrize(
    ("channel", "said"), [("12", "more than 40000 drum chips"), ("03", r"line 2: more than 40000 changes of tempo")]
)
def test_a_dtx_chart_of_more_chips_than_any_has(channel: str, said: str) -> None:
    text = f"#00012: 01\n#000{channel}: " + "50" * 40_001 + "\n"
    with pytest.raises(BadInput, match=said):
        read_dtx(text.encode(), "a.dtx")


def test_a_midi_file_of_more_strokes_than_the_program_can_take(tmp_path: Path) -> None:
    events = b"\0\x99\x26\x64" + b"\x01\x26\x64" * 50_000 + b"\0\xff\x2f\0"
    path = tmp_path / "dense.mid"
    path.write_bytes(b"MThd\0\0\0\x06\0\0\0\x01\x01\xe0MTrk" + len(events).to_bytes(4, "big") + events)
    with pytest.raises(BadInput, match=r"dense\.mid: 50,001 strokes; expected at most 50,000$"):
        read_part(path)


def test_a_lesson_of_more_strokes_than_anybody_writes() -> None:
    with pytest.raises(BadInput, match=r"^long\.mid: 12,001 strokes; at most 12,000 become a lesson$"):
        transcribe(_snares(12_001), "long", "long.mid")


def test_a_title_of_a_megabyte_is_cut_to_a_page() -> None:
    assert transcribe(_snares(4, "A " * 500_000), "long").lesson.title == "A " * 999 + "A"


def test_of_many_changes_of_tempo_the_last_before_a_bar_counts() -> None:
    changes = [TempoChange(k * PPQ // 8, 400_000 + k) for k in range(10_000)]
    score = Score.from_notes([Note(0, Piece.SNARE)], TempoMap.build(changes, []), 10_000 * PPQ // 8)
    found = at_bar_starts(score)
    assert [(t.tick, t.us_per_quarter) for t in found.tempos[:3]] == [
        (0, 400_015),
        (4 * PPQ, 400_047),
        (8 * PPQ, 400_079),
    ]


@pytest.mark.parametrize("text", ["HH" + "|x---" * 15_000 + "|\n", "HH|x---|\n\n" * 15_000], ids=["wide", "long"])
def test_a_tab_of_more_bars_than_music_is_refused_in_time(text: str) -> None:
    before = process_time()
    with pytest.raises(BadInput, match=r"^a\.tab: more than 2000 bars with all repeats$"):
        ASCII_TAB.read(text.encode(), "a.tab")
    assert process_time() - before < _LIMIT_S


@pytest.mark.parametrize(
    "line", ["A" + " " * 100_000 + "!", "by " + " " * 100_000 + "\v x" * 15_000, "|x- " * 100_000], ids=["A", "by", "x"]
)
def test_long_lines_of_a_tab_take_no_longer_than_they_are(line: str) -> None:
    before = process_time()
    ASCII_TAB.read(f"{line}\nHH|x-x-x-x-|\nSD|--o---o-|\n".encode(), "a.tab")
    assert process_time() - before < _LIMIT_S


@pytest.mark.parametrize("written", [CHART, DTX], ids=lambda known: known.name)
def test_a_part_without_a_stroke_that_the_format_knows_is_not_written(written: MusicFormat) -> None:
    part = DrumPart(Score.from_notes([Note(0, Piece.COWBELL)], TempoMap.constant(120), title="Bell"))
    assert written.write is not None
    with pytest.raises(BadInput, match=r"^Bell: .* no lane for any of its strokes$"):
        written.write(part)


@pytest.mark.parametrize("bpm", [10, 99.5, 1000])
def test_the_slowest_and_the_fastest_tempo_come_back_from_a_tab(bpm: float) -> None:
    part = DrumPart(Score.from_notes([Note(0, Piece.SNARE)], TempoMap.constant(bpm)))
    assert ASCII_TAB.write is not None
    again = ASCII_TAB.read(ASCII_TAB.write(part).data, "a.tab")
    assert again.score.tempo_map.tempos[0].us_per_quarter == round(60e6 / bpm)


def test_a_count_of_five_thousand_digits_is_no_count() -> None:
    text = f"   1 + 2 + {'3' * 5_000} +\nHH|x-x-x-x-|\nSD|--o---o-|\n"
    assert len(ASCII_TAB.read(text.encode(), "a.tab").score) == 6
