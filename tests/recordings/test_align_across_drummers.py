"""One drummer's hits against another's notes: the truth is that both played to one click (`benchmarks/gmd_cross.py`).

The pairs are those that fit a bar off about as well, because each drummer has fills and ghost strokes of his own, or
plays the time on another piece throughout. Where another drummer's notes speak for bars elsewhere by more than a jump
costs, they are believed; such pairs are not asked for here.
"""

import pytest

from benchmarks.gmd_cross import compared, f1, read
from tests.real_data import DATA


@pytest.mark.parametrize(
    ("groove", "one", "other"),
    [
        ("2_funk-groove2_105", 7, 1),
    ],
)
def test_bars_of_another_drummer_are_found(groove: str, one: int, other: int) -> None:
    takes = [read(DATA / f"gmd/drummer{n}/eval_session/{groove}_beat_4-4.mid") for n in (one, other)]
    alignment, truth, _ = compared(takes[0], takes[1])
    assert len(truth) > 100
    assert f1(alignment, truth) > 0.98
