"""Rhythm spelling: what a drummer's pen would write, by hand; and that every bar adds up."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from station.core.units import PPQ
from station.music.beat_groups import beat_groups
from station.music.tempo import MeterChange
from station.render.notation.spelling.bar_spelling import spell_bar
from station.render.notation.spelling.note_values import BeatGroup, Stroke, Value
from station.render.notation.spelling.rhythm import spell
from tests.unit.render.rhythm_sums import gaps

Q = PPQ


def words(groups: list[BeatGroup]) -> str:
    """Groups in brackets: values as 8 or 8., r before rests, ~ where tied, / a slash; then its tuplets as 3:2."""
    found = []
    for group in groups:
        values = [
            "r" * (v.source < 0) + "~" * v.is_tied + str(v.value.base) + "." * v.value.dots + "/" * v.slashes
            for v in group.values
        ]
        found.append(f"[{' '.join(values)}]" + ",".join(f"{t.number}:{t.of}" for t in group.tuplets))
    return " ".join(found)


def meter_of(text: str) -> MeterChange:
    """4/4, or 3+2+2/8."""
    beats, unit = text.split("/")
    groups = tuple(map(int, beats.split("+")))
    return MeterChange(0, sum(groups), int(unit), groups if len(groups) > 1 else ())


def written(meter: str, *steps: tuple[int, str], accents: str = "") -> str:
    """How a bar is spelled whose beats are divided into so many steps, x where one is struck; quarters a beat."""
    where = meter_of(meter)
    strokes, start = list[Stroke](), 0.0
    for count, letters in steps:
        length = where.bar_ticks / len(steps)
        for k, letter in enumerate(letters):
            if letter in "xX":
                strokes.append(Stroke(round(start + k * length / count), is_accented=letter == "X"))
        start += length
    groups = spell_bar(strokes, where, where.bar_ticks)
    assert gaps(groups, where.bar_ticks) == []
    return words(groups)


BARS = [
    # straight eighths, as hi-hats are written: four under a beam
    ("4/4", [(8, "xxxxxxxx")], "[8 8 8 8] [8 8 8 8]"),
    ("4/4", [(4, "x-x-")], "[4] [r4] [4] [r4]"),
    ("4/4", [(4, "-x-x")], "[r4] [4] [r4] [4]"),
    ("4/4", [(4, "x---")], "[4] [r4] [r2]"),
    ("4/4", [(4, "--x-")], "[r2] [4] [r4]"),
    ("4/4", [(8, "x--x----")], "[4] [r8 8] [r2]"),
    ("4/4", [(16, "xxxxx-x-x-xxx--x")], "[16 16 16 16] [8 8] [8 16 16] [8. 16]"),
    ("4/4", [(16, "x-xxxx-xxxxx-x-x")], "[8 16 16] [16 8 16] [16 16 16 16] [r16 8 16]"),
    ("4/4", [(16, "x--x--x---x-x---")], "[8. 16] [r8 8] [r8 8] [4]"),
    ("4/4", [(16, "-x---x--xx------")], "[r16 8.] [r16 8.] [16 8.] [r4]"),
    ("4/4", [(4, "xxx"), (4, "xxxx"), (4, "x"), (4, "---x")], "[16 16 8] [16 16 16 16] [4] [r8 r16 16]"),
    ("4/4", [(8, "xxxxxxxx"), (4, "x"), (4, "x"), (4, "x")], "[32 32 32 32 32 32 32 32] [4] [4] [4]"),
    # tuplets of a beat
    ("4/4", [(3, "xxx"), (3, "x-x"), (3, "xx-"), (3, "--x")], "[8 8 8]3:2 [4 8]3:2 [8 4]3:2 [r4 8]3:2"),
    ("2/4", [(6, "xxxxxx"), (6, "XxxXxx")], "[16 16 16 16 16 16]6:4 [16 16 16 16 16 16]3:2,3:2"),
    ("2/4", [(6, "x--xxx"), (6, "xxxx--")], "[8 16 16 16]3:2 [16 16 16 8]3:2"),
    ("2/4", [(6, "xxx-x-"), (6, "x-xxxx")], "[16 16 8 8]3:2 [8 16 16 16 16]3:2"),
    ("2/4", [(6, "x-xx-x"), (6, "xxx---")], "[8 16 8 16]3:2,3:2 [16 16 16 r8]3:2"),
    ("2/4", [(5, "xxxxx"), (5, "x-x-x")], "[16 16 16 16 16]5:4 [8 8 16]5:4"),
    ("2/4", [(7, "xxxxxxx"), (7, "x-xxx-x")], "[16 16 16 16 16 16 16]7:4 [8 16 16 8 16]7:4"),
    ("2/4", [(9, "x" * 9), (10, "x" * 10)], f"[{' '.join(['32'] * 9)}]9:8 [{' '.join(['32'] * 10)}]10:8"),
    ("2/4", [(11, "x" * 11), (12, "x" * 12)], f"[{' '.join(['32'] * 11)}]11:8 [{' '.join(['32'] * 12)}]12:8"),
    ("2/4", [(13, "x" * 13), (14, "x" * 14)], f"[{' '.join(['32'] * 13)}]13:8 [{' '.join(['32'] * 14)}]14:8"),
    # tuplets of half a bar and of a bar
    ("4/4", [(3, "xxx"), (2, "xx")], "[4 4 4]3:2 [4] [4]"),
    ("4/4", [(6, "x-x-xx"), (2, "xx")], "[4 4 8 8]3:2 [4] [4]"),
    ("4/4", [(3, "-xx"), (2, "xx")], "[r4 4 4]3:2 [4] [4]"),
    ("4/4", [(3, "xxx")], "[2 2 2]3:2"),
    ("4/4", [(5, "xxxxx")], "[4 4 4 4 4]5:4"),
    ("4/4", [(5, "xxxxx"), (2, "xx")], "[8 8 8 8 8]5:4 [4] [4]"),
    # other meters
    ("3/4", [(6, "xxxxxx")], "[8 8] [8 8] [8 8]"),
    ("3/4", [(3, "x--")], "[4] [r4] [r4]"),
    ("2/4", [(4, "xxxx")], "[8 8] [8 8]"),
    ("5/4", [(5, "x--xx")], "[4] [r4] [r4] [4] [4]"),
    ("6/8", [(6, "xxxxxx")], "[8 8 8] [8 8 8]"),
    ("6/8", [(6, "x-xx--")], "[4 8] [4.]"),
    ("6/8", [(6, "x-----")], "[4.] [r4.]"),
    ("6/8", [(6, "--x-xx")], "[r4 8] [r8 8 8]"),
    ("6/8", [(12, "x--xx-xxxxxx")], "[8. 16 8] [16 16 16 16 16 16]"),
    ("6/8", [(2, "xx"), (4, "xxxx")], "[8 8]2:3 [8 8 8 8]4:3"),
    ("12/8", [(4, "x---")], "[4.] [r4.] [r2.]"),
    ("9/8", [(9, "x-xx-xxxx")], "[4 8] [4 8] [8 8 8]"),
    ("7/8", [(7, "xxxxxxx")], "[8 8] [8 8] [8 8 8]"),
    ("3+2+2/8", [(7, "x--x-x-")], "[4.] [4] [4]"),
    ("5/8", [(5, "xxxxx")], "[8 8] [8 8 8]"),
    ("3+3+2/8", [(8, "xxxxxxxx")], "[8 8 8] [8 8 8] [8 8]"),
]


@pytest.mark.parametrize(("meter", "steps", "expected"), BARS)
def test_bars_as_books_have_them(meter: str, steps: list[tuple[int, str]], expected: str) -> None:
    assert written(meter, *steps) == expected


def test_groups_of_meters() -> None:
    def lengths(text: str) -> list[int]:
        meter = meter_of(text)
        return [(end - start) * 2 // Q for start, end in beat_groups(meter, meter.bar_ticks)]

    assert lengths("4/4") == [2, 2, 2, 2]
    assert lengths("6/8") == [3, 3]
    assert lengths("12/8") == [3, 3, 3, 3]
    assert lengths("7/8") == [2, 2, 3]
    assert lengths("5/8") == [2, 3]
    assert lengths("3+2+2/8") == [3, 2, 2]
    assert lengths("3+3+2/8") == [3, 3, 2]
    assert lengths("4+3/8") == [2, 2, 3]
    assert lengths("3+2/4") == [2, 2, 2, 2, 2]


@pytest.mark.parametrize(("count", "base"), [(9, 32), (10, 32), (14, 32), (13, 32), (24, 64), (32, 128)])
def test_many_strokes_to_a_beat_are_all_written(count: int, base: int) -> None:
    """Nine, ten, fourteen take the place of eight thirty-seconds (Gould, Behind Bars, on tuplets)."""
    onsets = [round(k * Q / count) for k in range(count)]
    group = spell([Stroke(onset) for onset in onsets], 0, Q)
    assert [stroke.tick for stroke in group.strokes] == onsets
    assert {stroke.value.base for stroke in group.strokes} == {base}
    assert [tuplet.number for tuplet in group.tuplets] == ([count] if count & (count - 1) else [])


def test_a_silent_voice_has_no_groups() -> None:
    meter = meter_of("4/4")
    assert spell_bar([], meter, meter.bar_ticks) == []


@pytest.mark.parametrize(
    ("strokes", "expected"),
    [
        ([Stroke(0, 2 * Q), Stroke(2 * Q)], "[2] [4] [r4]"),
        ([Stroke(0, 4 * Q)], "[1]"),
        ([Stroke(0, 3 * Q)], "[2.] [r4]"),
        ([Stroke(Q, 3 * Q)], "[r4] [4] [~4] [r4]"),  # a half note would hide the middle of the bar
        ([Stroke(Q // 2, Q * 5 // 2), Stroke(Q * 11 // 4)], "[r8 8] [~4] [~8 r16 16] [r4]"),
        ([Stroke(0, Q // 4), Stroke(Q)], "[16 r16 r8] [4] [r2]"),
        ([Stroke(0, Q * 5 // 8)], "[8 ~32 r32 r16] [r4] [r2]"),
        ([Stroke(0, 2 * Q, is_held=True)], "[~2] [r2]"),
        ([Stroke(0, Q // 4, is_measured=True), Stroke(Q // 2)], "[16/ r16 8] [r4] [r2]"),
        ([Stroke(k * Q // 4, (k + 1) * Q // 4, is_measured=True) for k in range(4)], "[16/ 16/ 16/ 16/] [r4] [r2]"),
        ([Stroke(0, Q, is_measured=True), Stroke(Q)], "[4/] [4] [r2]"),
        ([Stroke(0, Q // 3, is_measured=True), Stroke(2 * Q // 3)], "[8/ r8 8]3:2 [r4] [r2]"),
    ],
)
def test_rolls_last_as_long_as_they_are_held(strokes: list[Stroke], expected: str) -> None:
    groups = spell_bar(strokes, meter_of("4/4"), 4 * Q)
    assert words(groups) == expected
    assert gaps(groups, 4 * Q) == []


def test_a_played_beat_is_written_as_what_was_meant() -> None:
    early = [0, Q // 4 - 2000, Q // 2 + 1500, 3 * Q // 4 + 2500]  # within 12 ms at 120 bpm
    assert words([spell([Stroke(tick) for tick in early], 0, Q)]) == "[16 16 16 16]"


def test_beams_of_values() -> None:
    assert [Value(base).beams for base in (1, 2, 4, 8, 16, 32, 64)] == [0, 0, 0, 1, 2, 3, 4]


METERS = [
    "4/4",
    "3/4",
    "2/4",
    "5/4",
    "7/4",
    "2/2",
    "3/2",
    "6/8",
    "9/8",
    "12/8",
    "7/8",
    "5/8",
    "3+2+2/8",
    "3+3+2/8",
    "4+3/8",
]
METERS += ["3/8", "7/16", "5/16", "6/16", "9/16", "11/8", "1/4", "15/16"]


@settings(max_examples=300)
@given(st.sampled_from(METERS), st.sampled_from([2, 3, 4, 5, 6, 7, 8, 9, 12]), st.data())
def test_notes_and_rests_add_up_to_the_bar(text: str, steps: int, data: st.DataObject) -> None:
    """Of every meter, whatever is struck on the steps of its beats: no gap, no overlap, no stroke lost or moved."""
    meter = meter_of(text)
    beats = beat_groups(meter, meter.bar_ticks)
    places = {start + round(k * (end - start) / steps) for start, end in beats for k in range(steps)}
    ticks = sorted(data.draw(st.sets(st.sampled_from(sorted(places)), min_size=1)))
    groups = spell_bar([Stroke(tick) for tick in ticks], meter, meter.bar_ticks)
    assert gaps(groups, meter.bar_ticks) == []
    assert [value.tick for group in groups for value in group.strokes] == ticks
    assert [value.source for group in groups for value in group.strokes] == list(range(len(ticks)))


@settings(max_examples=200)
@given(st.lists(st.tuples(st.integers(0, 15), st.integers(1, 8)), min_size=1, unique_by=lambda pair: pair[0]))
def test_rolls_add_up_to_the_bar(pairs: list[tuple[int, int]]) -> None:
    """In 4/4, each roll as many sixteenths long as it says, or up to the next stroke."""
    pairs.sort()
    following = [slot for slot, _ in pairs[1:]] + [16]
    ends = [min(slot + size, after) for (slot, size), after in zip(pairs, following, strict=True)]
    strokes = [Stroke(slot * Q // 4, end * Q // 4) for (slot, _), end in zip(pairs, ends, strict=True)]
    groups = spell_bar(strokes, meter_of("4/4"), 4 * Q)
    assert gaps(groups, 4 * Q) == []
    held = [0.0] * len(strokes)
    for group in groups:
        for value in group.strokes:
            held[value.source] += float(group.time_of(value)) * 4 / Q
    assert held == [end - slot for (slot, _), end in zip(pairs, ends, strict=True)]
