"""The drum kits and outputs that there are, as the page lists them; looked for in a process of its own."""

from dataclasses import dataclass
from pathlib import Path

from station.core.errors import StationError
from station.sound.output.card_stream import SoundDevice

_MADE = {
    "acoustic": "Made by rule: a studio kit, sticks",
    "brushes": "Made by rule: the same, brushes and a soft beater",
    "electronic": "Made by rule: an analogue drum machine",
}


@dataclass(frozen=True, slots=True)
class KitCard:
    """A drum kit: the name that the settings have for it, what it is, and its place, empty for one that is made."""

    name: str
    about: str
    place: str = ""


@dataclass(frozen=True, slots=True)
class SoundShelf:
    """What there is: `kits`, `outputs` with the system's default first; `fault` why no output can be listed."""

    kits: tuple[KitCard, ...]
    outputs: tuple[SoundDevice, ...] = ()
    fault: str = ""


def sound_shelf() -> SoundShelf:
    """What there is now. Takes tenths of a second, seconds where a sound server is slow: never in the window."""
    from station.sound.output.list_outputs import outputs_now

    try:
        return SoundShelf(kit_cards(), tuple(outputs_now()))
    except StationError as fault:
        return SoundShelf(kit_cards(), (), str(fault))


def kit_cards() -> tuple[KitCard, ...]:
    """Every kit that has a name."""
    from station.sound.samples.load_kit import find_kit, kit_names

    return tuple(_card(name, find_kit(name)) for name in kit_names())


def _card(name: str, path: Path | None) -> KitCard:
    if path is None:
        return KitCard(name, _MADE.get(name, "Made by rule"))
    if path.is_file():
        return KitCard(name, "Your own: a kit of Hydrogen's", str(path))
    files = sum(1 for each in path.rglob("*") if each.is_file())
    return KitCard(name, f"Your own: a folder of {files} file{'' if files == 1 else 's'}", str(path))
