"""`station devices learn`: the kit wizard in the terminal; a line typed is a key, for a drummer's hands are busy."""

from collections.abc import Callable
from pathlib import Path

from station.cli.console import say, write
from station.cli.input.device_listening import ListenOptions, TypedLines, event_line, listening, polls
from station.core.clock import monotonic_ns
from station.core.events import DeviceEvent, Hit
from station.core.units import NS_PER_MS
from station.devices.decoders import DecoderBank
from station.devices.mapping.device_file import save_kit
from station.devices.port_watch import PortPoll
from station.devices.wizard.wizard import Wizard, WizardView

KEYS = "Enter skips what the kit lacks, b goes back, f leaves the rest to the preset, q ends without keeping anything"
SHOW_EVERY_NS = 50 * NS_PER_MS
DONE_KEYS = "Play, and see whether it is right. Enter keeps it, b goes back, q keeps nothing"


def learn(options: ListenOptions) -> int:
    """Teach the station one kit."""
    typed = TypedLines()
    page = LearnPage(lambda: not typed.ended)
    with listening(options) as kits:
        for findings in polls(kits, options.seconds):
            page.handle(findings)
            for line in typed.pop():
                page.key(line)
            page.advance(monotonic_ns())
            if page.over:
                break
    if page.kept is None:
        say("nothing was kept")
    else:
        say(f"kept in {page.kept}; practice uses it from now on")
    return 0


class LearnPage:
    """The first kit that is found, its wizard, and what of it is on the screen."""

    def __init__(self, is_attended: Callable[[], bool]) -> None:
        self._is_attended = is_attended  # whether somebody can still press a key
        self.kept: Path | None = None
        self.over = False
        self._wizard: Wizard | None = None
        self._shown: tuple[object, ...] = ()
        self._trial: DecoderBank | None = None
        self._start_ns = 0
        self._next_show_ns = 0

    def handle(self, findings: PortPoll) -> None:
        """What the kit brought; another kit than the first is not listened to."""
        if findings.found and self._wizard is None:
            self._wizard = Wizard(findings.device)
            say(f"{findings.device} is here. {KEYS}.")
        if self._wizard is None or findings.device != self._wizard.port:
            return
        if findings.lost:
            say(f"{findings.device} is gone; plug it in again, the questions go on")
        for packet in findings.packets:
            self._start_ns = self._start_ns or packet.at_ns
            if self._trial is None:
                self._wizard.feed(packet.data, packet.at_ns)
            else:
                self._try(self._trial.feed(findings.device, packet.data, packet.at_ns).certain)

    def _try(self, events: list[DeviceEvent]) -> None:
        for event in events:
            if isinstance(event, Hit):
                write(event_line(event, self._start_ns), flush=True)

    def key(self, line: str) -> None:
        """A line that was typed."""
        wizard = self._wizard
        if line == "q":
            self.over = True
        elif wizard is None:
            return
        elif line == "b":
            self._trial = None
            wizard.back()
        elif wizard.over:
            self._keep(wizard)
        elif line == "f":
            wizard.finish()
        elif not line:
            wizard.skip()
        else:
            say(KEYS)

    def advance(self, now_ns: int) -> None:
        """Show what is new; once all was asked, what was learned."""
        wizard = self._wizard
        if wizard is None:
            return
        if self._trial is not None:
            self._try(self._trial.settle(now_ns))
        wizard.advance(now_ns)
        if self._trial is None and now_ns >= self._next_show_ns:
            self._next_show_ns = now_ns + SHOW_EVERY_NS
            self._show(wizard.view())
        if wizard.over and self._trial is None:
            self._show_learned(wizard)

    def _show(self, view: WizardView) -> None:
        if view.text and (view.step, view.text) != self._shown[:2]:
            write(f"\n{view.step}/{view.steps}  {view.text}", flush=True)
        if view.text and (view.done, view.hint) != self._shown[2:]:
            heard = "".join(f"  {number}:{velocity}" for number, velocity in view.heard)
            write(f"       {view.done}/{view.needed}{heard}  {view.hint}".rstrip(), flush=True)
        self._shown = (view.step, view.text, view.done, view.hint)

    def _show_learned(self, wizard: Wizard) -> None:
        learned = wizard.learned()
        write("\n".join(("", *learned.findings, "")))
        self._trial = DecoderBank()
        self._trial.add(wizard.port, learned.kit)
        if not self._is_attended():
            self._keep(wizard)
        else:
            say(DONE_KEYS)

    def _keep(self, wizard: Wizard) -> None:
        self.kept, self.over = save_kit(wizard.learned().kit, wizard.port), True
