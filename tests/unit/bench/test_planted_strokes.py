"""Which strokes a planted fault concerns, on bars that a drummer would write out by hand."""

import ast
from collections.abc import Iterable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import station.bench.rigs
from station.bench.rigs.planted.planted_music import Music, on_grid
from station.bench.rigs.planted.planted_strokes import Written, level_db
from station.core.pieces import Dynamic, Limb, Ornament, Piece
from station.core.units import PPQ
from station.music.score import Note, Score
from station.music.tempo import TempoMap

EIGHTH, SIXTEENTH, BAR = PPQ // 2, PPQ // 4, 4 * PPQ
R, L = Limb.RIGHT_HAND, Limb.LEFT_HAND


def written(notes: Iterable[Note], tempo_bpm: float = 120) -> Written:
    return Written(Music("by hand", Score.from_notes(notes, TempoMap.constant(tempo_bpm))))


def rock(bars: int) -> list[Note]:
    """Eighths on the hi-hat, kick on one and three, snare on two and four."""
    hats = [Note(bar * BAR + k * EIGHTH, Piece.HIHAT, limb=R) for bar in range(bars) for k in range(8)]
    drums = [
        Note(bar * BAR + k * PPQ, Piece.KICK if k % 2 == 0 else Piece.SNARE, limb=Limb.RIGHT_FOOT if k % 2 == 0 else L)
        for bar in range(bars)
        for k in range(4)
    ]
    return [*hats, *drums]


def ticks(of: Written, mask: NDArray[np.bool_]) -> list[int]:
    return [int(t) for t in of.score.notes["tick"][mask]]


def test_off_beats_of_straight_eighths() -> None:
    groove = written(rock(1))
    assert ticks(groove, groove.offbeats) == [EIGHTH, 3 * EIGHTH, 5 * EIGHTH, 7 * EIGHTH]
    assert not groove.swung.any()
    assert groove.only_eighths


def test_a_shuffle_has_short_notes_and_no_straight_off_beats() -> None:
    short = 2 * PPQ // 3
    hats = [Note(beat * PPQ + at, Piece.RIDE) for beat in range(4) for at in (0, short)]
    shuffle = written(hats)
    assert ticks(shuffle, shuffle.swung) == [beat * PPQ + short for beat in range(4)]
    assert not shuffle.offbeats.any()


def test_triplets_are_no_swing() -> None:
    triplets = written([Note(k * PPQ // 3, Piece.SNARE) for k in range(12)])
    assert not triplets.swung.any()


def test_a_fill_is_where_drums_replace_the_timekeeper_and_lands_on_the_next_beat() -> None:
    fill = [Note(BAR + 2 * PPQ + k * SIXTEENTH, Piece.TOM_1, limb=R if k % 2 == 0 else L) for k in range(8)]
    groove = [n for n in rock(2) if not (n.tick >= BAR + 2 * PPQ and n.piece is not Piece.KICK)]
    after = [Note(n.tick + 2 * BAR, n.piece, limb=n.limb) for n in rock(2)]
    music = written([*groove, *fill, *after])
    ((inside, landing),) = music.fills
    assert ticks(music, inside) == sorted([*(n.tick for n in fill), BAR + 2 * PPQ])  # the kick on three, too
    assert ticks(music, landing) == [2 * BAR, 2 * BAR, 2 * BAR + EIGHTH]


def test_a_groove_has_no_fill_and_no_long_wait() -> None:
    assert written(rock(4)).fills == []
    assert not written(rock(4)).after_wait.any()


def test_after_a_long_wait() -> None:
    stop = [Note(2 * BAR, Piece.CRASH_1), Note(2 * BAR + 3 * PPQ, Piece.SNARE)]
    music = written([*rock(2), *stop])
    assert ticks(music, music.after_wait) == [2 * BAR + 3 * PPQ]  # three beats at 120 are one and a half seconds


@pytest.mark.parametrize(
    ("sticking", "seconds"),
    [
        ("RLRRLRLL", [3, 7]),  # single paradiddle
        ("RRLLRRLL", [1, 3, 5, 7]),  # double stroke roll
        ("RLRLRLRL", []),
        ("RRRLRRRL", []),  # three in a row are no double
    ],
)
def test_doubles_by_the_sticking(sticking: str, seconds: list[int]) -> None:
    hands = [R if hand == "R" else L for hand in sticking]
    music = written([Note(k * SIXTEENTH, Piece.SNARE, limb=hand) for k, hand in enumerate(hands)])
    assert [t // SIXTEENTH for t in ticks(music, music.second_of_double)] == seconds
    assert [t // SIXTEENTH + 1 for t in ticks(music, music.first_of_double)] == seconds


def test_a_timekeepers_strokes_are_no_doubles() -> None:
    music = written(
        [Note(0, Piece.HIHAT, limb=R), Note(SIXTEENTH, Piece.HIHAT, limb=R), Note(EIGHTH, Piece.SNARE, limb=L)]
    )
    assert not music.second_of_double.any()


def test_graces_stand_with_their_main_stroke() -> None:
    flam = [Note(0, Piece.SNARE, limb=L, ornament=Ornament.FLAM, lead_ms=30), Note(0, Piece.SNARE, limb=R)]
    music = written(flam)
    assert music.flam_graces.tolist() == [True, False]
    assert music.main_of.tolist() == [1, 1]
    assert music.limb(L).tolist() == [False, False]


def test_ghosts_are_compared_with_taps_of_their_piece() -> None:
    ghosts = [Note(k * EIGHTH, Piece.SNARE, velocity=30, dynamic=Dynamic.GHOST) for k in (1, 3)]
    taps = [Note(k * EIGHTH, Piece.SNARE) for k in (2, 6)]
    accents = [Note(4 * EIGHTH, Piece.SNARE, velocity=115, dynamic=Dynamic.ACCENT)]
    music = written([*ghosts, *taps, *accents, Note(0, Piece.KICK)])
    these, those = music.ghosts_and_others
    assert ticks(music, these) == [EIGHTH, 3 * EIGHTH]
    assert ticks(music, those) == [2 * EIGHTH, 6 * EIGHTH]


def test_levels_are_those_of_the_page_on_humans() -> None:
    assert np.round(level_db(np.array([112, 80, 32])), 1).tolist() == [-2.2, -8.0, -23.9]


def test_a_played_groove_is_put_on_paper() -> None:
    late = 2000  # ticks: under 10 ms at 120
    hits = [
        Note(bar * BAR + k * EIGHTH + late, Piece.HIHAT, velocity=50 + 30 * (k % 2))
        for bar in range(9)
        for k in range(8)
    ]
    hits += [Note(2 * PPQ + 500, Piece.SNARE, velocity=20), Note(2 * PPQ + 900, Piece.SNARE, velocity=120)]
    score = on_grid(Score.from_notes(hits, TempoMap.constant(120)), 120)
    assert score is not None
    snare = score.notes[score.notes["piece"] == Piece.SNARE]
    assert snare["tick"].tolist() == [2 * PPQ]
    assert snare["dynamic"].tolist() == [Dynamic.ACCENT]
    assert set(np.diff(score.notes["tick"][score.notes["piece"] == Piece.HIHAT]).tolist()) == {EIGHTH}


def test_a_short_take_is_left_out() -> None:
    assert on_grid(Score.from_notes(rock(4), TempoMap.constant(120)), 120) is None


def test_planter_and_detector_share_no_definition() -> None:
    folder = Path(station.bench.rigs.__file__).parent
    allowed = {"station.scoring.align", "station.scoring.analysis.summary", "station.scoring.report.advice"}
    for path in folder.glob("planted_*.py"):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        modules = {node.module or "" for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
        shared = {
            m for m in modules if m.startswith(("station.scoring", "station.simulation", "station.music.passages"))
        }
        assert shared <= allowed, path.name
