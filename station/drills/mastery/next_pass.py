"""The mastery policy for one item: how the last pass went in, the next pass and its reason out.

A state machine without clock, device or chance: identical inputs give identical steps. It speaks only between passes,
so that no tempo ever changes in mid-pass. `begin` opens a day, `next_step` answers each pass, `veto` refuses its
answer, `fix_tempo` is the switch that pins the tempo. `rules` has the numbers, docs/mastery.md the reasons.
"""

from dataclasses import replace
from datetime import date

from station.drills.mastery.feedback_fading import Feedback
from station.drills.mastery.mastery_state import Before, ItemState
from station.drills.mastery.pass_measures.pass_facts import PassResult
from station.drills.mastery.pass_outcome import after_pass
from station.drills.mastery.plateau import Plateau
from station.drills.mastery.practice_steps import PROBES, PassKind, PracticeItem, PracticeStep
from station.drills.mastery.probes import Probes
from station.drills.mastery.rules import DEFAULT_RULES, Rules
from station.drills.mastery.tempo_ladder import TOP_PCT, Ladder
from station.drills.mastery.verdict import judge

# --- a day's beginning ------------------------------------------------------------------------------------------------


def new_item(item: PracticeItem, today: date, rules: Rules = DEFAULT_RULES) -> ItemState:
    """An item that was never practised, with its first step."""
    ladder = Ladder(rules.start_pct)
    step = PracticeStep(PassKind.WHOLE, ladder.pct, item.bpm(ladder.pct), item.bars, 1, Feedback.TIMING, "")
    blank = ItemState(item, step, today, ladder, Probes(ladder.pct), Plateau(ladder.pct))
    return _asked(blank, f"A start at {ladder.pct:g} % of the tempo, {item.beats(ladder.pct)}", rules)


def begin(state: ItemState, today: date, rules: Rules = DEFAULT_RULES) -> ItemState:
    """The state as a day opens: a review that is due comes first, the rest goes on a step below where it ended.

    On the same day it goes on where it was.
    """
    if state.review.is_due(today) and state.fixed_pct is None:
        opened = _opened(state, state.ladder.resting(), today)
        judged = "" if state.review.level is state.level else f", and judged as {state.review.level}"
        why = f"Some days have passed: does it still stick? This one is blind{judged}"
        return _with(opened, PassKind.REVIEW, TOP_PCT, why, rules)
    if state.today == today:
        here = _opened(state, state.ladder.resting(), today)
        return _asked(here, f"On from where it was, {state.item.beats(here.pct)}", rules)
    start = min(rules.start_pct, state.ladder.pct)
    ladder = Ladder(state.ladder.pct if state.is_stable(rules) else max(state.ladder.pct - rules.down_pct, start))
    return _asked(_opened(state, ladder, today), f"Another day: a start at {state.item.beats(ladder.pct)}", rules)


def _opened(state: ItemState, ladder: Ladder, today: date) -> ItemState:
    probes = state.probes.at_rung(ladder.pct)
    return replace(
        state, today=today, ladder=ladder, probes=probes, chunk=None, before=None, plateau=state.plateau.again()
    )


# --- between passes ---------------------------------------------------------------------------------------------------


def next_step(state: ItemState, result: PassResult, rules: Rules = DEFAULT_RULES) -> tuple[ItemState, PracticeStep]:
    """What to play after the pass `result`, which answered `state.step`."""
    if result.is_silent:
        return state, replace(state.step, why="Nothing was played: the same again.", notice=None)
    equipment, notice = state.equipment.after(result, rules)
    rewired = equipment.swap != state.equipment.swap
    state = replace(state, equipment=equipment, before=Before(state.ladder, state.chunk))
    if rewired:
        state, why = replace(state, tally=()), "The pads were mixed up, so that this pass says nothing: once more"
    else:
        state, why = after_pass(state, result, judge(result, rules), rules)
    if state.is_stable(rules):
        state = replace(state, review=state.review.mastered(state.today, state.level, rules))
    state = _asked(state, why, rules)
    state = replace(state, step=replace(state.step, notice=notice))
    return state, state.step


def veto(state: ItemState, rules: Rules = DEFAULT_RULES) -> tuple[ItemState, PracticeStep]:
    """The student refuses what was proposed: the last pass once more, and the counting starts anew."""
    if state.before is None:
        return state, state.step
    kind, probes = state.step.kind, state.probes
    if kind is PassKind.TARGET_PROBE:
        probes = replace(probes, tried_pct=state.ladder.pct)
    elif kind in PROBES:
        probes = replace(probes, since=0)
    chunk = state.before.chunk
    kept = replace(
        state,
        ladder=state.before.ladder.resting(),
        chunk=chunk and replace(chunk, ladder=chunk.ladder.resting()),
        probes=probes,
        plateau=state.plateau.again(),
        before=None,
    )
    return _replied(kept, "As you wish: all stays as it was", rules)


def fix_tempo(
    state: ItemState, tempo_bpm: float | None, rules: Rules = DEFAULT_RULES
) -> tuple[ItemState, PracticeStep]:
    """Pin the tempo (quarter notes a minute), or with None let it go: the ladder goes on from there."""
    if tempo_bpm is not None:
        pinned = replace(state, fixed_pct=100.0 * tempo_bpm / state.item.target_bpm, chunk=None, before=None)
        return _replied(pinned, f"The tempo stays at {state.item.beats(pinned.pct)}, as you asked", rules)
    ladder = Ladder(min(max(state.pct, rules.floor_pct), TOP_PCT))
    freed = replace(state, fixed_pct=None, ladder=ladder, probes=state.probes.at_rung(ladder.pct), chunk=None)
    return _replied(freed, f"The tempo is free again, from {state.item.beats(ladder.pct)}", rules)


# --- what comes next --------------------------------------------------------------------------------------------------


def _asked(state: ItemState, why: str, rules: Rules) -> ItemState:
    """The state with its next step: the kinds in order of precedence."""
    is_free = state.fixed_pct is None
    if state.plateau.is_reached(rules):
        runs = f"{rules.runs_to_leave} runs brought no step forward: leave it for today, sleep helps"
        return _with(replace(state, chunk=None), PassKind.LEAVE, state.pct, runs, rules)
    if state.chunk is not None:
        return _with(state, PassKind.CHUNK, state.chunk.ladder.pct, why, rules)
    if is_free and state.probes.is_target_due(state.ladder.pct, rules):
        tried = f"{why}; now {rules.rungs_a_target_probe} rungs up, the target tempo once, blind"
        return _with(state, PassKind.TARGET_PROBE, TOP_PCT, tried, rules)
    if state.probes.is_due(rules):
        return _with(state, PassKind.PROBE, state.pct, f"{why}; this one is blind, to see what stays", rules)
    if is_free and state.is_stable(rules) and state.ladder.pct == TOP_PCT:
        return _varied(state, why, rules)
    return _with(state, PassKind.WHOLE, state.pct, why, rules)


def _varied(state: ItemState, why: str, rules: Rules) -> ItemState:
    """A stable item: a little faster, a little slower, on the other cymbal if it may, as written, and again."""
    turns = [(rules.vary_pct, "a little faster"), (-rules.vary_pct, "a little slower"), (0.0, "")]
    if state.item.can_reorchestrate:
        turns.insert(2, (0.0, "on the other cymbal"))
    off_pct, how = turns[state.varied % len(turns)]
    if not how:
        return _with(replace(state, varied=state.varied + 1), PassKind.WHOLE, state.pct, why, rules)
    varied = _with(state, PassKind.VARIATION, TOP_PCT + off_pct, f"{why}; now {how}, so that it holds anywhere", rules)
    return replace(varied, step=replace(varied.step, reorchestrated=off_pct == 0.0))


def _with(state: ItemState, kind: PassKind, pct: float, why: str, rules: Rules) -> ItemState:
    bars = state.item.bars if state.chunk is None else _chunk_bars(state.item, state.chunk.bar, rules)
    feedback = Feedback.NONE if kind in PROBES else state.fading.feedback(rules)
    item, gap = state.item, state.gaps.bars(rules) if kind in _GAPPED and state.is_stable(rules) else None
    if gap is not None:
        why = f"{why}; the click sounds for {_bars(gap[0])} and is silent for {_bars(gap[1])}: keep the time"
    step = PracticeStep(kind, pct, item.bpm(pct), bars, item.repeats(bars, rules, gap), feedback, f"{why}.", gap=gap)
    return replace(state, step=step)


_GAPPED = frozenset({PassKind.WHOLE, PassKind.VARIATION})


def _bars(count: int) -> str:
    return "1 bar" if count == 1 else f"{count} bars"


def _replied(state: ItemState, why: str, rules: Rules) -> tuple[ItemState, PracticeStep]:
    """The plain step of a state that the student has set: no probe, no variation."""
    kind, pct = (PassKind.CHUNK, state.chunk.ladder.pct) if state.chunk else (PassKind.WHOLE, state.pct)
    state = _with(state, kind, pct, why, rules)
    return state, state.step


def _chunk_bars(item: PracticeItem, bar: int, rules: Rules) -> tuple[int, int]:
    first, last = item.bars
    return max(min(bar, last - rules.chunk_bars + 1), first), min(bar + rules.chunk_bars - 1, last)
