"""Rushed, dragged or on: what is asked, and what is said of the answer; by hand."""

import pytest

from station.core.pieces import Piece
from station.practice.session.self_estimate import PADS_OF, SelfEstimate, answered, is_worth_asking, typed_guess


def report(mean_ms: float | None = 0.0, strokes: int = 100, **session: bool) -> dict[str, object]:
    return {
        "session": {"complete": True, "click": True, **session},
        "timing": {"mean_signed_asynchrony_ms": mean_ms, "strokes": strokes},
    }


@pytest.mark.parametrize(
    ("guess", "mean_ms", "said"),
    [
        (SelfEstimate.RUSHED, -14.2, "You said rushed, and you were 14 ms early on average: your ear is right."),
        (SelfEstimate.RUSHED, 14.2, "You said rushed, and you were 14 ms late on average."),
        (SelfEstimate.DRAGGED, 22.0, "You said dragged, and you were 22 ms late on average: your ear is right."),
        (SelfEstimate.ON, -10.0, "You said on, and you were on the click on average: your ear is right."),
        (SelfEstimate.DRAGGED, 10.0, "You said dragged, and you were on the click on average."),
        (SelfEstimate.ON, 10.1, "You said on, and you were 10 ms late on average."),
    ],
)
def test_an_answer_is_held_against_the_mean(guess: SelfEstimate, mean_ms: float, said: str) -> None:
    assert answered(guess, report(mean_ms)) == said


def test_only_what_can_be_answered_is_asked() -> None:
    assert is_worth_asking(report(strokes=16))
    assert not is_worth_asking(report(strokes=15))
    assert not is_worth_asking(report(None, strokes=0))
    assert not is_worth_asking(report(complete=False))
    assert not is_worth_asking(report(click=False))


@pytest.mark.parametrize(
    ("line", "guess"),
    [
        ("r\n", SelfEstimate.RUSHED),
        ("D\n", SelfEstimate.DRAGGED),
        (" o \n", SelfEstimate.ON),
        ("on\n", SelfEstimate.ON),
        ("dragged\n", SelfEstimate.DRAGGED),
        ("\n", None),
        ("", None),
        ("x\n", None),
        ("rash\n", None),
    ],
)
def test_an_answer_can_be_typed(line: str, guess: SelfEstimate | None) -> None:
    assert typed_guess(line) is guess


def test_every_answer_has_a_pad() -> None:
    assert set(PADS_OF) == set(SelfEstimate)
    assert PADS_OF[SelfEstimate.ON] == {Piece.SNARE}
