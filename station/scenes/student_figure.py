"""The student's double: a second drummer, moved by the student's hits alone, limb by limb.

Nobody knows where a student's stroke will fall before it is heard, so that nothing can be planned for them. But the
demonstrator's strokes are planned already, and a stroke of the student looks like the demonstrator's of the same limb
on the same piece. So each limb of the double shows the demonstrator's limb at a time of its own: at a hit it is at once
at that stroke, from there its time runs on as the clock does, and it waits a moment before the limb's next stroke until
that is heard. A limb that plays in time moves with the demonstrator's; one that is late comes late, and one that misses
waits. Only the trunk is the demonstrator's, at every instant. Pedals go with the feet; drums and cymbals stand still,
for what the student strikes is lit by the strokes themselves.

Times are seconds of the score; asynchronies are played − written.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.events import Hit
from station.core.pieces import Limb, Piece
from station.core.units import NS_PER_S
from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.motion.kinematics.figure import Joint
from station.motion.kinematics.pose import Pose
from station.render.snapshot import LimbParting, StudentShown, TimingCue

WAITS_S = 0.07
"""A limb waits so long before its next stroke, about where the stick begins to fall (our choice)."""
AHEAD_S = 0.3
"""Strokes from so long before the score on count; what was played before that belonged to something else."""
PARTED_NS = 700_000_000
"""How long a limb glows after it parted (our choice: longer than a beat at 90 a minute)."""

_JOINTS = {
    Limb.RIGHT_HAND: range(Joint.RIGHT_SHOULDER, Joint.RIGHT_HAND + 1),
    Limb.LEFT_HAND: range(Joint.LEFT_SHOULDER, Joint.LEFT_HAND + 1),
    Limb.RIGHT_FOOT: range(Joint.RIGHT_HIP, Joint.RIGHT_TOE + 1),
    Limb.LEFT_FOOT: range(Joint.LEFT_HIP, Joint.LEFT_TOE + 1),
}


def _fields(limb: Limb) -> NDArray[np.int64]:
    """The places of a limb's numbers in a pose's row."""
    found = [frame.JOINTS.start + 3 * joint + k for joint in _JOINTS[limb] for k in range(3)]
    side = int(limb) % 2
    if limb.is_hand:
        for part in (frame.BUTT, frame.TIP, frame.PALM):
            found += [part.start + 3 * side + k for k in range(3)]
    else:
        found.append(frame.BOARDS.start + side)
    return np.array(found)


LIMB_FIELDS = {limb: _fields(limb) for limb in _JOINTS}
"""The places of each limb's numbers in a pose's row; what feet move of the pedals is apart."""


@dataclass(frozen=True, slots=True)
class _Stroke:
    """The student's last stroke with a limb: that of `row` of the score, `late_s` after it was written."""

    row: int
    late_s: float


class StudentFigure:
    """The double beside one drummer, for as long as one score is played."""

    def __init__(self) -> None:
        self._last: dict[Limb, _Stroke] = {}
        self._heard_ns = -(2**63)
        self._parted: dict[Limb, tuple[TimingCue, int]] = {}

    def heard(self, hits: Iterable[Hit], drummer: Drummer, position_s: float, now_ns: int) -> None:
        """Take in those of the last `hits` that are new; the drummer's score is at `position_s` at `now_ns`."""
        for hit in hits:
            at_s = position_s - (now_ns - hit.at_ns) / NS_PER_S
            if hit.at_ns > self._heard_ns and at_s > -AHEAD_S:
                self._heard_ns = hit.at_ns
                self._strike(hit, drummer, at_s)

    def _strike(self, hit: Hit, drummer: Drummer, at_s: float) -> None:
        """The nearest written stroke on the piece says which limb it was; without one nobody knows how to move."""
        row = nearest_note(hit.piece, drummer, at_s)
        if row is not None:
            late_s = at_s - float(drummer.score.onset_s[row])
            self._last[Limb(drummer.assignment.limbs[row])] = _Stroke(row, late_s)

    def parted(self, limb: Limb, cue: TimingCue, now_ns: int) -> None:
        """A stroke of the limb was judged: where it was not as written, the limb glows for a while."""
        self._parted[limb] = cue, now_ns

    def double(self, drummer: Drummer, position_s: float, now_ns: int) -> StudentShown:
        """How the double stands and where it glows, the score being at `position_s`."""
        now = drummer.pose(position_s)
        row = now.row.copy()
        row[frame.PLAYED :] = 0.0
        kicks, _ = drummer.kit.feet
        for limb, fields in LIMB_FIELDS.items():
            time_s = self._time_s(limb, drummer, position_s)
            if time_s != position_s:
                borrowed = drummer.pose(time_s).row
                row[fields] = borrowed[fields]
                if not limb.is_hand:
                    moved = [frame.BEATER] if limb is kicks else [frame.GAP, frame.SLAVE_BOARD, frame.SLAVE_BEATER]
                    row[moved] = borrowed[moved]
        return StudentShown(Pose(position_s, row, now.holds), self._partings(now_ns))

    def _time_s(self, limb: Limb, drummer: Drummer, position_s: float) -> float:
        """The time at which the limb is: as late as its last stroke was, and not beyond where it waits."""
        onset_s = drummer.score.onset_s[drummer.assignment.limbs == limb]
        last = self._last.get(limb)
        struck_s = -np.inf if last is None else float(drummer.score.onset_s[last.row])
        coming = onset_s[onset_s > struck_s]
        waits_s = float(coming[0]) - WAITS_S if len(coming) else np.inf
        late_s = 0.0 if last is None else last.late_s
        return max(min(position_s - late_s, waits_s), struck_s)

    def _partings(self, now_ns: int) -> dict[Limb, LimbParting]:
        ages = ((limb, cue, (now_ns - at_ns) / PARTED_NS) for limb, (cue, at_ns) in self._parted.items())
        return {limb: LimbParting(cue, 1 - age) for limb, cue, age in ages if cue not in _SYNCHRONOUS and 0 <= age < 1}


def nearest_note(piece: Piece, drummer: Drummer, at_s: float) -> int | None:
    """The row of the note on `piece` that is nearest to a time of the drummer's score; None where there is none."""
    score = drummer.score
    rows = np.flatnonzero(score.notes["piece"] == piece)
    return int(rows[np.argmin(np.abs(score.onset_s[rows] - at_s))]) if len(rows) else None


_SYNCHRONOUS = (TimingCue.NONE, TimingCue.ON_TIME)
