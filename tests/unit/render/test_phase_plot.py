"""Where a trace lies on its plot, by what its shapes say."""

import numpy as np
import pytest

from station.core.pieces import Limb
from station.render.palette import BRAND
from station.render.phase.phase_plot import PhaseMark, PhaseTrace, PlotAxes, draw_phase_plot, time_ticks
from station.render.report.report_layout import ReportBox
from station.render.text.atlas import Atlas
from station.render.text.draw_list import DrawList, ShapeKind

BOX = ReportBox(100.0, 50.0, 600.0, 400.0)


def trace(marks: tuple[PhaseMark, ...] = ()) -> PhaseTrace:
    """Two cycles in two seconds that wrap once, trusted in the second one."""
    time_s = np.linspace(0, 2, 201)
    share = time_s % 1.0
    return PhaseTrace("a", time_s, share, np.where(time_s < 1, -0.5, 0.9), time_s >= 1, marks)


def test_times_and_shares_fill_the_axes() -> None:
    axes = PlotAxes.within(trace(), BOX)
    assert (axes.x(0.0), axes.x(2.0)) == (axes.phase.left, axes.phase.right)
    assert [axes.y_of_share(0.0), axes.y_of_share(1.0)] == pytest.approx([axes.phase.bottom, axes.phase.top])
    assert axes.quality.top > axes.phase.bottom
    assert axes.quality.bottom < BOX.bottom


def test_a_quality_beyond_the_axis_lies_on_its_end() -> None:
    axes = PlotAxes.within(trace(), BOX)
    assert axes.y_of_quality(-7.0) == axes.quality.bottom


def test_no_line_crosses_the_plot_where_the_phase_wraps() -> None:
    draw_list = DrawList(Atlas())
    axes = draw_phase_plot(draw_list, trace(), BOX)
    shapes = draw_list.shapes()
    slanted = shapes[(shapes["kind"] == ShapeKind.BOX) & (shapes["axis"][:, 1] != 0)]
    assert len(slanted)
    assert slanted["half"][:, 0].max() < axes.phase.height / 4


def test_a_trigger_is_a_disc_at_its_time_and_share() -> None:
    draw_list = DrawList(Atlas())
    axes = draw_phase_plot(draw_list, trace((PhaseMark(1.25, Limb.RIGHT_FOOT, 0.25),)), BOX)
    shapes = draw_list.shapes()
    (disc,) = shapes[shapes["kind"] == ShapeKind.ELLIPSE]
    assert disc["centre"] == pytest.approx([axes.x(1.25), axes.y_of_share(0.25)], abs=1e-3)
    assert disc["colour"][:3].tolist() == [round(255 * c) for c in BRAND[:3]]


@pytest.mark.parametrize(
    ("span_s", "words"),
    [
        ((0.0, 1.0), ["0.0 s", "0.2 s", "0.4 s", "0.6 s", "0.8 s", "1.0 s"]),
        ((7.4, 9.1), ["7.4 s", "7.6 s"]),
        ((3.0, 40.0), ["5 s", "10 s"]),
    ],
)
def test_ticks_are_round_times(span_s: tuple[float, float], words: list[str]) -> None:
    assert [text for _, text in time_ticks(span_s)][: len(words)] == words
