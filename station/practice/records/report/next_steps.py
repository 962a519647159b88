"""What comes after a result: steps that can be begun, the best one first. One answer, for words and for buttons.

Where nothing stood out the tempo goes up by the rung of the mastery policy's ladder, or the next lesson comes; where
something did, its bars come alone and slower, as the advice says. Pure: an assessment document, what was measured and
what was practised in. `session.steps` of a report holds them (docs/documents.md).
"""

from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from enum import StrEnum
from math import ceil, floor

from station.core.errors import BadInput
from station.core.units import PPQ
from station.drills.library import find_lesson
from station.drills.mastery.agenda import Turn
from station.drills.mastery.goals_missed import Miss, PassFault, missed_goals
from station.drills.mastery.pass_measures.pass_facts import PassResult
from station.drills.mastery.rules import Rules
from station.drills.mastery.tempo_ladder import TOP_PCT, Ladder
from station.drills.mastery.verdict import Grade
from station.practice.session.plan import MAX_TEMPO_BPM, MIN_TEMPO_BPM, Plan
from station.scoring.report.assessment_document import Json

MOST = 4
"""More one does not choose from at a glance, and a kit has hardly more pads under the hands (our choice)."""
SAME_TEMPO = 0.01
"""Tempi that nobody tells apart (our choice)."""


class StepKind(StrEnum):
    """What a step does."""

    TEMPO = "tempo"
    """The same bars at another tempo."""
    BARS = "bars"
    """Some bars alone, or all again."""
    AGAIN = "again"
    """The same once more."""
    LESSON = "lesson"
    """Another lesson."""
    BLOCK = "block"
    """The next block of the day's plan."""


@dataclass(frozen=True, slots=True)
class NextStep:
    """A step and its reason in a line.

    `tempo_bpm` counts quarter notes, `bars` (first, last) from 1, each None where it stays; `lesson` is the one to
    turn to by name, `place` the block of the day's plan, from 0.
    """

    kind: StepKind
    label: str
    why: str = ""
    tempo_bpm: float | None = None
    bars: tuple[int, int] | None = None
    lesson: str = ""
    place: int | None = None


def steps_document(steps: Iterable[NextStep]) -> list[Json]:
    """The steps as a report keeps them."""
    return [{**asdict(step), "bars": None if step.bars is None else [*step.bars]} for step in steps]


def steps_in(document: dict[str, Json]) -> tuple[NextStep, ...]:
    """The steps of a report of ours; none where it has none."""
    session = document.get("session")
    rows = session.get("steps", []) if isinstance(session, dict) else []
    assert isinstance(rows, list), "the report is ours"
    return tuple(_step_in(row) for row in rows if isinstance(row, dict))


def _step_in(row: dict[str, Json]) -> NextStep:
    bars = row["bars"]
    first_last = (int(bars[0]), int(bars[1])) if isinstance(bars, list) else None  # type: ignore[arg-type] # our own
    return NextStep(**{**row, "kind": StepKind(str(row["kind"])), "bars": first_last})  # type: ignore[arg-type] # our own


# --- practice whose tempo stays ---------------------------------------------------------------------------------------


def next_steps(
    document: dict[str, Json], plan: Plan, measured: PassResult, following: Turn | None = None, is_whole: bool = True
) -> tuple[NextStep, ...]:
    """What comes after `plan`; `following` is the lesson to turn to, `is_whole` whether it was played to its end."""
    counts = document["counts"]
    assert isinstance(counts, dict), "the report is ours"
    if not counts["notes"] or not counts["hits"]:
        return (again("nothing was heard"),)
    if drills := advised(document, plan):
        return _kept((*drills, again(), *_lesson(following)))
    rules = Rules().for_lesson(plan.lesson, plan.level)
    if missed := missed_goals(measured, rules):
        return _kept((*_after_miss(missed[0], plan, rules), *_lesson(following)))
    if not is_whole:
        return _kept((again("play it once to its end"), *_lesson(following)))
    return _kept((*_onwards(plan, rules, following), again(), *_lesson(following)))


def advised(document: dict[str, Json], plan: Plan) -> tuple[NextStep, ...]:
    """What the advice asks for, each once."""
    rows = document["advice"]
    assert isinstance(rows, list), "the report is ours"
    steps = [_advised(row, plan) for row in rows if isinstance(row, dict)]
    return tuple(dict.fromkeys(step for step in steps if step is not None))


def _advised(row: dict[str, Json], plan: Plan) -> NextStep | None:
    drill = row.get("drill")
    if not isinstance(drill, dict):
        return None
    said = str(row["text"])
    why, beats = said.rpartition(": ")[0] or said, drill["tempo_bpm"]
    assert isinstance(beats, float | int), "the report is ours"
    bars = drill["bars"]
    first, last = (int(bars[0]), int(bars[1])) if isinstance(bars, list) else _bars(plan)  # type: ignore[arg-type] # our own
    return _at(plan, float(beats), (first, last), why)


def _after_miss(miss: Miss, plan: Plan, rules: Rules) -> tuple[NextStep, ...]:
    """What a goal that was missed asks for, as its sentence has it."""
    lower = _ladder(plan).lower(rules).pct * plan.lesson.target_tempo_bpm / 100.0 / _beat_quarters(plan)
    slower = _at(plan, lower, _bars(plan), "until it holds")
    if miss.part is not None and miss.part.bars is not None:
        first, last = miss.part.bars
        return _at(plan, lower, (first + 1, last + 1), miss.words), again()
    if miss.fault is PassFault.PADS:
        return _at(plan, lower, _bars(plan), miss.words), again()
    return (again(miss.words), slower) if miss.fault in (PassFault.RIGHT, PassFault.SPREAD) else (again(miss.words),)


def _onwards(plan: Plan, rules: Rules, following: Turn | None) -> tuple[NextStep, ...]:
    """What comes where nothing stood out and no goal was missed."""
    loop = plan.lesson.loop
    whole = (loop[0] + 1, loop[1] + 1)
    back = (_at(plan, plan.beats_a_minute, whole, "these bars hold"),) if _is_part(plan.bars, loop) else ()
    target = plan.lesson.target_tempo_bpm
    if plan.tempo_bpm < target * (1 - SAME_TEMPO):
        up, _ = Ladder(_ladder(plan).pct, clean=rules.clean_to_climb - 1).after(Grade.CLEAN, rules)
        raised = _tempo(plan, up.pct * target / 100.0, "nothing stands out")
        own = target * (1 - SAME_TEMPO) > (raised.tempo_bpm or target) and plan.lesson.band is not None
        return (raised, *back, *((_tempo(plan, target, "the song's own tempo"),) if own else ()))
    lesson = _lesson(following)
    goes_on = plan.lesson.band is None and _within(plan, MAX_TEMPO_BPM / _beat_quarters(plan)) > plan.beats_a_minute
    faster = (_tempo(plan, plan.tempo_bpm + rules.up_pct * target / 100.0),) if goes_on else ()
    return (*lesson, *back, *faster) if lesson or back or faster else (again("nothing stands out"),)


# --- practice that follows the student --------------------------------------------------------------------------------


def followed_steps(
    document: dict[str, Json], plan: Plan, go_on: NextStep, turn: Turn | None, other: Turn | None
) -> tuple[NextStep, ...]:
    """What comes after passes that followed the student: what the agenda says, `turn` where it turns away, else on.

    `plan` is that of their first pass, `go_on` the same lesson from where it was, `other` another that the student may
    turn to.
    """
    counts = document["counts"]
    assert isinstance(counts, dict), "the report is ours"
    if not counts["notes"] or not counts["hits"]:
        return (again("nothing was heard"),)
    drills = [step for step in advised(document, plan) if step.kind is StepKind.BARS]
    if turn is not None and turn.item.name != plan.lesson.name:
        return _kept((*_lesson(turn), go_on, *drills))
    return _kept((go_on, *drills, *_lesson(other)))


def block_step(place: int, title: str, why: str) -> NextStep:
    """A block of the day's plan, from 0."""
    return NextStep(StepKind.BLOCK, f"Next block: {title.partition(':')[0]}", why, place=place)


def with_block(steps: Sequence[NextStep], block: NextStep) -> tuple[NextStep, ...]:
    """The steps after a block of the day's plan: its next block first."""
    return _kept((block, *(step for step in steps if step.kind is not StepKind.LESSON)))


# --- single steps -----------------------------------------------------------------------------------------------------


def again(why: str = "") -> NextStep:
    """The same once more."""
    return NextStep(StepKind.AGAIN, "Once more", why)


def _lesson(turn: Turn | None) -> tuple[NextStep, ...]:
    if turn is None:
        return ()
    first, last = turn.item.bars
    bars = None if (first, last) == _loop_of(turn.item.name) else (first + 1, last + 1)
    title = title_of(turn.item.name)
    return (NextStep(StepKind.LESSON, f"Next: {title}", turn.why, lesson=turn.item.name, bars=bars),)


def title_of(name: str) -> str:
    """The title of the lesson of that name before its colon, or the name where it does not ship."""
    try:
        return find_lesson(name).title.partition(":")[0]
    except BadInput:
        return name


def _loop_of(name: str) -> tuple[int, int] | None:
    try:
        return find_lesson(name).loop
    except BadInput:
        return None


def _at(plan: Plan, beats: float, bars: tuple[int, int], why: str) -> NextStep:
    """These bars (from 1) at so many beats a minute: once more, at another tempo, or bars of their own."""
    beats = _within(plan, beats)
    is_same_tempo = abs(beats - plan.beats_a_minute) <= SAME_TEMPO * beats
    if bars == _bars(plan):
        return again(why) if is_same_tempo else _tempo(plan, beats * _beat_quarters(plan), why)
    quarters = plan.tempo_bpm if is_same_tempo else beats * _beat_quarters(plan)
    return NextStep(StepKind.BARS, f"{_bar_words(bars, plan)} at {beats:.0f} bpm", why, quarters, bars)


def _tempo(plan: Plan, tempo_bpm: float, why: str = "") -> NextStep:
    """The same bars at so many quarter notes a minute, to the nearest whole beat."""
    beats = _within(plan, tempo_bpm / _beat_quarters(plan))
    words = "Raise the tempo" if beats > plan.beats_a_minute else "Slower"
    return NextStep(StepKind.TEMPO, f"{words}: {beats:.0f} bpm", why, beats * _beat_quarters(plan))


def _within(plan: Plan, beats: float) -> float:
    quarters = _beat_quarters(plan)
    return float(min(max(round(beats), ceil(MIN_TEMPO_BPM / quarters)), floor(MAX_TEMPO_BPM / quarters)))


def _beat_quarters(plan: Plan) -> float:
    return plan.lesson.beat_ticks / PPQ


def _ladder(plan: Plan) -> Ladder:
    return Ladder(min(100.0 * plan.tempo_bpm / plan.lesson.target_tempo_bpm, TOP_PCT))


def _bars(plan: Plan) -> tuple[int, int]:
    """First and last bar from 1."""
    return plan.bars[0] + 1, plan.bars[1] + 1


def _is_part(bars: tuple[int, int], of: tuple[int, int]) -> bool:
    return bars != of and of[0] <= bars[0] and bars[1] <= of[1]


def _bar_words(bars: tuple[int, int], plan: Plan) -> str:
    if bars == (plan.lesson.loop[0] + 1, plan.lesson.loop[1] + 1):
        return "All bars"
    return f"Bar {bars[0]}" if bars[0] == bars[1] else f"Bars {bars[0]}–{bars[1]}"


def _kept(steps: Iterable[NextStep]) -> tuple[NextStep, ...]:
    """The first of them, each label once."""
    first: dict[str, NextStep] = {}
    for step in steps:
        first.setdefault(step.label, step)
    return tuple(first.values())[:MOST]
