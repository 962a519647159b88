"""The click as light, where nothing is heard: what the engine was sent to click flashes when it would be heard.

So whatever clicks is seen: a session, a demonstration, a take, with its accents and with the bars in which it is
silent. A counted word flashes on its beat.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS
from station.engine.messages import (
    AddCues,
    Bus,
    ClickVoice,
    Command,
    EngineEvent,
    Play,
    Resume,
    Started,
    Stop,
)
from station.practice.session.cues.click_pattern import leads_ns

FLASH_NS = 140 * NS_PER_MS
"""So long a flash fades (our choice: two of them in a second at 240 clicks a minute are still apart)."""
_FIRST = (ClickVoice.ACCENT, ClickVoice.ONE)
_BETWEEN = (ClickVoice.SUBDIVISION, ClickVoice.E, ClickVoice.AND, ClickVoice.A)
_WEAK = 0.35
"""A click between the beats against one on them (our choice: seen apart at two metres)."""


@dataclass(frozen=True, slots=True)
class Flash:
    """How bright it is, 0 … 1, and whether it is an accent's."""

    strength: float = 0.0
    is_accent: bool = False


DARK = Flash()
_NO_TIMES = np.empty(0, np.int64)
_NO_VOICES = np.empty(0, np.uint8)


class ClickFlash:
    """Follows what an engine is sent and says."""

    def __init__(self) -> None:
        self._at_ns: NDArray[np.int64] = _NO_TIMES
        self._voices: NDArray[np.uint8] = _NO_VOICES
        self._zero_ns: int | None = None

    def sent(self, command: Command) -> None:
        """The engine was sent a command."""
        match command:
            case Play(cues):
                self._take(cues, None)
            case Resume(cues, zero_ns):
                self._take(cues, zero_ns)
            case AddCues(cues):
                self._add(cues)
            case Stop():
                self._zero_ns, self._at_ns = None, _NO_TIMES
            case _:
                pass

    def _take(self, cues: NDArray[np.void], zero_ns: int | None) -> None:
        self._zero_ns, self._at_ns, self._voices = zero_ns, _NO_TIMES, _NO_VOICES
        self._add(cues)

    def _add(self, cues: NDArray[np.void]) -> None:
        clicks = cues[(cues["bus"] == Bus.CLICK) & (cues["velocity"] > 0)]
        at_ns = np.concatenate([self._at_ns, clicks["at_ns"] + leads_ns(clicks)])
        voices = np.concatenate([self._voices, clicks["piece"]])
        order = np.argsort(at_ns, kind="stable")
        self._at_ns, self._voices = at_ns[order], voices[order]

    def handle(self, event: EngineEvent) -> None:
        """Take one event of the engine."""
        if isinstance(event, Started):
            self._zero_ns = event.zero_ns

    def at(self, now_ns: int) -> Flash:
        """What is seen at session time `now_ns`."""
        if self._zero_ns is None or not len(self._at_ns):
            return DARK
        at_ns = now_ns - self._zero_ns
        last = int(np.searchsorted(self._at_ns, at_ns, side="right")) - 1
        gone_ns = at_ns - int(self._at_ns[last]) if last >= 0 else FLASH_NS
        if gone_ns >= FLASH_NS:
            return DARK
        voice = int(self._voices[last])
        return Flash((1.0 - gone_ns / FLASH_NS) * (_WEAK if voice in _BETWEEN else 1.0), voice in _FIRST)
