"""The option `--kit`, which may be given several times: the same for every command that listens to kits."""

from collections.abc import Sequence

KIT_HELP = "part of the MIDI port's name, or serial:PATH[@BAUD]; once a kit (the first kit found)"


def wanted_kits(said: Sequence[str] | None, otherwise: str) -> str:
    """What the command line says of kits, in the settings' words; raises `BadInput` where a kit cannot be meant."""
    from station.devices.device_ports import BETWEEN_KITS, parse_kit  # drivers are loaded by those alone who need them

    if said is None:
        return otherwise
    for text in said:
        parse_kit(text)
    return BETWEEN_KITS.join(said)
