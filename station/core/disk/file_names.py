"""What files and folders may be called, on every system."""

import re
from hashlib import sha256
from unicodedata import normalize

_LONGEST = 80
"""Our choice: two such names and a date stay far below every file system's 255 bytes, even of four-byte letters."""
_RESERVED = {"CON", "PRN", "AUX", "NUL", *(f"{port}{n}" for port in ("COM", "LPT") for n in range(10))}
"""Names that Windows keeps for itself."""
_MARK_DIGITS = 8
"""Hexadecimal digits (our choice): of a thousand names that lose letters two share a mark once in 8,000 schools."""
_UNSAFE = re.compile(r"[^\w.-]+")


def folder_name(text: str) -> str:
    """`text` as a name that every file system takes."""
    name = _UNSAFE.sub("-", text).strip("-.")[:_LONGEST] or "unnamed"
    return f"{name}_" if name.split(".")[0].upper() in _RESERVED else name


def telling_name(text: str) -> str:
    """As `folder_name`, but texts that differ have names that differ, for a mark says which letters are lost.

    Texts that are alike (`alike`), or differ in blanks and hyphens, have names that are alike.
    """
    plain = "-".join(normalize("NFC", text).split())
    return plain if folder_name(plain) == plain else marked(folder_name(plain), text)


def marked(name: str, text: str) -> str:
    """A name with a short mark of the `text` that it stands for."""
    same = "-".join(alike(text).split())
    mark = sha256(same.encode("utf-8", "surrogatepass")).hexdigest()[:_MARK_DIGITS]
    return f"{name[: _LONGEST - _MARK_DIGITS - 1].rstrip('-.')}-{mark}"


def alike(name: str) -> str:
    """What two names share that a file system or a reader may take for one."""
    return normalize("NFKC", name).casefold()
