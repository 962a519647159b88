"""Years of a student's practice as the history keeps it, made up: for pages to be drawn and measured by.

Three to five days a week, some sessions a day, holidays; a dozen lessons that come one after the other and return. The
scores rise a little and scatter a lot. Nothing here is of a real student.
"""

import json
from collections.abc import Iterator
from datetime import date, datetime, timedelta

import numpy as np

from station.store.rows import FigureRow, JudgementRow, KeptSession, Part, SessionKind, SessionRow

LESSONS = (
    ("rock-1", "Rock 1: eighths, backbeat, one and three", 72.0),
    ("rock-2", "Rock 2: the kick moves", 80.0),
    ("rock-fill-1", "Rock with a fill", 84.0),
    ("single-paradiddle", "Single paradiddle", 60.0),
    ("shuffle-1", "Shuffle 1", 96.0),
    ("funk-1", "Funk 1: sixteenths", 76.0),
)
_LIMBS = ("right_hand", "left_hand", "right_foot", "left_foot")
_PIECES = ("hihat", "snare", "kick", "ride", "crash_1", "tom_1", "floor_tom_1")
_FIRST_HOUR = 16
_LEANS = {"right_hand": -4.0, "left_hand": 9.0, "right_foot": -14.0, "left_foot": 2.0}


def made_sessions(count: int, today: date, student: str = "student", judged: int = 0) -> Iterator[KeptSession]:
    """So many sessions up to `today`, the newest first, each with so many judgements."""
    random = np.random.default_rng(11)
    day, made = today, 0
    while made < count:
        if random.random() < 0.62:
            for number in range(1 + random.poisson(2.0)):
                started = datetime.combine(day, datetime.min.time()) + timedelta(hours=_FIRST_HOUR, minutes=14 * number)
                yield _session(student, started, (today - day).days, random, judged)
                made += 1
                if made == count:
                    return
        day -= timedelta(days=1 if random.random() < 0.985 else 17)


def _session(student: str, started: datetime, ago: int, random: np.random.Generator, judged: int) -> KeptSession:
    name = f"{started:%Y-%m-%dT%H-%M-%S}"
    kind = str(random.choice(["lesson", "take", "battle"], p=[0.9, 0.07, 0.03]))
    played_s = float(random.uniform(120.0, 420.0))
    if kind != "lesson":
        title = "Just play" if kind == "take" else "Battle with The steady one"
        row = SessionRow(student, f"{name}_{kind}", started, "", SessionKind(kind), title=title, played_s=played_s)
        return KeptSession(row)
    lesson, title, bpm = LESSONS[(ago // 9 + int(random.integers(2))) % len(LESSONS)]
    tempo = bpm * 1.05 ** int(random.integers(4))
    better = 12.0 * 0.5 ** (ago / 60.0)
    spread = max(22.0 - better / 2 + random.normal(0, 3.0), 8.0)
    row = SessionRow(
        student,
        f"{name}_{lesson}",
        started,
        "",
        lesson=lesson,
        title=title,
        device="Alesis Nitro",
        played_s=played_s,
        complete=bool(random.random() < 0.9),
        score=float(np.clip(66.0 + better + random.normal(0, 6.0) - 0.4 * (tempo - bpm), 0.0, 100.0)),
        level="beginner",
        beats_a_minute=round(tempo, 1),
        notes=128,
        right=int(np.clip(128 * (0.8 + better / 100 + random.normal(0, 0.04)), 0, 128)),
        strokes=120,
        mean_ms=float(-8.0 + better / 2 + random.normal(0, 4.0)),
        sd_ms=float(spread),
    )
    document = {"score": row.score, "bars": [{"bar": n, "right": 0.5, "words": "as it was played"} for n in range(300)]}
    figures = (*_figures(Part.LIMB, _LIMBS, row, random), *_figures(Part.PIECE, _PIECES, row, random))
    judgements = tuple(_judgement(n) for n in range(judged))
    capture = random.bytes(20_000) if judged else None
    return KeptSession(row, figures, judgements, {"report.json": json.dumps(document).encode()}, capture)


def _figures(part: Part, names: tuple[str, ...], row: SessionRow, random: np.random.Generator) -> Iterator[FigureRow]:
    for name in names:
        notes = int(random.integers(8, 64))
        matched = round(notes * min(row.right / 128 + random.normal(0, 0.03), 1.0))
        mean = _LEANS.get(name, 0.0) + (row.mean_ms or 0.0) / 2 + random.normal(0, 3.0)
        sd = (row.sd_ms or 0.0) + random.normal(0, 1.5)
        yield FigureRow(part, name, notes, matched, notes - matched, 0, matched, float(mean), float(sd))


def _judgement(n: int) -> JudgementRow:
    return JudgementRow(
        "match", 1 + n // 64, 1 + n // 8, 1.0 + n % 8 / 2, n, n / 4, 38, n, n / 4 + 0.01, 38, "snare", "head", "normal",
        90.0, None,
    )  # fmt: skip
