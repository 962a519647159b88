"""What came while a step was asked: notes grouped into strokes, controllers, aftertouch. Times are monotonic ns."""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import NamedTuple

from station.core.units import NS_PER_MS

ONE_STROKE_NS = 70 * NS_PER_MS
"""Notes so close are one stroke with its crosstalk; who is asked for single strokes plays none closer (our choice)."""

_NOTE_ON, _AFTERTOUCH, _CONTROL = 0x9, 0xA, 0xB


class Said(NamedTuple):
    """A note, an aftertouch or a controller: its number and value."""

    at_ns: int
    number: int
    value: int


Stroke = tuple[Said, ...]
"""The notes that one stroke made, in the order in which they came."""


@dataclass(slots=True)
class StepAnswer:
    """The answer to one step."""

    notes: list[Said] = field(default_factory=list)
    controllers: list[Said] = field(default_factory=list)
    touches: list[Said] = field(default_factory=list)

    def add(self, message: bytes, at_ns: int) -> None:
        """Take one MIDI message; what tells nothing of a kit is passed over."""
        kind = message[0] >> 4
        if kind == _NOTE_ON and message[2]:
            self.notes.append(Said(at_ns, message[1], message[2]))
        elif kind == _CONTROL:
            self.controllers.append(Said(at_ns, message[1], message[2]))
        elif kind == _AFTERTOUCH and message[2]:
            self.touches.append(Said(at_ns, message[1], message[2]))

    def strokes(self) -> list[Stroke]:
        """The notes as strokes."""
        return groups(self.notes, ONE_STROKE_NS)

    def value_at(self, controller: int, at_ns: int) -> int | None:
        """What `controller` had said last by `at_ns`, None if nothing within this take."""
        said = [c.value for c in self.controllers if c.number == controller and c.at_ns <= at_ns]
        return said[-1] if said else None


def groups(said: Iterable[Said], gap_ns: int) -> list[Stroke]:
    """What came without a pause longer than `gap_ns`, together."""
    found: list[list[Said]] = []
    for one in said:
        if found and one.at_ns - found[-1][-1].at_ns <= gap_ns:
            found[-1].append(one)
        else:
            found.append([one])
    return [tuple(group) for group in found]


def loudest(stroke: Stroke) -> Said:
    """The note of a stroke that is no false trigger: the loudest, the first of equals."""
    return max(stroke, key=lambda note: note.value)


def main_note(strokes: Iterable[Stroke]) -> int | None:
    """The number that most of the strokes have for their loudest note, None where there are none."""
    numbers = Counter(loudest(stroke).number for stroke in strokes)
    return numbers.most_common(1)[0][0] if numbers else None
