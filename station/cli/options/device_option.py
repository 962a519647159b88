"""The options `--device` and `--sticks`, which may be given several times: the same for every command that listens."""

from collections.abc import Sequence

from station.cli.options.option_fields import repeated

DEVICE_FORM = "--device --kit PORT"
DEVICE_HELP = "the kit that is plugged in: part of its MIDI port's name, or serial:PATH[@BAUD]"
STICKS_FORM = "--sticks PORT"
STICKS_HELP = "a motion sensor on a stick: serial:PATH[@BAUD], or ble:NAME"


def devices_option() -> tuple[str, ...]:
    """The field of the kits to listen to; nothing said is none."""
    return repeated(DEVICE_FORM, f"{DEVICE_HELP}; once for each kit (the first kit found)")


def sticks_option() -> tuple[str, ...]:
    """The field of the motion sensors to listen to; nothing said is none."""
    return repeated(STICKS_FORM, f"{STICKS_HELP}; once for each stick")


def wanted_sticks(said: Sequence[str], otherwise: str) -> str:
    """What the command line says of sensors, in the settings' words; raises `BadInput` where none can be meant."""
    from station.devices.device_ports import BETWEEN_DEVICES
    from station.devices.stick_ports import parse_stick

    if not said:
        return otherwise
    for text in said:
        parse_stick(text)
    return BETWEEN_DEVICES.join(said)


def wanted_kits(said: Sequence[str], otherwise: str) -> str:
    """What the command line says of kits, in the settings' words; raises `BadInput` where a kit cannot be meant."""
    from station.devices.device_ports import (  # drivers are loaded by those alone who need them
        BETWEEN_DEVICES,
        parse_device,
    )

    if not said:
        return otherwise
    for text in said:
        parse_device(text)
    return BETWEEN_DEVICES.join(said)
