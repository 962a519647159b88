"""Who plays? The list that comes up between sessions, from the window or by the kit: a choice on the screen."""

from collections.abc import Callable, Collection
from dataclasses import dataclass
from datetime import date

from station.app.actions.settings_actions import PlayAs
from station.app.sessions.screen_choice import Option, ScreenChoice
from station.app.settings.students import Students
from station.core.labels import piece_name
from station.core.pieces import Piece
from station.practice.control.pad_choice import pads_for

BY_PAD = 5
"""So many students have a pad (our choice: what one looks over at a glance); the others are chosen with the mouse."""
QUESTION = "Who plays?"


@dataclass(frozen=True, slots=True)
class StudentLine:
    """A student of the list, when they `played`, the `pad` that chooses them (empty: none), whether it was struck."""

    name: str
    played: str
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
        self._choice: ScreenChoice | None = None

    @property
    def is_open(self) -> bool:
        """Whether the list is there, so that strokes choose and command nothing else."""
        return self._choice is not None

    def ask(self, on: bool) -> None:
        """Show the list, or put it away."""
        if on is self.is_open:
            return
        if not on:
            self._choice = None
            return
        self._students.look_again()
        known, today = self._students.known, date.today()
        first = pads_for(min(len(known), BY_PAD), self._pieces())
        pads = (*first, *[frozenset[Piece]()] * (len(known) - len(first)))
        options = [
            Option(student.name, PlayAs(student.name), student.words(today), pad)
            for student, pad in zip(known, pads, strict=True)
        ]
        self._choice = ScreenChoice(tuple(options), QUESTION)

    def choice(self) -> ScreenChoice | None:
        """The list as a choice; None while it is closed."""
        return self._choice

    def view(self, heard: ScreenChoice | None) -> StudentsView:
        """What is shown; `heard` is the choice with what pads do to it."""
        if self._choice is None or heard is None:
            return StudentsView(self._students.now)
        lines = [
            StudentLine(option.label, option.why, " or ".join(map(piece_name, sorted(option.pads))), n == heard.meant)
            for n, option in enumerate(heard.options)
        ]
        return StudentsView(self._students.now, True, tuple(lines), heard.hears)
