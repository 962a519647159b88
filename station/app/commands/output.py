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
