"""Files that are dropped on the window, as the GLFW that imgui-bundle brings hands them over.

imgui-bundle binds no drop callback and sets none. `GLFWdropfun` is of GLFW 3.4 (www.glfw.org/docs, "Path drop input"):
it is called while events are polled, in the thread that draws, and its strings do not outlive the call.
"""

import os
from collections.abc import Sequence
from ctypes import CDLL, CFUNCTYPE, POINTER, c_char_p, c_int, c_void_p

from imgui_bundle import hello_imgui

from station.gui.glfw_screen import glfw_library

_DROPPED = CFUNCTYPE(None, c_void_p, c_int, POINTER(c_char_p))


class FileDrop:
    """What was dropped on a window since it was last asked."""

    def __init__(self, glfw: CDLL, window: int) -> None:
        self._glfw, self._window = glfw, c_void_p(window)
        self._dropped: list[str] = []
        self._call = _DROPPED(self._take)  # GLFW keeps the address alone
        glfw.glfwSetDropCallback(self._window, self._call)

    def _take(self, _: object, count: int, paths: Sequence[bytes]) -> None:
        self._dropped += [os.fsdecode(paths[index]) for index in range(count)]

    def paths(self) -> list[str]:
        """Files and folders in the order in which they were dropped."""
        dropped, self._dropped = self._dropped, []
        return dropped

    def close(self) -> None:
        """Take no more; before the window goes."""
        self._glfw.glfwSetDropCallback(self._window, None)


def file_drop() -> FileDrop | None:
    """What is dropped on the window that is open; None where GLFW is another's."""
    window = hello_imgui.get_glfw_window_address()  # type: ignore[attr-defined] # its types do not know it
    glfw = glfw_library()
    return FileDrop(glfw, window) if window and glfw is not None else None
