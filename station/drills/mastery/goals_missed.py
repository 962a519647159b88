"""Which goals a pass misses, of the whole, of limbs and of bars: the one answer, for the verdict and for the report.

Bias and spread are judged apart (TEACHING): a lean costs nothing unless the lesson asks for it.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType

from station.drills.lesson import PartGoals
from station.drills.mastery.pass_measures.asked_parts import Part
from station.drills.mastery.pass_measures.part_facts import PartResult
from station.drills.mastery.pass_measures.pass_facts import PassResult
from station.drills.mastery.rules import Rules


class PassFault(StrEnum):
    """What keeps a pass from being clean."""

    RIGHT = "right"
    PADS = "pads"
    SPREAD = "spread"
    LEAN = "lean"
    SWING = "swing"
    POINTS = "points"
    LOUDNESS = "loudness"
    TEMPO = "tempo"


@dataclass(frozen=True, slots=True)
class Miss:
    """A goal that was not reached: `value` where `limit` is asked, of a `part`, or of the whole (None).

    `words` are for the reason of a pass, without a full stop; `sentence` is for a report. Units: notes or shares 0–1
    (`RIGHT` of the whole and of a part), strokes, ms, ratios, points, dB, % of the tempo.
    """

    fault: PassFault
    value: float
    limit: float
    words: str
    sentence: str
    part: Part | None = None


def missed_goals(result: PassResult, rules: Rules) -> tuple[Miss, ...]:
    """What of the rules' goals `result` misses: those of the whole first, then of limbs, then of bars."""
    measured = {one.part: one for one in result.parts}
    ofs = [(measured[asked.part], asked.goals) for asked in rules.parts if asked.part in measured]
    return (*_of_whole(result, rules), *(miss for one, goals in ofs for miss in _of_part(one, goals)))


# --- the whole --------------------------------------------------------------------------------------------------------


def _of_whole(result: PassResult, rules: Rules) -> Iterator[Miss]:
    if result.wrong_pads > (allowed := allowed_wrong_pads(result.notes, rules)):
        words = f"{result.wrong_pads} strokes on a wrong pad, {allowed} allowed"
        sentence = f"{result.wrong_pads} strokes went to a wrong pad and {allowed} may: play it again, slower."
        yield Miss(PassFault.PADS, result.wrong_pads, allowed, words, sentence)
    yield from _right(result, rules)
    limit_ms = rules.sd_limit_ms(result.interval_ms)
    if result.sd_ms is not None and result.sd_ms > limit_ms:
        yield _spread(result.sd_ms, limit_ms)
    if (lean_ms := _beyond(result.lean_ms, 0.0, rules.max_lean_ms)) is not None:
        yield _lean(lean_ms, rules.max_lean_ms or 0.0)
    if (ratio := _beyond(result.swing_ratio, rules.swing_ratio, rules.max_swing_error)) is not None:
        yield _swing(ratio, rules.swing_ratio, rules.max_swing_error or 0.0)
    if rules.min_points is not None and result.points is not None and result.points < rules.min_points:
        words = f"{result.points:.0f} points, {rules.min_points:.0f} needed"
        sentence = f"The score is {math.floor(result.points)} and {rules.min_points:g} is the goal"
        yield Miss(
            PassFault.POINTS, result.points, rules.min_points, words, f"{sentence}: play it again at this tempo."
        )
    if (off_db := _beyond(result.loudness_error_db, 0.0, rules.max_loudness_error_db)) is not None:
        yield _loudness(off_db, rules.max_loudness_error_db or 0.0)


def _right(result: PassResult, rules: Rules) -> Iterator[Miss]:
    """Strokes too many count like notes left out."""
    total = result.notes + result.extras
    needed = math.ceil(rules.min_right * total - _TINY)
    if result.right >= needed:
        return
    goal = math.ceil(100 * rules.min_right - _TINY)
    share = min(round(100 * result.right / total), goal - 1)  # a goal that was missed is never rounded up to
    of = f" ({result.extras} strokes too many count as notes left out)" if result.extras else ""
    words = f"{result.right} of {result.notes} right, {needed} needed"
    if result.extras:  # nobody can play more right ones than there are
        words = f"{share} % right ({result.right} of {result.notes} and {result.extras} too many), {goal} % needed"
    yield Miss(
        PassFault.RIGHT,
        result.right,
        needed,
        words,
        f"{share} % of the notes were right{of}, {goal} % are the goal: play it again at this tempo, or slower.",
    )


def allowed_wrong_pads(notes: int, rules: Rules) -> int:
    """One in each full `notes_a_wrong_pad`, and one where a pass is shorter."""
    return max(1, notes // rules.notes_a_wrong_pad)


def _spread(sd_ms: float, limit_ms: float) -> Miss:
    sentence = (
        f"No one fault stands out, but your strokes spread by {_ms(sd_ms, limit_ms)} ms and {math.floor(limit_ms)} are"
        " the goal: stay at this tempo, or go slower, until they lie closer together."
    )
    return Miss(PassFault.SPREAD, sd_ms, limit_ms, f"spread {sd_ms:.0f} ms, {limit_ms:.0f} allowed", sentence)


def _lean(lean_ms: float, limit_ms: float) -> Miss:
    sentence = (
        f"You play {_ms(lean_ms, limit_ms)} ms {_side(lean_ms)} on average and the lesson allows {limit_ms:g}:"
        " play it again and listen to the click."
    )
    words = f"{lean_ms:+.0f} ms beside the click, {limit_ms:.0f} allowed"
    return Miss(PassFault.LEAN, lean_ms, limit_ms, words, sentence)


def _swing(ratio: float, written: float, limit: float) -> Miss:
    sentence = (
        f"You swing {ratio:.2f}:1, {written:.2f}:1 is written and the lesson allows {limit:g} to either side:"
        " play it again and listen to the offbeats."
    )
    return Miss(PassFault.SWING, ratio, limit, f"swung {ratio:.1f}:1, {written:.1f}:1 is written", sentence)


def _loudness(off_db: float, limit_db: float) -> Miss:
    sentence = (
        f"Your strokes are {_up(off_db)} dB off the written loudness on average and the lesson allows {limit_db:g}:"
        " play it again and make accents, strokes and ghosts as far apart as they are written."
    )
    words = f"{_up(off_db)} dB off the written loudness, {limit_db:g} allowed"
    return Miss(PassFault.LOUDNESS, off_db, limit_db, words, sentence)


# --- a limb, or bars --------------------------------------------------------------------------------------------------

_LIMB_SAID: Mapping[PassFault, str] = MappingProxyType(
    {
        PassFault.RIGHT: "Your {name} has {value} % of its notes right; the goal is {limit}.",
        PassFault.SPREAD: "Your {name} spreads {value} ms; the goal is {limit}.",
        PassFault.LEAN: "Your {name} is {value} ms {side} on average; the goal is {limit}.",
        PassFault.LOUDNESS: "Your {name} is {value} dB off the written loudness on average; the goal is {limit}.",
    }
)
_BARS_SAID: Mapping[PassFault, str] = MappingProxyType(
    {
        PassFault.RIGHT: "In {name} {value} % of your notes are right; the goal is {limit}.",
        PassFault.SPREAD: "In {name} your strokes spread {value} ms; the goal is {limit}.",
        PassFault.LEAN: "In {name} you are {value} ms {side} on average; the goal is {limit}.",
        PassFault.LOUDNESS: "In {name} you are {value} dB off the written loudness on average; the goal is {limit}.",
        PassFault.TEMPO: "In {name} you play {value} % {speed} than the click; the goal is {limit}.",
    }
)
_BRIEFLY: Mapping[PassFault, str] = MappingProxyType(
    {
        PassFault.RIGHT: "{name}: {value} % right, {limit} needed",
        PassFault.SPREAD: "{name}: spread {value} ms, {limit} allowed",
        PassFault.LEAN: "{name}: {value} ms {side}, {limit} allowed",
        PassFault.LOUDNESS: "{name}: {value} dB off the written loudness, {limit} allowed",
        PassFault.TEMPO: "{name}: {value} % {speed} than the click, {limit} allowed",
    }
)
_LIMB_DO = " Play it alone with the click until it holds, then with the rest."
_BARS_DO = " Loop these bars alone, slower, until they hold."


def _of_part(result: PartResult, goals: PartGoals) -> Iterator[Miss]:
    if not result.notes:
        return
    share = result.right / result.notes
    if goals.min_accuracy is not None and share < goals.min_accuracy - _TINY:
        limit = f"{100 * goals.min_accuracy:g}"
        yield _part_miss(PassFault.RIGHT, result.part, share, goals.min_accuracy, f"{math.floor(100 * share)}", limit)
    for fault, value, limit_of in (
        (PassFault.SPREAD, result.sd_ms, goals.max_sd_ms),
        (PassFault.LEAN, result.lean_ms, goals.max_lean_ms),
        (PassFault.LOUDNESS, result.loudness_error_db, goals.max_loudness_error_db),
        (PassFault.TEMPO, result.tempo_error_pct, goals.max_tempo_error_pct),
    ):
        if (size := _beyond(value, 0.0, limit_of)) is not None and limit_of is not None:
            figure = _ms(size, limit_of) if fault in _IN_MS else _up(size)
            yield _part_miss(fault, result.part, size, limit_of, figure, f"{limit_of:g}")


_IN_MS = (PassFault.SPREAD, PassFault.LEAN)


def _part_miss(fault: PassFault, part: Part, value: float, limit: float, figure: str, goal: str) -> Miss:
    filled = {
        "name": part.name,
        "value": figure,
        "limit": goal,
        "side": _side(value),
        "speed": "faster" if value > 0 else "slower",
    }
    said, do = (_LIMB_SAID, _LIMB_DO) if part.bars is None else (_BARS_SAID, _BARS_DO)
    return Miss(fault, value, limit, _BRIEFLY[fault].format(**filled), said[fault].format(**filled) + do, part)


# --- figures ----------------------------------------------------------------------------------------------------------

_TINY = 1e-9
"""Keeps 0.9 · 50 from needing 46."""


def _beyond(value: float | None, centre: float, limit: float | None) -> float | None:
    """`value` where it lies farther from `centre` than `limit`; None where it does not, or one of them is unknown."""
    return value if value is not None and limit is not None and abs(value - centre) > limit else None


def _side(lean_ms: float) -> str:
    return "early" if lean_ms < 0 else "late"


def _ms(value: float, limit: float) -> str:
    """The size of what misses `limit` in whole ms: the nearest, as advice says it, or above where that seems enough."""
    nearest = round(abs(value))
    return f"{nearest if nearest > limit else math.ceil(abs(value))}"


def _up(value: float) -> str:
    """A size with a decimal, rounded away from the goal that it misses."""
    return f"{math.ceil(10 * abs(value) - _TINY) / 10:.1f}"
