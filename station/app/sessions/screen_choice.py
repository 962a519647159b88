"""A choice that stands large on the screen: the question before a result, whose a lag is, or what comes after it."""

from collections.abc import Collection
from dataclasses import dataclass

from station.app.actions.action import Action
from station.app.actions.equipment_actions import AnswerLag
from station.app.actions.practice_actions import Answer, TakeStep
from station.app.sessions.current_practice import CurrentPractice
from station.core.pieces import Piece
from station.practice.control.pad_choice import pads_for
from station.practice.session.self_estimate import PADS_OF, QUESTION, SelfEstimate


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


_MEANS = {
    SelfEstimate.RUSHED: "ahead of the click",
    SelfEstimate.ON: "with the click",
    SelfEstimate.DRAGGED: "behind the click",
}
_ANSWERS = tuple(
    Option(guess.value.capitalize(), Answer(guess), _MEANS[guess], pads) for guess, pads in PADS_OF.items()
)
_QUESTION = ScreenChoice(_ANSWERS, QUESTION)


def choice_beside(practice: CurrentPractice, kit_starts: bool) -> ScreenChoice | None:
    """What is to be chosen beside what is practised, None where nothing is; `kit_starts` where strokes may begin it."""
    if not practice.shows_result:
        return None
    if practice.last_result.is_asking:
        return _QUESTION
    steps = practice.last_result.steps
    there = frozenset(practice.session.plan.kit.pieces) if kit_starts else frozenset[Piece]()
    if practice.lag_ms is not None:
        return _whose_lag(practice.lag_ms, there)
    options = zip(steps, pads_for(len(steps), there), strict=True)
    made = tuple(Option(step.label, TakeStep(place), step.why, pads) for place, (step, pads) in enumerate(options))
    return ScreenChoice(made, kicks=kit_starts) if made else None


def _whose_lag(lag_ms: float, there: Collection[Piece]) -> ScreenChoice:
    """Whose a lag of all strokes is, as the student says; two kicks say nothing, for they mean to play."""
    out, left = pads_for(2, there)
    late = "My headphones, sound card or kit are late"
    return ScreenChoice(
        (
            Option(
                f"Take out {abs(lag_ms):.0f} ms",
                AnswerLag(take_out=True),
                late if lag_ms > 0 else "My equipment is quicker than the station believes",
                out,
            ),
            Option("Leave it in", AnswerLag(take_out=False), "It is how I play: it counts", left),
        )
    )
