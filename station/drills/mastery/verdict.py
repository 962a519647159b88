"""Whether a pass was clean, and if not, what was wrong with it, in words that a student can use."""

from dataclasses import dataclass
from enum import StrEnum

from station.drills.mastery.goals_missed import Miss, PassFault, missed_goals
from station.drills.mastery.pass_measures.pass_facts import PassResult
from station.drills.mastery.rules import Rules


class Grade(StrEnum):
    """How good a pass was."""

    CLEAN = "clean"
    LOOSE = "loose"
    """Right but for a spread that only the slow tempo brings: no faster tempo is refused for it, none is proved."""
    BAD = "bad"
    BROKEN = "broken"
    """So much went wrong that repeating it would only teach the mistakes."""


@dataclass(frozen=True, slots=True)
class Verdict:
    """A pass's grade, the goals that it `missed`, none of a clean one, and `words` for the first of them."""

    grade: Grade
    missed: tuple[Miss, ...]
    words: str

    @property
    def is_clean(self) -> bool:
        """Whether nothing was wrong."""
        return self.grade is Grade.CLEAN


def judge(result: PassResult, rules: Rules) -> Verdict:
    """Judge a pass by the rules."""
    missed = missed_goals(result, rules)
    return Verdict(_grade(result, missed, rules), missed, missed[0].words if missed else "clean")


def _grade(result: PassResult, missed: tuple[Miss, ...], rules: Rules) -> Grade:
    if not missed:
        return Grade.CLEAN
    if result.right < rules.broken_right * (result.notes + result.extras):
        return Grade.BROKEN
    return Grade.LOOSE if all(_is_of_slow_waits(miss, result, rules) for miss in missed) else Grade.BAD


def _is_of_slow_waits(miss: Miss, result: PassResult, rules: Rules) -> bool:
    """Whether it is a spread that long waits bring about."""
    share_of = result.interval_ms
    return miss.fault is PassFault.SPREAD and share_of is not None and miss.value <= rules.loose_share * share_of
