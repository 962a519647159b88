"""Who plays? The list that comes up between sessions, from the window or by the kit; pads choose from it."""

from collections.abc import Callable, Collection
from dataclasses import dataclass
from itertools import zip_longest

from station.app.actions.settings_actions import PlayAs
from station.app.sessions.screen_choice import Option, ScreenChoice
from station.app.settings.students import Students
from station.core.labels import piece_name
from station.core.pieces import Piece
from station.practice.control.pad_choice import pads_for
from station.practice.records.students import KnownStudent

BY_PAD = 5
"""So many students have a pad (our choice: what one looks over at a glance); the others are chosen with the mouse."""
QUESTION = "Who plays?"


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
        self.choice: ScreenChoice | None = None
        """The list as what is to be chosen from; None while it is put away."""

    @property
    def is_open(self) -> bool:
        """Whether the list is there, so that strokes choose and command nothing else."""
        return self.choice is not None

    def ask(self, on: bool) -> None:
        """Show the list, or put it away."""
        if on is self.is_open:
            return
        if not on:
            self.choice = None
            return
        self._students.look_again()
        self._listed = self._students.known
        pads = pads_for(min(len(self._listed), BY_PAD), self._pieces())
        self.choice = ScreenChoice(
            tuple(
                Option(student.name, PlayAs(student.name), pads=pad)
                for student, pad in zip_longest(self._listed, pads, fillvalue=frozenset())
                if isinstance(student, KnownStudent) and isinstance(pad, frozenset)
            ),
            QUESTION,
        )

    def view(self, heard: ScreenChoice | None) -> StudentsView:
        """What is shown; `heard` is the open list with what pads do to it now."""
        if heard is None:
            return StudentsView(self._students.now)
        lines = tuple(
            StudentLine(student, " or ".join(piece_name(piece) for piece in sorted(option.pads)), place == heard.meant)
            for place, (student, option) in enumerate(zip(self._listed, heard.options, strict=True))
        )
        return StudentsView(self._students.now, True, lines, heard.hears)
