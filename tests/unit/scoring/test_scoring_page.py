"""docs/scoring.md says what the code does: its table of prices is the code's."""

from pathlib import Path

import pytest

from station.scoring.following.prices import PRICES, When, Where

_PAGE = (Path(__file__).parents[3] / "docs" / "scoring.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("where", Where)
def test_the_page_has_every_price(where: Where) -> None:
    (row,) = [line for line in _PAGE.splitlines() if line.startswith(f"| {where.value} |")]
    shown = [f"{PRICES[when, where]:g}" if (when, where) in PRICES else "" for when in When]
    assert [cell.strip() for cell in row.split("|")[2:5]] == shown


def test_the_columns_are_the_moments_in_order() -> None:
    (head,) = [line for line in _PAGE.splitlines() if line.startswith("| where they turn out to be |")]
    assert [cell.strip() for cell in head.split("|")[2:5]] == [when.value for when in When]
