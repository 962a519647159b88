"""Students of whom the truth is known, simulated from plain reasoning and from what is published, not from the code.

A session's value is a line in time (what is to be found), a harder tempo's price, the day's form, the session's luck.
Form persists little from day to day and differs by about as much as two sessions of a day do (psychologists' diaries:
intra-class correlations of .3 to .6); practice comes on about every second day, with holidays; tempi wander or climb.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import datetime, timedelta

import numpy as np

from station.store.rows import SessionRow

BEGIN = datetime(2026, 3, 2, 17, 0)
Random = np.random.Generator
Tempo = Callable[[int, int, Random], float]


@dataclass(frozen=True)
class Story:
    days: int
    a_day: float = 0.0
    """What the score gains a day."""
    day_sd: float = 4.0
    session_sd: float = 4.0
    is_heavy: bool = False
    interrupted: float = 0.0
    """The share of sessions in which the telephone rings."""
    holiday: int = 0
    persists: float = 0.0
    tempo: Tempo = lambda _day, _days, _random: 80.0


def wandering(_day: int, _days: int, random: Random) -> float:
    return float(random.choice([60.0, 66.0, 72.0, 80.0, 90.0]))


def climbing(day: int, _days: int, random: Random) -> float:
    """Up a rung in three days, and now and then some rungs down to warm up."""
    rung = min(day // 3, 8)
    return 60.0 * 1.05 ** (rung if random.random() < 0.7 else max(rung - int(random.integers(1, 4)), 0))


def slowing(day: int, days: int, random: Random) -> float:
    """Ever slower: what looks like progress and is none."""
    return float(100.0 * 0.8 ** (day / days) * random.uniform(0.97, 1.03))


def told(story: Story, random: Random) -> tuple[list[SessionRow], float]:
    """Sessions, and by how much the score truly changed from the first day to the last."""
    gaps = random.geometric(0.45, story.days)
    if story.holiday:
        gaps[story.days // 2] += story.holiday
    at = np.cumsum(gaps) - gaps[0]
    return list(_sessions(story, at, random)), story.a_day * float(at[-1])


def _sessions(story: Story, at: np.ndarray, random: Random) -> Iterator[SessionRow]:
    form = random.normal()
    for number, day in enumerate(at):
        kept = story.persists ** (day - at[number - 1]) if number else 0.0
        form = kept * form + np.sqrt(1 - kept**2) * random.normal()
        for session in range(1 + random.poisson(0.8)):
            bpm = story.tempo(number, story.days, random)
            luck = random.standard_t(3) / 3**0.5 if story.is_heavy else random.normal()
            price = 25.0 * np.log(bpm / 60) + 15.0 * np.log(bpm / 60) ** 2
            score = 65.0 + story.a_day * day - price + story.day_sd * form + story.session_sd * luck
            score -= 30.0 * (random.random() < story.interrupted)
            yield row(float(score), float(bpm), BEGIN + timedelta(days=int(day), minutes=20 * session))


def row(score: float, bpm: float, started: datetime, **others: object) -> SessionRow:
    values: dict[str, object] = {
        "lesson": "rock-1", "title": "Rock", "notes": 64, "right": 50, "strokes": 60, "played_s": 300.0
    }  # fmt: skip
    values |= {"score": score, "beats_a_minute": bpm, "mean_ms": -5.0, "sd_ms": 20.0, "device": "kit"} | others
    return SessionRow("Ada", f"{started:%Y-%m-%dT%H-%M-%S}", started, "", **values)  # type: ignore[arg-type]
