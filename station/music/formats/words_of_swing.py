"""Words over the staff that ask for swing where the file has no `<swing>`: MuseScore 3 exports no other mark."""

import re

from station.core.units import PPQ
from station.music.swing import TRIPLETS, Swing

_KIND = r"(?:(?:slow|easy|light|medium|moderate|fast|up|jazz|hard) )*"
_SWUNG = re.compile(rf"{_KIND}(?:half[ -]?time )?(?:swing|swung|shuffle)(?: (?:feel|groove|8ths|eighths|16ths))?")
_STRAIGHT = re.compile(r"(?:even|straight)(?: (?:feel|8ths|eighths|16ths))?")
_OF_SIXTEENTHS = re.compile(r"16ths|half[ -]?time shuffle")


def swing_in_words(words: str) -> Swing | None:
    """The swing that `words` (lower case, single spaces) ask for; None where they are about something else.

    A mark without a number means triplets, of eighths where it does not name sixteenths, as in books; a half-time
    shuffle is one of sixteenths.
    """
    if _STRAIGHT.fullmatch(words):
        return Swing()
    if not _SWUNG.fullmatch(words):
        return None
    return Swing(TRIPLETS, PPQ // 4 if _OF_SIXTEENTHS.search(words) else PPQ // 2)
