"""What an X screen of 24 bits shows now, asked of the server: what OpenGL has in hand is the driver's affair.

Structures as in Xlib.h (X11R6), the image's up to its colour masks.
"""

import ctypes

import numpy as np
from numpy.typing import NDArray

from station.gui.display import Rectangle

_ALL_PLANES, _Z_PIXMAP = ctypes.c_ulong(-1), 2


class _Image(ctypes.Structure):
    _fields_ = (
        ("width", ctypes.c_int),
        ("height", ctypes.c_int),
        ("xoffset", ctypes.c_int),
        ("format", ctypes.c_int),
        ("data", ctypes.c_void_p),
        ("byte_order", ctypes.c_int),
        ("bitmap_unit", ctypes.c_int),
        ("bitmap_bit_order", ctypes.c_int),
        ("bitmap_pad", ctypes.c_int),
        ("depth", ctypes.c_int),
        ("bytes_per_line", ctypes.c_int),
        ("bits_per_pixel", ctypes.c_int),
    )


def screen_shot(area: Rectangle) -> NDArray[np.uint8]:
    """What is seen in an area of the screen, (height, width, 3), top row first."""
    x11 = ctypes.CDLL("libX11.so.6")
    x11.XOpenDisplay.restype = x11.XDefaultRootWindow.restype = ctypes.c_void_p
    x11.XGetImage.restype = ctypes.POINTER(_Image)
    display = ctypes.c_void_p(x11.XOpenDisplay(None))
    root = ctypes.c_void_p(x11.XDefaultRootWindow(display))
    image = x11.XGetImage(display, root, area.left, area.top, area.width, area.height, _ALL_PLANES, _Z_PIXMAP)
    lines, pitch = image.contents.height, image.contents.bytes_per_line
    assert image.contents.bits_per_pixel == 32, "blue, green, red, and one to spare"
    held = (ctypes.c_uint8 * (lines * pitch)).from_address(image.contents.data)
    pixels = np.frombuffer(held, np.uint8).reshape(lines, pitch // 4, 4)[:, : area.width, 2::-1].copy()
    x11.XDestroyImage(image)
    x11.XCloseDisplay(display)
    return pixels
