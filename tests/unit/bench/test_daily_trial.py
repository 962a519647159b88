"""The trial of daily plans: a day of it keeps the minutes, whoever plans it."""

import pytest

from station.bench.rigs.daily_trial import COURSE, PLANNERS, daily_trial


@pytest.mark.parametrize("planner", PLANNERS)
def test_a_day_has_its_twenty_minutes_whoever_plans_it(planner: str) -> None:
    """Blocks end with a whole pass: half a minute over at most in each of a handful of blocks."""
    outcome = daily_trial(planner, "gifted", 5, days=1)
    assert 100 <= outcome.minutes_pct <= 110
    assert 1 <= outcome.begun <= len(COURSE)
    assert outcome.reviews == 0, "nothing is due on the first day"
