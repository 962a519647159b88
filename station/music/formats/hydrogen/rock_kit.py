"""GMRockKit, the drum kit that comes with Hydrogen: its instruments in their order, and what ours are called in a song.

Source: data/drumkits/GMRockKit/drumkit.xml, by the names of its instruments, their types and recordings.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from station.core.sound_names import SUBSTITUTES, SoundName

ROCK_KIT = "GMRockKit"
_LOUDNESS = ("Softest", "Soft", "Med", "Hard", "Hardest")


@dataclass(frozen=True, slots=True)
class KitInstrument:
    """An instrument of the kit; its `recordings` from soft to loud."""

    sound: SoundName
    name: str
    kind: str
    recordings: tuple[str, ...]


def _recorded(sound: SoundName, name: str, kind: str, stem: str) -> KitInstrument:
    return KitInstrument(sound, name, kind, tuple(f"{stem}-{loudness}.wav" for loudness in _LOUDNESS))


KIT: tuple[KitInstrument, ...] = (
    _recorded(SoundName.KICK, "Kick", "Kick", "Kick"),
    _recorded(SoundName.SNARE_CROSS_STICK, "Stick", "Stick", "SideStick"),
    _recorded(SoundName.SNARE, "Snare", "Snare", "Snare"),
    KitInstrument(SoundName.CLAP, "Hand Clap", "Hand Clap", ("HandClap.wav",)),
    _recorded(SoundName.SNARE_RIM_SHOT, "Snare Rimshot", "Snare Rimshot", "SnareRimshot"),
    _recorded(SoundName.FLOOR_TOM_1, "Floor Tom", "Tom Floor", "TomFloor"),
    _recorded(SoundName.HIHAT_CLOSED, "Hat Closed", "Hi-hat Closed", "HatClosed"),
    _recorded(SoundName.TOM_2, "Tom 2", "Tom Low", "Tom2"),
    _recorded(SoundName.HIHAT_CHICK, "Hat Pedal", "Hi-hat Pedal", "HatPedal"),
    _recorded(SoundName.TOM_1, "Tom 1", "Tom Mid", "Tom1"),
    _recorded(SoundName.HIHAT_OPEN, "Hat Open", "Hi-hat Open", "HatOpen"),
    _recorded(SoundName.COWBELL, "Cowbell", "Cowbell", "Cowbell"),
    _recorded(SoundName.RIDE_BOW, "Ride", "Ride Bow", "Ride"),
    _recorded(SoundName.CRASH_1, "Crash", "Crash", "Crash"),
    KitInstrument(SoundName.RIDE_2, "Ride 2", "Ride Bow 2", tuple(f"24Ride-{i}.wav" for i in (5, 4, 3, 2, 1))),
    _recorded(SoundName.SPLASH, "Splash", "Splash", "Splash"),
    _recorded(SoundName.HIHAT_HALF, "Hat Semi-Open", "Hi-hat Semi-Open", "HatSemiOpen"),
    _recorded(SoundName.RIDE_BELL, "Bell", "Ride Bell", "Bell"),
)
"""An instrument's id is its index."""

KIT_ID: Mapping[SoundName, int] = MappingProxyType({one.sound: i for i, one in enumerate(KIT)})

NAMES: Mapping[SoundName, str] = MappingProxyType(
    {
        **{sound: sound.value.replace("_", " ").title() for sound in SoundName},
        SoundName.SNARE_RIM_SHOT: "Snare Rimshot",
        SoundName.HIHAT_LOOSE: "Hat Loose",
        SoundName.HIHAT_WIDE: "Hat Wide",
        SoundName.HIHAT_FOOT_SPLASH: "Hat Foot Splash",
        SoundName.CRASH_2: "Crash 2",
        **{one.sound: one.name for one in KIT},
    }
)
"""What a song's instruments are called: as in the kit where it has them, else in the same manner."""


def kit_id(sound: SoundName) -> int:
    """The id of the kit's instrument for `sound`, or for what stands in for it."""
    return next((KIT_ID[one] for one in (sound, *SUBSTITUTES.get(sound, ())) if one in KIT_ID), KIT_ID[SoundName.SNARE])
