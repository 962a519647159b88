"""A session of a return opened to be heard and seen: judged, and laid out as a result, in a process with limits."""

from dataclasses import dataclass
from pathlib import Path

from station.app.sessions.shown_result import SavedSession, shown_result
from station.app.teacher_desk.judge_worker import Heard, within_limits
from station.app.teacher_desk.stroke_lines import StrokeLine, stroke_lines
from station.core.settings import Settings
from station.practice.exchange.return_file import read_return
from station.practice.exchange.return_judging import judge_returned
from station.practice.exchange.teacher_store import assignment_of, given

_NO_BEFORE = "it is a student's: what they played before lies with them"


@dataclass(frozen=True, slots=True, eq=False)
class OpenedTake:
    """A take as it is opened: what is `saved` of it to be shown and heard, what was `heard`, its `strokes`."""

    saved: SavedSession
    heard: Heard
    strokes: tuple[StrokeLine, ...]


def opened_take(path: Path, number: int, settings: Settings) -> OpenedTake:
    """Session `number` of the return at `path`; raises `BadInput`."""
    return within_limits(lambda: _opened(path, number, settings), path, number)


def _opened(path: Path, number: int, settings: Settings) -> OpenedTake:
    returned = read_return(path)
    asked = assignment_of(returned, given(settings))
    judged = judge_returned(returned, number, str(path), settings, asked)
    shown = shown_result(judged.result, judged.document, before=_NO_BEFORE, student=returned.student)
    saved, heard = SavedSession(judged.result, shown), Heard(judged.figures, judged.differences)
    return OpenedTake(saved, heard, stroke_lines(judged.result, shown.hits))
