"""Keys that are pressed at once."""

from imgui_bundle import imgui


def chord(*keys: imgui.Key) -> int:
    """These keys at once; a sum, for Python 3.11.2 cannot unite members of this enumeration."""
    return sum(key.value for key in keys)
