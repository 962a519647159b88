"""How trends are shown: axes that make no hill of nothing, and what a dot is of."""

from datetime import datetime, timedelta

import numpy as np
import pytest

from station.app.history.trend_shown import axis_of, dot_words, dots_of, told
from station.practice.progress.trends import Measure, trend_of
from station.store.rows import SessionRow

FIRST = datetime(2026, 11, 2, 17, 5)


def sessions(scores: list[float], tempo: float = 70.0) -> list[SessionRow]:
    """One a day."""
    return [
        SessionRow(
            "Ada",
            str(day),
            FIRST + timedelta(days=day),
            "",
            id=day + 1,
            lesson="rock-1",
            notes=64,
            score=score,
            beats_a_minute=tempo,
        )
        for day, score in enumerate(scores)
    ]


@pytest.mark.parametrize(
    ("measure", "values", "ends"),
    [
        (Measure.TEMPO, [70.0, 70.0], (65.0, 75.0)),
        (Measure.TEMPO, [60.0, 90.0], (60.0, 90.0)),
        (Measure.SCORE, [100.0, 100.0], (90.0, 100.0)),
        (Measure.SCORE, [1.0], (0.0, 10.0)),
        (Measure.SPREAD, [20.0, 22.0], (18.0, 24.0)),
        (Measure.SPREAD, [1.0], (0.0, 6.0)),
        (Measure.LEAN, [-4.0, -2.0], (-7.0, 3.0)),
        (Measure.LEAN, [5.0, 30.0], (0.0, 30.0)),
    ],
)
def test_an_axis_is_never_narrower_than_what_matters(
    measure: Measure, values: list[float], ends: tuple[float, float]
) -> None:
    assert axis_of(measure, np.array(values)) == ends


def test_what_never_changed_is_said_as_one_value() -> None:
    rows = sessions([60.0, 70.0, 65.0, 80.0, 75.0, 70.0])
    assert told(trend_of(Measure.TEMPO, rows)) == "Tempo: 70 bpm each time, on 6 days of practice"
    assert "95 % interval" in told(trend_of(Measure.SCORE, rows))
    assert "cannot be told from 1 day" in told(trend_of(Measure.TEMPO, rows[:1]))
    assert "cannot be told" in told(trend_of(Measure.SPREAD, rows))


def test_a_dot_says_its_day_tempo_and_score() -> None:
    rows = sessions([60.0, 70.0, 65.0, 80.0, 75.0, 70.0])
    found = trend_of(Measure.SCORE, rows)
    assert found.compared is not None
    assert len(dots_of(found)[0]) == 6
    first, second = dot_words(found, 3, {row.id: row for row in rows}).split("\n")
    assert first.endswith("score 80 points, as at 70 bpm")
    assert "5 November 2026: " in first
    assert second == "17:05, 70 bpm, 80 of 100"


def test_a_dot_of_too_few_days_is_a_session() -> None:
    rows = sessions([60.0, 70.0])
    assert dot_words(trend_of(Measure.TEMPO, rows), 1, {}).endswith("tempo 70 bpm")
