"""A recorded motion in the window: its phase, the sounds that it triggers, and how far it has been heard.

Files are read and tracked by a thread, for a long trial takes seconds. The sound goes through the engine, and the sound
card's clock says where in the motion it is.
"""

from collections.abc import Callable
from concurrent.futures import Executor, Future
from dataclasses import dataclass
from pathlib import Path
from typing import assert_never

from station.app.actions.phase_actions import ChooseTriggers, OpenMotion, PhaseAction, PlayMotion, SeekMotion
from station.core.errors import BadInput
from station.core.units import NS_PER_S, ns_from_s
from station.practice.session.cues.listening import Listening, cues_between
from station.scenes.phase_film import cues_of
from station.scenes.phase_view import WalkingScene, trace_of
from station.sync.phase.model_file import load_model
from station.sync.phase.periodic_model import PeriodicModel
from station.sync.signals.signal_files import read_signal
from station.sync.sonification.sonified import Sonified, sonified
from station.sync.sonification.trigger_table import PRESETS
from station.sync.walking.trial import Trial, gait_model

_MODEL_ENDING = ".toml"
_FIRST_PRESET = "walk"


@dataclass(frozen=True, slots=True)
class PhaseView:
    """What the page shows: the files' names, the preset of triggers, whether files are being read, and the `scene`.

    `at_s` is where in the motion it is, `plays` whether it goes on.
    """

    model: str = ""
    motion: str = ""
    preset: str = _FIRST_PRESET
    is_reading: bool = False
    scene: WalkingScene | None = None
    at_s: float = 0.0
    plays: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class _Opened:
    """A motion and the model it is tracked by."""

    model: PeriodicModel
    trial: Trial
    told: Sonified
    scene: WalkingScene


class PhasePage:
    """One motion. `hear` lets cues sound in place of what does, `is_heard` says whether they do, `quiet` ends them.

    Files are read by the `reader`.
    """

    def __init__(
        self,
        hear: Callable[[Listening], None],
        is_heard: Callable[[Listening], bool],
        quiet: Callable[[], None],
        reader: Executor,
    ) -> None:
        self._hear, self._is_heard, self._quiet = hear, is_heard, quiet
        self._reader = reader
        self._reading: Future[_Opened] | None = None
        self._names = "", ""
        self._preset = _FIRST_PRESET
        self._opened: _Opened | None = None
        self._listening: Listening | None = None
        self._at_s = 0.0

    # --- as time goes by ---------------------------------------------------------------------------------------------

    def advance(self, now_ns: int) -> None:
        """Take what was read, and move on with what is heard; raises `BadInput` for files that cannot be read."""
        if self._reading is not None and self._reading.done():
            reading, self._reading = self._reading, None
            self._take(reading.result())
        if self._listening is None:
            return
        at_ns = self._listening.at_ns(now_ns)
        if at_ns is not None:
            self._at_s = min(at_ns / NS_PER_S, self._span_s[1])
        if not self._is_heard(self._listening) or self._listening.is_over(now_ns):
            self._listening = None

    def view(self) -> PhaseView:
        """What is shown."""
        scene = None if self._opened is None else self._opened.scene
        plays = self._listening is not None
        return PhaseView(*self._names, self._preset, self._reading is not None, scene, self._at_s, plays)

    # --- what the user does ------------------------------------------------------------------------------------------

    def act(self, action: PhaseAction) -> None:
        """Do what the user asks; raises `StationError`."""
        match action:
            case OpenMotion(model, motion):
                self._open(model, motion)
            case ChooseTriggers(preset):
                self._choose(preset)
            case PlayMotion(on):
                self._play() if on else self._stop()
            case SeekMotion(to_s):
                self._seek(to_s)
            case _:
                assert_never(action)

    def close(self) -> None:
        """End the reader; what it reads is dropped."""
        self._reader.shutdown(wait=False, cancel_futures=True)

    def _open(self, model: Path, motion: Path) -> None:
        self._stop()
        self._names = model.name, motion.name
        preset = self._preset
        self._reading = self._reader.submit(lambda: _opened(_model(model), Trial.read(motion), motion.stem, preset))

    def _choose(self, preset: str) -> None:
        if preset not in PRESETS:
            raise BadInput("triggers", preset, "no such preset")
        self._stop()
        self._preset = preset
        if self._opened is not None:
            opened = self._opened
            self._opened = _opened(opened.model, opened.trial, opened.scene.trace.title, preset)

    def _take(self, opened: _Opened) -> None:
        self._opened = opened
        self._at_s = self._span_s[0]

    def _play(self) -> None:
        """From where it is, or from the beginning where it is at its end; raises `DeviceError`."""
        if self._opened is None or self._listening is not None:
            return
        start_s, end_s = self._span_s
        from_s = start_s if self._at_s >= end_s else self._at_s
        cues = cues_of(self._opened.told.hits, 0.0)
        begin_ns, end_ns = ns_from_s(from_s), ns_from_s(end_s)
        listening = Listening(cues_between(cues, begin_ns, end_ns), end_ns - begin_ns, begin_ns)
        self._hear(listening)
        self._listening, self._at_s = listening, from_s

    def _stop(self) -> None:
        if self._listening is not None:
            self._quiet()
            self._listening = None

    def _seek(self, to_s: float) -> None:
        self._stop()
        start_s, end_s = self._span_s
        self._at_s = min(max(to_s, start_s), end_s)

    @property
    def _span_s(self) -> tuple[float, float]:
        return (0.0, 0.0) if self._opened is None else self._opened.scene.trace.span_s


def _model(path: Path) -> PeriodicModel:
    """The model of a file, or of the first cycle of a motion."""
    return load_model(path) if path.suffix.lower() == _MODEL_ENDING else gait_model(read_signal(path))


def _opened(model: PeriodicModel, trial: Trial, title: str, preset: str) -> _Opened:
    triggers = PRESETS[preset]
    told = sonified(model, trial.signal, triggers)
    scene = WalkingScene.of(trial, trace_of(told, triggers, title, trial.steps))
    return _Opened(model, trial, told, scene)
