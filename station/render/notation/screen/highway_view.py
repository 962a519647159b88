"""Draws the highway into its place, lying or upright, with the play line across all lanes."""

from station.music.score import Score
from station.render.gpu.shape_renderer import ShapeRenderer, Transform
from station.render.notation.screen.highway import MARK_UNITS, Highway, LaneGrid, lanes
from station.render.notation.screen.kept_values import KeptValues
from station.render.notation.screen.score_place import ScoreForm, ScorePlace
from station.render.notation.screen.time_span import BEHIND_SHARE, MOST_AHEAD_S, two_bars_s, visible_bars
from station.render.palette import BRAND, with_opacity
from station.render.snapshot import Snapshot
from station.render.text.atlas import Atlas

_LEAST_LANES = 4
"""With fewer pieces the lanes grow no wider (our choice: notes stay notes)."""
_NAMES_SHARE = 0.12
"""The names' share of a highway that lies (our choice)."""
_FALLING_LINE, _FALLING_NAMES = 0.20, 0.08
"""Where the line of an upright one stands from below, and what the names take under it (our choice)."""
_FALLING_UNIT = 0.055
"""A unit of an upright one, as a share of its height: two bars of sixteenths stand apart (our choice)."""

_UPBEAT_S = 1.0
"""Strokes so long before the first bar that is seen are drawn, too: grace strokes, and what came early."""


class HighwayView:
    """Draws highways, the bars that are seen anew only where others come into sight."""

    def __init__(self, printer: ShapeRenderer, atlas: Atlas) -> None:
        self._printer, self._atlas = printer, atlas
        self._kept = KeptValues()

    def draw_paper(self, snapshot: Snapshot, place: ScorePlace, size: tuple[int, int], form: ScoreForm) -> None:
        """Draw the lanes and their names."""
        way = _Way(snapshot, place, form)
        highway = Highway(snapshot, self._atlas, way.grid, way.per_s / way.unit)
        shapes = highway.paper(way.length / way.unit, way.behind / way.unit, way.names / way.unit)
        self._printer.draw(shapes, Transform(size, way.origin, way.unit))

    def draw(self, snapshot: Snapshot, place: ScorePlace, size: tuple[int, int], form: ScoreForm) -> None:
        """Draw what moves over them."""
        way = _Way(snapshot, place, form)
        highway = Highway(snapshot, self._atlas, way.grid, way.per_s / way.unit)
        at_s, falls = snapshot.position_s, way.grid.falls
        score, per_s = snapshot.score, way.per_s
        bars = visible_bars(score, at_s - way.behind / per_s, at_s + (way.length - way.behind) / per_s)
        window_s = _window_s(score, bars)
        known = score, way.grid, bars, highway.units_per_s
        rolled = self._kept.once("rolled", (*known, snapshot.limbs), lambda: highway.rolling(window_s))
        judged = (*known, snapshot.marks, snapshot.extras)
        marks = self._kept.once("marks", judged, lambda: highway.marks(window_s))
        line, across = with_opacity(BRAND, 0.95), way.grid.across * way.unit
        x, y = way.origin
        box = (x, y - 2.0, across, 4.0) if falls else (x - 2.0, y, 4.0, across)
        self._printer.fill(box, (line, line), Transform(size))
        rolling = Transform(size, way.origin, way.unit, at_s, way.per_s, way.fade, falls)
        self._printer.draw(rolled, rolling)
        marked = Transform(size, way.origin, way.unit * MARK_UNITS, at_s, way.per_s, way.fade, falls)
        self._printer.draw(marks, marked)


def _window_s(score: Score, bars: range) -> tuple[float, float]:
    """From when until when whole bars last, with what comes before the first beat of the first."""
    starts = [score.tempo_map.bar_start(bar) for bar in (bars.start, bars.stop)]
    start_s, end_s = score.tempo_map.seconds_at(starts).tolist()
    return start_s - _UPBEAT_S, end_s


class _Way:
    """Pixels of a highway in its place: `length` along the time, `behind` the play line, `names` at the near end.

    `unit` and `per_s` are pixels a unit and a second, `origin` the play line's upper or left end.
    """

    def __init__(self, snapshot: Snapshot, place: ScorePlace, form: ScoreForm) -> None:
        pieces = tuple(lanes(snapshot.score))
        falls, count = form is ScoreForm.FALLING, max(len(pieces), 1)
        right, bottom = place.left + place.width, place.top + place.height
        self.length, across = (place.height, place.width) if falls else (place.width, place.height)
        lane_px = across / max(count, _LEAST_LANES)
        self.unit = min(lane_px, self.length * _FALLING_UNIT) if falls else lane_px
        self.behind = self.length * (_FALLING_LINE if falls else BEHIND_SHARE)
        self.names = self.length * (_FALLING_NAMES if falls else _NAMES_SHARE)
        self.per_s = (self.length - self.behind) / max(two_bars_s(snapshot.score), MOST_AHEAD_S)
        self.grid = LaneGrid(pieces, lane_px / self.unit, falls)
        aside = (across - count * lane_px) / 2
        if falls:
            self.origin = place.left + aside, bottom - self.behind
            self.fade = place.top, place.top + self.unit, bottom - self.names - self.unit, bottom - self.names
        else:
            self.origin = place.left + self.behind, place.top + aside
            left = place.left + self.names
            self.fade = left, left + self.unit, right - self.unit, right
