"""The drummer: a score, a kit, a figure and a style in, the pose at any time out.

What a style cannot change is made once (`plan`). What it can, the keyframes of strokes and body, is made anew by
`with_style` (`keys`). A pose evaluates the splines at its time and runs forward kinematics; the arm is solved from
where the shoulder is at that instant, so that the body may move as it likes and every tip is still on its drum at the
strike.
"""

from dataclasses import dataclass, field
from functools import lru_cache
from struct import Struct

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb
from station.motion.feasibility.on_a_kit import InfeasibleDemand
from station.motion.keyframes import Keys
from station.motion.kinematics.figure import Figure, figure_of
from station.motion.kinematics.pose import Pose
from station.motion.kinematics.posture import seated
from station.motion.kit.kit import Kit, load_kit
from station.motion.motion_plan import MotionPlan, holds
from station.motion.sticking.limbs import Assignment
from station.motion.strokes.hand import HandPart
from station.motion.style.style import Style
from station.music.score import Score

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Drummer:
    """Plays `score` on `kit` with the body of `figure` in the manner of `style`; ask `pose` for any time.

    The throne of `kit` is set to the figure.

    Raises `BadInput` for a piece that a limb cannot reach: it names the piece, the note and the missing distance.
    """

    score: Score
    kit: Kit = field(default_factory=load_kit)
    figure: Figure = field(default_factory=figure_of)
    style: Style = field(default_factory=Style)
    plan: MotionPlan | None = None
    parts: tuple[HandPart, HandPart] | None = None
    keys: Keys | None = None

    def __post_init__(self) -> None:
        plan = self.plan or MotionPlan.of(self.score, seated(self.kit, self.figure), self.figure)
        object.__setattr__(self, "plan", plan)
        object.__setattr__(self, "kit", plan.kit)
        parts = self.parts or plan.hands(self.style)
        object.__setattr__(self, "parts", parts)
        object.__setattr__(self, "keys", self.keys or Keys.of(plan, parts, self.style))

    def with_style(self, style: Style) -> "Drummer":
        """The same drummer in another style; what it does not change is shared."""
        plan = self._plan
        same = holds(style) == holds(self.style) and style.heel == self.style.heel
        parts = self._hands if same else plan.hands(style)
        keys = Keys.of(plan, parts, style, self._keys)
        return Drummer(self.score, self.kit, self.figure, style, plan, parts, keys)

    @property
    def assignment(self) -> Assignment:
        """Who plays what, and why."""
        return self._plan.assignment

    @property
    def left_over(self) -> tuple[InfeasibleDemand, ...]:
        """The bars in which no way was found on which the hands meet nothing; looked for anew at each call."""
        return self._plan.left_over(self.style, self._hands)

    @property
    def _plan(self) -> MotionPlan:
        assert self.plan is not None
        return self.plan

    @property
    def _hands(self) -> tuple[HandPart, HandPart]:
        assert self.parts is not None
        return self.parts

    def swings(self, index: int, time_s: Array) -> Array:
        """How piece `index` of the kit has tipped about its right and away axes at each time, (n, 2) radians."""
        instrument = self._plan.instruments[index]
        return np.array([instrument.at(t)[:2] for t in time_s.tolist()]).reshape(-1, 2)

    def touching_m(self, row: int) -> float:
        """From the fulcrum to the part of the stick that touches at the stroke of `row` of the score."""
        hand = self._hands[0 if self.assignment.limbs[row] == Limb.RIGHT_HAND else 1]
        event = int(np.argmin(np.abs(hand.events.time_s - self.score.onset_s[row])))
        return float(hand.lies[int(hand.which[event])].contact.ahead_m)

    @property
    def _keys(self) -> Keys:
        assert self.keys is not None
        return self.keys

    def pose(self, time_s: float) -> Pose:
        """Everything at `time_s` seconds from the score's tick 0, before and after the score too."""
        keys = self._keys
        row = keys.at(time_s)
        for instrument in keys.instruments:
            row += instrument.at(time_s)
        return Pose(time_s, np.frombuffer(_packing(len(row)).pack(*row)), keys.holds)

    def rows(self, time_s: Array) -> Array:
        """The poses at each time (n,) as rows (n, fields) in the layout of `frame`; the instruments are left out."""
        row = self._keys.many(time_s)
        return np.stack([np.broadcast_to(value, time_s.shape) for value in row], axis=1)


@lru_cache(maxsize=8)
def _packing(numbers: int) -> Struct:
    return Struct(f"{numbers}d")
