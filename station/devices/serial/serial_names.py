"""How serial ports are called in a list of ports.

A port is `serial:PATH`, such as `serial:/dev/ttyUSB0` or `serial:COM3`, after what the system says of the adapter where
it says something: `CP2102 USB to UART serial:/dev/ttyUSB0`. The kit behind it goes by the adapter's name, which stays
when the path changes.
"""

import re

SERIAL = "serial:"

_ADDRESS = re.compile(r" (?:serial|hid):\S+$")
"""Of HID devices too, whose ports are named in the same way (`hid_names`)."""


def serial_port(path: str, title: str = "") -> str:
    """The name of the port at `path` that belongs to what the system calls `title`, empty where it says nothing."""
    return f"{title} {SERIAL}{path}".strip()


def device_of_port(port: str) -> str:
    """The name of what is behind a port with an address: the same whichever it gets, if the system knows it at all."""
    return _ADDRESS.sub("", port)
