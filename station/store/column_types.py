"""Columns that take the same values on SQLite and on PostgreSQL: the one place where what comes in is made to fit.

Each has a mind of its own: PostgreSQL refuses NUL, half a surrogate pair, a longer text than a column's and a larger
number than its own, and sorts as its server's country does; SQLite turns NaN into NULL. Here each does as the other.
"""

import math
import re
from typing import Any

from sqlalchemy import Dialect, Float, Integer, String, Text
from sqlalchemy.types import TypeDecorator, TypeEngine

_UNKEPT = re.compile("[\0\ud800-\udfff]")
"""Characters that stand in no UTF-8 text of PostgreSQL's."""
_LARGEST = 2**31
"""PostgreSQL's `integer` ends here."""


class Words(TypeDecorator[str]):
    """A text of `length` characters at most (None: any), in the order of its characters' numbers.

    U+FFFD stands for what no database holds; what is longer is cut.
    """

    impl = String
    kind: type[String] = String
    cache_ok = True

    def __init__(self, length: int | None = None) -> None:
        super().__init__(length)
        self.length = length

    def load_dialect_impl(self, dialect: Dialect) -> TypeEngine[Any]:
        """As SQLite sorts, PostgreSQL does, wherever its server stands."""
        return self.kind(self.length, collation="C" if dialect.name == "postgresql" else None)

    def process_bind_param(self, value: str | None, dialect: Dialect) -> str | None:
        """The text as both hold it."""
        return None if value is None else _UNKEPT.sub("\ufffd", value)[: self.length]


class LongWords(Words):
    """A text of any length."""

    impl = Text
    kind = Text
    cache_ok = True


class Number(TypeDecorator[int]):
    """A whole number of 32 bits; a larger one raises `ValueError`."""

    impl = Integer
    cache_ok = True

    def process_bind_param(self, value: int | None, dialect: Dialect) -> int | None:
        """The number, as it is."""
        if value is not None and not -_LARGEST <= value < _LARGEST:
            raise ValueError(f"{value} is too large a number")
        return value


class Real(TypeDecorator[float]):
    """A number of 64 bits; NaN and infinity are no data."""

    impl = Float
    cache_ok = True

    def process_bind_param(self, value: float | None, dialect: Dialect) -> float | None:
        """The number, None where it is none."""
        return None if value is None or not math.isfinite(value) else value
