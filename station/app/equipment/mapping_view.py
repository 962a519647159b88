"""What the devices page shows of kits: their last lines, strokes and suspicions, and what is learnt of them."""

from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from station.core.events import Hit
from station.core.pieces import Piece
from station.devices.mapping.device_map import DeviceMap, Sent
from station.devices.mapping.suspect_hits import Suspicion
from station.devices.mapping.trigger_filter import HeldBack
from station.devices.monitor import MonitorLine
from station.devices.wizard.one_hit import PadListener

LINES_SHOWN, STROKES_SHOWN, SUSPICIONS_SHOWN = 8, 24, 4
"""Our choice: what a glance takes in."""


@dataclass(frozen=True, slots=True)
class PadStroke:
    """A hit on a pad; `why` it is no stroke, None for one that counts."""

    velocity: int
    why: HeldBack | None = None


@dataclass(slots=True)
class SeenKit:
    """What one kit did of late, the newest last, and what is wrong with its file.

    `before` is how it was kept, and how it was on trial, before each thing that was learnt.
    """

    lines: deque[MonitorLine] = field(default_factory=lambda: deque(maxlen=LINES_SHOWN))
    suspicions: deque[Suspicion] = field(default_factory=lambda: deque(maxlen=SUSPICIONS_SHOWN))
    strokes: dict[Piece, deque[PadStroke]] = field(default_factory=dict)
    fault: str = ""
    listener: PadListener = field(default_factory=PadListener)
    before: list[tuple[DeviceMap, DeviceMap]] = field(default_factory=list)

    def add(self, line: MonitorLine) -> None:
        """One more line."""
        self.lines.append(line)
        hit = line.false_trigger.hit if line.false_trigger is not None else line.event
        if isinstance(hit, Hit):
            why = None if line.false_trigger is None else line.false_trigger.why
            self.strokes.setdefault(hit.piece, deque(maxlen=STROKES_SHOWN)).append(PadStroke(hit.velocity, why))
        self.suspicions.extend(line.suspicions)


@dataclass(frozen=True, slots=True)
class MappingView:
    """What the devices page shows: the kits that are here, and of `device`, empty for none, what it did and its rules.

    `kit` has the rules on trial, None where no kit is here; `asks` what to play now while it `learns`, `learnt` what
    came of it last.
    """

    devices: tuple[str, ...] = ()
    device: str = ""
    kit: DeviceMap | None = None
    fault: str = ""
    lines: tuple[MonitorLine, ...] = ()
    suspicions: tuple[Suspicion, ...] = ()
    strokes: Mapping[Piece, tuple[PadStroke, ...]] = field(default_factory=lambda: MappingProxyType({}))
    pads: tuple[Piece, ...] = ()
    unknown: tuple[Sent, ...] = ()
    is_changed: bool = False
    learns: bool = False
    asks: str = ""
    learnt: str = ""
    can_undo: bool = False
