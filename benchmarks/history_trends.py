"""How often the history's trends and the week's page say what is not so, on students whose truth is known.

    python -m benchmarks.history_trends [STUDENTS] > table.md

Skill stays, grows by the power law of practice (Newell and Rosenbloom 1981: quick at first, slower later), along a
line, or gets worse; a day's form goes on to the next day (AR(1)), a session's luck has heavy tails (Student's t, 4
degrees), days of practice are irregular with a holiday, tempi stay, wander or climb a ladder. The page of each week
from the 6th to the 20th is made, as parents would read it.
"""

import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import date, datetime, timedelta

import numpy as np

from station.practice.progress.trends import Measure, Trend, Verdict, trend_of
from station.practice.progress.week_told import got_better
from station.store.rows import SessionRow

FIRST = date(2026, 1, 5)
_WEEKS = 20
_FROM = 6
Random = np.random.Generator


@dataclass(frozen=True)
class Student:
    """`gain` is the share by which spread falls until the end of 8 weeks, in the shape that `curve` has."""

    gain: float = 0.0
    curve: str = "line"
    persists: float = 0.6
    a_week: float = 4.0
    tempo: str = "same"
    lessons: int = 1
    equipment: bool = False
    easier_from: int | None = None
    holiday: bool = True


STUDENTS = {
    "nothing changes": Student(),
    "nothing changes, form persists (0.85)": Student(persists=0.85),
    "nothing changes, no form": Student(persists=0.0),
    "nothing changes, five lessons": Student(lessons=5, a_week=5.0),
    "nothing changes, tempo wanders": Student(tempo="wanders"),
    "nothing changes, tempo climbs": Student(tempo="climbs"),
    "nothing changes, the kit's lag is measured anew": Student(equipment=True),
    "nothing changes, easier bars from day 21": Student(easier_from=21),
    "35 % worse": Student(gain=-0.35),
    "35 % worse, tempo climbs": Student(gain=-0.35, tempo="climbs"),
    "30 % better, line": Student(gain=0.30),
    "30 % better, power law": Student(gain=0.30, curve="power"),
    "50 % better, line": Student(gain=0.50),
    "50 % better, power law": Student(gain=0.50, curve="power"),
    "30 % better, tempo climbs": Student(gain=0.30, tempo="climbs"),
}


def skill(student: Student, day: float) -> float:
    """What is left of the first day's spread."""
    end = 56.0
    if student.curve == "power":
        power = np.log(1.0 - student.gain) / np.log(1.0 + end / 2)
        return float((1.0 + day / 2) ** power)
    return float(1.0 - student.gain * min(day / end, 1.0))


def tempo(student: Student, day: float, random: Random) -> float:
    """In beats a minute."""
    if student.tempo == "wanders":
        return float(random.choice([60.0, 66.0, 72.0, 80.0, 90.0]))
    if student.tempo == "climbs":
        return float(70.0 + 40.0 * min(day / 100.0, 1.0) + random.normal(0.0, 1.0))
    return 80.0


def sessions(student: Student, random: Random, lesson: str) -> list[SessionRow]:
    """All sessions of a lesson in `_WEEKS`."""
    days = np.flatnonzero(random.random(7 * _WEEKS) < student.a_week / 7 / (1.5 if student.lessons > 1 else 1))
    if student.holiday:
        days = days[(days < 63) | (days >= 77)]
    return list(_played(student, days, random, lesson))


def _played(student: Student, days: np.ndarray, random: Random, lesson: str) -> Iterator[SessionRow]:
    form = random.normal(size=3)
    for at, day in enumerate(days.tolist()):
        kept = student.persists ** (day - days[at - 1]) if at else 0.0
        form = kept * form + np.sqrt(1 - kept**2) * random.normal(size=3)
        for number in range(1 + int(random.poisson(0.3))):
            luck = random.standard_t(4, 3) / 2**0.5
            beats = tempo(student, day, random)
            left, price = skill(student, day), np.log(beats / 80.0)
            easier = student.easier_from is not None and day >= student.easier_from
            spread = 22.0 * left * (0.7 if easier else 1.0) + 3.0 * price + 2.5 * form[0] + 2.5 * luck[0]
            score = 100.0 - 30.0 * left * (0.7 if easier else 1.0) - 20.0 * price + 5.0 * form[1] + 5.0 * luck[1]
            lag = 22.0 if student.equipment and day >= 40 else 0.0
            lean = -25.0 + lag + 3.0 * form[2] + 3.0 * luck[2]
            started = datetime(2026, 1, 5, 17) + timedelta(days=day, minutes=10 * number)
            yield SessionRow(
                "Ada", f"{lesson}-{day}-{number}", started, "", lesson=lesson, title=lesson, device="kit",
                played_s=300.0, score=float(np.clip(score, 0, 100)), beats_a_minute=beats, notes=64, right=50,
                strokes=60, mean_ms=float(lean), sd_ms=max(float(spread), 4.0), first_bar=5 if easier else 1,
                last_bar=8, click=True, input_latency_ms=8.0 + lag, output_latency_ms=20.0,
            )  # fmt: skip


def truth(student: Student, trend: Trend) -> float:
    """By how much the spread truly changed from the first days of a trend to its last."""
    assert trend.compared is not None
    assert trend.first is not None
    begun = (trend.first - FIRST).days
    days = [begun + float(day) for day in trend.compared.days]
    side = trend.compared.a_side
    early, late = (np.mean([skill(student, day) for day in some]) for some in (days[:side], days[-side:]))
    return float(22.0 * (late - early))


@dataclass
class Found:
    """What came of one kind of student."""

    pages: int = 0
    pages_told: int = 0
    told_ever: int = 0
    told_by_8: int = 0
    held: int = 0
    compared: int = 0
    claims: int = 0
    claims_held: int = 0
    impossible: int = 0
    first_told: list[int] = None  # type: ignore[assignment]


def look(student: Student, count: int, random: Random) -> Found:
    """Weeks of so many students of a kind."""
    found = Found(first_told=[])
    for _ in range(count):
        lessons = [sessions(student, random, f"lesson {n}") for n in range(student.lessons)]
        rows = [row for each in lessons for row in each]
        first = None
        for week in range(_FROM, _WEEKS + 1):
            monday = FIRST + timedelta(days=7 * (week - 1))
            seen = [row for row in rows if row.started.date() < monday + timedelta(days=7)]
            told = got_better(seen, monday)
            found.pages += 1
            found.pages_told += told != ()
            found.impossible += sum(_is_impossible(each) for each in told)
            first = week if told and first is None else first
        found.told_ever += first is not None
        found.told_by_8 += first is not None and first <= 10
        if first is not None:
            found.first_told.append(first)
        if student.tempo == "same" and student.easier_from is None:
            _hold(found, student, [row for row in lessons[0] if (row.started.date() - FIRST).days < 56])
    return found


def _hold(found: Found, student: Student, rows: list[SessionRow]) -> None:
    trend = trend_of(Measure.SPREAD, rows)
    if trend.change is None:
        return
    _, low, high = trend.change
    held = low <= truth(student, trend) <= high
    found.compared += 1
    found.held += held
    if trend.verdict is Verdict.BETTER or trend.verdict is Verdict.WORSE:
        found.claims += 1
        found.claims_held += held


def _is_impossible(words: str) -> bool:
    return bool(re.search(r"[-−]\d", words)) or any(int(each) > 100 for each in re.findall(r"\d+", words))


def main() -> None:
    """Print the table."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 250
    only = sys.argv[2] if len(sys.argv) > 2 else ""
    print(
        "| student | pages that tell of better | students told in 15 weeks | by week 10"
        " | intervals hold the truth | those of told changes (how many) |"
    )
    print("|---|---|---|---|---|---|")
    for name, student in STUDENTS.items():
        if only in name:
            found = look(student, count, np.random.default_rng(15))
            assert not found.impossible
            print(
                f"| {name} | {found.pages_told / found.pages:.1%} | {found.told_ever / count:.0%}"
                f" | {found.told_by_8 / count:.0%} | {_share(found.held, found.compared)}"
                f" | {_share(found.claims_held, found.claims)} ({found.claims}) |",
                flush=True,
            )


def _share(some: int, of: int) -> str:
    return f"{some / of:.0%}" if of else "–"


if __name__ == "__main__":
    main()
