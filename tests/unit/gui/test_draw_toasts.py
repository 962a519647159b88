"""What the window tells in passing; expected lines are written out by hand."""

import pytest

from station.gui.draw_toasts import Toasts, new_of


@pytest.mark.parametrize(
    ("before", "now", "new"),
    [
        ((), ("a",), ("a",)),
        (("a",), ("a", "b", "c"), ("b", "c")),
        (("a", "b", "c"), ("b", "c", "d"), ("d",)),
        (("a", "b", "c"), ("d", "e", "f"), ("d", "e", "f")),
        (("a", "a"), ("a", "a", "a"), ("a",)),
        (("a",), (), ()),
    ],
)
def test_what_is_new_of_the_last_lines(before: tuple[str, ...], now: tuple[str, ...], new: tuple[str, ...]) -> None:
    assert new_of(before, now) == new


def test_two_faults_of_one_frame_are_both_told() -> None:
    news = Toasts()
    news.follow(("the kit is gone",), 0.0)
    news.follow(("the kit is gone", "it is back", "the engine has ended", "the disk is full"), 0.1)
    assert news.text == "the engine has ended\nthe disk is full"
