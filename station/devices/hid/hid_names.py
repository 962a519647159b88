"""How HID devices are called in a list of ports: `Rock Band drums (PS3) hid:/dev/hidraw3`.

The path changes when it is plugged in again; the device goes by what is before it (`serial_names.device_of_port`).
"""

HID = "hid:"


def hid_port(title: str, path: str) -> str:
    """The name of the port at `path` of a device called `title`."""
    return f"{title} {HID}{path}"
