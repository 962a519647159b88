"""What pauses a session, as a setting says it: `crash_1+crash_2 cc=64`.

Words between spaces: two pads that are struck at once, a foot switch by its MIDI controller (`cc=64`), its program
(`program=5`) or its key (`key=5`), a game kit's button (`button=10`): as `Switched` calls them. Any of them pauses and
goes on; without a word there is the window alone.
"""

from dataclasses import dataclass

from station.core.counts import is_count
from station.core.errors import BadInput
from station.core.pieces import Piece, word

_PIECES = {word(piece): piece for piece in Piece}
_SWITCHES = {"cc": 127, "program": 127, "key": 231, "button": 13}
"""Each kind with its greatest number: MIDI's, and those of the HID usage tables that a keyboard and a game kit have."""


@dataclass(frozen=True, slots=True)
class PauseOptions:
    """Pairs of pads, and switches as `Switched` calls them."""

    pairs: tuple[frozenset[Piece], ...] = ()
    switches: frozenset[str] = frozenset()


def parse_pause(text: str, source: str = "pause") -> PauseOptions:
    """What `text` says; raises `BadInput` that names `source` and the word at fault."""
    pairs: list[frozenset[Piece]] = []
    switches: set[str] = set()
    for entry in text.split():
        kind, _, number = entry.partition("=")
        names = entry.split("+")
        if kind in _SWITCHES and is_count(number) and int(number) <= _SWITCHES[kind]:
            switches.add(f"{kind}={int(number)}")
        elif len(set(names)) == len(names) == 2 and all(name in _PIECES for name in names):
            pairs.append(frozenset(_PIECES[name] for name in names))
        else:
            switches_there = ", ".join(f"{kind}=0…{most}" for kind, most in _SWITCHES.items())
            expected = f"expected two pads such as crash_1+crash_2, or one of {switches_there}"
            raise BadInput(source, entry, expected)
    return PauseOptions(tuple(pairs), frozenset(switches))
