"""Which sound a file's or an instrument's name means: "Hat Semi-Open", "BD_02", "FloorTom2Rim", "snare_v3_r1".

Names are split into words (at signs, at digits, and between small and capital letters) and compared with a table, the
more telling rows first. A number counts drums of one family: the second crash, the third tom. Of a file, `v` and a
number name the layer and `r` and a number the take: see docs/sound.md.
"""

import re
from collections.abc import Sequence
from typing import NamedTuple

from station.core.note_map import GENERAL_MIDI
from station.core.sound_names import SoundName, choose_sound

_HAT = r"\b(hi ?hats?|hats?|hh|hho|hhc|hhp)\b"
_TOM = r"\b(toms?|tt|rack)\b"
_RIM = r"\b(rims?|rim ?shot|hoop)\b"
_STICK = r"\b(side ?sticks?|cross ?sticks?|x ?sticks?|rim ?clicks?)\b"

_TABLE: tuple[tuple[tuple[str, ...], SoundName], ...] = (
    ((_HAT, r"\bsplash\b"), SoundName.HIHAT_FOOT_SPLASH),
    ((_HAT, r"\b(foot|pedal|chick|chik|ped)\b"), SoundName.HIHAT_CHICK),
    ((r"\bhhp\b",), SoundName.HIHAT_CHICK),
    ((_HAT, r"\b(wide|three quarters?)\b"), SoundName.HIHAT_WIDE),
    ((_HAT, r"\b(half|semi|medium|middle)\b"), SoundName.HIHAT_HALF),
    ((_HAT, r"\b(loose|sloshy|quarter|slightly)\b"), SoundName.HIHAT_LOOSE),
    ((_HAT, r"\b(open|opened|op)\b"), SoundName.HIHAT_OPEN),
    ((r"\bhho\b",), SoundName.HIHAT_OPEN),
    ((_HAT,), SoundName.HIHAT_CLOSED),
    ((_STICK,), SoundName.SNARE_CROSS_STICK),
    ((r"\b(kick|bass ?drum|bd|kd)\b",), SoundName.KICK),
    ((r"\b(snare|sd|sn)\b", r"\b(buzz|roll|press)\b"), SoundName.SNARE_BUZZ),
    ((r"\b(snare|sd|sn)\b", _RIM), SoundName.SNARE_RIM_SHOT),
    ((r"\b(snare|sd|sn)\b",), SoundName.SNARE),
    ((r"\bfloor\b", _RIM), SoundName.FLOOR_TOM_1_RIM),
    ((r"\bfloor\b",), SoundName.FLOOR_TOM_1),
    ((r"\bft\b",), SoundName.FLOOR_TOM_1),
    ((_TOM, _RIM), SoundName.TOM_1_RIM),
    ((_TOM, r"\b(mid|middle|medium)\b"), SoundName.TOM_2),
    ((_TOM, r"\b(low|lo|lower)\b"), SoundName.TOM_3),
    ((_TOM,), SoundName.TOM_1),
    ((r"\brim ?shots?\b",), SoundName.SNARE_RIM_SHOT),
    ((r"\brims?\b",), SoundName.SNARE_CROSS_STICK),
    ((r"\bcow ?bell\b",), SoundName.COWBELL),
    ((r"\b(bell|cup)\b",), SoundName.RIDE_BELL),
    ((r"\bride\b", r"\b(edge|crash)\b"), SoundName.RIDE_EDGE),
    ((r"\b(ride|rd)\b",), SoundName.RIDE_BOW),
    ((r"\b(china|chinese)\b",), SoundName.CHINA),
    ((r"\bsplash\b",), SoundName.SPLASH),
    ((r"\b(crash|cr|cymbal)\b",), SoundName.CRASH_1),
    ((r"\b(tambourine|tamb)\b",), SoundName.TAMBOURINE),
    ((r"\b(hand ?)?(clap|claps)\b",), SoundName.CLAP),
    ((r"\bsticks?\b",), SoundName.SNARE_CROSS_STICK),
    ((r"\b(percussion|perc|wood ?block|clave|claves)\b",), SoundName.PERCUSSION),
)
"""All patterns of a row occur in the name; the first such row tells."""

FAMILIES: tuple[tuple[SoundName, ...], ...] = (
    (SoundName.TOM_1, SoundName.TOM_2, SoundName.TOM_3, SoundName.TOM_4),
    (SoundName.TOM_1_RIM, SoundName.TOM_2_RIM, SoundName.TOM_3_RIM, SoundName.TOM_4_RIM),
    (SoundName.FLOOR_TOM_1, SoundName.FLOOR_TOM_2),
    (SoundName.FLOOR_TOM_1_RIM, SoundName.FLOOR_TOM_2_RIM),
    (SoundName.CRASH_1, SoundName.CRASH_2),
    (SoundName.RIDE_BOW, SoundName.RIDE_2),
)
"""Sounds that are counted: the number in a name picks one, and a name that is taken moves on to the next."""

_DYNAMICS = ("softest", "soft", "medium", "hard", "hardest")
_MARKS = ("ppp", "pp", "p", "mp", "mf", "f", "ff", "fff")


class FileName(NamedTuple):
    """What a file's name says: the sound, a rank or velocity of its layer, and which take it is (0 for the first)."""

    sound: SoundName
    layer: int
    take: int


def words(name: str) -> str:
    """The name's words in small letters, one space apart: "FloorTom2-Rim" is "floor tom 2 rim"."""
    split = re.sub(r"(?<=[a-z])(?=[A-Z])|(?<=[A-Za-z])(?=\d)|(?<=\d)(?=[A-Za-z])", " ", name)
    return " ".join(re.findall(r"[a-z]+|\d+", split.lower()))


def sound_named(name: str) -> SoundName | None:
    """The sound that `name` means; None where it says nothing that a kit has."""
    spoken = words(name)
    exact = spoken.replace(" ", "_")
    if exact in set(SoundName):
        return SoundName(exact)
    for patterns, sound in _TABLE:
        if all(re.search(pattern, spoken) for pattern in patterns):
            return _numbered(sound, spoken)
    return None


_FIRST_NOTE = 36
"""Hydrogen numbers the MIDI notes of instruments from here on where nobody chose them: then they mean nothing."""


def are_chosen(midi_notes: Sequence[int | None]) -> bool:
    """Whether somebody gave the instruments of a Hydrogen kit these notes, in the kit's order."""
    return list(midi_notes) != list(range(_FIRST_NOTE, _FIRST_NOTE + len(midi_notes)))


def sound_of_instrument(name: str, kind: str, midi_note: int | None) -> SoundName | None:
    """The sound that an instrument of a Hydrogen kit is: by its name, its kind, else its note in General MIDI."""
    by_words = sound_named(name) or sound_named(kind)
    strike = GENERAL_MIDI.get(midi_note) if midi_note is not None else None
    return choose_sound(strike).sound if by_words is None and strike is not None else by_words


def _numbered(sound: SoundName, spoken: str) -> SoundName:
    number = re.search(r"\d+", spoken)
    for family in FAMILIES:
        if number and sound is family[0] and 1 <= int(number[0]) <= len(family):
            return family[int(number[0]) - 1]
    return sound


def file_named(stem: str) -> FileName | None:
    """What the name of a sound file says; None where it names no sound."""
    spoken = words(stem)
    layer, spoken = _taken_out(r"\b(?:v|vel|velocity|layer) (\d+)\b", spoken)
    take, spoken = _taken_out(r"\b(?:r|rr|robin|take) (\d+)\b", spoken)
    if layer is None:
        layer, spoken = _spoken_dynamic(spoken)
    sound = sound_named(spoken)
    return None if sound is None else FileName(sound, layer or 0, take or 0)


def _taken_out(pattern: str, spoken: str) -> tuple[int | None, str]:
    found = re.search(pattern, spoken)
    if found is None:
        return None, spoken
    return int(found[1]), (spoken[: found.start()] + spoken[found.end() :]).strip()


def _spoken_dynamic(spoken: str) -> tuple[int | None, str]:
    """The rank of a word for loudness at the name's end, such as "kick softest" or "snare mf"."""
    head, _, last = spoken.rpartition(" ")
    for scale in (_DYNAMICS, _MARKS):
        if head and last in scale:
            return scale.index(last) + 1, head
    return None, spoken
