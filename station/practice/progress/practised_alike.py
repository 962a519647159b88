"""Which sessions of a lesson were practised alike: the same bars, click, level and device at nearly one tempo."""

from collections.abc import Sequence

import numpy as np

from station.practice.progress.trend_fit import Indices
from station.store.rows import SessionRow

BAND = 1.10
"""Tempi within such a ratio are one band (our choice: two rungs of the ladder, TEACHING: 5 % each)."""
SAME_LATENCY_MS = 2.0
"""What is taken out as lag is one and the same up to such a step (our choice: less moves no verdict)."""


def tempo_of(row: SessionRow) -> float:
    """In beats a minute; where it rose, the middle of its way (geometric). 1 where the session has none."""
    start = row.beats_a_minute or 1.0
    return float(np.sqrt(start * max(row.top_beats_a_minute or start, start)))


def strata_of(rows: Sequence[SessionRow], latency_matters: bool) -> Indices:
    """The stratum of each session, numbers from 0; `latency_matters` where the mean asynchrony is part of the value."""
    log_tempo = np.log([tempo_of(row) for row in rows])
    band = np.round((log_tempo - np.median(log_tempo)) / np.log(BAND)).astype(int).tolist()
    lag = _lags(rows) if latency_matters else [0] * len(rows)
    numbers: dict[tuple[object, ...], int] = {}
    alike = [
        (row.device, row.level, row.first_bar, row.last_bar, row.click, row.gap, _rises(row), at, lagging)
        for row, at, lagging in zip(rows, band, lag, strict=True)
    ]
    return np.array([numbers.setdefault(each, len(numbers)) for each in alike], np.int64)


def _rises(row: SessionRow) -> bool:
    start = row.beats_a_minute or 1.0
    return (row.top_beats_a_minute or start) > start * BAND


def _lags(rows: Sequence[SessionRow]) -> list[int]:
    """Groups of what was taken out as lag, from 1, no two of one group far from a third; 0 where nobody said."""
    known = [
        None
        if row.input_latency_ms is None or row.output_latency_ms is None
        else row.input_latency_ms + row.output_latency_ms
        for row in rows
    ]
    steps = np.unique([each for each in known if each is not None])
    ends = steps[1:][np.diff(steps) > SAME_LATENCY_MS] if len(steps) else steps
    return [0 if each is None else 1 + int(np.searchsorted(ends, each, side="right")) for each in known]
