"""Spells one voice of a whole bar: its beat groups, long notes, tuplets over several beats, rests and what beams join.

What is held to, after Gould, "Behind Bars" (2011), on grouping:
* A voice that is silent for the bar is left to the caller (a whole-bar rest, or nothing); one that is written is
  written to its end: its notes and rests add up to the bar.
* No value crosses from one beat group to the next, but a held roll and a tuplet over several beats; and those do not
  hide the middle of a bar of four beats, unless they fill the bar or begin it.
* Silent beats share a rest where they are half a bar of four; three beats have a rest each.
* Eighths alone, two to a beat, share a beam over half a bar of four, as drum books have them; everything else is
  beamed beat by beat.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

from station.core.units import PPQ
from station.music.beat_groups import COMPOUND, beat_groups
from station.music.tempo import MeterChange
from station.render.notation.spelling.beat_divisions import tuplets_over
from station.render.notation.spelling.note_values import BeatGroup, Stroke, TimedValue, Value
from station.render.notation.spelling.rhythm import spell, spell_by

_LONG: Mapping[int, Value] = MappingProxyType(
    {PPQ: Value(4), COMPOUND: Value(4, 1)}
    | {2 * PPQ: Value(2), 3 * PPQ: Value(2, 1), 4 * PPQ: Value(1), 6 * PPQ: Value(1, 1)}
)
"""The lengths of beats that one note writes."""
_OVER_BEATS = (3, 5, 7)
"""Tuplets over several beats; nine and eleven are counted by the beat (our choice)."""
_MOST_BEATS = 4


def spell_bar(strokes: Sequence[Stroke], meter: MeterChange, length: int) -> list[BeatGroup]:
    """The groups of a voice of a bar `length` ticks long: `strokes` rising, ticks from the bar's start.

    Every stroke is the source of one value, and of more that are tied to it where a roll goes on. A silent voice has
    no groups.
    """
    if not strokes:
        return []
    beats = beat_groups(meter, length)
    return list(_joined(list(_groups(strokes, beats)), beats))


def _groups(strokes: Sequence[Stroke], beats: Sequence[tuple[int, int]]) -> Iterator[BeatGroup]:
    i = 0
    while i < len(beats):
        start, end = beats[i]
        sounding = _sounding(strokes, start)
        last = i if sounding is None else _last_held(strokes[sounding].until or 0, beats, i)
        over = _over_beats(strokes, beats, i)
        if sounding is not None and last is not None:
            yield _long(strokes[sounding], sounding, start, beats[last][1])
            i = last + 1
        elif over is not None:
            yield over[1]
            i = over[0] + 1
        else:
            yield _beat(strokes, sounding, start, end)
            i += 1


def _beat(strokes: Sequence[Stroke], sounding: int | None, start: int, end: int) -> BeatGroup:
    """One beat; what is still held at its start is tied to what came before."""
    inside = [k for k, stroke in enumerate(strokes) if start <= stroke.tick < end]
    if sounding is None or sounding in inside:
        return spell([strokes[k] for k in inside], start, end, inside[0] if inside else 0)
    goes_on = replace(strokes[sounding], tick=start, is_held=True, is_accented=False)
    return spell([goes_on, *(strokes[k] for k in inside)], start, end, sounding)


def _sounding(strokes: Sequence[Stroke], tick: int) -> int | None:
    """The roll that is held at `tick`, or begins there."""
    found = [k for k, s in enumerate(strokes) if s.until is not None and s.tick <= tick < s.until]
    return found[-1] if found else None


def _last_held(until: int, beats: Sequence[tuple[int, int]], first: int) -> int | None:
    """The last of the beats from `first` on that one note fills which is held to `until`."""
    start = beats[first][0]
    found = None
    for last in range(first, len(beats)):
        end = beats[last][1]
        if end <= until and end - start in _LONG and _may_join(beats, first, last):
            found = last
    return found


def _may_join(beats: Sequence[tuple[int, int]], first: int, last: int) -> bool:
    """Whether one value over these beats shows where the middle of the bar is: half a bar, or from its start on."""
    is_even = len(beats) % 2 == 0 and len(beats) > 2
    middle = len(beats) // 2
    return first in (0, last) or not is_even or not first < middle <= last


def _long(stroke: Stroke, source: int, start: int, end: int) -> BeatGroup:
    is_tied = stroke.is_held or stroke.tick < start
    value = TimedValue(start, _LONG[end - start], is_tied, int(stroke.is_measured), source)
    return BeatGroup(start, end, (value,), ())


# --- tuplets over several beats ---------------------------------------------------------------------------------------


def _over_beats(
    strokes: Sequence[Stroke], beats: Sequence[tuple[int, int]], first: int
) -> tuple[int, BeatGroup] | None:
    """The last beat, and the group, of a tuplet that begins with this one; the longest that there is.

    Its beats but the first are not struck themselves, and at most one of its notes is missing.
    """
    start = beats[first][0]
    for last in reversed(range(first + 1, min(first + _MOST_BEATS, len(beats)))):
        end = beats[last][1]
        inside = [k for k, s in enumerate(strokes) if start <= s.tick < end]
        plain = all(e - s == PPQ for s, e in beats[first : last + 1]) and _is_round(last - first + 1)
        free = not any(strokes[k].tick in {s for s, _ in beats[first + 1 : last + 1]} for k in inside)
        held = any(s.until is not None and not s.is_measured and s.tick < end and s.until > start for s in strokes)
        if len(inside) < 2 or not plain or not free or held or not _may_join(beats, first, last):
            continue
        moved = [replace(strokes[k], tick=strokes[k].tick - start) for k in inside]
        for division in tuplets_over(end - start, _OVER_BEATS):
            group = spell_by(moved, end - start, division)
            if group is not None and _is_full(group, moved):
                return last, _placed(group, start, inside[0])
    return None


def _is_round(beats: int) -> bool:
    return beats & (beats - 1) == 0


def _is_full(group: BeatGroup, strokes: Sequence[Stroke]) -> bool:
    """Whether at most one of the notes that the tuplet counts is missing, and never two strokes on a third."""
    tuplet = group.tuplets[0]
    steps = {round(stroke.tick * tuplet.number / group.end, 2) for stroke in strokes}
    counted = sum(step == int(step) for step in steps)
    return counted >= max(tuplet.number - 1, 3 if 0.0 in steps else 2)


def _placed(group: BeatGroup, start: int, first: int) -> BeatGroup:
    return BeatGroup(
        start,
        start + group.end,
        tuple(replace(v, tick=v.tick + start, source=v.source + first) for v in group.strokes),
        tuple(replace(v, tick=v.tick + start) for v in group.rests),
        tuple(replace(t, start=t.start + start, end=t.end + start) for t in group.tuplets),
    )


# --- half bars --------------------------------------------------------------------------------------------------------


def _joined(groups: Sequence[BeatGroup], beats: Sequence[tuple[int, int]]) -> Iterator[BeatGroup]:
    """Beats of half a bar of four joined, where both are silent or both two eighths."""
    pairs = {(beats[k][0], beats[k + 1][1]) for k in (0, len(beats) // 2)} if _has_halves(beats) else set()
    waiting: BeatGroup | None = None
    for group in groups:
        if waiting is not None and (waiting.start, group.end) in pairs and _alike(waiting, group):
            yield _pair(waiting, group)
            waiting = None
            continue
        if waiting is not None:
            yield waiting
        waiting = group
    if waiting is not None:
        yield waiting


def _has_halves(beats: Sequence[tuple[int, int]]) -> bool:
    lengths = {end - start for start, end in beats}
    return len(beats) == 4 and len(lengths) == 1 and lengths <= {PPQ, COMPOUND}


def _alike(one: BeatGroup, other: BeatGroup) -> bool:
    return _kind(one) == _kind(other) != ""


def _kind(group: BeatGroup) -> str:
    if not group.strokes:
        return "silent"
    eighths = [v.value == Value(8) for v in group.strokes]
    is_two = len(eighths) == 2 and all(eighths) and not group.rests and not group.tuplets
    return "eighths" if is_two and group.end - group.start == PPQ else ""


def _pair(one: BeatGroup, other: BeatGroup) -> BeatGroup:
    if one.strokes:
        return BeatGroup(one.start, other.end, one.strokes + other.strokes, ())
    return BeatGroup(one.start, other.end, (), (TimedValue(one.start, _LONG[other.end - one.start]),))
