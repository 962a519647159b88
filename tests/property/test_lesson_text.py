"""Texts laid out: whatever grid the format allows plays the same shown, and shown again nothing changes."""

import tomllib

from hypothesis import given, settings

from station.core.toml.toml_write import toml_value
from station.drills.grid.cell_strokes import expand
from station.drills.writing.lesson_text import show
from tests.property.test_grids import grids, section_of


def text_of(table: dict[str, object]) -> str:
    """A lesson with this one grid."""
    pairs = [f"{key} = {toml_value(value)}" for key, value in table.items() if key != "cycle"]
    cycles = table.get("cycle", [])
    assert isinstance(cycles, list)
    rows = [["[[grid.cycle]]", *(f"{key} = {toml_value(value)}" for key, value in cycle.items())] for cycle in cycles]
    return "\n".join(['title = "T"', "[grid]", *pairs, *(row for cycle in rows for row in cycle)])


@given(grids())
@settings(deadline=None, max_examples=80)
def test_any_legal_grid_plays_the_same_shown(table: dict[str, object]) -> None:
    text = show(text_of(table))
    rows, _ = expand(section_of(table).at(0))
    again, _ = expand(section_of(tomllib.loads(text)["grid"]).at(0))
    assert rows.tobytes() == again.tobytes()
    assert show(text) == text
