"""The sticks behind their page: what their sensors tell, which hand holds which, how they are mounted, the air kit.

The engine reads the sensors and knows how they are mounted from the user's files (`stick_file`); what is learnt here is
kept there, and the engine told to read it anew. Samples come only while something is learnt (`WatchSensors`).
"""

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, assert_never

from station.app.actions.equipment_actions import (
    FollowPhase,
    GiveUpSticks,
    LearnAir,
    LearnMounting,
    LookForSticks,
    PlayInAir,
    SetHand,
    SoundPhase,
    StickAction,
)
from station.app.equipment.sticks_view import Lesson, SeenStick, SticksView, view_of
from station.app.settings.settings_store import SettingsStore
from station.core.errors import DeviceError
from station.core.events import (
    PhaseEstimate,
    SensorLost,
    SensorMounted,
    SensorSamples,
    SensorStatus,
    StickPose,
    StickStroke,
)
from station.core.imu import ImuSample, Mounting
from station.core.pieces import Limb
from station.core.units import ns_from_s
from station.devices.mapping.stick_file import save_stick
from station.devices.stick_ports import parse_sticks
from station.engine.messages import Command, EngineEvent, ReloadDevice, SetAirDrums, WatchSensors
from station.sync.air.air_drums import AIR_AHEAD_NS
from station.sync.air.air_file import air_path, read_air, save_air
from station.sync.air.air_zones import AirKit

if TYPE_CHECKING:
    from station.app.equipment.air_learning import AirLearning
    from station.sync.strokes.mounting_gesture import GestureResult


@dataclass(frozen=True, slots=True)
class _Step:
    """One part of the gesture: what to do for so long; its samples count unless it is there to get ready."""

    lasts_s: float
    asks: str
    counts: bool = True


_GESTURE = (
    _Step(4.0, "Lay both sticks on the snare drum, tips ahead. It begins in a moment.", counts=False),
    _Step(2.5, "Let them lie still."),
    _Step(3.75, "Take up the right stick: four taps."),
    _Step(3.75, "Now the left stick: four taps."),
)
"""Ten seconds that count, as `sync.strokes.mounting_gesture` wants them, and time to put the hand from the mouse to the
sticks (our choice)."""


@dataclass(slots=True)
class _Gesture:
    """A gesture that is being made, and once it is over what is found in it."""

    begun_ns: int
    samples: dict[str, list[ImuSample]] = field(default_factory=dict)
    result: "Future[GestureResult] | None" = None

    def step(self, now_ns: int) -> _Step | None:
        """The part that `now_ns` is in, None when it is over."""
        end_ns = self.begun_ns
        for step in _GESTURE:
            end_ns += ns_from_s(step.lasts_s)
            if now_ns < end_ns:
                return step
        return None

    def done(self, now_ns: int) -> float:
        """How much of it is over, 0 … 1."""
        whole_ns = ns_from_s(sum(step.lasts_s for step in _GESTURE))
        return min(1.0, max(0.0, (now_ns - self.begun_ns) / whole_ns))


def _understood(samples: dict[str, list[ImuSample]], before: dict[str, Mounting]) -> "GestureResult":
    from station.sync.strokes.mounting_gesture import learn_mounting

    return learn_mounting(samples, before)


class SticksEditor:
    """The sticks of the settings `store`; `send` reaches the engine, and `anew` has it start by other settings.

    `folder` holds the user's files of sticks, `air` is the air kit's file; None for this user's, both.
    """

    def __init__(
        self,
        send: Callable[[Command], None],
        store: SettingsStore,
        anew: Callable[[], None] = lambda: None,
        folder: Path | None = None,
        air: Path | None = None,
    ) -> None:
        self._send, self._store, self._anew = send, store, anew
        self._folder, self._air_path = folder, air or air_path()
        self._seen: dict[str, SeenStick] = {}
        self._thread = ThreadPoolExecutor(1, "mounting gesture")
        self._gesture: _Gesture | None = None
        self._air: AirLearning | None = None
        self._learnt: tuple[str, ...] = ()
        self._phase: PhaseEstimate | None = None
        self._kit = AirKit(())
        self._now_ns = 0

    def begin(self) -> None:
        """Read the air kit, as the engine does; raises `StationError` where it cannot be."""
        self._kit = read_air(self._air_path)

    def _play_air(self) -> None:
        if self._store.now.air_drums:
            self._send(SetAirDrums(self._kit, AIR_AHEAD_NS))

    @property
    def learns(self) -> bool:
        """Whether strokes are taken for what they teach: they command nothing meanwhile."""
        return self._gesture is not None or self._air is not None

    @property
    def is_lively(self) -> bool:
        """Whether a stick is here, which may move at any moment."""
        return bool(self._seen)

    def view(self) -> SticksView:
        """What the page shows now."""
        settings = self._store.now
        return SticksView(
            tuple(view_of(device, seen, self._now_ns) for device, seen in sorted(self._seen.items())),
            self._lesson(),
            self._learnt,
            settings.air_drums,
            self._kit.zones,
            settings.follow_phase,
            settings.sound_phase,
            self._phase,
        )

    def _lesson(self) -> Lesson | None:
        if self._air is not None:
            return Lesson(self._air.asks, self._air.done)
        if self._gesture is None:
            return None
        step = self._gesture.step(self._now_ns)
        return Lesson("One moment." if step is None else step.asks, self._gesture.done(self._now_ns))

    # --- from the engine ---------------------------------------------------------------------------------------------

    def handle(self, event: EngineEvent) -> None:
        """What the engine says."""
        match event:
            case SensorMounted(at_ns, device, mounting):
                self._seen[device] = SeenStick(mounting, at_ns)
            case SensorLost(_, device):
                self._lost(device)
            case SensorStatus(at_ns, device):
                seen = self._seen.setdefault(device, SeenStick())
                seen.status, seen.heard_ns = event, at_ns
            case StickPose(at_ns, device):
                seen = self._seen.setdefault(device, SeenStick())
                seen.heard_ns = at_ns
                seen.hold(event)
            case StickStroke(device=device):
                self._seen.setdefault(device, SeenStick()).strokes.append(event)
            case PhaseEstimate():
                self._phase = event
            case SensorSamples():
                self._measured(event)
            case _:
                pass

    def _lost(self, device: str) -> None:
        self._seen.pop(device, None)
        if self.learns:
            self.give_up()
            self._learnt = (f"{device} went away: nothing was learnt",)

    def _measured(self, event: SensorSamples) -> None:
        if self._air is not None:
            self._air.feed(event)
        elif self._gesture is not None:
            step = self._gesture.step(event.at_ns)
            if step is not None and step.counts:
                self._gesture.samples.setdefault(event.device, []).extend(event.samples)

    def advance(self, now_ns: int) -> None:
        """The time: what is complete is learnt and kept. Raises `DeviceError` if the disk or the engine refuses."""
        self._now_ns = now_ns
        if self._gesture is not None and self._gesture.step(now_ns) is None:
            self._learn_mountings(self._gesture)
        elif self._air is not None and self._air.is_over:
            self._keep_air(self._air)

    # --- what the user does ------------------------------------------------------------------------------------------

    def act(self, action: StickAction) -> None:
        """Do what the user asks; raises `StationError` where it cannot be done."""
        match action:
            case LookForSticks(ports):
                self._look(ports)
            case SetHand(device, limb):
                self._set_hand(device, limb)
            case LearnMounting():
                self._listen()
                self._gesture = _Gesture(self._now_ns)
            case LearnAir():
                self._learn_air()
            case GiveUpSticks():
                self.give_up()
            case PlayInAir(on):
                self._store.update(lambda settings: replace(settings, air_drums=on))
                self._send(SetAirDrums(self._kit, AIR_AHEAD_NS) if on else SetAirDrums(None))
            case FollowPhase(on):
                self._store.update(lambda settings: replace(settings, follow_phase=on))
            case SoundPhase(on):
                self._store.update(lambda settings: replace(settings, sound_phase=on))
            case _:
                assert_never(action)

    def give_up(self) -> None:
        """Learn no longer; what was done meanwhile changes nothing."""
        if not self.learns:
            return
        was_air = self._air is not None
        self._gesture = self._air = None
        with suppress(DeviceError):  # a dead engine tells no samples
            self._send(WatchSensors(on=False))
            if was_air:
                self._play_air()

    def _look(self, ports: str) -> None:
        """Raises `BadInput` for ports that cannot be meant, `DeviceError` while somebody plays."""
        parse_sticks(ports)
        self.give_up()
        before = self._store.now.sticks
        self._store.update(lambda settings: replace(settings, sticks=ports.strip()))
        try:
            self._anew()
        except DeviceError:
            self._store.update(lambda settings: replace(settings, sticks=before))
            raise
        self._seen.clear()

    def _listen(self) -> None:
        """Have the samples told; raises `DeviceError` where there is nobody to tell them."""
        if not self._seen:
            raise DeviceError("no sensor is here: there is nothing to learn from")
        self.give_up()
        self._learnt = ()
        self._send(WatchSensors(on=True))

    def _set_hand(self, device: str, limb: Limb) -> None:
        """The stick is in that hand; one that was there is in the other one now."""
        before = self._seen[device].mounting.limb
        for other, seen in self._seen.items():
            if other != device and seen.mounting.limb is limb:
                self._keep(other, before)
        self._keep(device, limb)

    def _keep(self, device: str, limb: Limb) -> None:
        seen = self._seen[device]
        seen.mounting = replace(seen.mounting, limb=limb)
        save_stick(seen.mounting, device, self._folder)
        self._send(ReloadDevice(device))

    def _learn_mountings(self, gesture: _Gesture) -> None:
        """Have the gesture understood in a thread, for that takes seconds of a fast sensor; then keep what it shows."""
        if gesture.result is None:
            before = {device: seen.mounting for device, seen in self._seen.items()}
            gesture.result = self._thread.submit(_understood, gesture.samples, before)
        elif gesture.result.done():
            self.give_up()
            self._keep_mountings(gesture.result.result())

    def _keep_mountings(self, result: "GestureResult") -> None:
        shown = {device: mounting for device, mounting in result.mountings.items() if mounting.learnt}
        silent = [f"{device}: nothing came from it" for device in self._seen if device not in result.mountings]
        for device, mounting in shown.items():
            seen = self._seen[device]
            seen.mounting = mounting if mounting.limb.is_hand else replace(mounting, limb=seen.mounting.limb)
            save_stick(seen.mounting, device, self._folder)
            self._send(ReloadDevice(device))
        self._learnt = (*(f"{device} is learnt and kept" for device in shown), *result.faults, *silent)

    def _learn_air(self) -> None:
        from station.app.equipment.air_learning import AirLearning

        learning = AirLearning({device: seen.mounting for device, seen in self._seen.items()})
        if self._seen and learning.is_over:
            raise DeviceError("say first which hand holds which stick: make the mounting gesture, or choose")
        self._listen()
        self._send(SetAirDrums(None))
        self._air = learning

    def _keep_air(self, learning: "AirLearning") -> None:
        from station.app.equipment.air_learning import close_in_words

        learnt = learning.learnt()
        save_air(learnt.kit, self._air_path)
        self._kit = learnt.kit
        self._learnt = (f"{len(learnt.kit.zones)} zones are learnt and kept", *map(close_in_words, learnt.close))
        self.give_up()
