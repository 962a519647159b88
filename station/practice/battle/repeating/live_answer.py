"""What is said of an answer while it is played: the station's live judgement, stroke by stroke."""

from collections.abc import Sequence
from dataclasses import replace

from station.core.events import Hit
from station.music.judgement import Judgement
from station.practice.battle.phrase import Phrase
from station.practice.session.judging import Judging


class LiveAnswer:
    """One answer to `phrase`, which began at `start_ns` of the battle."""

    def __init__(self, phrase: Phrase, start_ns: int) -> None:
        self._start_ns = start_ns
        self._judging = Judging(phrase.with_landing, clocked=True)

    def hit(self, stroke: Hit) -> None:
        """Take a stroke, in battle time."""
        self._judging.hit(replace(stroke, at_ns=stroke.at_ns - self._start_ns))

    def advance(self, battle_ns: int) -> None:
        """Tell the battle time: what can no longer be played is missed."""
        self._judging.advance(battle_ns - self._start_ns)

    @property
    def played(self) -> Sequence[Hit]:
        """The strokes so far in turn time, in the order in which they came."""
        return tuple(self._judging.hits)

    @property
    def judged(self) -> tuple[Judgement, ...]:
        """The newest verdict on each note that has one, then those on strokes that answer none."""
        lone = (self._judging.of_hit[hit] for hit in self._judging.extras())
        return (*self._judging.of_note.values(), *lone)
