"""The bars that stand on a sheet: those of the score with what comes again folded, and what stands at their lines."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from station.music.repeats import Ending, Passage, folded
from station.music.score import Score
from station.music.tempo import MeterChange
from station.render.notation.bar_lines import BarLine, Volta

_MOST_NUMBERS = 3
"""So many numbers stand above one bar, beyond that the first ones and the last (our choice)."""


@dataclass(frozen=True, slots=True)
class SheetBar:
    """Bar `bar` of the score, from 0, as it stands on the sheet.

    `number` is what it is called in all places where it is played, such as "1, 5" or "1–4", empty for a pick-up; `line`
    stands on its right;
    `opens_repeat`: a repeat sign on its left; `times` how often a passage without endings is played that ends with it,
    else 0; `meter` what is new before its notes; `in_phrase` counts from its phrase's first bar, 0.
    """

    bar: int
    number: str
    line: BarLine = BarLine.PLAIN
    opens_repeat: bool = False
    times: int = 0
    volta: Volta | None = None
    meter: MeterChange | None = None
    in_phrase: int = 0


def sheet_bars(
    score: Score, sections: Mapping[int, str], loop: tuple[int, int] | None = None, first_number: int = 1
) -> list[SheetBar]:
    """The bars in order; `sections` are names by the bars where they begin, `loop` the bars that are practised.

    The loop stands between repeat signs unless something within it is folded: signs within signs nobody reads.
    """
    apart = {loop[0], loop[1] + 1} if loop else set[int]()
    starts = apart | set(sections)
    bars: list[SheetBar] = []
    played = phrase = 0
    was_repeat = False
    for passage in folded(score, sections, apart):
        if passage.times > 1 or was_repeat or passage.first_bar in starts:
            phrase = passage.first_bar
        was_repeat = passage.times > 1
        for bar in _passage(passage, played + first_number):
            phrase = bar.bar if bar.bar in starts else phrase
            bars.append(replace(bar, in_phrase=bar.bar - phrase))
        played += passage.times * passage.pass_length
    bars = _with_lines(_with_loop(bars, loop), set(sections))
    has_pickup = first_number == 1 and score.tempo_map.pickup_ticks(score.end_tick) > 0
    return _with_meters([replace(bars[0], number=""), *bars[1:]] if has_pickup else bars, score, has_pickup)


@dataclass(frozen=True, slots=True)
class BarRun:
    """Bars `first_bar` to `last_bar` of a score that stand on the sheet once and are played `times` times.

    `passes`, from 1, say which passes of the run before these bars end; `has_endings`: such runs follow.
    """

    first_bar: int
    last_bar: int
    times: int = 1
    passes: tuple[int, ...] = ()
    has_endings: bool = False


def unfolded_bars(score: Score, runs: Sequence[BarRun]) -> list[SheetBar]:
    """The bars of `runs`, which cover the score in order, each as it is; they count from 1 in each run."""
    bars: list[SheetBar] = []
    for run, after in zip(runs, [*runs[1:], None], strict=True):
        is_last_ending = after is None or not after.passes
        bars += [_run_bar(run, bar, is_last_ending) for bar in range(run.first_bar, run.last_bar + 1)]
    return _with_meters(_with_lines(bars, {run.first_bar for run in runs}), score, has_pickup=False)


def _run_bar(run: BarRun, bar: int, is_last_ending: bool) -> SheetBar:
    is_first, is_last = bar == run.first_bar, bar == run.last_bar
    comes_back = (run.times > 1 and not run.has_endings) or (bool(run.passes) and not is_last_ending)
    text = f"{number_words(run.passes)}." if is_first and run.passes else ""
    return SheetBar(
        bar,
        str(bar - run.first_bar + 1),
        BarLine.REPEAT_END if is_last and comes_back else BarLine.PLAIN,
        opens_repeat=is_first and run.times > 1,
        times=run.times if is_last and run.times > 2 and not run.has_endings else 0,
        volta=Volta(text, is_first, is_last and not is_last_ending) if run.passes else None,
        in_phrase=bar - run.first_bar,
    )


def _passage(passage: Passage, number: int) -> Iterator[SheetBar]:
    """The bars of a passage whose first one is called `number`."""
    body, last = passage.last_bar - passage.first_bar + 1, passage.written_bars[-1]
    for bar in passage.written_bars:
        ending = next((e for e in passage.endings if e.first_bar <= bar <= e.last_bar), None)
        passes = ending.passes if ending else range(1, passage.times + 1)
        offset = bar - passage.first_bar if ending is None else body + bar - ending.first_bar
        numbers = [number + (k - 1) * passage.pass_length + offset for k in passes]
        returns = passage.times > 1 and (bar == passage.last_bar if ending is None else bar == ending.last_bar)
        if (ending is None and passage.endings) or (
            ending and passage.times in ending.passes and len(ending.passes) == 1
        ):
            returns = False  # into an ending, or out of the last one
        yield SheetBar(
            bar,
            number_words(numbers),
            BarLine.REPEAT_END if returns else BarLine.PLAIN,
            opens_repeat=passage.times > 1 and bar == passage.first_bar,
            times=passage.times if returns and not passage.endings and passage.times > 2 else 0,
            volta=_volta(ending, bar, bar == last) if ending else None,
        )


def _volta(ending: Ending, bar: int, is_last: bool) -> Volta:
    opens, ends = bar == ending.first_bar, bar == ending.last_bar
    return Volta(f"{_spans(ending.passes)}." if opens else "", opens, ends and not is_last)


def number_words(numbers: Sequence[int]) -> str:
    """Bar numbers as a sheet says them: "7", "1–4", "1, 5", "1, 5 … 13"."""
    if len(numbers) > 2 and numbers[-1] - numbers[0] == len(numbers) - 1:
        return _spans(numbers)
    if len(numbers) > _MOST_NUMBERS:
        return f"{numbers[0]}, {numbers[1]} … {numbers[-1]}"
    return ", ".join(map(str, numbers))


def _spans(numbers: Sequence[int]) -> str:
    return str(numbers[0]) if len(numbers) == 1 else f"{numbers[0]}–{numbers[-1]}"


def _with_loop(bars: list[SheetBar], loop: tuple[int, int] | None) -> list[SheetBar]:
    """The loop between repeat signs where nothing in it is folded."""
    if loop is None:
        return bars
    inside = [k for k, bar in enumerate(bars) if loop[0] <= bar.bar <= loop[1]]
    if any(bars[k].opens_repeat for k in inside) or not inside:
        return bars
    bars[inside[0]] = replace(bars[inside[0]], opens_repeat=True)
    bars[inside[-1]] = replace(bars[inside[-1]], line=BarLine.REPEAT_END)
    return bars


def _with_lines(bars: list[SheetBar], starts: set[int]) -> list[SheetBar]:
    """A double line before a section, and the last line at the end."""
    found = [
        replace(bar, line=BarLine.DOUBLE)
        if after.bar in starts and bar.line is BarLine.PLAIN and not after.opens_repeat and after.volta is None
        else bar
        for bar, after in pairwise(bars)
    ]
    last = bars[-1]
    return [*found, replace(last, line=BarLine.FINAL) if last.line is BarLine.PLAIN else last]


def _with_meters(bars: list[SheetBar], score: Score, has_pickup: bool) -> list[SheetBar]:
    """Each bar with its meter where another one stands before it, or where a repeat leads back to it from another.

    A pick-up has that of the bar after it.
    """
    meters = [score.tempo_map.meter_at(score.tempo_map.bar_start(bar.bar)) for bar in bars]
    if has_pickup:
        meters[0] = score.tempo_map.meter_at(score.tempo_map.bar_start(1))
    found = []
    for k, bar in enumerate(bars):
        befores = [meters[k - 1]] if k else []
        if bar.opens_repeat:
            ends = (j for j in range(k, len(bars)) if bars[j].line is BarLine.REPEAT_END)
            befores += [meters[next(ends, k)]] if k else []
        is_new = k == 0 or any(_signature(meters[k]) != _signature(before) for before in befores)
        found.append(replace(bar, meter=meters[k] if is_new else None))
    return found


def _signature(meter: MeterChange) -> tuple[int, int, tuple[int, ...]]:
    return meter.beats, meter.unit, meter.groups
