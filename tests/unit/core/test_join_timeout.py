"""Waits that a machine which stands still does not shorten; the expected turns are counted by hand."""

from station.core.join_timeout import TURN_S, ends_within


class Slow:
    """Ends after so many turns, however long each takes by the clock."""

    def __init__(self, turns: int) -> None:
        self._left = turns
        self.waits: list[float | None] = []

    def join(self, timeout: float | None = None) -> None:
        self.waits.append(timeout)
        self._left -= 1

    def is_alive(self) -> bool:
        return self._left > 0


def test_it_waits_by_turns() -> None:
    ending = Slow(7)
    assert ends_within(ending, 20 * TURN_S)
    assert ending.waits == [TURN_S] * 7


def test_it_gives_up_after_its_turns() -> None:
    ending = Slow(21)
    assert not ends_within(ending, 20 * TURN_S)
    assert len(ending.waits) == 20
