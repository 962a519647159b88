"""Values of an option that say several things: `rock-1:tempo=90,level=advanced,words=hands low, please`.

What stands before the colon is what it is about; `words`, if it is there, comes last and goes on to the end.
"""

from collections.abc import Callable, Mapping
from typing import TypeVar

from station.core.did_you_mean import did_you_mean
from station.core.errors import BadInput
from station.core.toml.schema import Fields
from station.practice.exchange.lesson_goals import GOAL_FIELDS, LessonGoals
from station.practice.exchange.note_file import VERDICT_FIELDS, SessionVerdict, StrokeVerdict
from station.practice.exchange.parcel_json import meaning
from station.scoring.matching.hit_windows import OUR_LEVELS, Level

_Number = TypeVar("_Number", int, float)
WORDS = "words"
GOAL_KEYS = ("tempo", "level", "passes", "minutes", WORDS)
VERDICT_KEYS = ("score", "reached", "counts", "refused", WORDS)
_KEY_IN_FILE = {"tempo": "tempo_bpm"}
"""What an assignment's table calls it, where an option says it shorter."""


def keyed(option: str, text: str, keys: tuple[str, ...]) -> tuple[str, dict[str, str]]:
    """What an option's value is about, and what it says by the `keys` that it may have; raises `BadInput`."""
    about, colon, rest = text.partition(":")
    if not about or not colon:
        raise BadInput(option, text, f"expected NAME:KEY=VALUE,… with {', '.join(keys)}")
    said: dict[str, str] = {}
    while rest:
        key, equals, rest = rest.partition("=")
        key = key.strip()
        if key not in keys or not equals:
            raise BadInput(option, text, f"no such key: {key}{did_you_mean(key, keys)}")
        value, _, rest = (rest, "", "") if key == WORDS else rest.partition(",")
        said[key] = value.strip()
    return about.strip(), said


def goals_in(option: str, text: str) -> tuple[str, LessonGoals]:
    """A lesson's name, and what is asked of it; raises `BadInput`."""
    lesson, said = keyed(option, text, GOAL_KEYS)
    read = _Values(option, said)
    return lesson, LessonGoals(
        read.number("tempo", float, GOAL_FIELDS),
        read.level(),
        read.number("passes", int, GOAL_FIELDS),
        read.number("minutes", float, GOAL_FIELDS),
        read.words,
    )


def verdict_in(option: str, text: str, lesson_of: Callable[[int], str]) -> SessionVerdict:
    """What is said of the session of that number, whose lesson `lesson_of` names; raises `BadInput`."""
    about, said = keyed(option, text, VERDICT_KEYS)
    if not (about.isascii() and about.isdecimal() and len(about) < 4):
        raise BadInput(option, text, "expected the number of a session before the colon")
    read = _Values(option, said)
    strokes = (*read.strokes("counts", counts=True), *read.strokes("refused", counts=False))
    number = int(about)
    return SessionVerdict(
        number,
        lesson_of(number),
        read.words,
        read.number("score", float, VERDICT_FIELDS),
        read.truth("reached"),
        strokes,
    )


class _Values:
    """The values of an option's keys, None for what is not said."""

    def __init__(self, option: str, said: Mapping[str, str]) -> None:
        self._option, self._said = option, said

    @property
    def words(self) -> str:
        return self._said.get(WORDS, "")

    def number(self, key: str, read: Callable[[str], _Number], fields: Fields) -> _Number | None:
        """A number in the range that the file's own table allows."""
        if key not in self._said:
            return None
        try:
            found = read(self._said[key])
        except ValueError:
            raise BadInput(self._option, key, f"expected a number, found {self._said[key]}") from None
        meaning(found, fields[_KEY_IN_FILE.get(key, key)].read, self._option, key)
        return found

    def level(self) -> Level | None:
        said = self._said.get("level")
        if said is not None and said not in OUR_LEVELS:
            raise BadInput(self._option, "level", f"no such level: {said}{did_you_mean(said, OUR_LEVELS)}")
        return None if said is None else OUR_LEVELS[said]

    def truth(self, key: str) -> bool | None:
        said = self._said.get(key)
        if said not in (None, "yes", "no"):
            raise BadInput(self._option, key, f"expected yes or no, found {said}")
        return None if said is None else said == "yes"

    def strokes(self, key: str, *, counts: bool) -> list[StrokeVerdict]:
        return [self._stroke(key, word, counts) for word in self._said.get(key, "").split("+") if word]

    def _stroke(self, key: str, word: str, counts: bool) -> StrokeVerdict:
        kind, index = word[:4].rstrip("0123456789"), word.lstrip("abcdefghijklmnopqrstuvwxyz")
        if kind not in ("note", "hit") or not (index.isascii() and index.isdecimal() and len(index) < 9):
            raise BadInput(self._option, key, f"expected note3+hit5 as pairs.csv counts them, found {word}")
        return StrokeVerdict(counts, note=int(index)) if kind == "note" else StrokeVerdict(counts, hit=int(index))
