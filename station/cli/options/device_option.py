"""The option `--device`, which may be given several times: the same for every command that listens to kits."""

from collections.abc import Sequence

from station.cli.options.option_fields import repeated

DEVICE_FORM = "--device --kit PORT"
DEVICE_HELP = "the kit that is plugged in: part of its MIDI port's name, or serial:PATH[@BAUD]"


def devices_option() -> tuple[str, ...]:
    """The field of the kits to listen to; nothing said is none."""
    return repeated(DEVICE_FORM, f"{DEVICE_HELP}; once for each kit (the first kit found)")


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
