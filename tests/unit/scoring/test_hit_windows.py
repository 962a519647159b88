"""The table of windows and its boundaries."""

from itertools import pairwise

import pytest

from station.scoring.matching.hit_windows import LEVELS, Windows


@pytest.mark.parametrize(
    ("name", "edges"),
    [
        ("yarg", (70,)),
        ("drum_game", (35, 76, 135)),
        ("drum_game_lax", (50, 100, 150)),
        ("drum_game_strict", (20, 60, 100)),
        ("dtxmania", (34, 67, 84, 117)),
    ],
)
def test_other_programs_are_as_published(name: str, edges: tuple[float, ...]) -> None:
    """The figures are those of PEERS, read from those programs' sources."""
    assert LEVELS[name].edges_ms == edges


@pytest.mark.parametrize("windows", LEVELS.values(), ids=lambda w: w.name)
def test_every_edge_is_inclusive_on_both_sides(windows: Windows) -> None:
    for grade, edge in enumerate(windows.edges_ms):
        assert windows.grade(edge) == windows.grade(-edge) == grade
        assert windows.grade(edge + 1e-6) == windows.grade(-edge - 1e-6) == grade + 1


@pytest.mark.parametrize("windows", LEVELS.values(), ids=lambda w: w.name)
def test_edges_rise(windows: Windows) -> None:
    assert list(windows.edges_ms) == sorted(set(windows.edges_ms))


def test_ours_become_narrower() -> None:
    ours = [LEVELS[name].edges_ms for name in ("beginner", "elementary", "intermediate", "advanced", "studio")]
    for wide, narrow in pairwise(ours):
        assert all(a > b for a, b in zip(wide, narrow, strict=True))


def test_credit_by_hand() -> None:
    """Edges 10, 20, 40: full to 10, half at 20, a quarter at 30, nothing from 40."""
    windows = Windows("test", (10.0, 20.0, 40.0), "made up")
    assert windows.credit([0, 10, -15, 20, 30, -40, 41]).tolist() == [1, 1, 0.75, 0.5, 0.25, 0, 0]


def test_credit_of_a_single_window() -> None:
    assert LEVELS["yarg"].credit([70.0, -70.0, 70.001]).tolist() == [1, 1, 0]
