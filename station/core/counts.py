"""Whole numbers as people and files write them."""

_MOST_DIGITS = 18
"""More count nothing (our choice), and Python reads no number of thousands of digits."""


def is_count(word: str) -> bool:
    """Whether `word` is a whole number from 0 on that `int` can read."""
    return word.isdecimal() and len(word) <= _MOST_DIGITS
