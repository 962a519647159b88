"""All that the kit and its foot switches may command, as the settings ask for it.

Two pads at once or a switch pause and go on, two kicks go on, and start what is quiet.
"""

from collections.abc import Sequence

from station.core.events import Hit, Switched
from station.core.settings import Settings, setting_source
from station.engine.messages import EngineEvent
from station.music.score import Score
from station.practice.control.pad_gestures import FootSwitch, PadsTogether, TwoKicks
from station.practice.control.pause_options import parse_pause


class PadCommands:
    """Hand it every event that may command something; raises `BadInput` for a pause in `settings` that is none."""

    def __init__(self, settings: Settings, score: Score) -> None:
        self._pause = parse_pause(settings.pause, setting_source("pause"))
        self._kicks_start = settings.kicks_start
        self._foot = FootSwitch(self._pause.switches)
        self._score: Score | None = None
        self._kicks, self._pad_pairs = TwoKicks(), PadsTogether((), score)
        self.practise(score)

    def practise(self, score: Score) -> None:
        """From now on `score` is played: what it asks for commands nothing."""
        if score is self._score:
            return
        self._score = score
        self._kicks.forget()
        self._pad_pairs = PadsTogether(self._pause.pairs, score)

    def forget(self) -> None:
        """What was struck so far means nothing."""
        self._kicks.forget()
        self._pad_pairs.forget()

    def starts(self, event: EngineEvent) -> bool:
        """Whether two kicks were complete before `event`; hand it every one, for they must stand alone."""
        return isinstance(event, Hit) and self._kicks.feed(event) and self._kicks_start

    def starts_by(self, now_ns: int) -> bool:
        """Whether two kicks are complete at `now_ns`."""
        return self._kicks.advance(now_ns) and self._kicks_start

    def pauses(self, event: EngineEvent) -> Sequence[Hit] | None:
        """The strokes that ask for a pause, none where a switch does; None where nothing does."""
        if isinstance(event, Switched):
            return () if self._foot.feed(event) else None
        return (self._pad_pairs.feed(event) or None) if isinstance(event, Hit) else None

    def asks(self, event: EngineEvent, score: Score, is_paused: bool) -> Sequence[Hit] | None:
        """The strokes with which `event` asks a session of `score` to pause or go on; None where it asks nothing."""
        self.practise(score)
        asked = () if self.starts(event) and is_paused else self.pauses(event)
        if asked is not None:
            self.forget()
        return asked


def ways_to_go_on(settings: Settings) -> tuple[str, ...]:
    """What ends a pause from the kit, in words; empty where nothing does."""
    return (*(["two kicks"] if settings.kicks_start else []), *settings.pause.split())
