"""The highway: a lane for every piece that the score asks for, its notes rolling towards the play line.

For players who do not read music. It lies, and notes come from the right, or stands upright, and they fall. A note has
its piece's colour, is as long across its lane as it is loud, and bears its limb's letter: ghosts are hollow, accents
filled from edge to edge and framed, grace notes half as large, rolls drawn out, an open hi-hat ringed. What was judged
bears the staff's own marks. Shapes are drawn in units of `LaneGrid`, along the time and across the lanes.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.labels import LIMB_LETTERS, piece_name
from station.core.pieces import Dynamic, Limb, Piece
from station.music.score import Score
from station.render.notation.screen.judgement_marks import MarkScale, draw_dynamics, draw_mark, off_db
from station.render.notation.staff import PLACES
from station.render.notation.staff_rows import OPEN_FROM, WIDE_FROM
from station.render.palette import EXTRA, INK, INK_FAINT, NIGHT, piece_colour, with_opacity
from station.render.snapshot import PENDING, Snapshot
from station.render.text.atlas import Atlas
from station.render.text.draw_list import DrawList, TypeStyle
from station.render.text.fonts import Face

MARK_UNITS = 0.42
"""A staff space of a mark, in units: a ring round a note (our choice)."""
NAME_UNITS = 0.5
"""Size of a lane's name."""
_LEAST, _MOST = 0.30, 0.86
"""How far across its lane the softest and the loudest note reaches (our choice: both can be seen across a room)."""
_ALONG = 0.36
"""How long a note is along the time, where the next one leaves it room."""
_CORNER, _FRAME, _HOLLOW = 0.08, 0.06, 0.07
_LETTER, _LETTER_DROP = 0.34, 0.12
_BEAT_LINE, _GROUP_LINE = 0.10, 0.20
"""How strong the lines of beats are, and of the first beats of groups; bar lines are stronger still (our choice)."""
_EXTRA_SIZE, _EXTRA_WIDTH = 0.22, 0.1
_RING = 0.30


def lanes(score: Score) -> list[Piece]:
    """The pieces that the score asks for, the highest on the staff first."""
    pieces = [Piece(int(piece)) for piece in np.unique(score.notes["piece"])]
    return sorted(pieces, key=lambda piece: (-PLACES[piece].step, piece))


@dataclass(frozen=True, slots=True)
class LaneGrid:
    """Where lanes lie: how wide each is in units, and whether notes fall; then the lowest piece is on the left."""

    pieces: tuple[Piece, ...]
    lane: float = 1.0
    falls: bool = False

    def at(self, along: float, piece: Piece) -> tuple[float, float]:
        """The place so far along the time from a shape's anchor, in the middle of a piece's lane."""
        return self.point(along, self._number(piece) * self.lane + self.lane / 2)

    def point(self, along: float, across: float) -> tuple[float, float]:
        """The same, so far across the lanes."""
        return (across, -along) if self.falls else (along, across)

    def edges(self, piece: Piece) -> tuple[float, float]:
        """From where to where across a piece's lane lies."""
        return self._number(piece) * self.lane, (self._number(piece) + 1) * self.lane

    @property
    def across(self) -> float:
        """All lanes together."""
        return len(self.pieces) * self.lane

    def box(
        self,
        draw_list: DrawList,
        middle: tuple[float, float],
        size: tuple[float, float],
        colour: tuple[float, float, float, float],
        style: tuple[float, float, float] = (0.0, 0.0, 0.0),
    ) -> None:
        """A box round `middle`, its size along and across."""
        wide, high = size[::-1] if self.falls else size
        draw_list.box((middle[0] - wide / 2, middle[1] - high / 2), (wide, high), colour, None, style)

    def _number(self, piece: Piece) -> int:
        number = self.pieces.index(piece)
        return len(self.pieces) - 1 - number if self.falls else number


@dataclass(frozen=True, eq=False)
class Highway:
    """The lanes of one snapshot, as shapes; `units_per_s` units of its grid go by in a second."""

    snapshot: Snapshot
    atlas: Atlas
    grid: LaneGrid
    units_per_s: float

    def paper(self, length: float, line: float, names: float) -> NDArray[np.void]:
        """What stands still: lanes `length` along, their names within `names`, rings where the notes arrive.

        Units run along from the play line, which is `line` from the near end.
        """
        draw_list, grid = DrawList(self.atlas), self.grid
        for piece in grid.pieces:
            colour = piece_colour(piece)
            low, high = grid.edges(piece)
            middle = grid.point(length / 2 - line, (low + high) / 2)
            grid.box(draw_list, middle, (length, high - low - 0.06), with_opacity(colour, 0.07), (_CORNER, 0, 0))
            grid.box(draw_list, grid.at(0.0, piece), (_ALONG, grid.lane * _MOST), colour, (_CORNER, _FRAME, 0.0))
            self._name(draw_list, piece, line, names)
        return draw_list.shapes()

    def _name(self, draw_list: DrawList, piece: Piece, line: float, names: float) -> None:
        """A lane's name, in its colour: left of a lane that lies, below one that stands."""
        grid, name, style = self.grid, piece_name(piece), TypeStyle(NAME_UNITS, piece_colour(piece), Face.BOLD)
        room = grid.lane - 0.1 if grid.falls else names - 0.4
        size = min(NAME_UNITS, NAME_UNITS * room / max(draw_list.width(name, style), 1e-6))
        style = TypeStyle(size, piece_colour(piece), Face.BOLD, 0.5 if grid.falls else 0.0)
        x, y = grid.at(names / 2 - line if grid.falls else 0.3 - line, piece)
        draw_list.text(name, (x, y + 0.36 * size), style)

    def rolling(self, window_s: tuple[float, float]) -> NDArray[np.void]:
        """Beats and notes between two times of the score."""
        draw_list, score = DrawList(self.atlas), self.snapshot.score
        self._beats(draw_list, window_s)
        first, last = np.searchsorted(score.onset_s, window_s).tolist()
        along = self._lengths(first, last)
        for i in range(first, last):
            draw_list.time_s = float(score.onset_s[i])
            self._note(draw_list, i, along[i - first])
        return draw_list.shapes()

    def marks(self, window_s: tuple[float, float]) -> NDArray[np.void]:
        """Judgements between two times, in staff spaces of `MARK_UNITS`."""
        draw_list, snapshot, grid = DrawList(self.atlas), self.snapshot, self.grid
        score, marks = snapshot.score, snapshot.marks
        scale = MarkScale(self.units_per_s / MARK_UNITS, snapshot.on_time_ms, grid.falls)
        if marks is not None:
            first, last = np.searchsorted(score.onset_s, window_s).tolist()
            judged = first + np.flatnonzero((marks["label"][first:last] != PENDING) & ~score.is_grace[first:last])
            for i in judged.tolist():
                draw_list.time_s = float(score.onset_s[i])
                at = self._mark_at(Piece(int(score.notes["piece"][i])))
                draw_mark(draw_list, marks[i], at, scale)
                error = float(marks["velocity_error"][i])
                draw_dynamics(draw_list, off_db(int(score.notes["velocity"][i]), error), at)
        size = _EXTRA_SIZE / MARK_UNITS
        for extra in snapshot.extras:
            if window_s[0] <= extra.time_s <= window_s[1] and extra.piece in grid.pieces:
                draw_list.time_s = extra.time_s
                draw_list.cross(self._mark_at(extra.piece), (size, size), _EXTRA_WIDTH / MARK_UNITS, EXTRA)
        return draw_list.shapes()

    def _mark_at(self, piece: Piece) -> tuple[float, float]:
        x, y = self.grid.at(0.0, piece)
        return x / MARK_UNITS, y / MARK_UNITS

    def _beats(self, draw_list: DrawList, window_s: tuple[float, float]) -> None:
        tempo_map, grid = self.snapshot.score.tempo_map, self.grid
        last_bar = self.snapshot.score.bar_count
        ticks = tempo_map.ticks_at([max(time_s, 0.0) for time_s in window_s])
        first, last = tempo_map.bars_at(ticks).tolist()
        for bar in range(first, min(last, last_bar) + 1):
            start, end = tempo_map.bar_start(bar), tempo_map.bar_start(bar + 1)
            meter = tempo_map.meter_at(start)
            groups = meter.group_starts if max(meter.felt_groups) > 1 else (0,)
            for tick in range(start, end, meter.beat_ticks) if bar < last_bar else (start,):
                beat = (tick - start) // meter.beat_ticks
                opacity = _GROUP_LINE if beat in groups else _BEAT_LINE
                draw_list.time_s = float(tempo_map.seconds_at(tick))
                colour = INK_FAINT if beat == 0 else with_opacity(INK, opacity)
                middle = grid.point(0.0, grid.across / 2)
                grid.box(draw_list, middle, (0.07 if beat == 0 else 0.04, grid.across), colour)

    def _lengths(self, first: int, last: int) -> list[float]:
        """How long notes are along the time: shorter where the next on the piece leaves no room."""
        score = self.snapshot.score
        pieces, onsets_s = score.notes["piece"][first:last], score.onset_s[first:last]
        found = np.full(last - first, _ALONG)
        for piece in np.unique(pieces):
            rows = np.flatnonzero(pieces == piece)
            gaps = np.diff(onsets_s[rows], append=np.inf) * self.units_per_s
            found[rows] = np.clip(0.8 * gaps, 0.06, _ALONG)
        return found.tolist()

    def _note(self, draw_list: DrawList, i: int, along: float) -> None:
        score, grid = self.snapshot.score, self.grid
        note = score.notes[i]
        piece, dynamic = Piece(int(note["piece"])), int(note["dynamic"])
        colour, at = piece_colour(piece), grid.at(0.0, piece)
        across = grid.lane * (_LEAST + (_MOST - _LEAST) * int(note["velocity"]) / 127)
        if score.is_grace[i]:
            along, across = along / 2, across / 2
        self._tail(draw_list, i, colour)
        if dynamic == Dynamic.GHOST:
            grid.box(draw_list, at, (along, across), colour, (_CORNER, _HOLLOW, 0.0))
        else:
            grid.box(draw_list, at, (along, across), colour, (_CORNER, 0.0, 0.0))
        if dynamic == Dynamic.ACCENT:
            grid.box(draw_list, at, (along + 0.12, grid.lane * 0.94), INK, (_CORNER, _FRAME, 0.0))
        if piece == Piece.HIHAT and note["openness"] >= OPEN_FROM:
            is_wide = note["openness"] >= WIDE_FROM
            draw_list.ellipse(at, (_RING, _RING), INK, 0.0, (0.0, 0.07 if is_wide else 0.035, 0.0))
        letter = self._letter(i)
        if letter and not score.is_grace[i] and along > _ALONG / 2:
            ink = colour if dynamic == Dynamic.GHOST else NIGHT
            draw_list.text(letter, (at[0], at[1] + _LETTER_DROP), TypeStyle(_LETTER, ink, Face.BOLD, 0.5))

    def _tail(self, draw_list: DrawList, i: int, colour: tuple[float, float, float, float]) -> None:
        """How long a roll lasts."""
        score, grid = self.snapshot.score, self.grid
        ticks = int(score.notes["duration_ticks"][i])
        if ticks <= 0:
            return
        start = int(score.notes["tick"][i])
        start_s, end_s = score.tempo_map.seconds_at([start, start + ticks]).tolist()
        draw_list.span_s = end_s - start_s
        at = grid.at(0.0, Piece(int(score.notes["piece"][i])))
        grid.box(draw_list, at, (0.0, grid.lane * _LEAST), with_opacity(colour, 0.55))
        draw_list.span_s = 0.0

    def _letter(self, i: int) -> str:
        limbs = self.snapshot.limbs
        limb = Limb(int(self.snapshot.score.notes["limb"][i] if limbs is None else limbs[i]))
        return LIMB_LETTERS.get(limb, "")
