from pathlib import Path

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.motion.kit.kit import load_kit
from station.motion.sticking.limbs import assign_limbs
from station.music.formats.format_table import read_part
from station.music.formats.text_score import parse_text_score, score_text, write_text_score
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap
from tests.unit.motion.patterns import ROCK, score_of

RICH = Score.from_notes(
    [
        Note(0, Piece.KICK, velocity=100),
        Note(PPQ // 3, Piece.HIHAT, Zone.BOW, 70, openness=0.35),
        Note(PPQ, Piece.SNARE, velocity=30, ornament=Ornament.FLAM, lead_ms=25.5),
        Note(PPQ, Piece.SNARE, velocity=110, dynamic=Dynamic.ACCENT, articulation=Articulation.RIM_SHOT),
        Note(3 * PPQ, Piece.CRASH_1, Zone.EDGE, 120, choke_ticks=PPQ // 2, midi_note=49),
        Note(4 * PPQ, Piece.HIHAT_PEDAL, Zone.PEDAL, 60, Articulation.SPLASH),
        Note(5 * PPQ + 7, Piece.SNARE, articulation=Articulation.BUZZ, duration_ticks=PPQ, ornament=Ornament.ROLL),
    ],
    TempoMap.build([TempoChange(0, 500_000), TempoChange(3 * PPQ, 612_345)], [MeterChange(0, 3, 4)]),
    title="Rich # and strange",
)


def same(a: Score, b: Score) -> bool:
    names = a.notes.dtype.names or ()
    rows = all(np.array_equal(a.notes[n], b.notes[n], equal_nan=n == "openness") for n in names)
    return rows and a.tempo_map == b.tempo_map and a.end_tick == b.end_tick and a.title == b.title


def test_what_is_written_reads_back_to_the_tick() -> None:
    limbs = assign_limbs(RICH, load_kit()).limbs
    assert same(parse_text_score(score_text(RICH, limbs)), RICH.with_limbs(limbs))


def test_a_limb_edited_by_hand_is_played(tmp_path: Path) -> None:
    score = score_of(ROCK)
    path = tmp_path / "rock.txt"
    write_text_score(score, assign_limbs(score, load_kit()).limbs, path)
    text = path.read_text()
    assert "left_hand" in text
    path.write_text(text.replace("left_hand ", "right_hand"))
    edited = read_part(path).score
    assignment = assign_limbs(edited, load_kit())
    snares = edited.notes["piece"] == Piece.SNARE
    assert set(assignment.limbs[snares].tolist()) == {Limb.RIGHT_HAND}
    assert {assignment.why[i] for i in np.flatnonzero(snares)} == {"written"}


def test_a_score_written_by_hand_needs_little() -> None:
    score = parse_text_score("tempo 1:1 90\n1:1 kick head - 100\n1:2+1/2 snare head left_hand 80 ghost # soft\n")
    assert [n.tick for n in score] == [0, PPQ + PPQ // 2]
    assert score[1].dynamic is Dynamic.GHOST
    assert score[0].limb is Limb.UNKNOWN
    assert score.tempo_map.bpm_at(0) == pytest.approx(90)


def test_meters_that_change_are_counted_from() -> None:
    score = parse_text_score("meter 1:1 3/4\nmeter 2:1 6/8\n3:1 kick head - 100\n")
    assert score[0].tick == 3 * PPQ + 3 * PPQ


@pytest.mark.parametrize(
    ("line", "column", "fault"),
    [
        ("1:1 snair head - 80", 5, "expected a piece: kick, snare"),
        ("1:1 snare middle - 80", 11, "expected a zone"),
        ("1:1 snare head nose 80", 16, "expected a limb: -, right_hand"),
        ("1:1 snare head left_foot 80", 16, "that can play the snare: right_hand, left_hand or -"),
        ("1:1 kick head left_hand 80", 15, "that can play the kick: right_foot, left_foot or -"),
        ("1:1 snare head - 0", 18, "velocity from 1 to 127"),
        ("1:1 snare head - \u00b2", 18, "velocity from 1 to 127"),
        ("1:1 snare head - 80 loud", 21, "expected one of foot_splash"),
        ("1:1 snare head - 80 lead_ms=long", 21, "lead_ms from 0 to 1000"),
        ("1:1 snare head - 80 lead_ms=nan", 21, "lead_ms from 0 to 1000"),
        ("1:1 snare head - 80 midi_note=999", 21, "midi_note from 0 to 127"),
        ("1:1 snare head - 80 choke_ticks=" + "9" * 30, 21, "choke_ticks from 0 to"),
        ("1.1 snare head - 80", 1, "expected a place"),
        ("0:1 snare head - 80", 1, "count from 1"),
        ("  1:5 snare head - 80", 3, "a beat from 1 to 4"),
        ("1:1+1/0 snare head - 80", 1, "expected a place"),
        ("1:1+3/2 snare head - 80", 1, "expected a place"),
        ("1:1 snare", 1, "expected place, piece, zone, limb and velocity"),
        ("tempo 1:1 fast", 11, "expected quarter notes a minute"),
        ("tempo 1:1 0us", 11, "expected quarter notes a minute"),
        ("tempo 1:1", 1, 'expected "tempo BAR:BEAT BPM"'),
        ("meter 1:1 4/5", 11, "expected a meter"),
        ("end", 1, 'expected "end BAR:BEAT"'),
    ],
)
def test_a_fault_names_line_column_and_what_was_expected(line: str, column: int, fault: str) -> None:
    with pytest.raises(BadInput) as caught:
        parse_text_score(f"# a score\n1:1 kick head - 90\n{line}\n", "mine.txt")
    assert caught.value.source == "mine.txt"
    assert caught.value.place == f"line 3, column {column}"
    assert fault in caught.value.fault


def test_a_meter_that_changes_in_mid_bar_reads_back() -> None:
    """A bar of four that is cut after two beats: the next bar begins there."""
    meters = [MeterChange(0, 4, 4), MeterChange(2 * PPQ, 3, 4)]
    score = Score.from_notes([Note(4 * PPQ, Piece.KICK)], TempoMap.build([], meters))
    text = score_text(score, assign_limbs(score, load_kit()).limbs)
    assert "meter 1:3 3/4" in text
    assert "\n2:3 " in text
    assert same(parse_text_score(text), score.with_limbs(np.array([Limb.RIGHT_FOOT], np.int8)))


def test_a_file_that_cannot_be_read_is_bad_input(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match=r"none.txt: no such file$"):
        read_part(tmp_path / "none.txt")
    (tmp_path / "bytes.txt").write_bytes(b"tempo 1:1 120\nb\n\xff\xfe")
    with pytest.raises(BadInput, match=r"bytes.txt: line 3: not UTF-8 text; expected a text score, saved as UTF-8$"):
        read_part(tmp_path / "bytes.txt")


@pytest.mark.parametrize("text", ["hello\nworld\n", "", "My lessons of March\n- rock\n"])
def test_a_text_of_another_kind_is_told_what_it_could_be(text: str, tmp_path: Path) -> None:
    path = tmp_path / "notes.txt"
    path.write_text(text)
    with pytest.raises(BadInput, match=r"notes\.txt: is none of .*drum tab, text score"):
        read_part(path)


def test_a_text_score_with_a_fault_is_still_one(tmp_path: Path) -> None:
    path = tmp_path / "score.txt"
    path.write_text("tempo 1:1 120\n1:1 hihut bow - 80\n")
    with pytest.raises(BadInput, match=r"score\.txt: line 2, column 5"):
        read_part(path)
