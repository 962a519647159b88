"""The devices page without its picture: the kits that are here, their last strokes and lines, and their rules on trial.

While the page is open the engine reports every byte besides (`WatchRawBytes`). They are understood here once more, by
rules that may be set by looking; `save` keeps them in the kit's own file and lets the engine take it, so that what
counts as a stroke changes for sound and judgement only then. What is learnt from strokes, what a pad is and how loud
its ghosts and accents count, is kept at once, and can be undone.
"""

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import assert_never

from station.app.actions.equipment_actions import (
    GiveUp,
    HoldBack,
    LearnPad,
    LearnVelocity,
    MappingAction,
    NameNote,
    RevertRules,
    RuleAction,
    SaveRules,
    SetCurve,
    SetMask,
    SetShare,
    SetThreshold,
    ShowKit,
    UndoLearning,
)
from station.app.equipment.mapping_view import MappingView, SeenKit
from station.core.errors import DeviceError, StationError
from station.core.events import DeviceFound, DeviceLost, Hit
from station.core.note_map import NoteMeaning
from station.core.pieces import Piece, word
from station.core.units import NS_PER_MS
from station.devices.mapping.device_map import DeviceMap, Sent
from station.devices.mapping.trigger_filter import HeldBack
from station.devices.mapping_commands import obey
from station.devices.monitor import DeviceMonitor, MonitorLine, rule_against
from station.devices.wizard.one_hit import PadListener, in_words, taught
from station.devices.wizard.pad_choices import pad_name
from station.devices.wizard.velocity_learning import VelocityLearning
from station.engine.messages import Command, EngineEvent, RawBytes, ReloadDevice, WatchRawBytes

_SHOWN_LATE_NS = 200 * NS_PER_MS
"""Bytes come to the page with its frames: what the clock makes certain is shown so much later (our choice: four frames
of a slow machine)."""


class MappingEditor:
    """Kits by name; `device` is the one that is shown, empty while there is none."""

    def __init__(self, send: Callable[[Command], None], folder: Path | None = None) -> None:
        """`send` reaches the engine; `folder` holds the user's own kits, None for this user's."""
        self._send = send
        self._monitor = DeviceMonitor(folder)
        self._seen: dict[str, SeenKit] = {}
        self._kept: dict[str, DeviceMap] = {}
        self._listens = False
        self._pad: NoteMeaning | None = None
        self._velocity: VelocityLearning | None = None
        self.device = ""
        self.learnt = ""
        """What was learnt last, or why it was not."""

    @property
    def devices(self) -> list[str]:
        """The kits that are here."""
        return list(self._seen)

    @property
    def seen(self) -> SeenKit:
        """What the kit that is shown did."""
        return self._seen[self.device]

    @property
    def kit(self) -> DeviceMap:
        """The kit that is shown, by the rules on trial."""
        return self._monitor.kit(self.device)

    @property
    def is_changed(self) -> bool:
        """Whether the rules on trial are others than those that are kept."""
        return self.kit != self._kept[self.device]

    @property
    def pads(self) -> list[Piece]:
        """The pads that were struck, or of which something is known."""
        return sorted({*self.seen.strokes, *self.kit.pads} - {Piece.PERCUSSION})

    @property
    def unknown(self) -> list[Sent]:
        """The notes that came and that mean nothing yet."""
        return self.seen.listener.unknown(self.kit)

    @property
    def learns(self) -> bool:
        """Whether strokes are taken for what they teach: they command nothing meanwhile."""
        return self._pad is not None or self._velocity is not None

    @property
    def asks(self) -> str:
        """What to play now, empty while nothing is learnt."""
        if self._velocity is not None:
            return self._velocity.asks
        return "" if self._pad is None else f"hit it now, once: {pad_name(self._pad)}"

    @property
    def can_undo(self) -> bool:
        """Whether something was learnt since the kit is here."""
        return bool(self.seen.before)

    def view(self) -> MappingView:
        """What the page shows now."""
        if not self.device:
            return MappingView(learnt=self.learnt)
        seen = self.seen
        return MappingView(
            devices=tuple(self._seen),
            device=self.device,
            kit=self.kit,
            fault=seen.fault,
            lines=tuple(seen.lines),
            suspicions=tuple(seen.suspicions),
            strokes={piece: tuple(strokes) for piece, strokes in seen.strokes.items()},
            pads=tuple(self.pads),
            unknown=tuple(self.unknown),
            is_changed=self.is_changed,
            learns=self.learns,
            asks=self.asks,
            learnt=self.learnt,
            can_undo=self.can_undo,
        )

    # --- from the engine ---------------------------------------------------------------------------------------------

    def show(self, device: str) -> None:
        """Show another kit."""
        self.give_up()
        self.device = device

    def listen(self, on: bool) -> None:
        """Have the bytes reported, or no longer; a dead engine is not asked."""
        if on != self._listens:
            self._listens = on
            self.give_up()
            with suppress(DeviceError):
                self._send(WatchRawBytes(on))

    def handle(self, event: EngineEvent) -> None:
        """What the engine says."""
        match event:
            case DeviceFound(at_ns, device):
                lines, fault = self._monitor.found(device, at_ns)
                self._seen[device] = SeenKit(fault=fault, listener=PadListener(self._monitor.kit(device).reports))
                self._kept[device] = self._monitor.kit(device)
                self.device = self.device or device
                self._show(lines)
            case DeviceLost(at_ns, device):
                if self.device == device:
                    self.give_up()
                self._monitor.lost(device, at_ns)
                self._seen.pop(device, None)
                if self.device == device:
                    self.device = next(iter(self._seen), "")
            case RawBytes(at_ns, device, data):
                if device in self._seen:
                    self._seen[device].listener.feed(data, at_ns)
                self._show(self._monitor.bytes_came(device, data, at_ns))
            case _:
                pass

    def advance(self, now_ns: int) -> None:
        """Show what the clock has made certain."""
        self._show(self._monitor.settle(now_ns - _SHOWN_LATE_NS))
        if self._pad is not None:
            sent = self.seen.listener.hit(now_ns - _SHOWN_LATE_NS)
            if sent is not None:
                pad, self._pad = self._pad, None
                self.name(sent, pad)

    def _show(self, lines: list[MonitorLine]) -> None:
        for line in lines:
            if line.device in self._seen:
                self._seen[line.device].add(line)
            if self._velocity is not None and line.device == self.device:
                self._learn_from(line)

    def _learn_from(self, line: MonitorLine) -> None:
        """A stroke for the velocity curve that is learnt; those that are too soft to count are strokes too."""
        hit = (
            line.event
            if line.false_trigger is None or line.false_trigger.why is not HeldBack.TOO_SOFT
            else line.false_trigger.hit
        )
        if self._velocity is None or not isinstance(hit, Hit):
            return
        self._velocity.feed(hit)
        if self._velocity.is_over:
            learning, self._velocity = self._velocity, None
            self._learn(learning.learnt, learning.in_words())

    # --- learning ----------------------------------------------------------------------------------------------------

    def learn_pad(self, pad: NoteMeaning) -> None:
        """The next hit is on `pad`."""
        self.give_up()
        self._pad = pad
        self.seen.listener.listen(on=True)

    def learn_velocity(self, piece: Piece) -> None:
        """The next strokes are five ghosts and five accents on `piece`."""
        self.give_up()
        self._velocity = VelocityLearning(piece)

    def give_up(self) -> None:
        """Learn no longer; what was played meanwhile changes nothing."""
        self._pad = self._velocity = None
        self.learnt = ""
        if self.device:
            self.seen.listener.listen(on=False)

    def name(self, sent: Sent, pad: NoteMeaning) -> None:
        """The note that was `sent` is `pad` from now on."""
        is_shared = self.seen.listener.is_shared(sent)
        words = in_words(self._kept[self.device], sent, pad)
        self._learn(lambda kit: taught(kit, sent, pad, is_shared), words)

    def _learn(self, change: Callable[[DeviceMap], DeviceMap], words: str) -> None:
        """Keep a change at once, beside what is on trial; `learnt` says what came of it."""
        before = self._kept[self.device], self.kit
        try:
            self._keep(change(before[0]))
            self._monitor.trial(self.device, change(before[1]))
        except StationError as fault:
            self.learnt = str(fault)
            return
        self.seen.before.append(before)
        self.learnt = words

    def undo(self) -> None:
        """What was learnt last is as it was before."""
        kept, trial = self.seen.before[-1]
        try:
            self._keep(kept)
        except StationError as fault:
            self.learnt = str(fault)
            return
        self.seen.before.pop()
        self._monitor.trial(self.device, trial)
        self.learnt = "as it was before"

    def _keep(self, kit: DeviceMap) -> Path:
        """Keep `kit`, and let the engine take it; raises `DeviceError`, for a faulty file of the user's too."""
        if self.seen.fault:
            raise DeviceError(f"nothing is kept while the kit's file has a fault: {self.seen.fault}")
        path = self._monitor.keep(self.device, kit)
        self._kept[self.device] = kit
        with suppress(DeviceError):
            self._send(ReloadDevice(self.device))
        return path

    # --- from the page -----------------------------------------------------------------------------------------------

    def act(self, action: MappingAction) -> str:
        """Do what the user asks; returns what to show, empty for nothing. Raises `DeviceError` if the disk refuses."""
        match action:
            case ShowKit(device):
                self.show(device)
            case LearnPad(pad):
                self.learn_pad(pad)
            case LearnVelocity(piece):
                self.learn_velocity(piece)
            case GiveUp():
                self.give_up()
            case NameNote(sent, pad):
                self.name(sent, pad)
            case UndoLearning():
                self.undo()
            case _:
                return self._rule(action)
        return ""

    def _rule(self, action: RuleAction) -> str:
        match action:
            case SetThreshold(piece, velocity):
                self._obey(f"threshold {word(piece)} {velocity}")
            case SetMask(piece, milliseconds):
                self._obey(f"mask {word(piece)} {milliseconds}")
            case SetShare(source, victim, share):
                self._obey(f"ghost {word(source)} {word(victim)} {share:.2f}")
            case SetCurve(piece, curve):
                self._obey(f"curve {word(piece)} {curve.softest} {curve.loudest} {curve.bend}")
            case HoldBack(suspicion):
                self._obey(rule_against(suspicion))
                self.seen.suspicions.clear()
            case RevertRules():
                self._monitor.trial(self.device, self._kept[self.device])
            case SaveRules():
                return f"kept in {self.save()}"
            case _:
                assert_never(action)
        return ""

    def _obey(self, order: str) -> None:
        self._monitor.trial(self.device, obey(self.kit, order))

    def save(self) -> Path:
        """Keep the rules, and let the engine take them; returns where. Raises `DeviceError` if the disk refuses.

        What was learnt before is kept with them, and not undone any more.
        """
        self.seen.before.clear()
        return self._keep(self.kit)
