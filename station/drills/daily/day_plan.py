"""The plan of a day: a warm-up, what is due, what goes on or is new, and playing at the end. Pure.

Its order is the agenda's (`drills.mastery.agenda`): reviews that are due, the oldest first; what a teacher wants by
a day; what was begun and is not stable, the longest ago first, in a block each; something new where less than two
lessons are under way; and what is stable in turn (TEACHING: block until stable, then interleave).
Nothing is owed: what a day leaves undone is only there again the next day, in its place.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from station.drills.daily.asked import asked_in_turn, day_in_month
from station.drills.daily.blocks import Purpose, followed, steady, tempo_of_today, warm_up, weak_bars
from station.drills.daily.daily_items import DailyItem, DailyPlan, ItemKind
from station.drills.daily.day_facts import DayFacts
from station.drills.mastery.agenda import KEPT_WHY
from station.drills.mastery.mastery_state import ItemState
from station.drills.mastery.practice_steps import PracticeItem

BLOCK = 5
"""Minutes of a block (TEACHING: 5-minute blocks)."""
LEAST_BLOCK, MOST_BLOCK = 3, 7
"""What is left over is no block of its own below the first; our choice, as is the longest."""
REVIEW, KEPT = 2, 3
"""Minutes: a review is a blind pass or two, and a few more where it failed; TEACHING rotates items of 3 minutes."""
REVIEW_SHARE = 0.5
"""Reviews have at most this share of the time between warm-up and play while something else waits (our choice)."""
END_SHARE = 0.1
"""The share of a day that the warm-up has, and playing at the end (our choice: there is no evidence for either)."""
KEPT_SHARE = 0.25
"""What is stable has at most this share of the time between them while something is not (TEACHING: block until stable);
its reviews, which come besides, make it last (our choice)."""
UNDER_WAY = 2
"""So many lessons are learnt at a time; with less, a day begins another (our choice, by the trial in
docs/daily-plan.md)."""
MOST_ENDS = 5
"""Minutes of either at most."""
BACK_SHARE = 0.25
"""The warm-up's share of the first day after a long break (our choice)."""
WARM_UP_KINDS = ("rudiments", "hands", "rolls")
"""Folders of lessons for the hands alone."""
WARM_UP_DAYS = 3
"""So many days pass before a warm-up comes again, if there are others (our choice)."""
RANDOM_GAP = "random:20-40%"
"""The click of what holds without one for three bars of four already (TEACHING's last gap): nobody can count it out."""


def daily_plan(facts: DayFacts) -> DailyPlan:
    """The plan for the facts' day; equal facts give equal plans. Raises `BadInput` for minutes that no day has."""
    return _Day(facts.checked()).plan()


@dataclass
class _Day:
    """A day while it is filled: the blocks so far, and the lessons that they have."""

    facts: DayFacts
    core: list[DailyItem] = field(default_factory=list)

    def plan(self) -> DailyPlan:
        """All of it."""
        facts = self.facts
        ends = min(max(round(END_SHARE * facts.minutes), 1), MOST_ENDS)
        at_first = min(max(round(BACK_SHARE * facts.minutes), 1), MOST_ENDS) if facts.is_back else ends
        first = self._warm_up(at_first)
        self._fill(facts.minutes - ends - (0 if first is None else first.minutes), first)
        left = facts.minutes - sum(item.minutes for item in self.core) - (0 if first is None else first.minutes)
        return DailyPlan(facts.today, (*([] if first is None else [first]), *self.core, self._play(left)))

    # --- the two ends --------------------------------------------------------------------------------------------

    def _warm_up(self, minutes: int) -> DailyItem | None:
        facts = self.facts
        busy = {state.item.name for state in facts.turns(None).due} | {one.lesson for one in facts.assigned}
        held = {state.item.name: state for state in facts.states if state.is_settled(facts.rules)}
        names = [name for name in self._warm_up_names(held) if name not in busy]
        rested = [name for name in names if name not in facts.recent(ItemKind.WARM_UP, WARM_UP_DAYS)] or names
        facts.chance.shuffle(rested)
        for name in rested:
            item = facts.item_of(name, None)
            if item is not None:
                again = f"after {facts.days_away} days away, easily and a little longer" if facts.is_back else ""
                why = f"Hands and pulse first{f', {again}' if again else ''}: nothing is asked, let it be even."
                return warm_up(facts, item, name in held, minutes, why)
        return None

    def _warm_up_names(self, held: dict[str, ItemState]) -> list[str]:
        """Lessons for the hands that are held, with the easiest of the others while few are; else anything held."""
        rows = [row for row in self.facts.lessons.values() if row.folder in WARM_UP_KINDS]
        mastered = [row.name for row in rows if row.name in held]
        easiest = sorted((row for row in rows if row.name not in self.facts.begun), key=lambda row: row.difficulty)
        some = [*mastered, *(row.name for row in easiest[: max(WARM_UP_DAYS + 1 - len(mastered), 0)])]
        return some or list(held)

    def _play(self, minutes: int) -> DailyItem:
        """Something that goes well, without anything in it that is practised; what goes on, where nothing does yet."""
        facts, taken = self.facts, {item.lesson for item in self.core}
        for state in facts.turns(None).settled:
            if state.item.name not in taken and self._is_music(state.item.name):
                gap = self._gap(state)
                why = "To end with, something that goes well"
                how = ": the click drops out, keep the time." if gap else ": play it as music."
                return steady(facts, state.item, 100.0, Purpose(ItemKind.PLAY, minutes, why + how), gap)
        for item in reversed(self.core):
            known = facts.item_of(item.lesson, None)
            if known is not None:
                pct = tempo_of_today(facts, known, self._state(known))
                why = "To end with, the whole without stopping: play it as music."
                return steady(facts, known, pct, Purpose(ItemKind.PLAY, minutes, why))
        why = "To end with, whatever you like: nothing is judged."
        return DailyItem(ItemKind.PLAY, "", "Just play", (0, 0), 100.0, 100.0, "Yours.", minutes, 1, why)

    def _is_music(self, name: str) -> bool:
        rows = self.facts.lessons
        return name not in rows or rows[name].folder not in WARM_UP_KINDS

    def _gap(self, state: ItemState) -> str:
        """How the click of a stable item falls silent: as its level says, at random beyond the last."""
        rules = self.facts.rules
        gap = state.gaps.bars(rules)
        if gap is None:
            return ""
        if state.gaps.level < len(rules.gaps):
            return f"{gap[0]}/{gap[1]}"
        return f"{RANDOM_GAP}:{self.facts.chance.randrange(1000)}"

    # --- between them --------------------------------------------------------------------------------------------

    def _fill(self, minutes: int, first: DailyItem | None) -> None:
        """Fill `minutes` behind the warm-up `first`."""
        here = None if first is None else self.facts.item_of(first.lesson, None)
        turns = self.facts.turns(here)
        waits = [*self._asked(), *(self._on(state) for state in turns.fresh)]
        has_new = next(self._new(), None) is not None
        room = int(REVIEW_SHARE * minutes) if waits or has_new else minutes
        left = minutes - self._review(turns.due, max(room, min(REVIEW, minutes)))
        reviewed = {item.lesson for item in self.core}
        waits = [wanted for wanted in waits if wanted.item.name not in reviewed]
        for wanted in waits:
            left = self._block(wanted, left)
        if len({wanted.item.name for wanted in waits}) < UNDER_WAY:
            left = self._begin_new(left)
        kept = min(max(int(KEPT_SHARE * minutes), KEPT), left) if waits or has_new else left
        left += self._keep(turns.settled, kept, "" if first is None else first.lesson) - kept
        self._stretch(left)

    def _keep(self, settled: tuple[ItemState, ...], left: int, warm_up: str) -> int:
        """What is stable, in turn; returns what is left."""
        taken = {warm_up, *(item.lesson for item in self.core)}
        for state in settled:
            name = state.item.name
            if left >= KEPT and name not in taken and not state.review.is_due(self.facts.today):
                purpose = Purpose(ItemKind.KEEP, KEPT, _sentence(KEPT_WHY))
                self.core.append(followed(self.facts, state.item, state, purpose))
                taken.add(name)
                left -= KEPT
        return left

    def _review(self, due: tuple[ItemState, ...], minutes: int) -> int:
        """Reviews in `minutes`, the oldest first; returns what they take."""
        chosen = due[: minutes // REVIEW]
        for state in chosen:
            assert state.review.due is not None, "it is due"
            late = (self.facts.today - state.review.due).days
            since = "today" if late == 0 else f"since {day_in_month(state.review.due)}"
            why = f"Mastered on {day_in_month(state.review.mastered_on or state.today)}; its review is due {since}."
            self.core.append(followed(self.facts, state.item, state, Purpose(ItemKind.DUE, REVIEW, why)))
        return REVIEW * len(chosen)

    def _asked(self) -> list["_Wanted"]:
        """What a teacher wants that is not settled, the nearest day first."""
        facts = self.facts
        waits = asked_in_turn(facts.assigned, facts.item_of, facts.states, facts.today, facts.rules)
        return [
            _Wanted(one.item, one.state, 2 * BLOCK if one.is_pressing else BLOCK, _sentence(one.why)) for one in waits
        ]

    def _on(self, state: ItemState) -> "_Wanted":
        why = "Not stable yet, so on with it"
        if state.item.name in self.facts.left_over:
            why += "; there was no time for it last time"
        return _Wanted(state.item, state, BLOCK, f"{why}.")

    def _block(self, wanted: "_Wanted", left: int) -> int:
        """A block or two of what is wanted, its weak bars before the whole; returns what is left."""
        if left < LEAST_BLOCK or any(item.lesson == wanted.item.name for item in self.core):
            return left
        minutes = min(wanted.minutes, left)
        if left - minutes < LEAST_BLOCK and left <= MOST_BLOCK:
            minutes = left
        weak = weak_bars(self.facts, wanted.state, LEAST_BLOCK) if wanted.state and minutes >= LEAST_BLOCK + 2 else None
        if weak is not None:
            self.core.append(weak)
        rest = minutes - (0 if weak is None else weak.minutes)
        kind = ItemKind.NEW if wanted.state is None else ItemKind.GO_ON
        self.core.append(followed(self.facts, wanted.item, wanted.state, Purpose(kind, rest, wanted.why)))
        return left - minutes

    def _begin_new(self, left: int) -> int:
        """A new lesson where there is one; returns what is left."""
        item, why = next(self._new(), (None, ""))
        if item is None or left < LEAST_BLOCK:
            return left
        return self._block(_Wanted(item, None, MOST_BLOCK, why), left)

    def _new(self) -> Iterator[tuple[PracticeItem, str]]:
        """What was never practised: what the course has next, else the easiest whose prerequisites were begun."""
        facts = self.facts
        for name in facts.course_lessons:
            if name not in facts.begun and (item := facts.item_of(name, None)) is not None:
                yield item, f"Something new: it comes next in {facts.course}."
        for name, row in facts.lessons.items():
            is_for_hands = row.folder in WARM_UP_KINDS
            if name in facts.begun or is_for_hands or not facts.begun.issuperset(row.prerequisites):
                continue
            if (item := facts.item_of(name, None)) is not None:
                yield item, "Something new: the easiest that you have not begun."

    def _stretch(self, left: int) -> None:
        """Give minutes that nothing else wants to the blocks that they help most; the rest is for playing."""
        for kind in (ItemKind.NEW, ItemKind.GO_ON, ItemKind.KEEP):
            for index, item in enumerate(self.core):
                more = min(left, MOST_BLOCK - item.minutes) if item.kind is kind else 0
                if more > 0:
                    passes = round(item.passes * (item.minutes + more) / item.minutes)
                    self.core[index] = replace(item, minutes=item.minutes + more, passes=passes)
                    left -= more
        self._again(left)

    def _again(self, left: int) -> None:
        """A second block of what is learnt today, where there is time for one: a breath lies between."""
        learnt = next((item for item in self.core if item.kind in (ItemKind.NEW, ItemKind.GO_ON)), None)
        known = None if learnt is None else self.facts.item_of(learnt.lesson, None)
        if known is not None and left >= LEAST_BLOCK:
            purpose = Purpose(ItemKind.GO_ON, min(left, MOST_BLOCK), "Once more after a breath: from where it was.")
            self.core.append(followed(self.facts, known, self._state(known), purpose))

    def _state(self, item: PracticeItem) -> ItemState | None:
        return next((state for state in self.facts.states if state.item == item), None)


@dataclass(frozen=True, slots=True)
class _Wanted:
    """A block that waits: its item, what is remembered of it, and why."""

    item: PracticeItem
    state: ItemState | None
    minutes: int
    why: str


def _sentence(words: str) -> str:
    return f"{words[0].upper()}{words[1:]}."
