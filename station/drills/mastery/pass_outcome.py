"""What a pass did to an item's state, and the reason in words: one function for each kind of pass.

A reason is one sentence without its full stop; what is asked next may go on with it.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from types import MappingProxyType

from station.drills.mastery.mastery_state import Chunk, ItemState
from station.drills.mastery.pass_measures.pass_facts import PassResult
from station.drills.mastery.practice_steps import PassKind
from station.drills.mastery.rules import Rules
from station.drills.mastery.silent_bars import SilentBars
from station.drills.mastery.tempo_ladder import TOP_PCT, Ladder, Move
from station.drills.mastery.verdict import Grade, Verdict
from station.drills.mastery.weak_bars import WeakBar, tallied, weakest, without

After = tuple[ItemState, str]
"""The state after a pass, and why it is so."""


def after_pass(state: ItemState, result: PassResult, verdict: Verdict, rules: Rules) -> After:
    """The state after the pass `state.step`."""
    pct = state.step.pct
    state, why = _AFTER[state.step.kind](state, result, verdict, rules)
    if state.is_stable(rules):
        return replace(state, plateau=state.plateau.again(), gaps=_gaps(state, verdict, rules)), why
    is_lost = verdict.grade is Grade.BROKEN and pct <= rules.floor_pct
    passes = rules.passes_a_run if is_lost else 1
    reached = state.ladder.pct, state.mastery_pct, state.probes.in_a_row
    return replace(state, plateau=state.plateau.after(*reached, passes)), why


def _gaps(state: ItemState, verdict: Verdict, rules: Rules) -> SilentBars:
    """The click's silences; blind passes leave them as they are."""
    return state.gaps if state.step.is_probe else state.gaps.after(verdict.is_clean, rules)


# --- the whole --------------------------------------------------------------------------------------------------------


def _whole(state: ItemState, result: PassResult, verdict: Verdict, rules: Rules) -> After:
    """The ladder, the weak bars and the feedback; a blind pass counts like any other, and moves mastery."""
    tally = tallied(state.tally, result.bars, rules)
    if state.step.kind is PassKind.PROBE:
        state = replace(state, tally=tally, probes=state.probes.after(verdict.is_clean, state.pct, rules))
    else:
        fading = state.fading.after(verdict.is_clean, rules)
        state = replace(state, tally=tally, probes=state.probes.passed_by(), fading=fading)
    ladder, move = state.ladder.after(verdict.grade, rules)
    weak = weakest(tally, rules) if move is Move.DOWN and verdict.grade is not Grade.BROKEN else None
    if weak is not None:
        return _apart(state, weak, rules)
    if state.fixed_pct is not None:
        counted = replace(state, ladder=replace(ladder, pct=state.ladder.pct))
        return counted, f"{_capital(verdict.words)}; the tempo stays at {state.item.beats(state.pct)}"
    moved = replace(state, ladder=ladder, probes=state.probes.at_rung(ladder.pct))
    return moved, _ladder_words(state, ladder, move, verdict, rules)


def _apart(state: ItemState, weak: WeakBar, rules: Rules) -> After:
    """The weak bar alone, a step slower."""
    ladder = Ladder(state.pct) if state.fixed_pct is not None else state.ladder.lower(rules)
    share = f"{weak.faults:.0f} of the last {weak.of:.0f} mistakes"
    why = f"Bar {weak.bar + 1} holds {share}: alone at {state.item.beats(ladder.pct)}"
    chunk = Chunk(weak.bar, ladder, goal_pct=ladder.pct)
    return replace(state, ladder=state.ladder.resting(), chunk=chunk), why


def _ladder_words(state: ItemState, ladder: Ladder, move: Move, verdict: Verdict, rules: Rules) -> str:
    """Why the tempo is what it is."""
    now = f"{ladder.pct:g} %, {state.item.beats(ladder.pct)}"
    stays = ladder.pct == state.ladder.pct
    right = verdict.words if verdict.grade is Grade.LOOSE else "clean"
    if move is Move.UP and verdict.grade is Grade.LOOSE:
        return f"All right but for the {verdict.words}, which slow waits bring: on at {now}"
    if move is Move.UP:
        clean = f"Clean {_times(rules.clean_to_climb)}"
        return f"{clean} at the target tempo: stay" if stays else f"{clean}: up to {now}"
    if move is Move.DOWN:
        often = (
            "Too much went wrong"
            if verdict.grade is Grade.BROKEN
            else f"{_capital(_times(rules.bad_to_drop))} not clean"
        )
        wrong = f"{often} ({verdict.words})"
        return f"{wrong}: slower would not help, stay at {now}" if stays else f"{wrong}: down to {now}"
    return f"{_capital(right if move is Move.WAIT else verdict.words)}: once more at {now}"


# --- a weak bar -------------------------------------------------------------------------------------------------------


def _chunk(state: ItemState, result: PassResult, verdict: Verdict, rules: Rules) -> After:
    """The weak bar alone: back to the whole once it is clean at the whole's tempo, or after enough of it."""
    chunk = state.chunk
    assert chunk is not None, "a chunk was asked for"
    state = replace(state, fading=state.fading.after(verdict.is_clean, rules))
    is_good = verdict.grade in (Grade.CLEAN, Grade.LOOSE)
    clean = chunk.ladder.clean + 1 if is_good else 0
    is_there = clean >= rules.clean_to_return and chunk.ladder.pct >= chunk.goal_pct
    if is_there or chunk.passes + 1 >= rules.chunk_passes:
        return _returned(state, chunk, is_there, rules)
    ladder, move = chunk.ladder.after(verdict.grade, rules)
    if state.fixed_pct is not None:
        ladder, move = replace(ladder, pct=chunk.ladder.pct), Move.HOLD
    next_chunk = replace(chunk, ladder=ladder, passes=chunk.passes + 1)
    return replace(state, chunk=next_chunk), _chunk_words(state, next_chunk, move, verdict)


def _returned(state: ItemState, chunk: Chunk, is_there: bool, rules: Rules) -> After:
    back = Ladder(chunk.ladder.pct) if state.fixed_pct is None else state.ladder.resting()
    said = "is clean" if is_there else f"has had {chunk.passes + 1} passes"
    tally = without(state.tally, chunk.bar)
    state = replace(state, ladder=back, probes=state.probes.at_rung(back.pct), chunk=None, tally=tally)
    return state, f"Bar {chunk.bar + 1} {said}: back to the whole at {state.item.beats(state.pct)}"


def _chunk_words(state: ItemState, chunk: Chunk, move: Move, verdict: Verdict) -> str:
    bar, now = f"Bar {chunk.bar + 1}", state.item.beats(chunk.ladder.pct)
    if move is Move.UP:
        return f"{bar} is clean: up to {now}"
    if move is Move.DOWN:
        return f"{bar} goes wrong ({verdict.words}): down to {now}"
    return f"{bar}: {verdict.words}, once more at {now}"


# --- probes, variations and the rest ----------------------------------------------------------------------------------


def _target_probe(state: ItemState, result: PassResult, verdict: Verdict, rules: Rules) -> After:
    """Clean: straight to the target. Not clean: nothing is lost."""
    ladder = Ladder(TOP_PCT) if verdict.is_clean else state.ladder.resting()
    probes = replace(state.probes.after(verdict.is_clean, TOP_PCT, rules), tried_pct=ladder.pct)
    now = state.item.beats(ladder.pct)
    why = f"The target tempo is there: on at {now}" if verdict.is_clean else f"Not yet ({verdict.words}): back to {now}"
    return replace(state, ladder=ladder, probes=probes), why


def _review(state: ItemState, result: PassResult, verdict: Verdict, rules: Rules) -> After:
    """It stuck, or it is learnt once more from a step below the target."""
    review = state.review.after(verdict.is_clean, state.today, rules)
    probes = state.probes.after(verdict.is_clean, TOP_PCT, rules)
    if verdict.is_clean and state.review.level.rank < state.level.rank:  # it shows nothing of the narrower level
        probes = replace(probes, in_a_row=state.probes.in_a_row)
    if verdict.is_clean:
        return replace(state, review=review, probes=probes, ladder=Ladder(TOP_PCT)), "It stuck"
    ladder = Ladder(TOP_PCT).lower(rules)
    why = f"It has faded ({verdict.words}): again from {state.item.beats(ladder.pct)}"
    return replace(state, review=review, probes=probes.at_rung(ladder.pct), ladder=ladder), why


def _variation(state: ItemState, result: PassResult, verdict: Verdict, rules: Rules) -> After:
    """Off the target tempo nothing is won or lost."""
    fading = state.fading.after(verdict.is_clean, rules)
    state = replace(state, probes=state.probes.passed_by(), fading=fading, varied=state.varied + 1)
    return state, f"{_capital(verdict.words)} at {state.item.beats(state.step.pct)}"


def _leave(state: ItemState, result: PassResult, verdict: Verdict, rules: Rules) -> After:
    """The student plays on all the same."""
    return _whole(replace(state, plateau=state.plateau.again()), result, verdict, rules)


_AFTER: Mapping[PassKind, Callable[[ItemState, PassResult, Verdict, Rules], After]] = MappingProxyType(
    {
        PassKind.WHOLE: _whole,
        PassKind.PROBE: _whole,
        PassKind.CHUNK: _chunk,
        PassKind.TARGET_PROBE: _target_probe,
        PassKind.REVIEW: _review,
        PassKind.VARIATION: _variation,
        PassKind.LEAVE: _leave,
    }
)

_TIMES = MappingProxyType({1: "once", 2: "twice"})


def _times(count: int) -> str:
    return _TIMES.get(count, f"{count} times")


def _capital(words: str) -> str:
    return words[:1].upper() + words[1:]
