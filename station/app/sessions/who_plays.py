"""Who plays? The list that comes up between sessions, from the window or by the kit, and what a pad chooses of it."""

from collections.abc import Callable, Collection
from dataclasses import dataclass
from itertools import zip_longest

from station.app.settings.students import Students
from station.core.events import Hit
from station.core.labels import piece_name
from station.core.pieces import Piece
from station.engine.messages import EngineEvent
from station.practice.control.pad_choice import PadChoice, pads_for
from station.practice.records.students import KnownStudent

BY_PAD = 5
"""So many students have a pad (our choice: what one looks over at a glance); the others are chosen with the mouse."""


@dataclass(frozen=True, slots=True)
class StudentLine:
    """A student of the list, the `pad` that chooses them (empty: none), and whether it has been struck for it."""

    student: KnownStudent
    pad: str = ""
    is_meant: bool = False


@dataclass(frozen=True, slots=True)
class StudentsView:
    """Who plays `now`; the `lines` of the list while it `asks`, and whether it `hears` pads: all has been silent."""

    now: str = ""
    asks: bool = False
    lines: tuple[StudentLine, ...] = ()
    hears: bool = False


class WhoPlays:
    """The list of `students` while it is open; `pieces` are those of the kit that is there."""

    def __init__(self, students: Students, pieces: Callable[[], Collection[Piece]]) -> None:
        self._students, self._pieces = students, pieces
        self._listed: tuple[KnownStudent, ...] = ()
        self._pads: tuple[frozenset[Piece], ...] = ()
        self._choice: PadChoice | None = None
        self._now_ns = 0

    @property
    def is_open(self) -> bool:
        """Whether the list is there, so that strokes choose and command nothing else."""
        return self._choice is not None

    def ask(self, on: bool) -> None:
        """Show the list, or put it away."""
        if not on or self.is_open:
            self._choice = self._choice if on else None
            return
        self._students.look_again()
        self._listed = self._students.known
        self._pads = pads_for(min(len(self._listed), BY_PAD), self._pieces())
        self._choice = PadChoice(self._pads, self._now_ns)

    def handle(self, event: EngineEvent) -> None:
        """A stroke while the list is open."""
        if self._choice is not None and isinstance(event, Hit):
            self._choice.feed(event)

    def advance(self, now_ns: int) -> str | None:
        """Move on; returns the name of the student whom a pad has chosen."""
        self._now_ns = now_ns
        chosen = None if self._choice is None else self._choice.advance(now_ns)
        return None if chosen is None else self._listed[chosen].name

    def view(self) -> StudentsView:
        """What is shown."""
        if self._choice is None:
            return StudentsView(self._students.now)
        pads = [" or ".join(piece_name(piece) for piece in sorted(pad)) for pad in self._pads]
        meant = self._choice.meant
        lines = tuple(
            StudentLine(student, pad, number == meant)
            for number, (student, pad) in enumerate(zip_longest(self._listed, pads, fillvalue=""))
            if isinstance(student, KnownStudent)
        )
        return StudentsView(self._students.now, True, lines, self._choice.hears(self._now_ns))
