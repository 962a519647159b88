"""The timing of a page about a session: groups and bars as the report has them, each spread with its interval."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece, word
from station.music.judgement import Label
from station.practice.session.session import SessionResult
from station.render.report.page.session_page import (
    BarFigures,
    GroupFigures,
    Interval,
    StrokeTiming,
    TimingFigures,
)
from station.scenes.heat_map import heat_map
from station.scenes.hit_table import every_hit
from station.scoring.analysis.technique.estimates import scatter
from station.scoring.analysis.timing_spread import asynchrony_ms, timed_notes
from station.scoring.matching.alignment import Reference
from station.scoring.matching.hit_windows import Level
from station.scoring.matching.unheard import known_part

Document = Mapping[str, Any]
"""A report, or a table of it."""


class Spreads:
    """The spread of every group with its interval, as the report reckons its means: of known notes that have a time."""

    def __init__(self, result: SessionResult) -> None:
        score, alignment, _ = known_part(result.score, result.alignment)
        timed = timed_notes(score, alignment)
        self.off_ms = asynchrony_ms(alignment)[timed]
        self._slots = score.notes["tick"][timed].astype(np.int64)
        names, notes = np.asarray(result.plan.practised_bars), score.notes[timed]
        bars = names[np.minimum(score.bar[timed], len(names) - 1)] + 1
        self.pieces = {word(Piece(each)): self._ci(notes["piece"] == each) for each in np.unique(notes["piece"])}
        self.limbs = {word(Limb(each)): self._ci(notes["limb"] == each) for each in np.unique(notes["limb"])}
        self.bars = {int(each): self._ci(bars == each) for each in np.unique(bars)}
        self.whole = self._ci(np.ones(len(self.off_ms), np.bool_))

    def _ci(self, rows: NDArray[np.bool_]) -> Interval | None:
        one = np.zeros(int(rows.sum()), np.int64)
        return told_spread(scatter(self.off_ms[rows], one, self._slots[rows]).ci)


def told_spread(ci: Interval | None) -> Interval | None:
    """The interval of a spread where it tells something, None where its ends are too far apart to."""
    return None if ci is None or ci[1] > MOST_APART * ci[0] else ci


MOST_APART = 4.0
"""An interval of a spread that spans more says that nobody knows it: as of the inner clock (docs/report.md, Craft)."""


def stroke_timing(document: Document, spreads: Spreads) -> StrokeTiming:
    """All timed strokes, and what they come to."""
    is_own = document["reference"] == Reference.PLAYER.value
    on_time_ms = Level(str(document["level"])).windows.on_time_ms
    return StrokeTiming(spreads.off_ms, _figures(table(document["timing"]), spreads.whole), on_time_ms, is_own)


def _figures(timing: Document, sd_ci: Interval | None) -> TimingFigures:
    ci = timing["mean_ci_ms"]
    return TimingFigures(
        strokes=int(timing["strokes"]),
        mean_ms=number(timing["mean_signed_asynchrony_ms"]),
        mean_ci=None if ci is None else (float(ci[0]), float(ci[1])),
        sd_ms=number(timing["sd_asynchrony_ms"]),
        sd_ci=sd_ci,
    )


def group_figures(
    table: Document,
    sd_ci: Mapping[str, Interval | None],
    label: Any,  # noqa: ANN401 - a function of a name
) -> Iterator[GroupFigures]:
    """Groups that have notes, or strokes where none is written."""
    for name, group in table.items():
        if group["notes"] or group["extras"]:
            yield _group(str(label(name)), group, sd_ci.get(name))


def _group(name: str, group: Document, sd_ci: Interval | None) -> GroupFigures:
    return GroupFigures(
        name=name,
        notes=int(group["notes"]),
        matched=int(group["matched"]),
        misses=int(group["misses"]),
        wrong=int(group["wrong_piece"]),
        extras=None if group["extras"] is None else int(group["extras"]),
        timing=_figures(group["timing"], sd_ci),
    )


def hand_figures(document: Document) -> Iterator[GroupFigures]:
    """How each hand lies about the phase of the drill; nothing without sensors."""
    phase = document.get("phase")
    if phase is None:
        return
    for hand, lean in table(phase)["hands"].items():
        strokes, ci = int(lean["strokes"]), lean["ci"]
        interval = None if ci is None else (float(ci[0]), float(ci[1]))
        timing = TimingFigures(strokes, number(lean["late_ms"]), interval, number(lean["sd_ms"]))
        yield GroupFigures(hand.replace("_", " "), strokes, strokes, 0, 0, None, timing)


FEWEST_PASSES = 5
"""Of fewer passes the interval of a single bar is wider than all that it could tell (our choice)."""


def bar_figures(result: SessionResult, document: Document, spreads: Spreads) -> Iterator[BarFigures]:
    """The lesson's bars, with what was right and what was too many in each."""
    cells = heat_map(result).cells
    right: dict[int, int] = {}
    for (bar, _), cell in cells.items():
        right[bar] = right.get(bar, 0) + cell.right
    dots = every_hit(result).dots
    extras = dots["bar"][dots["label"] == Label.EXTRA].tolist()
    came = sum(start < result.score.bar_count for start in result.plan.pass_starts)
    for row in document["per_bar"]:
        bar = int(row["bar"])
        group = _group(f"bar {bar}", row, spreads.bars.get(bar))
        if came < FEWEST_PASSES:
            group = replace(group, timing=replace(group.timing, mean_ci=None, sd_ci=None))
        yield BarFigures(bar, group, right.get(bar, 0), extras.count(bar))


# --- what a report holds; of what is none our own words complain ----------------------------------------------------


def table(value: object) -> dict[str, Any]:
    """A table of a report; raises `TypeError` of what is none."""
    if not isinstance(value, dict):
        raise TypeError("expected a table")
    return value


def number(value: object) -> float | None:
    """A number of a report, None where it has none; raises `TypeError` of anything else."""
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise TypeError("expected a number")
    return float(value)
