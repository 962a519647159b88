"""The judgements on a staff: the marks of the notes of some bars, and a cross for each stroke too many.

Units are staff spaces, y down, 0 on the staff's middle line; shapes are anchored in time as the score's are.
"""

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.music.judgement import Label
from station.render.notation.screen.judgement_marks import MarkScale, draw_asynchrony, draw_dynamics, draw_mark, off_db
from station.render.notation.staff import PLACES, height
from station.render.palette import EXTRA
from station.render.snapshot import PENDING, Snapshot
from station.render.text.atlas import Atlas
from station.render.text.draw_list import DrawList

MS_APART = 4.0
"""Staff spaces to the strokes beside a note from which its mark is told in figures, too: "+123" under its arrow stays
clear of the next ring."""
_CROSS, _CROSS_WIDTH = 0.42, 0.2


def staff_marks(
    snapshot: Snapshot, bars: tuple[int, int], heads_x: NDArray[np.float64], spaces_per_s: float, atlas: Atlas
) -> NDArray[np.void]:
    """The marks in `bars`, first and the one after the last, where heads stand `heads_x` (n,) beside their times."""
    draw_list, score, marks = DrawList(atlas), snapshot.score, snapshot.marks
    tempo_map, scale = score.tempo_map, MarkScale(spaces_per_s, snapshot.on_time_ms)
    ticks = [tempo_map.bar_start(bar) for bar in bars]
    if marks is not None:
        first, last = np.searchsorted(score.notes["tick"], ticks).tolist()
        judged = first + np.flatnonzero((marks["label"][first:last] != PENDING) & ~score.is_grace[first:last])
        times_s = np.asarray(tempo_map.seconds_at(score.notes["tick"][judged]), np.float64)
        has_room = _has_room(snapshot, judged, spaces_per_s)
        for i, time_s, is_told in zip(judged.tolist(), times_s.tolist(), has_room, strict=True):
            draw_list.time_s = time_s
            at = float(heads_x[i]), height(PLACES[Piece(int(score.notes["piece"][i]))].step)
            draw_mark(draw_list, marks[i], at, scale)
            draw_dynamics(draw_list, off_db(int(score.notes["velocity"][i]), float(marks["velocity_error"][i])), at)
            if is_told and marks["label"][i] == Label.MATCH:
                draw_asynchrony(draw_list, float(marks["asynchrony_ms"][i]), at, snapshot.on_time_ms)
    start_s = -np.inf if bars[0] == 0 else float(tempo_map.seconds_at(ticks[0]))
    end_s = np.inf if bars[1] >= score.bar_count else float(tempo_map.seconds_at(ticks[1]))
    for extra in snapshot.extras:
        if start_s <= extra.time_s < end_s:
            draw_list.time_s = extra.time_s
            middle = (0.0, height(PLACES[extra.piece].step))
            draw_list.cross(middle, (_CROSS, _CROSS), _CROSS_WIDTH, EXTRA)
    return draw_list.shapes()


def _has_room(snapshot: Snapshot, rows: NDArray[np.int64], spaces_per_s: float) -> list[bool]:
    """Whether figures fit beside the marks of `rows`: in a picture that is to be studied, where strokes stand apart."""
    if not snapshot.is_replay:
        return [False] * len(rows)
    onsets_s = np.unique(snapshot.score.onset_s)
    at = np.searchsorted(onsets_s, snapshot.score.onset_s[rows])
    apart = np.diff(onsets_s, prepend=-np.inf, append=np.inf) * spaces_per_s
    return (np.minimum(apart[at], apart[at + 1]) >= MS_APART).tolist()  # type: ignore[no-any-return]
