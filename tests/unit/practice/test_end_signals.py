"""What asks for the end while a session is played is noted, and is as it was afterwards."""

import signal
import sys

import pytest

from station.practice.headless.end_signals import end_asked

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such signals")


@pytest.mark.parametrize(
    ("numbers", "is_attended"),
    [
        ([], True),
        ([signal.SIGINT, signal.SIGINT, signal.SIGINT], True),
        ([signal.SIGTERM], False),
        ([signal.SIGHUP, signal.SIGINT], False),
    ],
)
def test_every_signal_asks_once(numbers: list[signal.Signals], is_attended: bool) -> None:
    before = [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)]
    with end_asked() as asked:
        for number in numbers:
            signal.raise_signal(number)
    assert bool(asked) == bool(numbers)
    assert asked.is_attended == is_attended
    assert [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)] == before


def test_a_hang_up_that_is_ignored_stays_ignored() -> None:
    """As `nohup` wants it."""
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with end_asked() as asked:
            signal.raise_signal(signal.SIGHUP)
    finally:
        signal.signal(signal.SIGHUP, before)
    assert not asked
