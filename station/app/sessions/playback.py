"""What sounds between sessions: a take, a bar, the demonstration. One thing at a time, and no track with it."""

from collections.abc import Callable
from contextlib import suppress

from station.app.engine_client import EngineClient
from station.core.errors import DeviceError
from station.engine.messages import Command, EngineEvent, Play, SetBacking
from station.practice.session.cues.listening import Listening


class Playback:
    """The one thing that is heard now; `has_tracks` says whether a session may have played along to one."""

    def __init__(self, engine: EngineClient, has_tracks: Callable[[], bool]) -> None:
        self._engine, self._has_tracks = engine, has_tracks
        self._heard: Listening | None = None
        self._has_heard_track = False

    @property
    def hears(self) -> bool:
        """Whether something sounds that was played or is written."""
        return self._heard is not None

    def is_hearing(self, listening: Listening) -> bool:
        """Whether that is what sounds."""
        return self._heard is listening

    def hear(self, listening: Listening) -> None:
        """Let it sound in place of what does; raises `DeviceError`."""
        self.quiet()
        self.without_track()
        for command in listening.start():
            self._engine.send(command)
        self._heard = listening
        self._has_heard_track |= listening.track is not None

    def quiet(self) -> None:
        """End what is heard; a dead engine is quiet."""
        if self._heard is not None:
            with suppress(DeviceError):
                for command in self._heard.stop():
                    self._engine.send(command)
            self._heard = None

    def forget(self) -> None:
        """The engine has died, and what sounded with it."""
        self._heard = None

    def without_track(self) -> None:
        """Let no track sound with what comes, for one does whenever the transport runs; raises `DeviceError`."""
        if self._has_heard_track or self._has_tracks():
            self._engine.send(SetBacking(None))

    def demonstrate(self, command: Command) -> None:
        """Tell the engine what the demonstration needs; a dead one plays none, and has said so."""
        with suppress(DeviceError):
            if isinstance(command, Play):
                self.quiet()
                self.without_track()
            self._engine.send(command)

    def handle(self, event: EngineEvent) -> None:
        """Handle one event of the engine."""
        if self._heard is not None:
            self._heard.handle(event)

    def advance(self, now_ns: int) -> int | None:
        """Move on; returns the place in what is heard, None where nothing is."""
        if self._heard is not None and self._heard.is_over(now_ns):
            self._heard = None
        return None if self._heard is None else self._heard.at_ns(now_ns)
