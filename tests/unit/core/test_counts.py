"""Whole numbers of thousands of digits, wherever a user may write one: a line about it, never a `ValueError`."""

from argparse import ArgumentTypeError
from collections.abc import Callable

import pytest

from station.cli.input.read_scores import bars_of_gap
from station.core.counts import is_count
from station.core.errors import BadInput
from station.devices.device_ports import parse_device
from station.drills.rudiments import find_rudiment
from station.practice.control.pause_options import parse_pause
from station.practice.session.cues.click_options import parse_click

DIGITS = "9" * 5_000


@pytest.mark.parametrize("word", ["", "-1", "1.5", "x", DIGITS])
def test_what_counts_nothing(word: str) -> None:
    assert not is_count(word)


@pytest.mark.parametrize("word", ["0", "127", "9" * 18])
def test_what_counts(word: str) -> None:
    assert is_count(word)


@pytest.mark.parametrize(
    ("read", "text"),
    [
        (bars_of_gap, f"{DIGITS}/1"),
        (parse_device, f"serial:COM3@{DIGITS}"),
        (find_rudiment, DIGITS),
        (parse_pause, f"cc={DIGITS}"),
        (parse_click, f"levels={DIGITS}"),
    ],
)
def test_too_many_digits_are_the_users_fault(read: Callable[[str], object], text: str) -> None:
    with pytest.raises((BadInput, ArgumentTypeError)):
        read(text)
