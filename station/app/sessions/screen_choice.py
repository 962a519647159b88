"""A choice that stands large on the screen: the question before a result, or what comes after it."""

from dataclasses import dataclass

from station.app.actions.action import Action
from station.app.actions.practice_actions import Answer
from station.app.room_state import Stage
from station.app.sessions.current_practice import CurrentPractice
from station.core.pieces import Piece
from station.practice.session.self_estimate import PADS_OF, QUESTION


@dataclass(frozen=True, slots=True)
class Option:
    """What can be chosen: its `action`, `why` in a line, and the `pads` that choose it, none where no pad does."""

    label: str
    action: Action
    why: str = ""
    pads: frozenset[Piece] = frozenset()


@dataclass(frozen=True, slots=True)
class ScreenChoice:
    """Options, the best first where there is no `question`.

    Pads choose where `hears`, once nothing was struck for a second; `meant` is the option whose pad was struck just
    now, None for none. Two kicks take the first where `kicks`.
    """

    options: tuple[Option, ...]
    question: str = ""
    hears: bool = False
    meant: int | None = None
    kicks: bool = False


_QUESTION = ScreenChoice(tuple(Option(guess.value, Answer(guess), pads=PADS_OF[guess]) for guess in PADS_OF), QUESTION)


def choice_beside(practice: CurrentPractice) -> ScreenChoice | None:
    """What is to be chosen beside what is practised; None where nothing is."""
    is_open = practice.stage is Stage.RESULT and practice.last_result.is_asking
    return _QUESTION if is_open else None
