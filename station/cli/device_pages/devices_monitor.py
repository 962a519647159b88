"""`station devices monitor`: live hits with their raw bytes, what was held back, what looks suspect; rules by typing.

Each hit is a line: time in s, piece, zone, velocity, openness, position, bytes. Below it a suspicion, with the words
that would make a rule of it; typed in, they hold at once, and `save` keeps them in the kit's own file.
"""

from station.cli.console import write
from station.cli.device_pages.devices_monitor_sticks import monitor_sticks
from station.cli.input.device_listening import HearOptions, TypedLines, event_line, listening, polls
from station.core.clock import monotonic_ns
from station.core.errors import StationError
from station.core.events import DeviceEvent, Hit
from station.core.pieces import word
from station.core.units import s_from_ns
from station.devices.mapping.suspect_hits import Suspicion
from station.devices.mapping.trigger_filter import FalseTrigger
from station.devices.mapping_commands import USAGE, obey
from station.devices.monitor import DeviceMonitor, MonitorLine, rule_against, suspected
from station.devices.port_watch import PortPoll


def monitor(options: HearOptions) -> int:
    """Show what the kits send until Ctrl-C, or, where they are named, how the motion sensors do."""
    if options.sticks:
        return monitor_sticks(options)
    page, typed = MonitorPage(monotonic_ns()), TypedLines()
    with listening(options) as kits:
        for findings in polls(kits, options.seconds):
            lines = page.handle(findings) + page.settle(monotonic_ns())
            for line in lines + [answer for order in typed.pop() for answer in page.obey(order)]:
                write(line, flush=True)
    return 0


class MonitorPage:
    """The lines of the page: findings and typed words in, lines out."""

    def __init__(self, start_ns: int) -> None:
        self._start_ns = start_ns
        self._kits = DeviceMonitor()
        self._device = ""

    def handle(self, findings: PortPoll) -> list[str]:
        """What one look at a kit brought."""
        lines, now_ns, device = list[str](), monotonic_ns(), findings.device
        if findings.found:
            self._device = device
            shown, fault = self._kits.found(device, now_ns)
            lines.append(fault or f"{device}: {self._kits.kit(device).title}; {USAGE} | save; Ctrl-C ends")
            lines += self._words(shown)
        for packet in findings.packets:
            lines += self._words(self._kits.bytes_came(device, packet.data, packet.at_ns))
        if findings.lost:
            lines += self._words(self._kits.lost(device, now_ns))
        return lines

    def settle(self, now_ns: int) -> list[str]:
        """What the clock has made certain."""
        return self._words(self._kits.settle(now_ns))

    def obey(self, line: str) -> list[str]:
        """What was typed: a rule, or `save`; for the kit that was found last."""
        if not self._device:
            return ["no kit is here yet"]
        try:
            if line == "save":
                return [f"kept in {self._kits.save(self._device)}"]
            self._kits.trial(self._device, obey(self._kits.kit(self._device), line))
        except StationError as fault:
            return [f"{fault}; save keeps what is set"]
        return [f"{self._device}: {line}"]

    def _words(self, shown: list[MonitorLine]) -> list[str]:
        return [words for line in shown for words in self._line(line)]

    def _line(self, line: MonitorLine) -> list[str]:
        if line.false_trigger is not None:
            return [self._held_back(line.false_trigger, line.raw)]
        if line.event is None:
            return [f"{s_from_ns(line.at_ns - self._start_ns):10.4f}  {'':60}  {line.raw}"]
        counts = "" if line.counts is None else f"  counts as {line.counts}"
        shown = f"{event_line(line.event, self._start_ns)}{counts}{_position(line.event):16}  {line.raw}".rstrip()
        return [shown, *(f"{'':12}? {_words(suspicion)}" for suspicion in line.suspicions)]

    def _held_back(self, held: FalseTrigger, raw: str) -> str:
        source = "" if held.source is None else f" of {word(held.source)}"
        return f"{event_line(held.hit, self._start_ns)}  - no stroke: {held.why.value}{source}  {raw}".rstrip()


def _position(event: DeviceEvent) -> str:
    if not isinstance(event, Hit) or event.position is None:
        return ""
    return f"  position {event.position:.2f}"


def _words(suspicion: Suspicion) -> str:
    """What is suspected, and the rule that would hold it back."""
    return f"{suspected(suspicion)}: {rule_against(suspicion)}"
