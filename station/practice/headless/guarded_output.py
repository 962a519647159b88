"""Telling that costs no session: what cannot be said (a terminal that is gone, a bug of ours) is not raised."""

from collections.abc import Callable
from typing import ParamSpec

from station.core.errors import DeviceError, StationError

What = ParamSpec("What")


class GuardedOutput:
    """Says what it is given to say; the first `failure` is remembered, and what comes after is tried all the same."""

    def __init__(self) -> None:
        self.failure: Exception | None = None

    def attempt(self, say: Callable[What, None], *what: What.args, **more: What.kwargs) -> None:
        """Call `say`; whatever it raises is remembered."""
        try:
            say(*what, **more)
        except Exception as failure:  # whatever it is, a session is worth more than its words
            self.failure = self.failure or failure

    def fault(self, unshown: str) -> DeviceError | None:
        """The failure in one line that begins with what stayed `unshown`; None where nothing failed."""
        if self.failure is None:
            return None
        reason = " ".join((getattr(self.failure, "strerror", None) or str(self.failure)).split())
        if not isinstance(self.failure, OSError | StationError):
            reason = f"{type(self.failure).__name__}: {reason}"
        return DeviceError(f"{unshown}: {reason}")
