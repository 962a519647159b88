"""Charts of a session: what stands where, reckoned from their axes."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.render.palette import EARLY, GOOD, INK, LATE
from station.render.report.page.charts.asynchrony_histogram import asynchrony_histogram
from station.render.report.page.charts.bar_chart import bar_chart
from station.render.report.page.charts.chart import WIDTH, Chart
from station.render.report.page.charts.lean_chart import lean_chart
from station.render.report.page.charts.loudness_chart import loudness_chart
from station.render.report.page.charts.tempo_chart import tempo_chart
from station.render.report.page.session_page import (
    BarFigures,
    GroupFigures,
    LoudnessRow,
    StrokeTiming,
    TempoLine,
    TimingFigures,
)
from station.render.text.draw_list import Colour, ShapeKind
from station.render.text.paper import OutlineAtlas

ATLAS = OutlineAtlas()


def of(chart: Chart, kind: ShapeKind, colour: Colour) -> NDArray[np.void]:
    wanted = [round(255 * value) for value in colour[:3]]
    shapes = chart.shapes
    return np.asarray(shapes[(shapes["kind"] == kind) & (shapes["colour"][:, :3] == wanted).all(axis=1)])


def group(name: str, mean_ms: float, notes: int = 10) -> GroupFigures:
    timing = TimingFigures(notes, mean_ms, (mean_ms - 4, mean_ms + 4), 12.0, (10.0, 15.0))
    return GroupFigures(name, notes, notes, 0, 0, 0, timing)


def test_a_histogram_counts_every_stroke_on_its_side() -> None:
    values = np.array([-43.0, -42.0, -30.0, -3.0, 2.0, 4.0, 7.0, 33.0, 300.0])
    figures = TimingFigures(9, -6.0, (-9.0, -3.0), 15.0, (12.0, 19.0))
    chart = asynchrony_histogram(StrokeTiming(values, figures, 25.0, has_own_clock=False), ATLAS)
    counts = {spot.words: int(spot.words.split()[0]) for spot in chart.spots}
    assert sum(counts.values()) == len(values)
    assert counts["2 from 45 ms early to 40 ms early"] == 2
    zero = next(spot.left for spot in chart.spots if "from 0 ms" in spot.words)
    bars = {name: of(chart, ShapeKind.BOX, colour) for name, colour in (("early", EARLY), ("late", LATE))}
    assert (bars["early"]["centre"][:, 0] < zero).all()
    assert (bars["late"]["centre"][:, 0] > zero).all()
    heights = 2 * bars["early"]["half"][:, 1]
    assert sorted(heights / heights.min()) == pytest.approx([1, 2]), "as high as there are strokes"
    assert "Farther out than the ends: 1." in chart.legend
    assert "6.0 ms early on average (95 %: 9.0 ms early to 3.0 ms early)" in chart.words
    assert "spread (SD) 15.0 ms (95 %: 12.0 to 19.0 ms)" in chart.words


def test_without_a_click_no_side_is_told() -> None:
    timing = StrokeTiming(np.zeros(9), TimingFigures(9, 0.0, (-1.0, 1.0), 15.0, None), 25.0, has_own_clock=True)
    assert "early and late cannot be told" in asynchrony_histogram(timing, ATLAS).words


def test_pieces_stand_left_where_they_are_early_the_most_notes_first() -> None:
    chart = lean_chart("Pieces", [group("kick", -30.0, 4), group("snare", 0.0, 9), group("ride", 30.0, 7)], 25.0, ATLAS)
    assert [spot.words.partition(",")[0] for spot in chart.spots] == ["Snare", "Ride", "Kick"]
    early, late = (of(chart, ShapeKind.ELLIPSE, colour)["centre"][0] for colour in (EARLY, LATE))
    (middle,) = of(chart, ShapeKind.ELLIPSE, GOOD)["centre"]
    assert early[0] < middle[0] < late[0]
    assert middle[0] - early[0] == pytest.approx(late[0] - middle[0])
    assert early[1] > late[1] > middle[1]


def test_bars_that_are_late_stand_higher() -> None:
    bars = [BarFigures(k, group(f"bar {k}", mean), 10, 0) for k, mean in ((3, -30.0), (4, 30.0))]
    chart = bar_chart(bars, 25.0, ATLAS)
    early, late = (of(chart, ShapeKind.ELLIPSE, colour)["centre"][0] for colour in (EARLY, LATE))
    assert early[0] < late[0]
    assert early[1] > late[1]
    assert chart.spots[0].words.startswith("Bar 3: 10 of 10 right")


@pytest.mark.parametrize("count", [1, 2, 24, 400])
def test_any_number_of_bars_has_room(count: int) -> None:
    chart = bar_chart([BarFigures(k, group(f"bar {k}", 0.0), 9, 1) for k in range(1, count + 1)], 25.0, ATLAS)
    right = chart.shapes["centre"][:, 0] + chart.shapes["half"][:, 0]
    assert right.max() <= WIDTH
    assert len(chart.spots) == count


def test_tempo_rises_upward_and_time_goes_right() -> None:
    at_s, bpm = np.array([0.0, 10.0, 20.0]), np.array([80.0, 84.0, 82.0])
    tempo = TempoLine(at_s, bpm, np.zeros(1), np.array([80.0]), 30.0, "click", 82.0, 1.5, (-1.0, 4.0))
    chart = tempo_chart(tempo, ATLAS)
    dots = of(chart, ShapeKind.ELLIPSE, GOOD)["centre"].astype(float)
    x, y = dots[np.argsort(dots[:, 0])].T
    assert np.diff(x) == pytest.approx([x[1] - x[0]] * 2, abs=0.01)
    assert (y[0] - y[1]) / (y[0] - y[2]) == pytest.approx(2.0, abs=0.01)
    assert chart.words == "82.0 bpm in the middle of all bars, drift +1.50 % a minute (95 %: −1.00 to +4.00 %)."


def test_loudness_tells_the_middle_beside_what_is_written() -> None:
    chart = loudness_chart([LoudnessRow("snare", "ghost", 30.0, np.array([40.0, 50.0, 60.0]))], ATLAS)
    (spot,) = chart.spots
    assert spot.words == "Snare, ghost: 3 strokes, 50 in the middle for 30 written"


def test_an_interval_that_goes_on_beyond_the_axis_ends_in_an_arrow_there() -> None:
    """The axis reaches from -40 to 40 ms; 500 early and 30 late: an arrow to the left, a cap to the right."""
    wide = TimingFigures(10, 0.0, (-500.0, 30.0), 12.0, None)
    (row,) = (GroupFigures("snare", 10, 10, 0, 0, 0, wide),)
    triangles = of(lean_chart("Pieces", [row], 25.0, ATLAS), ShapeKind.TRIANGLE, INK)
    whole = of(lean_chart("Pieces", [group("snare", 0.0)], 25.0, ATLAS), ShapeKind.TRIANGLE, INK)
    assert (len(triangles), len(whole)) == (1, 0)
    assert triangles["centre"][0][0] == pytest.approx(108.0), "the axis's left end"
    assert triangles["axis"][0][0] == pytest.approx(-1.0), "to the left"
    bars = [BarFigures(1, row, 10, 0), BarFigures(2, group("bar 2", 0.0), 10, 0)]
    (down,) = of(bar_chart(bars, 25.0, ATLAS), ShapeKind.TRIANGLE, INK)
    assert down["axis"][1] == pytest.approx(1.0), "down, where early is"
