"""The track that a session plays along to: asked for once, made ready for the card's rate and the session's tempo.

Making it ready takes seconds and happens in a process of its own; a session begins when it is done.
"""

from concurrent.futures import Future
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from pathlib import Path

from station.core.errors import BadInput, DeviceError
from station.practice.session.plan import Plan
from station.sound.track import PreparedTrack
from station.sound.track_file import (
    MAX_SPEED,
    MIN_SPEED,
    TrackRequest,
    checked_length_s,
    file_length_s,
    prepare_in_background,
)


@dataclass(frozen=True, slots=True)
class BackingRequest:
    """A sound file, from where in it, which part of it again and again, and how fast; times in seconds of the file.

    With `speed` None it follows the tempo: a lesson practised at 80 % of its own tempo has its track at 80 %.
    """

    path: Path
    start_s: float = 0.0
    loop_s: tuple[float, float] | None = None
    speed: float | None = None

    def track(self, plan: Plan, rate_hz: int) -> TrackRequest:
        """What is to be made ready for `plan`; raises `BadInput` for a speed that no stretching reaches."""
        speed = plan.tempo_bpm / plan.lesson.tempo_bpm if self.speed is None else self.speed
        if not MIN_SPEED <= speed <= MAX_SPEED:
            limits = f"expected {MIN_SPEED:.0%} to {MAX_SPEED:.0%} of its own speed, found {speed:.0%}"
            raise BadInput(self.path, "speed", limits)
        return TrackRequest(self.path, rate_hz, speed, self.start_s, self.loop_s)

    def check(self, plan: Plan, rate_hz: int) -> None:
        """Raise `BadInput` for what could never be made ready, as far as the head of its file tells."""
        file_length_s(self.path)  # one that is not there has no speed either
        checked_length_s(self.track(plan, rate_hz))


class Backing:
    """Keeps the track ready that was asked for last."""

    def __init__(self, request: BackingRequest) -> None:
        self._request = request
        self._asked: TrackRequest | None = None
        self._future: Future[PreparedTrack] | None = None

    def ask(self, plan: Plan, rate_hz: int) -> None:
        """Begin to make the track ready for `plan`, unless it is so already; raises `BadInput`."""
        request = self._request.track(plan, rate_hz)
        if request != self._asked:
            self._asked, self._future = request, prepare_in_background(request)

    def ready(self, wait_s: float | None = 0.0) -> PreparedTrack | None:
        """The track that was asked for, None while it is not ready within `wait_s` (None: however long it takes).

        Raises `BadInput` for the file's fault, `DeviceError` for the disk's.
        """
        assert self._future is not None, "a track is asked for before it is waited for"
        try:
            return self._future.result(wait_s)
        except TimeoutError:
            return None
        except BrokenProcessPool as fault:
            raise DeviceError(f"{self._request.path}: the track could not be made ready: {fault}") from fault
