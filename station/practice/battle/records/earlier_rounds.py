"""What players have done in earlier battles, by the documents that these have left: what is expected of them."""

from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from station.core.errors import BadInput
from station.practice.battle.battle_result import STAIRCASE
from station.practice.battle.people.handicap import Expectation, expectation
from station.practice.battle.people.player import is_virtual
from station.practice.battle.records.battle_folder import DOCUMENT_NAME
from station.practice.battle.repeating.demands import MOST_STEP
from station.practice.battle.repeating.staircase import Answered
from station.practice.records.kept_json import kept_document
from station.practice.session.log_values import rows_in, table_in, whole

MOST_READ = 60
"""So many of a player's newest battles are read (our choice: five hundred turns, and a fraction of a second)."""

MOST_POINTS = 100.0
"""Of a turn."""


def expected_of(sessions: Path, name: str, virtual: bool = False) -> Expectation:
    """What is expected of the player called `name`; `sessions` is the folder of all students' sessions.

    What `virtual` players have done under a name tells of them alone, and of no person. A document that cannot be read
    tells nothing, nor does a battle in which no stroke of theirs was heard.
    """
    answered: list[Answered] = []
    points: list[float] = []
    documents = sorted(sessions.glob(f"*/*/{DOCUMENT_NAME}"), key=lambda path: path.parent.name)
    for path in documents[-MOST_READ:]:
        with suppress(BadInput, ValueError, TypeError, KeyError, AttributeError):
            document = kept_document(path)
            if not _has_played(document, name, virtual):
                continue
            turns = list(_turns(document, name))
            answered += [Answered(step, is_won) for step, is_won, _ in turns if step is not None and is_won is not None]
            points += [one for step, _, one in turns if step is None]
    return expectation(answered, points, STAIRCASE)


def _has_played(document: object, name: str, virtual: bool) -> bool:
    """Whether strokes of the player were heard, and a virtual player's only where such are asked for."""
    scores = map(table_in, rows_in(table_in(document)["scores"]))
    devices = [score["device"] for score in scores if score["name"] == name and score["drummer"] is False]
    return any(isinstance(device, str) and is_virtual(device) is virtual for device in devices)


def _turns(document: object, name: str) -> Iterator[tuple[int | None, bool | None, float]]:
    """Of each turn of a player its step, whether it was won (both None of an improvised one), and its points."""
    for kept in rows_in(table_in(document)["rounds"]):
        each = table_in(kept)
        for turn in map(table_in, rows_in(each["turns"])):
            marks = turn["marks"]
            if turn["kind"] != "answer" or turn["name"] != name or marks is None:
                continue
            points, step, won = table_in(marks)["points"], each["step"], turn["won"]
            if points is not None:
                yield (
                    None if step is None else min(max(whole(step), 0), MOST_STEP),
                    won if isinstance(won, bool) else None,
                    _points(points),
                )


def _points(value: object) -> float:
    points = float(str(value))
    if not 0 <= points <= MOST_POINTS:  # also refuses NaN
        raise ValueError
    return points
