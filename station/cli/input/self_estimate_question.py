"""The question before the result of a session in the terminal: did you rush or drag, or were you on the click."""

from collections.abc import Mapping

from station.cli.console import ask, is_attended, say
from station.practice.session.self_estimate import TYPED_QUESTION, answered, is_worth_asking, typed_guess


def ask_first(document: Mapping[str, object]) -> None:
    """Ask whoever sits at the terminal what they believe, and say how that was; nobody there, nothing asked."""
    if not (is_attended() and is_worth_asking(document)):
        return
    guess = typed_guess(ask(TYPED_QUESTION))
    if guess is not None:
        say(answered(guess, document))
