"""What a person may have meant by a word that nobody knows: what to add to "no such …", always short enough to read."""

from collections.abc import Iterable
from difflib import get_close_matches

FEW = 12
"""So many names can be read at a glance (our choice)."""
_ALIKE = 0.6


def nearest_word(word: str, known: Iterable[str]) -> str:
    """The known word that looks most like `word`; empty if none does."""
    return next(iter(get_close_matches(word, list(known), 1, _ALIKE)), "")


def nearest(word: str, known: Iterable[str]) -> str:
    """The known word that looks most like `word`, as a question; empty if none does."""
    found = nearest_word(word, known)
    return f"; did you mean {found}?" if found else ""


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """The known word that looks most like `word`; where none does, all of them if they are few, else the nearest."""
    names = list(dict.fromkeys(known))
    if question := nearest(word, names):
        return question
    if len(names) > FEW:
        return f"; the nearest are {', '.join(get_close_matches(word, names, 3, 0.0))}"
    return f"; there {'is' if len(names) == 1 else 'are'} {', '.join(names)}"
