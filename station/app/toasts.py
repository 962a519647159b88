"""What the window shows in passing: one or two lines that go away by themselves, long paths in them shortened."""

from collections.abc import Callable

from station.core.errors import StationError
from station.core.short_names import short_paths
from station.core.units import NS_PER_S

SHOWN_NS = 8 * NS_PER_S
"""How long a fault or a notice stays on the screen (our choice: twice the time to read it)."""
MOST_LINES = 2
"""So many notices are read at once (our choice: what has room above a result)."""


class Toasts:
    """The `text` that is shown now, empty for none."""

    def __init__(self) -> None:
        self.text = ""
        self._until_ns = 0
        self._waiting: list[str] = []

    def notify(self, line: str) -> None:
        """Show a line from the next `update` on, with others that come before it; an empty one is left out."""
        if line:
            self._waiting.append(line)

    def attempt(self, act: Callable[[], object]) -> None:
        """Do it; what cannot be done is said."""
        try:
            act()
        except StationError as fault:
            self.notify(str(fault))

    def update(self, now_ns: int) -> None:
        """Show what waits; what was shown long enough goes."""
        if self._waiting:
            self.text, self._until_ns = short_paths("\n".join(self._waiting[-MOST_LINES:])), now_ns + SHOWN_NS
            self._waiting = []
        elif now_ns >= self._until_ns:
            self.text = ""
