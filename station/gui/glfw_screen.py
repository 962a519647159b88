"""The monitors and the window's place, asked of the GLFW that imgui-bundle brings and opens the window with.

imgui-bundle binds none of this; it names its library in `PYGLFW_LIBRARY` when it is imported. Calls are of GLFW 3.4
(www.glfw.org/docs). On Wayland no program may know or say where its window is: the compositor moves it.
"""

import os
from collections.abc import Sequence
from ctypes import CDLL, POINTER, byref, c_int, c_void_p

from imgui_bundle import hello_imgui

from station.gui.display import Rectangle

_LIBRARY = "PYGLFW_LIBRARY"
_PLATFORM_WAYLAND = 0x00060003


class GlfwScreen:
    """The screen of the window that is open; a handle is a monitor's name."""

    def __init__(self, glfw: CDLL, window: int) -> None:
        self._glfw = glfw
        self._window = c_void_p(window)
        glfw.glfwGetMonitors.restype = POINTER(c_void_p)

    def monitors(self) -> Sequence[int]:
        """The handles of those that are there."""
        count = c_int()
        handles = self._glfw.glfwGetMonitors(byref(count))
        return [handles[index] for index in range(count.value)]

    def area(self, monitor: int) -> Rectangle:
        """Without the system's bars."""
        numbers = [c_int() for _ in range(4)]
        self._glfw.glfwGetMonitorWorkarea(c_void_p(monitor), *map(byref, numbers))
        return Rectangle(*(number.value for number in numbers))

    def window(self) -> Rectangle:
        """Without its title and border."""
        left, top, width, height = (c_int() for _ in range(4))
        self._glfw.glfwGetWindowPos(self._window, byref(left), byref(top))
        self._glfw.glfwGetWindowSize(self._window, byref(width), byref(height))
        return Rectangle(left.value, top.value, width.value, height.value)

    def move(self, place: Rectangle) -> None:
        """As the window's inside."""
        self._glfw.glfwSetWindowSize(self._window, place.width, place.height)
        self._glfw.glfwSetWindowPos(self._window, place.left, place.top)


def glfw_screen() -> GlfwScreen | None:
    """The screen, None where windows cannot be placed or GLFW is another's."""
    window = hello_imgui.get_glfw_window_address()  # type: ignore[attr-defined] # its types do not know it
    glfw = glfw_library()
    if not window or glfw is None or glfw.glfwGetPlatform() == _PLATFORM_WAYLAND:
        return None
    return GlfwScreen(glfw, window)


def glfw_library() -> CDLL | None:
    """The library that the window is of; None where it is not known, or older than 3.4."""
    path = os.environ.get(_LIBRARY, "")
    try:
        glfw = CDLL(path) if path else None
    except OSError:
        return None
    return glfw if hasattr(glfw, "glfwGetPlatform") else None
