"""The drum kit and the click that sound, read beside the sound: asked for by name, taken over when they are ready.

Reading takes a tenth of a second for a kit that was made before, seconds for one that is made or has many recordings.
It happens in a thread of its own, and with the short turns that the interpreter's lock has here no block of sound waits
for it. Of requests that come meanwhile the last one counts.
"""

import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from station.core.errors import StationError
from station.engine.messages import SetSounds
from station.sound.buses import ClickVoice
from station.sound.drum_kit import DrumKit, Frames

ReadKit = Callable[[str, int], DrumKit]
ReadClicks = Callable[[str, int], Mapping[ClickVoice, Frames]]


@dataclass(frozen=True, slots=True, eq=False)
class ReadSounds:
    """What was asked for, for a card's rate: kit and clicks, None where `fault` says why they cannot be had."""

    asked: SetSounds
    rate_hz: int
    kit: DrumKit | None = None
    clicks: Mapping[ClickVoice, Frames] | None = None
    fault: str | None = None


class SoundLoader:
    """Reads what is asked for by `read_kit` and `read_clicks`; `now` is what sounds, or will with the next card."""

    def __init__(self, now: SetSounds, read_kit: ReadKit, read_clicks: ReadClicks) -> None:
        self.now = now
        self._read_kit, self._read_clicks = read_kit, read_clicks
        self._next: SetSounds | None = None
        self._thread: threading.Thread | None = None
        self._read: ReadSounds | None = None

    def ask(self, sounds: SetSounds) -> None:
        """Read these, in place of what was asked for before and is not being read yet."""
        self._next = sounds

    def advance(self, rate_hz: int | None) -> ReadSounds | None:
        """What has been read since the last call, if it is still wanted; `rate_hz` is the card's, None without one.

        Without a card nothing is read: what was asked for is `now`, and the next card's.
        """
        read = self._take()
        if read is not None and read.fault is None:
            self.now = read.asked
        if self._thread is None and self._next is not None:
            asked, self._next = self._next, None
            if rate_hz is None:
                self.now = asked
                return ReadSounds(asked, 0)
            self._thread = threading.Thread(target=self._run, args=(asked, rate_hz), name="sounds", daemon=True)
            self._thread.start()
        return read

    def _take(self) -> ReadSounds | None:
        if self._thread is None or self._thread.is_alive():
            return None
        self._thread = None
        read, self._read = self._read, None
        return None if self._next is not None else read

    def _run(self, asked: SetSounds, rate_hz: int) -> None:
        try:
            kit, clicks = self._read_kit(asked.drums, rate_hz), self._read_clicks(asked.click, rate_hz)
        except StationError as fault:
            self._read = ReadSounds(asked, rate_hz, fault=str(fault))
        except (MemoryError, OSError) as fault:
            self._read = ReadSounds(asked, rate_hz, fault=f"{asked.drums}: cannot be read: {fault}")
        else:
            self._read = ReadSounds(asked, rate_hz, kit, clicks)
