"""Values and keys as TOML writes them."""

import json
import re
from datetime import date

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def toml_value(value: object) -> str:
    """A truth, a text, a number, a day, a list of these, or a table in braces, as TOML.

    Raises `TypeError` for what TOML has no word for.
    """
    if isinstance(value, dict):
        return "{" + ", ".join(f"{toml_key(key)} = {toml_value(each)}" for key, each in value.items()) + "}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(toml_value, value))}]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return toml_text(value)
    if isinstance(value, date):
        return value.isoformat()
    if isinstance(value, int | float):
        return str(value)
    raise TypeError(f"TOML has no word for {value!r}")


def toml_text(text: str) -> str:
    """A quoted text, which may stand for a key as well."""
    # JSON's escapes are TOML's too, but TOML wants the delete character escaped as well
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def toml_key(key: str) -> str:
    """A key, quoted where it must be."""
    return key if _BARE.fullmatch(key) else toml_text(key)


def toml_prose(text: str) -> str:
    """A text of several rows between three quotes, each of its rows one of the file."""
    return '"""\n' + "\n".join(toml_text(row)[1:-1] for row in text.split("\n")) + '"""'
