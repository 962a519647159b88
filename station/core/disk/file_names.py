"""What files and folders may be called, on every system."""

import re
from unicodedata import normalize

_LONGEST = 80
"""Our choice: two such names and a date stay far below every file system's 255 bytes, even of four-byte letters."""
_RESERVED = {"CON", "PRN", "AUX", "NUL", *(f"{port}{n}" for port in ("COM", "LPT") for n in range(10))}
"""Names that Windows keeps for itself."""
_UNSAFE = re.compile(r"[^\w.-]+")


def folder_name(text: str) -> str:
    """`text` as a name that every file system takes."""
    name = _UNSAFE.sub("-", text).strip("-.")[:_LONGEST] or "unnamed"
    return f"{name}_" if name.split(".")[0].upper() in _RESERVED else name


def alike(name: str) -> str:
    """What two names share that a file system or a reader may take for one."""
    return normalize("NFKC", name).casefold()
