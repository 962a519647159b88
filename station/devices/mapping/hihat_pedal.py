"""What the hi-hat's pedal says: how open it is at a stroke, and stomps of kits whose notes do not tell of them.

Kits tell the openness by a controller, by the note's number, by both or not at all; where nothing says it, it is None:
cannot tell. Openness 0 closed … 1 open; times monotonic ns.
"""

from station.core.events import DeviceEvent, Hit, PedalMoved
from station.core.note_map import NoteMeaning
from station.core.pieces import Articulation, Piece, Zone
from station.core.units import NS_PER_MS
from station.devices.mapping.device_map import Foot, PedalRange

_CONTRADICTION = 0.75
"""Where the pedal's openness and the note's own differ by more, the note is right (our choice: Roland modules change
from the open to the closed note at about a third of the way)."""

_OPEN, _SHUT = 0.5, 0.1
_STOMP_NS = 200 * NS_PER_MS
"""A pedal that goes from half open to shut within so long is stamped on; our choice."""
_HARDEST_NS = 15 * NS_PER_MS
"""So short a way down is velocity 127; our choice, for such modules do not say how hard the foot was."""
_UNKNOWN_VELOCITY = 64
_HARDEST = 127


class Hihat:
    """The pedal of one kit, as far as it has spoken."""

    def __init__(self, pedal: PedalRange | None, foot: Foot, device: str) -> None:
        self._pedal = pedal
        self._foot = foot
        self._device = device
        self.reset()

    def reset(self) -> None:
        """Forget where the pedal is."""
        self._openness: float | None = None
        self._has_moved = False
        self._left_open_ns: int | None = None

    def listens_to(self, controller: int) -> bool:
        """Whether `controller` is the pedal."""
        return self._pedal is not None and controller == self._pedal.controller

    def moved(self, value: int, at_ns: int) -> list[DeviceEvent]:
        """The pedal's controller says `value`; what that tells."""
        assert self._pedal is not None, "asked only for its own controller"
        openness, before = self._pedal.openness(value), self._openness
        if openness == before:
            return []
        self._has_moved = before is not None or 0.0 < openness < 1.0
        self._openness = openness
        events: list[DeviceEvent] = [PedalMoved(at_ns, openness, self._device)]
        if self._foot.by_controller and before is not None:
            events += self._stomp(before, openness, at_ns)
        return events

    def openness_of(self, strike: NoteMeaning) -> float | None:
        """How open the hi-hat is for a stroke that the map calls `strike`; None where nothing tells.

        A controller that has only ever said one end of its way may be none at all, so that a note that tells is right.
        """
        written, pedal = strike.openness, self._openness
        if strike.piece is not Piece.HIHAT or pedal is None:
            return written
        if written is None:
            return pedal
        return pedal if self._has_moved and abs(written - pedal) <= _CONTRADICTION else written

    def _stomp(self, before: float, openness: float, at_ns: int) -> list[DeviceEvent]:
        """The stomp that the way from `before` down to `openness` ends, if it does."""
        if openness >= _OPEN:
            self._left_open_ns = None
            return []
        if before >= _OPEN:
            self._left_open_ns = at_ns
        if openness > _SHUT or self._left_open_ns is None:
            return []
        took_ns, self._left_open_ns = at_ns - self._left_open_ns, None
        if took_ns > _STOMP_NS:
            return []
        velocity = min(_HARDEST, round(_HARDEST * _HARDEST_NS / took_ns)) if took_ns else _UNKNOWN_VELOCITY
        return [Hit(at_ns, Piece.HIHAT_PEDAL, Zone.PEDAL, velocity, Articulation.CHICK, 0.0, device=self._device)]
