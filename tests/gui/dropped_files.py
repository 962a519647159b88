"""Drops files on the window that is open, as GLFW does: it calls what the program has set for that."""

from collections.abc import Sequence
from ctypes import CFUNCTYPE, POINTER, c_char_p, c_int, c_void_p, cast
from pathlib import Path

from imgui_bundle import hello_imgui

from station.gui.glfw_screen import glfw_library

_DROPPED = CFUNCTYPE(None, c_void_p, c_int, POINTER(c_char_p))


def drop_files(paths: Sequence[Path]) -> None:
    """Drop `paths` at once; they are UTF-8 and gone when the call returns."""
    glfw = glfw_library()
    assert glfw is not None, "the window is GLFW's"
    window = c_void_p(hello_imgui.get_glfw_window_address())  # type: ignore[attr-defined] # its types do not know it
    glfw.glfwSetDropCallback.restype = c_void_p
    called = glfw.glfwSetDropCallback(window, None)
    assert called, "the window takes what is dropped"
    glfw.glfwSetDropCallback(window, c_void_p(called))
    names = (c_char_p * len(paths))(*[str(path).encode() for path in paths])
    cast(called, _DROPPED)(window, len(paths), names)
