"""Dynamics of a groove by what is mostly played; velocities and what they mean by hand."""

from collections.abc import Sequence

from station.core.pieces import Dynamic, Piece
from station.core.units import PPQ
from station.drills.grid.stroke_settings import Velocities
from station.drills.transcription.strokes.steady_dynamics import steady_dynamics
from station.music.score import Note
from station.music.tempo import TempoMap

G, N, A = Dynamic
LEVELS = Velocities()


def steadied(dynamics: Sequence[Dynamic], heard: Sequence[int], beats: int = 4) -> list[Dynamic]:
    """Strokes of a snare on the first `beats` beats of bars of 4/4, bar by bar."""
    ticks = [(i // beats * 4 + i % beats) * PPQ for i in range(len(heard))]
    notes = [
        Note(tick, Piece.SNARE, dynamic=d, velocity=LEVELS.of(Piece.SNARE, d))
        for tick, d in zip(ticks, dynamics, strict=True)
    ]
    found = steady_dynamics(notes, heard, LEVELS, TempoMap.constant(120))
    assert [note.velocity for note in found] == [LEVELS.of(Piece.SNARE, note.dynamic) for note in found]
    return [note.dynamic for note in found]


def test_a_stroke_beside_the_line_is_meant_as_its_place_is() -> None:
    """Accents on 1; once 101 fell to the accents on 2, once 95 on 1 to the rest."""
    heard = [114, 80, 120, 84, 95, 78, 110, 101, 118, 82]
    dynamics = [A, N, A, N, N, N, A, A, A, N]
    assert steadied(dynamics, heard, beats=2) == [A, N] * 5


def test_an_accent_that_is_clear_stays() -> None:
    """One bar has an accent on 2, 38 louder than that beat ever is besides."""
    heard = [114, 80, 120, 84, 116, 120, 110, 82, 118, 78]
    assert steadied([A, N, A, N, A, A, A, N, A, N], heard, beats=2) == [A, N, A, N, A, A, A, N, A, N]


def test_of_two_bars_nobody_knows_which_is_meant() -> None:
    assert steadied([A, N, N, N], [100, 80, 96, 80], beats=2) == [A, N, N, N]


def test_another_rhythm_is_another_place() -> None:
    """Three bars have two strokes, the fourth has one: its soft first stroke is of no groove."""
    assert steadied([A, N, A, N, A, N, N], [100, 80, 101, 80, 102, 80, 97], beats=2)[-1] is N
