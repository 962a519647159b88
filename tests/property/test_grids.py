"""Grids: whatever the format allows inside one grid is read, whole and in its place; anything else is a fault."""

from contextlib import suppress
from fractions import Fraction

from hypothesis import given, settings
from hypothesis import strategies as st

from station.core.toml.toml_faults import Faults, Wrong
from station.core.units import PPQ
from station.drills.grid.cell_strokes import expand
from station.drills.grid.grid import GridFrame, parse_line
from station.drills.grid.grid_reader import GridSection, read_grid
from station.drills.grid.grid_timing import GridTiming, meter
from station.drills.grid.landing import read_landing
from station.drills.grid.loudness_line import STICK_HEIGHTS_IN
from station.music.swing import MAX_RATIO
from station.music.tempo import MeterChange

TIMING = GridTiming(60, (MeterChange(0, 4, 4),), PPQ)
METERS = ("4/4", "3/4", "2/2", "6/8", "12/8", "7/8", "5/16", "3+2+2/8", "2+2+2+3/8", "3+2/4", "3+3+2/16")
LETTERS = "--oOgfdtbrxvwuz"


@st.composite
def cut_bars(draw: st.DrawFn, frame: GridFrame) -> tuple[str, list[int]]:
    """A bar of snare and where its cells start: as many plain cells on every beat, some beats in parentheses."""
    a_beat = draw(st.integers(1, 5))
    spans = list(frame.spans)
    if sum(length for _, length in spans) != frame.meter.bar_ticks:  # the beat of (…) does not fill the bar
        spans = [(i * frame.meter.beat_ticks, frame.meter.beat_ticks) for i in range(frame.meter.beats)]
    out, edges = "", []
    for start, length in spans:
        is_tuplet = length % frame.meter.beat_ticks or ((start, length) in frame.spans and draw(st.integers(0, 3)) == 0)
        count = draw(st.integers(1, 64)) if is_tuplet else length // frame.meter.beat_ticks * a_beat
        out += f" ({draw(_cells(count))}) " if is_tuplet else draw(_cells(count))
        edges += [round(start + Fraction(length * i, count)) for i in range(count)]
    return out, edges


def bars(frame: GridFrame) -> st.SearchStrategy[str]:
    """A bar of snare."""
    return cut_bars(frame).map(lambda cut: cut[0])


def _cells(count: int) -> st.SearchStrategy[str]:
    return st.text(LETTERS, min_size=count, max_size=count)


@st.composite
def loudness_bars(draw: st.DrawFn, frame: GridFrame) -> str:
    """A bar of one mark, in whole beats long enough for its letters."""
    mark = draw(st.sampled_from(sorted(STICK_HEIGHTS_IN)))
    return mark.ljust(frame.meter.beats * len(mark), "-")


@st.composite
def grids(draw: st.DrawFn) -> dict[str, object]:
    """The table of any grid that has no fault."""
    in_turn = draw(st.lists(st.sampled_from(METERS), min_size=1, max_size=3))
    frames = [GridFrame(meter(m), PPQ) for m in in_turn]
    count = draw(st.integers(1, 4))
    turn = [frames[i % len(frames)] for i in range(count)]
    table: dict[str, object] = {"meter": in_turn, "times": draw(st.integers(1, 3))}
    table["snare"] = "|".join(draw(bars(f)) for f in turn)
    if draw(st.booleans()):
        table["loudness"] = "|".join(draw(loudness_bars(f)) for f in turn)
    if draw(st.booleans()):
        own = draw(st.sampled_from(METERS))
        table["cycle"] = [{"meter": own, "tom_1": draw(bars(GridFrame(meter(own), PPQ)))}]
    if draw(st.booleans()):
        table["swing_ratio"] = draw(st.floats(1, MAX_RATIO))
    return table


def section_of(table: dict[str, object]) -> GridSection:
    faults = Faults()
    section = read_grid(table, ("grid",), TIMING, faults)
    assert faults.noted == [], table
    return section


@given(grids())
@settings(deadline=None, max_examples=80)
def test_any_legal_grid_is_read_and_stays_within_its_bars(table: dict[str, object]) -> None:
    section = section_of(table)
    rows, origins = expand(section.at(0))
    assert len(rows) == len(origins)
    end = section.length_ticks * section.times
    assert ((rows["tick"] >= 0) & (rows["tick"] < end)).all()
    assert (rows["tick"] + rows["duration_ticks"] <= end).all()
    assert ((rows["velocity"] >= 1) & (rows["velocity"] <= 127)).all()


@given(grids(), st.integers(0, 10 * PPQ))
@settings(deadline=None, max_examples=40)
def test_all_repetitions_together_are_the_section(table: dict[str, object], start: int) -> None:
    section = section_of(table)
    one_by_one = [
        stroke
        for number in range(section.times)
        for stroke in section.repetition(number, start + number * section.length_ticks)
    ]
    assert section.at(start) == one_by_one


@given(st.sampled_from(METERS), st.data())
@settings(deadline=None, max_examples=80)
def test_cells_fill_the_bar_without_a_gap(text: str, data: st.DataObject) -> None:
    """Against exact fractions: each beat or group is cut into equal parts, rounded to the nearest tick."""
    frame = GridFrame(meter(text), PPQ)
    line, edges = data.draw(cut_bars(frame))
    told: list[str] = []
    (bar,) = parse_line(line, [frame], lambda _, what: told.append(what))
    assert told == []
    assert [cell.tick for cell in bar.cells] == edges
    assert [cell.tick + cell.length_ticks for cell in bar.cells] == [*edges[1:], frame.meter.bar_ticks]


keys = st.sampled_from(
    [
        *("snare", "kick", "sticking", "loudness", "cycle", "times", "bars", "meter", "beat", "dynamics", "graces"),
        *("swing_ratio", "swing_unit", "tempo_bpm", "tempo_to_bpm", "name", "like", "ending", "at", "left_hand"),
    ]
)
values = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-1, 200)
    | st.floats()
    | st.sampled_from(["o---", "oooo|%", "(ooo)ooo", "p-<-f---", "RLRB", "7/8", "3+2/8", "1/4", "#~%()|", "", "é"]),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(keys, inner, max_size=4),
    max_leaves=8,
)


@given(st.dictionaries(keys, values, max_size=6) | values)
@settings(deadline=None, max_examples=300)
def test_no_table_is_too_strange(table: object) -> None:
    faults = Faults()
    with suppress(Wrong):  # of what is far too long nothing is read
        section = read_grid(table, ("grid", 0), TIMING, faults)
        assert section.length_ticks > 0
        assert all(fault.path[:2] == ("grid", 0) for fault in faults.noted)
        read_landing(table, TIMING, faults)
