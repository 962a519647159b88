"""Tooltips beside what they explain."""

from itertools import product

import pytest

from station.gui.tooltip_place import Box, Pair, tooltip_place

GAP, FAR = 8.0, 300.0


def box(place: Pair, size: Pair) -> Box:
    return place[0], place[1], place[0] + size[0], place[1] + size[1]


def overlap(one: Box, other: Box) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


@pytest.mark.parametrize("window", [(760.0, 480.0), (1280.0, 720.0), (1920.0, 1080.0)])
@pytest.mark.parametrize("size", [(80.0, 30.0), (430.0, 60.0), (430.0, 200.0)])
def test_it_lies_in_the_window_and_never_over_the_item(window: Pair, size: Pair) -> None:
    width, height = window
    for across, down in product(range(0, 11), range(0, 11)):
        item = box((across * (width - 120) / 10, down * (height - 34) / 10), (120.0, 34.0))
        for panel in ((0.0, 0.0, width, height), item, (0.0, item[1], width, height)):
            seen = box(tooltip_place(item, panel, size, window, GAP, FAR), size)
            assert not overlap(seen, item)
            assert min(seen[:2]) >= 0
            assert seen[2] <= width
            assert seen[3] <= height


def test_beside_the_lessons_nothing_of_them_is_hidden() -> None:
    panel = (0.0, 0.0, 330.0, 600.0)
    seen = box(tooltip_place((16, 200, 250, 226), panel, (400, 60), (1280, 720), GAP, FAR), (400, 60))
    assert not overlap(seen, panel)
    assert seen[:2] == (338.0, 200.0)


def test_above_the_strip_nothing_of_it_is_hidden() -> None:
    panel = (0.0, 600.0, 1280.0, 720.0)
    seen = box(tooltip_place((600, 665, 640, 700), panel, (300, 30), (1280, 720), GAP, FAR), (300, 30))
    assert not overlap(seen, panel)


def test_in_a_wide_page_it_stands_by_the_item() -> None:
    """The editor's grid is far from the page's edges: above the cell."""
    seen = tooltip_place((600, 450, 640, 476), (0, 100, 1280, 600), (200, 30), (1280, 720), GAP, FAR)
    assert seen == (600.0, 412.0)


def test_over_an_item_as_large_as_the_window_it_stays_inside() -> None:
    seen = box(tooltip_place((0, 0, 760, 480), (0, 0, 760, 480), (300, 100), (760, 480), GAP, FAR), (300, 100))
    assert min(seen[:2]) >= 0
    assert (seen[2] <= 760, seen[3] <= 480) == (True, True)
