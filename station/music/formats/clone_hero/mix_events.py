"""The `mix` events of a drum track: which say where red and yellow are flipped (disco flip).

`[mix 3 drums0d]`, with or without brackets, with spaces or underscores: difficulty, stems, flag. A flag holds until the
next event of its difficulty.
"""

import re
from collections.abc import Iterable

from station.music.formats.clone_hero.drum_chart import Difficulty, Span, spans_between

_MIX = re.compile(r"\[?mix[ _]([0-3])[ _]drums[0-9]?([a-z]*)\]?", re.IGNORECASE)
_FLIP = "d"


def flips_of(events: Iterable[tuple[int, str]], difficulty: Difficulty, end: int) -> tuple[Span, ...]:
    """Where `difficulty` is flipped, of (tick, text) events; a flip that nothing ends lasts to the tick `end`."""
    switches = []
    for tick, text in events:
        mix = _MIX.fullmatch(text.strip().strip('"').strip())
        if mix and int(mix[1]) == difficulty:
            switches.append((tick, mix[2].lower() == _FLIP))
    return spans_between(switches, end)
