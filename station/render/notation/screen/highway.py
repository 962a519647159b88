"""The highway: a lane for every piece that the score asks for, its notes rolling towards the play line.

For players who do not read music. Units of the shapes are lanes, y down from the first one's top; a note is as tall as
it is loud, bears its limb's letter, and takes the colour of its judgement (with a shape, as on the staff).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.labels import LIMB_LETTERS, piece_name
from station.core.pieces import Limb, Piece
from station.music.judgement import Label
from station.music.score import Score
from station.render.notation.screen.judgement_marks import ON_TIME_MS, draw_dynamics, off_db, timing_colour
from station.render.notation.staff import PLACES
from station.render.palette import EXTRA, INK, INK_FAINT, INK_SOFT, MISSED, NIGHT, WRONG, with_opacity
from station.render.snapshot import PENDING, Snapshot
from station.render.text.atlas import Atlas
from station.render.text.draw_list import Colour, DrawList, TypeStyle
from station.render.text.fonts import Face

NAMES_SHARE = 0.14
"""The names' share of the width; our choice."""
LINE_SHARE = 0.36
"""Where the play line stands, as a share of the width: most of it is for what comes, the rest for what was played."""
SHOWN_S = 6.0
"""Seconds of music that the width stands for (our choice: nearly four of them ahead, as on the staff)."""
LABEL_LANES = 0.46
"""Size of a lane's name, in lanes."""
_LEAST, _MOST = 0.34, 0.86
"""Height of the softest and the loudest note, in lanes (our choice: both can be seen across a room)."""
_WIDE = 0.34
_WEDGE_SIZE = 0.26
_BEAT_LINE, _GROUP_LINE = 0.09, 0.18
"""How strong the lines of beats are, and of the first beats of groups; bar lines are stronger still (our choice)."""
_LEAST_LANES = 4
"""With fewer pieces the lanes grow no taller (our choice: notes stay notes)."""


def lanes(score: Score) -> list[Piece]:
    """The pieces that the score asks for, the highest on the staff first."""
    pieces = [Piece(int(piece)) for piece in np.unique(score.notes["piece"])]
    return sorted(pieces, key=lambda piece: (-PLACES[piece].step, piece))


@dataclass(frozen=True, eq=False)
class Highway:
    """The lanes of one snapshot, as shapes; `lane_px` pixels a lane."""

    snapshot: Snapshot
    atlas: Atlas
    lane_px: float

    def paper(self, width: float) -> NDArray[np.void]:
        """What stands still: lanes and their names, over `width` pixels."""
        draw_list, across = DrawList(self.atlas), width / self.lane_px
        style = TypeStyle(LABEL_LANES, INK_SOFT, Face.REGULAR, 0.0)
        for row, piece in enumerate(lanes(self.snapshot.score)):
            if row % 2 == 0:
                draw_list.box((0.0, float(row)), (across, 1.0), with_opacity(INK, 0.035))
            room = NAMES_SHARE * across - 0.3
            draw_list.text(draw_list.fitted(piece_name(piece), style, room), (0.3, row + 0.66), style)
        return draw_list.shapes()

    def rolling(self, window_s: tuple[float, float]) -> NDArray[np.void]:
        """Beats, notes and judgements between two times of the score."""
        draw_list, snapshot = DrawList(self.atlas), self.snapshot
        score = snapshot.score
        rows = {piece: row for row, piece in enumerate(lanes(score))}
        self._beats(draw_list, window_s, len(rows))
        first, last = np.searchsorted(score.onset_s, window_s)
        for i in range(int(first), int(last)):
            draw_list.time_s = float(score.onset_s[i])
            self._note(draw_list, i, rows[Piece(int(score.notes["piece"][i]))] + 0.5)
        for extra in snapshot.extras:
            if window_s[0] <= extra.time_s <= window_s[1] and extra.piece in rows:
                draw_list.time_s = extra.time_s
                draw_list.cross((0.0, rows[extra.piece] + 0.5), (0.22, 0.22), 0.1, EXTRA)
        return draw_list.shapes()

    def _beats(self, draw_list: DrawList, window_s: tuple[float, float], rows: int) -> None:
        tempo_map = self.snapshot.score.tempo_map
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
                draw_list.box((-0.02, 0.0), (0.04, float(rows)), colour)

    def _note(self, draw_list: DrawList, i: int, y: float) -> None:
        score, marks = self.snapshot.score, self.snapshot.marks
        tall = _LEAST + (_MOST - _LEAST) * int(score.notes["velocity"][i]) / 127
        grace = 0.5 if score.is_grace[i] else 1.0
        half = (_WIDE * grace / 2, tall * grace / 2)
        row = None if marks is None or marks["label"][i] == PENDING else marks[i]
        label = None if row is None else Label(int(row["label"]))
        if label is Label.MISS:
            draw_list.box((-half[0], y - half[1]), (2 * half[0], 2 * half[1]), MISSED, None, (0.08, 0.06, 0.0))
            draw_list.line((-half[0], y + half[1]), (half[0], y - half[1]), 0.06, MISSED)
            return
        if label is Label.UNKNOWN:
            draw_list.box((-half[0], y - half[1]), (2 * half[0], 2 * half[1]), INK_SOFT, None, (0.08, 0.06, 0.0))
            draw_list.text("?", (0.0, y + 0.11), TypeStyle(0.32, INK_SOFT, Face.BOLD, 0.5))
            return
        draw_list.box((-half[0], y - half[1]), (2 * half[0], 2 * half[1]), _colour(row, label), None, (0.08, 0.0, 0.0))
        if label is Label.MATCH and row is not None:
            self._judged(draw_list, row, y, off_db(int(score.notes["velocity"][i]), float(row["velocity_error"])))
        letter = self._letter(i)
        if letter and grace == 1.0:
            draw_list.text(letter, (0.0, y + 0.11), TypeStyle(0.32, NIGHT, Face.BOLD, 0.5))

    @staticmethod
    def _judged(draw_list: DrawList, row: np.void, y: float, louder_db: float | None) -> None:
        asynchrony_ms = float(row["asynchrony_ms"])
        if abs(asynchrony_ms) > ON_TIME_MS:
            way = 1.0 if asynchrony_ms > 0 else -1.0
            draw_list.triangle((way * 0.30, y), (0.09, 0.16), timing_colour(asynchrony_ms), 0.0 if way > 0 else np.pi)
        draw_dynamics(draw_list, louder_db, (0.0, y), _WEDGE_SIZE)

    def _letter(self, i: int) -> str:
        limbs = self.snapshot.limbs
        limb = Limb(int(self.snapshot.score.notes["limb"][i] if limbs is None else limbs[i]))
        return LIMB_LETTERS.get(limb, "")


def _colour(row: np.void | None, label: Label | None) -> Colour:
    if row is None:
        return INK
    return WRONG if label is Label.WRONG_PIECE else timing_colour(float(row["asynchrony_ms"]))


def lane_height(height: float, count: int) -> float:
    """Pixels a lane where `count` of them share `height`."""
    return height / max(count, _LEAST_LANES)
