"""The one typeface of all pictures: Roboto, read from the files that imgui-bundle installs for the window's panels."""

from enum import IntEnum
from functools import cache
from importlib.util import find_spec
from pathlib import Path

from station.core.errors import DeviceError
from station.render.text.truetype import TrueType


class Face(IntEnum):
    """The weights in use."""

    REGULAR = 0
    BOLD = 1


_FILES = {Face.REGULAR: "Roboto-Regular.ttf", Face.BOLD: "Roboto-Bold.ttf"}


def font_path(face: Face) -> Path:
    """Where the font file lies; raises `DeviceError` where imgui-bundle is missing or came without its fonts."""
    spec = find_spec("imgui_bundle")
    if spec is not None:
        for folder in spec.submodule_search_locations or ():
            path = Path(folder) / "assets" / "fonts" / "Roboto" / _FILES[face]
            if path.is_file():
                return path
    raise DeviceError(f"{_FILES[face]} was not found: install imgui-bundle, which brings it")


@cache
def font(face: Face) -> TrueType:
    """The face, read once a process."""
    return TrueType(font_path(face))
