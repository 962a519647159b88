"""Whole numbers as people and files write them."""

_MOST_DIGITS = 18
"""More count nothing (our choice), and Python reads no number of thousands of digits."""


def counted(count: int, noun: str) -> str:
    """The count and the noun: "1 flam", "2 buzzes"."""
    return f"{count} {noun}{'' if count == 1 else 'es' if noun.endswith('z') else 's'}"


def whole_minutes(seconds: float) -> int:
    """Seconds in whole minutes, half of one rounded up: what a time is called wherever minutes are told."""
    return int(seconds / 60 + 0.5)


def is_count(word: str) -> bool:
    """Whether `word` is a whole number from 0 on that `int` can read."""
    return word.isdecimal() and len(word) <= _MOST_DIGITS
