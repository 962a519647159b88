"""The text of a file that a person may have written: UTF-8, with or without the mark that some editors put first."""

from pathlib import Path

from station.core.errors import BadInput


def utf8_text(data: bytes, source: str | Path, expected: str) -> str:
    """`data` as text; raises `BadInput` that names the first line that is none and what was `expected` instead."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as fault:
        line = data[: fault.start].count(b"\n") + 1
        raise BadInput(source, f"line {line}", f"not UTF-8 text; expected {expected}, saved as UTF-8") from fault


def one_line(words: str) -> str:
    """`words` in one line without control characters, as a title is shown."""
    return " ".join("".join(c if c.isprintable() else " " for c in words).split())
