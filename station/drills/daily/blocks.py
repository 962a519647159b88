"""One block of a day's plan: which bars of an item, at which tempo, how often, and with which click."""

from dataclasses import dataclass
from datetime import date
from math import ceil

from station.drills.daily.daily_items import DailyItem, ItemKind
from station.drills.daily.day_facts import DayFacts
from station.drills.mastery.mastery_state import ItemState
from station.drills.mastery.next_pass import begin, new_item
from station.drills.mastery.practice_steps import PracticeItem, PracticeStep
from station.drills.mastery.rules import Rules
from station.drills.mastery.weak_bars import weakest

COUNT_IN_BARS = 1
"""Most lessons count in a bar (`Lesson.count_in_bars`); the others are a few seconds off."""
MOST_PASSES = 32
"""What the window's slider has (`app.selection.MAX_LOOPS`)."""
SLOWER_PCT = 10.0
"""So much below the tempo of the day weak bars begin, to rise to it: two rungs of the ladder (our choice)."""
RISE_BPM, RISE_BARS = 4, 4
"""Our choice: a step that is hardly felt (5 % of 80 bpm, TEACHING's step), every phrase."""
WARM_UP_PCTS = 60.0, 80.0
"""Where a warm-up begins and ends: below the tempo at which anything is learnt (TEACHING: 70 to 75 %)."""
HELD_WARM_UP_PCTS = 70.0, 95.0
"""The same of what is mastered."""


@dataclass(frozen=True, slots=True)
class Purpose:
    """What a block is for, how long it takes, and why it is there."""

    kind: ItemKind
    minutes: int
    why: str


def followed(facts: DayFacts, item: PracticeItem, state: ItemState | None, purpose: Purpose) -> DailyItem:
    """A block whose tempo follows the student, from where the mastery policy begins today."""
    step = _first_step(item, state, facts.today, facts.rules)
    pass_s = sum(item.bar_s[bar - item.first_bar] for bar in step.bar_names) + _bar_s(item)
    return DailyItem(
        kind=purpose.kind,
        lesson=item.name,
        title=facts.title(item.name),
        bars=item.bars,
        tempo_pct=step.pct,
        beats_a_minute=_beats(item, step.pct),
        tempo_why=step.why,
        minutes=purpose.minutes,
        passes=_passes(purpose.minutes, pass_s * 100.0 / step.pct),
        why=purpose.why,
        gap="" if step.gap is None else f"{step.gap[0]}/{step.gap[1]}",
    )


def weak_bars(facts: DayFacts, state: ItemState, minutes: int) -> DailyItem | None:
    """The bar of a begun item that goes wrong, slowly, then up to the tempo of the day; None where none stands out."""
    weak = weakest(state.tally, facts.rules)
    item = state.item
    if weak is None or not item.bars[0] <= weak.bar <= item.bars[1]:
        return None
    top_pct = _first_step(item, state, facts.today, facts.rules).pct
    bars = max(weak.bar - 1, item.bars[0]), weak.bar  # with the way into it
    share = f"bar {weak.bar + 1} had {weak.faults:.0f} of the {weak.of:.0f} mistakes of late"
    why = f"{share[0].upper()}{share[1:]}: alone and slowly before the whole."
    pcts = max(top_pct - SLOWER_PCT, facts.rules.floor_pct), top_pct
    return rising(facts, item, bars, pcts, Purpose(ItemKind.WEAK_BARS, minutes, why))


def warm_up(facts: DayFacts, item: PracticeItem, is_held: bool, minutes: int, why: str) -> DailyItem:
    """A block that begins below all effort and rises a little."""
    pcts = HELD_WARM_UP_PCTS if is_held else WARM_UP_PCTS
    return rising(facts, item, item.bars, pcts, Purpose(ItemKind.WARM_UP, minutes, why))


def rising(
    facts: DayFacts, item: PracticeItem, bars: tuple[int, int], pcts: tuple[float, float], purpose: Purpose
) -> DailyItem:
    """A block at a tempo that rises from the first of `pcts` of the target to the second."""
    first, top = (round(_beats(item, pct)) for pct in pcts)
    length_s = sum(item.bar_s[bar - item.first_bar] for bar in range(bars[0], bars[1] + 1))
    middle = (first + top) / 2.0 / _beats(item, 100.0)
    rise = f"{RISE_BPM}/{RISE_BARS}:{top}" if top > first else ""
    slowly = f"It begins at {first} bpm, {first / _beats(item, 100.0):.0%} of the target"
    return DailyItem(
        kind=purpose.kind,
        lesson=item.name,
        title=facts.title(item.name),
        bars=bars,
        tempo_pct=100.0 * first / _beats(item, 100.0),
        beats_a_minute=first,
        tempo_why=f"{slowly}, and rises to {top}." if rise else f"{slowly}.",
        minutes=purpose.minutes,
        passes=_passes(purpose.minutes, length_s / middle),
        why=purpose.why,
        rise=rise,
    )


def steady(facts: DayFacts, item: PracticeItem, pct: float, purpose: Purpose, gap: str = "") -> DailyItem:
    """A block at one tempo."""
    return DailyItem(
        kind=purpose.kind,
        lesson=item.name,
        title=facts.title(item.name),
        bars=item.bars,
        tempo_pct=pct,
        beats_a_minute=_beats(item, pct),
        tempo_why="The target tempo." if pct == 100.0 else "The tempo of the day, and it stays.",
        minutes=purpose.minutes,
        passes=_passes(purpose.minutes, sum(item.bar_s) * 100.0 / pct),
        why=purpose.why,
        gap=gap,
    )


def tempo_of_today(facts: DayFacts, item: PracticeItem, state: ItemState | None) -> float:
    """Where the mastery policy begins today, percent of the target."""
    return _first_step(item, state, facts.today, facts.rules).pct


def _first_step(item: PracticeItem, state: ItemState | None, today: date, rules: Rules) -> PracticeStep:
    opened = new_item(item, today, rules) if state is None else begin(state, today, rules)
    return opened.step


def _beats(item: PracticeItem, pct: float) -> float:
    return round(item.bpm(pct) / item.beat_quarters, 1)


def _bar_s(item: PracticeItem) -> float:
    return COUNT_IN_BARS * sum(item.bar_s) / len(item.bar_s)


def _passes(minutes: int, pass_s: float) -> int:
    return min(max(ceil(60.0 * minutes / max(pass_s, 1.0)), 1), MOST_PASSES)
