"""Marks and places of strokes, each by hand: on time is within 25 ms, and beyond 80 ms a stroke stands on the edge."""

import numpy as np
import pytest

from station.music.judgement import Label
from station.render.report.stroke_plot import AXIS_MS, KINDS, LINES, StrokeMark, by_kind, heights_ms, line_words

LABEL = np.array([*[Label.MATCH] * 5, Label.WRONG_PIECE, Label.MISS, Label.EXTRA], np.uint8)
LATE_MS = np.array([-25.0, 25.0, -26.0, 26.0, 300.0, -10.0, np.nan, np.nan])


def test_every_stroke_bears_the_mark_of_its_kind() -> None:
    marks = {int(row): kind.mark for kind, rows in by_kind(LABEL, LATE_MS, 25.0) for row in rows}
    assert [marks[row] for row in range(8)] == [
        StrokeMark.DISC,
        StrokeMark.DISC,
        StrokeMark.DOWN,
        StrokeMark.UP,
        StrokeMark.UP,
        StrokeMark.SQUARE,
        StrokeMark.BARRED_RING,
        StrokeMark.CROSS,
    ]
    assert not list(by_kind(LABEL[:0], LATE_MS[:0], 25.0))
    assert len({kind.mark for kind in KINDS}) == len(KINDS), "told apart by shape alone"


def test_strokes_stand_at_their_time_up_to_the_edge_and_others_below() -> None:
    at_ms = heights_ms(LABEL, LATE_MS)
    assert at_ms[:6].tolist() == [-25.0, 25.0, -26.0, 26.0, 80.0, -10.0]
    assert AXIS_MS[0] < at_ms[7] < at_ms[6] < -80.0
    assert np.isnan(heights_ms(LABEL[:1], np.array([np.nan]))).all(), "right, and its time is not told"


@pytest.mark.parametrize(
    ("letter_ms", "words"),
    [
        (29.0, ["60 early", "30 early", "0 ms", "30 late", "60 late"]),
        (31.0, ["60 early", "", "0 ms", "", "60 late"]),
    ],
)
def test_lines_are_called_early_and_late_as_far_as_there_is_room(letter_ms: float, words: list[str]) -> None:
    assert len(words) == len(LINES)
    assert line_words(letter_ms) == words
