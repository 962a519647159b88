"""What the kits send, understood beside the engine for a page that shows it: hits, what is held back, what is suspect.

Bytes and times in, lines out, whoever brings them: the terminal's `monitor` from ports of its own, the window's page
from the engine. Each kit is understood by the user's own file where there is one; `trial` sets other rules, which hold
here at once, and `save` keeps them. Velocities are those that were sent, for which the rules are set. Times are
monotonic ns.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from station.core.errors import BadInput
from station.core.events import DeviceEvent, Hit, SensorEvent
from station.core.pieces import word
from station.core.units import NS_PER_MS, ms_from_ns
from station.devices.decoders import DecoderBank
from station.devices.mapping.device_file import own_kit, save_kit
from station.devices.mapping.device_map import DeviceMap
from station.devices.mapping.suspect_hits import Suspects, Suspicion
from station.devices.mapping.trigger_filter import FalseTrigger, HeldBack
from station.devices.mapping.velocity_curve import AS_SENT
from station.devices.midi.midi_tokens import MidiTokenizer

_CHATTER = (b"\xf8", b"\xfe")
"""MIDI clock and active sensing: several a second, and nothing that a drummer did."""
_MOST_BEGUN = 3
"""Bytes are shown together as the message that they are; so many that are none yet are shown as they stand."""
_WIDER = 1.25
"""A rule is proposed so much wider than what was seen (our choice: the next one may be louder)."""


@dataclass(frozen=True, slots=True)
class MonitorLine:
    """One line of the page: an event or a false trigger, or bytes that make neither; `raw` is what was sent, in hex.

    `counts` is what the velocity of a stroke counts as, None where that is what was sent.
    """

    at_ns: int
    device: str
    raw: str
    event: DeviceEvent | None = None
    false_trigger: FalseTrigger | None = None
    suspicions: tuple[Suspicion, ...] = ()
    counts: int | None = None


class DeviceMonitor:
    """The kits as they are set on the page."""

    def __init__(self, folder: Path | None = None) -> None:
        """`folder` holds the user's own kits, None for this user's."""
        self._folder = folder
        self._bank = DecoderBank(with_curves=False)
        self._suspects: dict[str, Suspects] = {}
        self._raw: dict[str, dict[int, str]] = {}
        """What each kit sent, by its time, as long as something of it is not certain."""
        self._begun: dict[str, tuple[MidiTokenizer, bytes]] = {}
        """The bytes of each kit that may become a message, which serial ports bring one by one."""

    def found(self, device: str, now_ns: int) -> tuple[list[MonitorLine], str]:
        """A kit is here; its lines, and what is wrong with the user's file for it: the preset holds then."""
        self._suspects[device] = Suspects()
        fault = ""
        try:
            self.reread(device)
        except BadInput as wrong:
            fault = str(wrong)
        return self._lines(self._bank.found(device, now_ns)), fault

    def reread(self, device: str) -> None:
        """Understand `device` as its file says; raises `BadInput`."""
        kit = own_kit(device, self._folder)
        if kit is not None:
            self._bank.add(device, kit)

    def lost(self, device: str, now_ns: int) -> list[MonitorLine]:
        """A kit is gone."""
        self._begun.pop(device, None)
        return self._lines(self._bank.lost(device, now_ns))

    def bytes_came(self, device: str, data: bytes, at_ns: int) -> list[MonitorLine]:
        """What was sent."""
        if data[:1] in _CHATTER:
            return []
        cutter, begun = self._begun.get(device) or (MidiTokenizer(), b"")
        sent, ends = begun + data, bool(cutter.feed(data))
        if not ends and len(sent) < _MOST_BEGUN:
            self._begun[device] = cutter, sent
            return self._lines(self._bank.feed(device, data, at_ns).certain)
        self._begun[device] = cutter, b""
        raw = self._raw.setdefault(device, {})
        raw[at_ns] = f"{raw.get(at_ns, '')} {sent.hex(' ')}".strip()
        lines = self._lines(self._bank.feed(device, data, at_ns).certain)
        if not self._bank.waits(device):
            lines = lines or [MonitorLine(at_ns, device, raw[at_ns])]
            raw.clear()
        return lines

    def settle(self, now_ns: int) -> list[MonitorLine]:
        """What the clock has made certain."""
        lines = self._lines(self._bank.settle(now_ns))
        for device, raw in self._raw.items():
            if not self._bank.waits(device):
                raw.clear()
        return lines

    def kit(self, device: str) -> DeviceMap:
        """The kit as it stands."""
        return self._bank.preset_of(device)

    def trial(self, device: str, kit: DeviceMap) -> None:
        """Understand `device` by other rules from now on."""
        self._bank.add(device, kit)

    def save(self, device: str) -> Path:
        """Keep the kit as it stands; returns where. Raises `DeviceError` if the disk refuses."""
        return self.keep(device, self.kit(device))

    def keep(self, device: str, kit: DeviceMap) -> Path:
        """Keep `kit` as the user's own for `device`, whatever is on trial; returns and raises as `save` does."""
        return save_kit(kit, device, self._folder)

    def _sent(self, device: str, at_ns: int) -> str:
        """The bytes of that moment; they are shown once."""
        return self._raw.get(device, {}).pop(at_ns, "")

    def _counts(self, hit: Hit) -> int | None:
        curve = self.kit(hit.device).pad(hit.piece).curve
        return None if curve == AS_SENT else curve.table[hit.velocity]

    def _lines(self, events: Sequence[DeviceEvent | SensorEvent]) -> list[MonitorLine]:
        lines = []
        for false_trigger in self._bank.pop_false_triggers():
            hit = false_trigger.hit
            lines.append(
                MonitorLine(hit.at_ns, hit.device, self._sent(hit.device, hit.at_ns), false_trigger=false_trigger)
            )
        for event in events:
            if isinstance(event, SensorEvent):  # what sensors send is no line each
                continue
            raw = self._sent(event.device, event.at_ns)
            suspicions: tuple[Suspicion, ...] = ()
            counts = None
            if isinstance(event, Hit):
                counts = self._counts(event)
                suspicions = tuple(self._suspects.setdefault(event.device, Suspects()).look(event))
            lines.append(MonitorLine(event.at_ns, event.device, raw, event, None, suspicions, counts))
        return lines


def suspected(suspicion: Suspicion) -> str:
    """What is suspected, in words."""
    hit, cause, gap_ms = suspicion.hit, suspicion.cause, ms_from_ns(abs(suspicion.after_ns))
    when = "after" if suspicion.after_ns >= 0 else "before"
    seen = f"{word(hit.piece)} {gap_ms:.1f} ms {when} {word(cause.piece)}, {suspicion.share:.0%} as loud"
    return f"{suspicion.why.value}? {seen}"


def rule_against(suspicion: Suspicion) -> str:
    """The rule, in the words of `devices.edit_mapping`, that would hold such a hit back."""
    hit, cause = suspicion.hit, suspicion.cause
    match suspicion.why:
        case HeldBack.DOUBLE:
            return f"mask {word(hit.piece)} {_WIDER * suspicion.after_ns / NS_PER_MS:.0f}"
        case HeldBack.FALSE_STOMP:
            return "travel 0.3"
        case _:
            return f"ghost {word(cause.piece)} {word(hit.piece)} {min(1.0, _WIDER * suspicion.share):.2f}"
