"""Somebody at a fake kit who battles: looks at the board, plays back what was called, and has an answer of their own.

They know what any player knows: what the drummer just played, the tempo, and when their bars begin.
"""

from collections.abc import Callable, Sequence

from station.app.sessions.battle_session import BattleSession
from station.devices.mapping.presets import GENERAL_MIDI_PRESET
from station.music.score import Score
from station.practice.battle.battle_view import BattleView, TurnView
from station.practice.battle.phrase import Phrase
from station.practice.battle.turn_plan import TurnKind
from station.simulation.student_spec import parse_spec
from station.simulation.virtual_student import VirtualStudent

Strokes = Sequence[tuple[int, bytes]]
Improvise = Callable[[BattleView, TurnView], Phrase]
"""What they improvise in a turn that is about to begin."""


class BattleStudent:
    """Plays as a virtual student of the `spec` does; `improvise` says what where nothing is to be repeated."""

    def __init__(self, spec: str, improvise: Improvise) -> None:
        self._spec, self._improvise = parse_spec(spec), improvise
        self._known: set[tuple[int, int]] = set()  # the transport's zero and the turn

    def strokes(self, battle: BattleSession) -> Strokes:
        """What they have just made up their mind to play, in session time."""
        view, zero_ns = battle.view(), battle.heard.zero_ns
        if view.at_ns is None or zero_ns is None:
            return ()
        begun_ns = zero_ns + battle.begins_ns  # as if output and kit were never late
        made: list[tuple[int, bytes]] = []
        for turn in view.turns:
            is_to_come = turn.start_ns >= view.at_ns and (zero_ns, turn.index) not in self._known
            if turn.kind is TurnKind.ANSWER and is_to_come:
                self._known.add((zero_ns, turn.index))
                made += [(begun_ns + turn.start_ns + at_ns, data) for at_ns, data in self._played(view, turn)]
        return made

    def _played(self, view: BattleView, turn: TurnView) -> Strokes:
        score: Score = (turn.phrase or self._improvise(view, turn)).score
        return VirtualStudent(self._spec, GENERAL_MIDI_PRESET).play(score).midi


def answer_of_the_call(view: BattleView, turn: TurnView) -> Phrase:
    """The phrase that the drummer has just played, in the student's own hands."""
    calls = [one.phrase for one in view.turns if one.index < turn.index and one.phrase is not None]
    assert calls, "the drummer begins"
    return calls[-1]
