"""The options by which another program of ours opens the window, watches it and closes it; no help names them."""

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING

from station.cli.console import write
from station.cli.options.option_fields import HIDDEN, number, option, whole_number

if TYPE_CHECKING:
    from station.app.opening import Watch


@dataclass(frozen=True, slots=True, kw_only=True)
class WatchOptions:
    """After how many frames or seconds the window closes by itself; None each where a person closes it."""

    frames: int | None = option("--watch-frames N", HIDDEN, whole_number, None)
    seconds: float | None = option("--watch-seconds S", HIDDEN, number, None)

    def watch(self) -> "Watch | None":
        """What watches the window, and writes what it reports as JSON, a document a line; None where nobody asks."""
        if self.frames is None and self.seconds is None:
            return None
        from station.app.opening import Watch

        return Watch(self.frames, self.seconds, lambda document: write(json.dumps(document), flush=True))
