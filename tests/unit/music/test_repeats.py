"""Repeats and endings, by hand as a copyist writes them."""

from dataclasses import replace
from time import process_time

import pytest

from station.core.pieces import Articulation, Limb, Piece
from station.core.units import PPQ
from station.music.loudness_marks import LoudnessMark
from station.music.repeats import Ending, Passage, folded
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap
from tests.played_passages import played_bars

BAR = 4 * PPQ
_STROKES = {"A": (0, 2), "B": (0, 1, 2, 3), "C": (1, 3), "D": (0,), "E": (3,)}
"""The quarters of each bar that are struck."""


def song(bars: str, tempo_map: TempoMap | None = None) -> Score:
    """A bar for each letter."""
    notes = [Note(bar * BAR + q * PPQ, Piece.SNARE) for bar, name in enumerate(bars) for q in _STROKES[name]]
    return Score.from_notes(notes, tempo_map or TempoMap.constant(100), len(bars) * BAR)


@pytest.mark.parametrize(
    ("bars", "passages"),
    [
        ("A", [Passage(0, 0)]),
        ("AAA", [Passage(0, 2)]),  # saves two bars only
        ("AAAA", [Passage(0, 0, 4)]),
        ("AAAB", [Passage(0, 3)]),
        ("ABABABAB", [Passage(0, 1, 4)]),
        ("ABCDABCD", [Passage(0, 3, 2)]),
        ("EABCDABCDE", [Passage(0, 0), Passage(1, 4, 2), Passage(9, 9)]),
        (
            "AAABAAAC",
            [Passage(0, 2, 2, (Ending(3, 3, (1,)), Ending(7, 7, (2,))))],
        ),
        (
            "AAABAAABAAABAAAC",
            [Passage(0, 2, 4, (Ending(3, 3, (1, 2, 3)), Ending(15, 15, (4,))))],
        ),
    ],
)
def test_a_copyist_s_folds(bars: str, passages: list[Passage]) -> None:
    assert folded(song(bars)) == passages


def test_every_bar_is_played_as_often_and_where_it_was() -> None:
    bars = "EAAABAAACDDDDDAB"
    written = played_bars(folded(song(bars)))
    assert [bars[bar] for bar in written] == list(bars)


def test_no_section_s_start_hides_in_a_fold() -> None:
    assert folded(song("AAAAAAAA"), {4: "bridge"}) == [Passage(0, 0, 4), Passage(4, 4, 4)]
    assert folded(song("ABCDABCD"), {4: "bridge"}) == [Passage(0, 7)]
    assert folded(song("ABCDABCD"), apart=[4]) == [Passage(0, 3), Passage(4, 7)]


def test_sections_that_come_again_by_name_fold_as_their_writer_meant() -> None:
    verse_and_chorus = {0: "verse", 2: "chorus", 4: "verse", 6: "chorus"}
    assert folded(song("ABCDABCD"), verse_and_chorus) == [Passage(0, 3, 2)]
    assert folded(song("ABCDABCD"), verse_and_chorus | {6: "coda"}) == [
        Passage(0, 1, 2, (Ending(2, 3, (1,)), Ending(6, 7, (2,))))
    ], "each ending has its name on paper"
    assert folded(song("ABAC"), {0: "groove", 2: "groove"}) == [
        Passage(0, 0, 2, (Ending(1, 1, (1,)), Ending(3, 3, (2,))))
    ]


def test_what_is_written_otherwise_is_no_repeat() -> None:
    plain = song("AAAA")
    limbs = [Limb.RIGHT_HAND] * 6 + [Limb.LEFT_HAND] * 2
    sticking = Score.from_notes(
        [replace(note, limb=limb) for note, limb in zip(plain, limbs, strict=True)], plain.tempo_map, plain.end_tick
    )
    harder = Score.from_notes(
        [replace(note, velocity=60 + k) for k, note in enumerate(plain)], plain.tempo_map, plain.end_tick
    )
    assert folded(sticking) == [Passage(0, 3)]
    assert folded(harder) == [Passage(0, 0, 4)], "what no sign says"
    tempi = [TempoChange.from_bpm(0, 100), TempoChange.from_bpm(2 * BAR, 120)]
    assert folded(song("AAAA", TempoMap.build(tempi))) == [Passage(0, 3)]
    groups = [MeterChange(0, 4, 4), MeterChange(2 * BAR, 8, 8, (3, 3, 2))]
    assert folded(song("AAAA", TempoMap.build([], groups))) == [Passage(0, 3)]


def test_a_roll_that_is_held_into_one_bar_sets_it_apart() -> None:
    roll = Note(BAR, Piece.SNARE, articulation=Articulation.BUZZ, duration_ticks=BAR + PPQ)
    rest = [Note(bar * BAR + 2 * PPQ, Piece.SNARE) for bar in (0, 2, 3, 4, 5)]
    score = Score.from_notes([roll, *rest], TempoMap.constant(100), 6 * BAR)
    assert folded(score) == [Passage(0, 5)], "the third bar begins with the roll's end"


def test_a_mark_that_holds_on_stands_once_and_one_that_comes_back_stands_in_both() -> None:
    def marked(*marks: tuple[int, str]) -> list[Passage]:
        loudness = tuple(LoudnessMark(bar * BAR, sign) for bar, sign in marks)
        return folded(replace(song("ABCDABCD"), loudness=loudness))

    assert marked((0, "p")) == [Passage(0, 3, 2)]
    assert marked((0, "p"), (2, "f"), (4, "p"), (6, "f")) == [Passage(0, 3, 2)]
    assert marked((2, "f"), (4, "mf"), (6, "f")) == [Passage(0, 7)], "mf stands before the second pass alone"
    assert marked((0, "p"), (4, "f")) == [Passage(0, 7)]


def test_a_tempo_that_comes_back_folds_with_its_ramp() -> None:
    tempi = [
        TempoChange.from_bpm(bar * BAR + k * PPQ, bpm + 5 * k) for bar in (0, 4) for k, bpm in enumerate([100] * 3)
    ]
    assert folded(song("ABCDABCD", TempoMap.build(tempi))) == [Passage(0, 3, 2)]


def test_a_long_song_of_one_bar_folds_at_once() -> None:
    """Five hundred bars took fifteen seconds when every pass was counted anew from every bar."""
    began = process_time()
    assert folded(song("A" * 500)) == [Passage(0, 0, 500)]
    assert process_time() - began < 2.0
