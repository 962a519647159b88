"""Whole numbers as people and files write them."""

_MOST_DIGITS = 18
"""More count nothing (our choice), and Python reads no number of thousands of digits."""


def counted(count: int, noun: str) -> str:
    """The count and the noun: "1 flam", "2 buzzes"."""
    return f"{count} {noun}{'' if count == 1 else 'es' if noun.endswith('z') else 's'}"


def is_count(word: str) -> bool:
    """Whether `word` is a whole number from 0 on that `int` can read."""
    return word.isdecimal() and len(word) <= _MOST_DIGITS
