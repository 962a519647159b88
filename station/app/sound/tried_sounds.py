"""A drum kit or a click's voice that is heard to try it: sent to the engine, played when it is there, taken back.

While the demonstration plays it goes on, by what is tried. Nothing is tried while somebody plays.
"""

from collections.abc import Callable
from contextlib import suppress

from station.app.engine_client import EngineClient
from station.app.sessions.session_control import SessionControl
from station.core.errors import DeviceError
from station.engine.messages import EngineEvent, SetSounds, SoundsSet
from station.practice.session.cues.listening import Listening


class TriedSounds:
    """What is tried now, in place of what `chosen` says."""

    def __init__(self, engine: EngineClient, sessions: SessionControl, chosen: Callable[[], SetSounds]) -> None:
        self._engine, self._sessions, self._chosen = engine, sessions, chosen
        self.name = ""
        """What is tried, empty for nothing."""
        self._asked: SetSounds | None = None  # what the engine was asked for last, None for what is chosen
        self._listening: Listening | None = None
        self._is_heard = False

    @property
    def is_awaited(self) -> bool:
        """Whether what is tried is still being read."""
        return self._listening is not None and not self._is_heard and not self._sessions.player.player.playing

    def hear(self, name: str, sounds: SetSounds, listening: Listening) -> None:
        """Try these sounds by letting something be heard; raises `DeviceError`."""
        if self._sessions.practice.is_playing:
            return
        self._quiet()
        self.name, self._listening = name, listening
        if sounds == (self._asked or self._chosen()):
            self._play()
        else:
            self._asked = sounds
            self._engine.send(sounds)

    def stop(self) -> None:
        """Hear no more of it; what is chosen sounds again."""
        self._quiet()
        self._take_back()

    def chose(self, sounds: SetSounds) -> None:
        """What is tried is chosen from now on, and goes on being heard."""
        if self._asked is not None and self._asked != sounds:
            self._quiet()
        self._asked = None

    def handle(self, event: EngineEvent) -> str | None:
        """Take one event; returns why sounds cannot be had."""
        if not isinstance(event, SoundsSet):
            return None
        is_wanted = SetSounds(event.drums, event.click) == (self._asked or self._chosen())
        if is_wanted and event.fault is not None:
            self._listening, self._asked = None, None
            return event.fault
        if is_wanted and self._listening is not None and not self._is_heard:
            with suppress(DeviceError):  # a session has begun meanwhile
                self._play()
        return None

    def advance(self) -> None:
        """Move on: whoever plays hears what is chosen."""
        if self._sessions.practice.is_playing and self.name:
            self._listening = None
            self._take_back()
        elif self._is_heard and self._listening is not None and not self._sessions.is_listening_to(self._listening):
            self._listening, self._is_heard = None, False

    def _play(self) -> None:
        if self._listening is not None and not self._sessions.player.player.playing:
            self._sessions.listen_to(self._listening)
            self._is_heard = True

    def _quiet(self) -> None:
        if self._is_heard and self._listening is not None and self._sessions.is_listening_to(self._listening):
            self._sessions.quiet()
        self._listening, self._is_heard = None, False

    def _take_back(self) -> None:
        self.name = ""
        if self._asked is not None:
            self._asked = None
            with suppress(DeviceError):  # a dead engine is told when it wakes
                self._engine.send(self._chosen())
