"""Learns what shall pause a session from the kit itself: two pads struck at once, or a foot switch that is pressed.

Pure: events with their own times in, the word that `pause_options` reads out.
"""

from station.core.events import Hit, Switched
from station.core.pieces import word
from station.engine.messages import EngineEvent
from station.practice.control.pad_gestures import AT_ONCE_NS


class PauseLearning:
    """Hand it every event until it knows a word."""

    def __init__(self) -> None:
        self._last: Hit | None = None

    def feed(self, event: EngineEvent) -> str | None:
        """What `event` says, with the one before it where it is a stroke; None while that is nothing."""
        if isinstance(event, Switched):
            return event.switch
        if not isinstance(event, Hit):
            return None
        before, self._last = self._last, event
        if before is None or before.piece is event.piece or abs(event.at_ns - before.at_ns) > AT_ONCE_NS:
            return None
        return "+".join(word(piece) for piece in sorted((before.piece, event.piece)))
