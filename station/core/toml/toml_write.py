"""Values and keys as TOML writes them."""

import json
from datetime import date


def toml_value(value: object) -> str:
    """A truth, a text, a number, a day, or a list of these as TOML."""
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(toml_value, value))}]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return toml_text(value)
    if isinstance(value, date):
        return value.isoformat()
    return str(value)


def toml_text(text: str) -> str:
    """A quoted text, which may stand for a key as well."""
    # JSON's escapes are TOML's too, but TOML wants the delete character escaped as well
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
