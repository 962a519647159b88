"""The question before the result of a session in the terminal: did you rush or drag, or were you on the click."""

import sys
from collections.abc import Mapping

from station.cli.console import say
from station.practice.session.self_estimate import TYPED_QUESTION, answered, is_worth_asking, typed_guess


def ask_first(document: Mapping[str, object]) -> None:
    """Ask whoever sits at the terminal what he believes, and say how that was; nobody there, nothing asked."""
    if not (sys.stdin.isatty() and sys.stderr.isatty() and is_worth_asking(document)):
        return
    print(TYPED_QUESTION, end="", file=sys.stderr, flush=True)
    guess = typed_guess(sys.stdin.readline())
    if guess is not None:
        say(answered(guess, document))
