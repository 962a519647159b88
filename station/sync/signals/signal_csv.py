"""Tables of a signal: a header with `time_s` and a name for each channel, then a line a sample, divided by commas."""

from pathlib import Path

import numpy as np

from station.core.errors import BadInput
from station.sync.signals.signal import Signal
from station.sync.signals.signal_text import SHORTEST_S, numbered_lines, numbers

TIME = "time_s"
_FURTHEST_S = 4e9
"""From 0 (our choice): beyond all dates that are counted from 1970, and few enough to be counted in nanoseconds."""


def read_signal_csv(path: Path) -> Signal:
    """The signal of a table; `time_s` increases strictly and may stand in any column. Raises `BadInput`."""
    lines = list(numbered_lines(path, "a table"))
    if not lines:
        raise BadInput(path, "line 1", f"expected a header such as {TIME},left,right")
    header = [word.strip().strip('"') for word in lines[0][1].split(",")]
    _check_header(header, path, lines[0][0])
    rows = [_row(line, words, len(header), path) for line, words in lines[1:]]
    values = np.array(rows, dtype=np.float64).reshape(len(rows), len(header))
    at = header.index(TIME)
    _check_times(values[:, at].tolist(), [line for line, _ in lines[1:]], path)
    return Signal(
        values[:, at].copy(), tuple(name for name in header if name != TIME), np.delete(values, at, axis=1), str(path)
    )


def _check_header(header: list[str], path: Path, line: int) -> None:
    place = f"line {line}"
    if TIME not in header:
        raise BadInput(path, place, f"expected a column {TIME}, found {', '.join(header)}")
    if len(header) < 2:
        raise BadInput(path, place, f"expected a column for each channel beside {TIME}")
    if "" in header:
        raise BadInput(path, place, f"column {header.index('') + 1} has no name")
    twice = next((name for at, name in enumerate(header) if name in header[:at]), None)
    if twice is not None:
        raise BadInput(path, place, f"{twice} is here twice")


def _row(line: int, text: str, columns: int, path: Path) -> list[float]:
    words = text.split(",")
    if len(words) != columns:
        raise BadInput(path, f"line {line}", f"expected {columns} numbers, found {len(words)}")
    return numbers(words, path, line)


def _check_times(times: list[float], lines: list[int], path: Path) -> None:
    far = next((at for at, time_s in enumerate(times) if abs(time_s) > _FURTHEST_S), None)
    if far is not None:
        raise BadInput(path, f"line {lines[far]}", f"{TIME} is not within {_FURTHEST_S:g} s: {times[far]:g}")
    for at in range(1, len(times)):
        if times[at] <= times[at - 1]:
            fault = f"{TIME} does not increase: {times[at]:g} after {times[at - 1]:g}"
            raise BadInput(path, f"line {lines[at]}", fault)
        if times[at] - times[at - 1] < SHORTEST_S:
            fault = f"{TIME} increases by less than a microsecond: {times[at]:g} after {times[at - 1]:g}"
            raise BadInput(path, f"line {lines[at]}", fault)
