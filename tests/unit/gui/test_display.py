"""Where the window goes when its monitor does; expected places are counted by hand."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import pytest

from station.core.units import NS_PER_S
from station.gui.display import GONE, MonitorWatch, Rectangle, home_for

LAPTOP = Rectangle(0, 0, 1920, 1080)
BESIDE = Rectangle(1920, 0, 2560, 1440)
SMALL = Rectangle(0, 0, 800, 600)
SIZE = (1280, 720)


@pytest.mark.parametrize(
    ("window", "home"),
    [
        (Rectangle(100, 100, *SIZE), None),
        (Rectangle(1920 - 640, 100, *SIZE), None),  # half of it is seen
        (Rectangle(1920 - 639, 100, *SIZE), Rectangle(320, 180, *SIZE)),
        (Rectangle(2400, 300, *SIZE), Rectangle(320, 180, *SIZE)),
    ],
)
def test_a_window_moves_when_less_than_half_of_it_is_seen(window: Rectangle, home: Rectangle | None) -> None:
    assert home_for(window, [LAPTOP]) == home


def test_it_shrinks_where_the_monitor_is_smaller_and_goes_to_the_nearest() -> None:
    assert home_for(Rectangle(2400, 300, *SIZE), [SMALL]) == Rectangle(40, 30, 720, 540)
    far = Rectangle(-5000, 0, 800, 600)
    assert home_for(Rectangle(2400, 300, *SIZE), [far, LAPTOP]) == Rectangle(320, 180, *SIZE)


def test_without_any_monitor_there_is_nowhere_to_go() -> None:
    assert home_for(Rectangle(2400, 300, *SIZE), []) is None


@dataclass
class Screen:
    """Monitors by number, and the window; `moved` is where it was put."""

    plugged: dict[int, Rectangle]
    place: Rectangle
    moved: list[Rectangle] = field(default_factory=list)

    def monitors(self) -> Sequence[int]:
        return list(self.plugged)

    def area(self, monitor: int) -> Rectangle:
        return self.plugged[monitor]

    def window(self) -> Rectangle:
        return self.place

    def move(self, place: Rectangle) -> None:
        self.place = place
        self.moved.append(place)


def two_monitors(place: Rectangle) -> tuple[Screen, MonitorWatch]:
    screen = Screen({1: LAPTOP, 2: BESIDE}, place)
    watch = MonitorWatch(screen)
    assert watch.check(0) == ""
    return screen, watch


def test_the_window_comes_back_when_its_monitor_goes() -> None:
    screen, watch = two_monitors(Rectangle(2400, 300, *SIZE))
    del screen.plugged[2]
    assert watch.check(1) == GONE
    assert screen.moved == [Rectangle(320, 180, *SIZE)]
    assert watch.check(2) == "", "said once"


def test_a_window_that_the_system_moved_itself_is_told_of_alone() -> None:
    screen, watch = two_monitors(Rectangle(2400, 300, *SIZE))
    del screen.plugged[2]
    screen.place = Rectangle(10, 10, *SIZE)
    assert watch.check(1) == GONE
    assert screen.moved == []


def test_another_monitor_that_goes_or_comes_changes_nothing() -> None:
    screen, watch = two_monitors(Rectangle(100, 100, *SIZE))
    del screen.plugged[2]
    assert watch.check(1) == ""
    screen.plugged[3] = BESIDE
    assert watch.check(2) == ""
    assert screen.moved == []


def test_the_only_monitor_that_goes_is_waited_for() -> None:
    screen, watch = two_monitors(Rectangle(2400, 300, *SIZE))
    screen.plugged.clear()
    assert watch.check(1) == ""
    screen.plugged[4] = LAPTOP
    assert watch.check(2 * NS_PER_S) == GONE
    assert screen.moved == [Rectangle(320, 180, *SIZE)]


def test_a_window_that_was_dragged_to_the_other_monitor_is_on_that_one() -> None:
    screen, watch = two_monitors(Rectangle(100, 100, *SIZE))
    screen.place = Rectangle(2400, 300, *SIZE)
    assert watch.check(2 * NS_PER_S) == ""
    del screen.plugged[1]
    assert watch.check(3 * NS_PER_S) == ""
