"""The devices page without its picture: the kits that are here, their last strokes and lines, and their rules on trial.

While the page is open the engine tells every byte besides (`Eavesdrop`). They are understood here once more, by rules
that may be set by looking; `save` keeps them in the kit's own file and lets the engine take it, so that what counts as
a stroke changes for sound and judgement only then.
"""

from collections import deque
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from station.app.kit_monitor import KitMonitor, Line, rule_against
from station.core.errors import DeviceError
from station.core.events import DeviceFound, DeviceLost, Hit
from station.core.pieces import Piece, word
from station.core.units import NS_PER_MS
from station.devices.desk import obey
from station.devices.guard import Why
from station.devices.kit import KitPreset
from station.devices.suspects import Suspicion
from station.engine.messages import Command, Eavesdrop, EngineEvent, Overheard, TakeKit

LINES_SHOWN, STROKES_SHOWN, SUSPICIONS_SHOWN = 8, 24, 4
"""Our choice: what a glance takes in."""
_SHOWN_LATE_NS = 200 * NS_PER_MS
"""Bytes come to the page with its frames: what the clock makes certain is shown so much later (our choice: four frames
of a slow machine)."""


@dataclass(frozen=True, slots=True)
class Stroke:
    """A hit on a pad; `why` it is no stroke, None for one that counts."""

    velocity: int
    why: Why | None = None


def _lines() -> deque[Line]:
    return deque(maxlen=LINES_SHOWN)


def _suspicions() -> deque[Suspicion]:
    return deque(maxlen=SUSPICIONS_SHOWN)


@dataclass(slots=True)
class Seen:
    """What one kit did of late, the newest last, and what is wrong with its file."""

    lines: deque[Line] = field(default_factory=_lines)
    suspicions: deque[Suspicion] = field(default_factory=_suspicions)
    strokes: dict[Piece, deque[Stroke]] = field(default_factory=dict)
    fault: str = ""

    def take(self, line: Line) -> None:
        """One more line."""
        self.lines.append(line)
        hit = line.ghost.hit if line.ghost is not None else line.event
        if isinstance(hit, Hit):
            why = None if line.ghost is None else line.ghost.why
            self.strokes.setdefault(hit.piece, deque(maxlen=STROKES_SHOWN)).append(Stroke(hit.velocity, why))
        self.suspicions.extend(line.suspicions)


class KitDesk:
    """Kits by name; `device` is the one that is shown, empty while there is none."""

    def __init__(self, send: Callable[[Command], None], folder: Path | None = None) -> None:
        """`send` reaches the engine; `folder` holds the user's own kits, None for this user's."""
        self._send = send
        self._monitor = KitMonitor(folder)
        self._seen: dict[str, Seen] = {}
        self._kept: dict[str, KitPreset] = {}
        self._listens = False
        self.device = ""

    @property
    def devices(self) -> list[str]:
        """The kits that are here."""
        return list(self._seen)

    @property
    def seen(self) -> Seen:
        """What the kit that is shown did."""
        return self._seen[self.device]

    @property
    def kit(self) -> KitPreset:
        """The kit that is shown, by the rules on trial."""
        return self._monitor.kit(self.device)

    @property
    def is_changed(self) -> bool:
        """Whether the rules on trial are others than those that are kept."""
        return self.kit != self._kept[self.device]

    @property
    def pads(self) -> list[Piece]:
        """The pads that were struck, or of which something is known."""
        return sorted({*self.seen.strokes, *self.kit.pads})

    # --- from the engine ---------------------------------------------------------------------------------------------

    def listen(self, on: bool) -> None:
        """Have the bytes told, or no longer; a dead engine is not asked."""
        if on != self._listens:
            self._listens = on
            with suppress(DeviceError):
                self._send(Eavesdrop(on))

    def take(self, event: EngineEvent) -> None:
        """What the engine says."""
        match event:
            case DeviceFound(at_ns, device):
                lines, fault = self._monitor.found(device, at_ns)
                self._seen[device] = Seen(fault=fault)
                self._kept[device] = self._monitor.kit(device)
                self.device = self.device or device
                self._show(lines)
            case DeviceLost(at_ns, device):
                self._monitor.lost(device, at_ns)
                self._seen.pop(device, None)
                if self.device == device:
                    self.device = next(iter(self._seen), "")
            case Overheard(at_ns, device, data):
                self._show(self._monitor.bytes_came(device, data, at_ns))
            case _:
                pass

    def advance(self, now_ns: int) -> None:
        """Show what the clock has made certain."""
        self._show(self._monitor.settle(now_ns - _SHOWN_LATE_NS))

    def _show(self, lines: list[Line]) -> None:
        for line in lines:
            if line.device in self._seen:
                self._seen[line.device].take(line)

    # --- from the page -----------------------------------------------------------------------------------------------

    def threshold(self, piece: Piece, velocity: int) -> None:
        """Softer than this is no stroke."""
        self._obey(f"threshold {word(piece)} {velocity}")

    def mask(self, piece: Piece, milliseconds: int) -> None:
        """For so long after a stroke there is no other."""
        self._obey(f"mask {word(piece)} {milliseconds}")

    def share(self, source: Piece, victim: Piece, share: float) -> None:
        """A stroke on `source` makes `victim` send ghosts up to so loud; 0 for no longer."""
        self._obey(f"ghost {word(source)} {word(victim)} {share:.2f}")

    def hold_back(self, suspicion: Suspicion) -> None:
        """Take hits such as this one for what they are suspected to be."""
        self._obey(rule_against(suspicion))
        self.seen.suspicions.clear()

    def _obey(self, order: str) -> None:
        self._monitor.trial(self.device, obey(self.kit, order))

    def back(self) -> None:
        """The rules as they are kept."""
        self._monitor.trial(self.device, self._kept[self.device])

    def save(self) -> Path:
        """Keep the rules, and let the engine take them; returns where. Raises `DeviceError` if the disk refuses."""
        path = self._monitor.save(self.device)
        self._kept[self.device] = self.kit
        with suppress(DeviceError):
            self._send(TakeKit(self.device))
        return path
