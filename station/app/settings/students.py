"""Who plays: the students of this computer, and what changes with them.

A student's own are their name, who leads (`hands`), the course that is listed, and all that their folder has: progress,
levels, lesson book, assignments. Kit, sound, devices, the look of the window and how sessions go are the computer's: no
cable changes with who sits down. What is a student's own stands in the settings while they play, and in `students`
while another one does.
"""

from dataclasses import replace

from station.app.settings.first_start import LONGEST_NAME
from station.app.settings.settings_store import SettingsStore
from station.core.errors import BadInput
from station.core.settings import Settings, StudentSettings
from station.practice.records.students import KnownStudent, known_students, shares_folder, sharing

MOST_KEPT = 200
"""So many students have settings of their own (our choice: a school's); of others their folder stays."""


def switched(settings: Settings, name: str) -> Settings:
    """The settings with `name` playing: what was the other's own is put away, what is theirs comes back."""
    if name == settings.student:
        return settings
    before = StudentSettings(settings.student, settings.hands, settings.course)
    kept = [each for each in settings.students if each.name not in (name, before.name)]
    known = {each.name: each for each in settings.students}
    theirs = known.get(name, StudentSettings(name))
    students = (theirs, before, *kept)[:MOST_KEPT]
    return replace(settings, student=name, hands=theirs.hands, course=theirs.course, students=students)


def forgotten(settings: Settings, name: str) -> Settings:
    """The settings without what is of `name`, however it is spelled; where they play, who played before plays now."""
    others = tuple(each for each in settings.students if not shares_folder(each.name, name))
    if not shares_folder(settings.student, name):
        return replace(settings, students=others)
    now = others[0] if others else StudentSettings(Settings().student)
    return replace(settings, student=now.name, hands=now.hands, course=now.course, students=others)


def plain_name(written: str) -> str:
    """A name as it is kept, blanks made one; raises `BadInput` for none, or letters that nobody sees."""
    name = " ".join(written.split())
    bad = next((letter for letter in name if not letter.isprintable()), None)
    if bad is not None:
        raise BadInput("the name", "", f"has a letter that nobody sees, U+{ord(bad):04X}")
    if not name:
        raise BadInput("the name", "", "is empty")
    if len(name) > LONGEST_NAME:
        raise BadInput("the name", "", f"has {len(name)} letters, and {LONGEST_NAME} are the most")
    return name


class Students:
    """The students of the settings `store` and of its folder of sessions, read where somebody has looked again."""

    def __init__(self, store: SettingsStore) -> None:
        self._store = store
        self._read: tuple[str, tuple[KnownStudent, ...]] | None = None

    @property
    def now(self) -> str:
        """Who plays."""
        return self._store.now.student

    @property
    def known(self) -> tuple[KnownStudent, ...]:
        """All of them, who played last first; who plays is the first."""
        settings = self._store.now
        if self._read is None or self._read[0] != settings.student:
            named = [settings.student, *(each.name for each in settings.students)]
            self._read = settings.student, known_students(settings, named)
        return self._read[1]

    def look_again(self) -> None:
        """Something was kept: who played last may be another."""
        self._read = None

    def play_as(self, written: str) -> str:
        """Let a student play from now on; returns the name. Raises `BadInput` for a name that is none, or no other."""
        known = [each.name for each in self.known]
        name = written if written in known else plain_name(written)
        other = sharing(name, known)
        if other is not None:
            raise BadInput(name, "", f"would share a folder with {other}: take a name that differs in more")
        self._store.update(lambda settings: switched(settings, name))
        return name
