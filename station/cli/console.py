"""Printing for commands: JSON documents on standard output, words for people on standard error."""

import json
import sys


def print_json(document: object) -> None:
    """Print one JSON document; NaN never appears, for no data is null."""
    json.dump(document, sys.stdout, ensure_ascii=False, allow_nan=False, indent=2)
    sys.stdout.write("\n")


def say(text: str) -> None:
    """Tell the user something that is not the command's result."""
    print(text, file=sys.stderr, flush=True)


_TOLD = 5
"""So many warnings are told one by one (our choice)."""


def say_beyond(warnings: tuple[str, ...]) -> None:
    """Tell what the score asks that no human can play, the rest as a number."""
    for warning in warnings[:_TOLD]:
        say(f"beyond a human: {warning}")
    if len(warnings) > _TOLD:
        say(f"beyond a human: {len(warnings) - _TOLD} more such bars")
