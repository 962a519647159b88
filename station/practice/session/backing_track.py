"""The track that a session plays along to: asked for once, made ready for the card's rate and the session's tempo.

A song brings its own: the bars that are practised, looped as they are. Making a track ready takes seconds and happens
in a process of its own; a session begins when it is done.
"""

from concurrent.futures import Future
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from pathlib import Path

from station.core.errors import BadInput, DeviceError
from station.core.settings import Settings
from station.music.score import Score
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

LEAD_S, RING_S = 1.0, 4.0
"""So much of a song is made ready before the bars that are practised, for the seam of a loop, and after them, where
what is played once rings out (our choice)."""


@dataclass(frozen=True, slots=True)
class BackingRequest:
    """A sound file, from where in it, which part of it again and again, and how fast; times in seconds of the file.

    With `speed` None it follows the tempo: a lesson practised at 80 % of its own tempo has its track at 80 %; where the
    file's own tempo `beats_a_minute` is known, that decides. `beside`, `piece_s`, `softer` and `turns` are a
    `TrackRequest`'s.
    """

    path: Path
    start_s: float = 0.0
    loop_s: tuple[float, float] | None = None
    speed: float | None = None
    beside: tuple[Path, ...] = ()
    piece_s: tuple[float, float] | None = None
    softer: tuple[tuple[float, int], ...] = ()
    turns: int | None = None
    beats_a_minute: float | None = None

    def track(self, plan: Plan, rate_hz: int) -> TrackRequest:
        """What is to be made ready for `plan`; raises `BadInput` for a speed that no stretching reaches."""
        speed = self._speed(plan)
        if not MIN_SPEED <= speed <= MAX_SPEED:
            limits = f"expected {MIN_SPEED:.0%} to {MAX_SPEED:.0%} of its own speed, found {speed:.0%}"
            raise BadInput(self.path, "speed", limits)
        return TrackRequest(
            self.path, rate_hz, speed, self.start_s, self.loop_s, self.beside, self.piece_s, self.softer, self.turns
        )

    def _speed(self, plan: Plan) -> float:
        if self.speed is not None:
            return self.speed
        if self.beats_a_minute is not None:
            return plan.beats_a_minute / self.beats_a_minute
        return plan.tempo_bpm / plan.lesson.tempo_bpm

    def check(self, plan: Plan, rate_hz: int) -> None:
        """Raise `BadInput` for what could never be made ready, as far as the head of its file tells."""
        file_length_s(self.path)  # one that is not there has no speed either
        checked_length_s(self.track(plan, rate_hz))


def track_request(settings: Settings) -> BackingRequest | None:
    """The track that a user's sessions play along to; None where there is none, or they shall not."""
    if not (settings.track and settings.with_track):
        return None
    speed = None if settings.track_stretched else 1.0
    path = Path(settings.track).expanduser()
    return BackingRequest(path, settings.track_start_s, speed=speed, beats_a_minute=settings.track_bpm or None)


def song_request(plan: Plan, with_drums: bool = True) -> BackingRequest | None:
    """The bars of the song that `plan` practises, again and again where they are; None where it is no song.

    Without drums their stems are left out; of a mix its drums, where the part has strokes, are turned down.
    """
    band, written = plan.lesson.band, plan.lesson.score.tempo_map
    if band is None:
        return None
    start_tick = written.bar_start(plan.first_bar)
    start_s, end_s = (band.start_s + written.seconds_at([start_tick, start_tick + plan.section.end_tick])).tolist()
    path, *beside = band.files(with_drums) or band.drums
    loop_s = (start_s, end_s) if plan.passes > 1 else None
    piece_s = start_s - LEAD_S, end_s + RING_S
    softer = () if with_drums or band.drums else _strokes(plan.lesson.score, band.start_s, piece_s)
    turns = plan.passes if loop_s else None
    return BackingRequest(path, start_s, loop_s, None, tuple(beside), piece_s, softer, turns)


def _strokes(score: Score, start_s: float, piece_s: tuple[float, float]) -> tuple[tuple[float, int], ...]:
    """Seconds of the sound, and pieces, of the strokes of `score` in the piece; tick 0 lies at `start_s`."""
    at_s = start_s + score.onset_s
    inside = (at_s >= piece_s[0]) & (at_s < piece_s[1])
    return tuple(zip(at_s[inside].tolist(), score.notes["piece"][inside].tolist(), strict=True))


class Backing:
    """Keeps the track ready that was asked for last: the `request`, else the song's own."""

    def __init__(self, request: BackingRequest | None = None) -> None:
        self._request = request
        self._asked: TrackRequest | None = None
        self._future: Future[PreparedTrack] | None = None

    def ask(self, plan: Plan, rate_hz: int, with_drums: bool = True, otherwise: BackingRequest | None = None) -> None:
        """Begin to make the track ready for `plan`, unless it is so already; raises `BadInput`.

        `otherwise` is for what brings none.
        """
        wanted = self._request or song_request(plan, with_drums) or otherwise
        assert wanted is not None, "it is asked for where there is one"
        request = wanted.track(plan, rate_hz)
        if request != self._asked:
            self._asked, self._future = request, prepare_in_background(request)

    def ready(self, wait_s: float | None = 0.0) -> PreparedTrack | None:
        """The track that was asked for, None while it is not ready within `wait_s` (None: however long it takes).

        Raises `BadInput` for the file's fault, `DeviceError` for the disk's.
        """
        assert self._future is not None, "a track is asked for before it is waited for"
        assert self._asked is not None
        try:
            return self._future.result(wait_s)
        except TimeoutError:
            return None
        except BrokenProcessPool as fault:
            raise DeviceError(f"{self._asked.path}: the track could not be made ready: {fault}") from fault
