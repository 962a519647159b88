"""`station devices monitor`: live hits with their raw bytes, what was held back, what looks suspect; rules by typing.

Each hit is a line: time in s, piece, zone, velocity, openness, position, bytes. Below it a suspicion, with the words
that would make a rule of it; typed in, they hold at once, and `save` keeps them in the kit's own file.
"""

import argparse

from station.app.commands.listening import TypedLines, event_line, listening, polls
from station.core.clock import monotonic_ns
from station.core.errors import BadInput, StationError
from station.core.events import DeviceEvent, Hit
from station.core.names import piece_name
from station.core.pieces import word
from station.core.units import NS_PER_MS, ms_from_ns, s_from_ns
from station.devices.decoders import DecoderBank
from station.devices.desk import USAGE, obey
from station.devices.guard import Ghost, Why
from station.devices.kit import KitPreset
from station.devices.kit_file import own_kit, save_kit
from station.devices.suspects import Suspects, Suspicion
from station.devices.watch import Findings

_CHATTER = (b"\xf8", b"\xfe")
"""MIDI clock and active sensing: several a second, and nothing that a drummer did."""
_WIDER = 1.25
"""A rule is proposed so much wider than what was seen (our choice: the next ghost may be louder)."""


def monitor(arguments: argparse.Namespace) -> int:
    """Show what the kits send until Ctrl-C."""
    page, typed = MonitorPage(monotonic_ns()), TypedLines()
    with listening(arguments) as kits:
        for findings in polls(kits, arguments.seconds):
            lines = page.take(findings) + page.settle(monotonic_ns())
            for line in lines + [answer for order in typed.take() for answer in page.obey(order)]:
                print(line, flush=True)
    return 0


class MonitorPage:
    """The lines of the page, and the kits as they are set: findings and typed words in, lines out."""

    def __init__(self, start_ns: int) -> None:
        self._start_ns = start_ns
        self._bank = DecoderBank()
        self._suspects: dict[str, Suspects] = {}
        self._raw: dict[tuple[str, int], str] = {}
        self._device = ""

    def take(self, findings: Findings) -> list[str]:
        """What one look at a kit brought."""
        lines, now_ns, device = list[str](), monotonic_ns(), findings.device
        if findings.found:
            lines += self._begin(device)
            lines += self._lines(self._bank.found(device, now_ns))
        for packet in findings.packets:
            raw = packet.data.hex(" ")
            if packet.data[:1] in _CHATTER:
                continue
            self._raw[device, packet.at_ns] = f"{self._raw.get((device, packet.at_ns), '')} {raw}"
            told = self._bank.feed(device, packet.data, packet.at_ns).told
            shown = self._lines(told)
            if not shown and not self._bank.waits(device):
                shown = [self._bare(device, packet.at_ns)]
            lines += shown
        if findings.lost:
            lines += self._lines(self._bank.lost(device, now_ns))
        return lines

    def settle(self, now_ns: int) -> list[str]:
        """What the clock has made certain."""
        return self._lines(self._bank.settle(now_ns))

    def obey(self, line: str) -> list[str]:
        """What was typed: a rule, or `save`; for the kit that was found last."""
        if not self._device:
            return ["no kit is here yet"]
        try:
            if line == "save":
                return [f"kept in {save_kit(self._own(), self._device)}"]
            self._bank.add(self._device, obey(self._own(), line))
        except StationError as fault:
            return [f"{fault}; save keeps what is set"]
        return [f"{self._device}: {line}"]

    def _own(self) -> KitPreset:
        """The kit as it stands."""
        return self._bank.preset_of(self._device)

    def _begin(self, device: str) -> list[str]:
        self._device = device
        self._suspects[device] = Suspects()
        try:
            kit = own_kit(device)
        except BadInput as fault:
            return [str(fault)]
        if kit is not None:
            self._bank.add(device, kit)
        return [f"{device}: {self._own().title}; {USAGE} | save"]

    def _lines(self, told: list[DeviceEvent]) -> list[str]:
        lines = [self._held_back(ghost) for ghost in self._bank.take_ghosts()]
        for event in told:
            raw = self._raw.pop((event.device, event.at_ns), "")
            lines.append(f"{event_line(event, self._start_ns)}{_position(event):16} {raw}".rstrip())
            if isinstance(event, Hit):
                found = self._suspects.setdefault(event.device, Suspects()).look(event)
                lines += [f"{'':12}? {_words(suspicion)}" for suspicion in found]
        return lines

    def _held_back(self, ghost: Ghost) -> str:
        source = "" if ghost.source is None else f" of {piece_name(ghost.source)}"
        raw = self._raw.pop((ghost.hit.device, ghost.hit.at_ns), "")
        return f"{event_line(ghost.hit, self._start_ns)}  - no stroke: {ghost.why.value}{source} {raw}".rstrip()

    def _bare(self, device: str, at_ns: int) -> str:
        """Bytes that make no event."""
        return f"{s_from_ns(at_ns - self._start_ns):10.4f}  {'':60} {self._raw.pop((device, at_ns), '')}"


def _position(event: DeviceEvent) -> str:
    if not isinstance(event, Hit) or event.position is None:
        return ""
    return f"  position {event.position:.2f}"


def _words(suspicion: Suspicion) -> str:
    """What is suspected, and the rule that would hold it back."""
    hit, cause, gap_ms = suspicion.hit, suspicion.cause, ms_from_ns(abs(suspicion.after_ns))
    when = "after" if suspicion.after_ns >= 0 else "before"
    seen = f"{piece_name(hit.piece)} {gap_ms:.1f} ms {when} {piece_name(cause.piece)}, {suspicion.share:.0%} as loud"
    match suspicion.why:
        case Why.DOUBLE:
            rule = f"mask {word(hit.piece)} {_WIDER * suspicion.after_ns / NS_PER_MS:.0f}"
        case Why.FALSE_STOMP:
            rule = "travel 0.3"
        case _:
            rule = f"ghost {word(cause.piece)} {word(hit.piece)} {min(1.0, _WIDER * suspicion.share):.2f}"
    return f"{suspicion.why.value}? {seen}: {rule}"
