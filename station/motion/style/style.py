"""How the drummer moves: the controls of expression, and how they change over the bars.

Amplitudes and frequencies are 0–100 as in the thesis (§ 4.1.1, figure 4.3), but the natural drummer stands in the
middle of each and the whole range is of use, which the thesis asks for: what is set is compared with the natural
setting, and the factor is bent so that it never passes `MOST`. The arm has a gain for each of amplitude and frequency,
and each joint a share of it in per cent; `with_share` moves one share and keeps the ratio of the other two.

Every number, a piece's amplitude too, may be automated: a list of (bar, value) from which it is read by straight lines,
so that phrases are played differently (thesis § 4.4.1, local control).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

from station.core.errors import BadInput
from station.core.pieces import Piece, word
from station.motion.kinematics.figure import figure_names

Array = NDArray[np.float64]

NATURAL = 50.0
MOST = 2.5
"""No control more than this multiplies what a natural drummer does (our choice)."""

JOINTS = ("wrist", "elbow", "shoulder")
HOLDS = ("grip_right", "grip_left", "held", "heel")
"""What changes the hands' whole way through a score, and takes longer to make anew than a picture lasts."""
_NATURAL_SHARES = MappingProxyType(
    {
        "amplitude_wrist": 40.0,
        "amplitude_elbow": 30.0,
        "amplitude_shoulder": 30.0,
        "frequency_wrist": 34.0,
        "frequency_elbow": 33.0,
        "frequency_shoulder": 33.0,
    }
)

ANYBODY = "any"
"""No drummer in particular."""

Automation = tuple[tuple[float, float], ...]
"""(bar from 1, value) in rising order; a fraction is a place within the bar."""


@dataclass(frozen=True, slots=True)
class Style:
    """All controls; the module's head tells the scale of amplitudes and frequencies.

    Angles in degrees; `twist_deg_s` the ceiling of the torso's speed; `stand` 0 sits … 1 stands; `half_time_bpm` from
    which on the back sways in half time; `bobs_per_beat` of the head, a half, 1 or 2; `lay_back_ms` how long after the
    beat body and head reach it; `mood` names the face, `attention` what is looked at in between;
    `grip_right`, `grip_left`, `held` name entries of `grip`; `heel` "down", "up"; `beater` "rebound" or "buried";
    `drummer` who plays so where the user asks for nobody, a shipped figure or "any"; `pieces` an amplitude for single
    pieces, 50 natural; `seed` of all that chance decides.
    """

    name: str = "natural"
    amplitude_gain: float = NATURAL
    amplitude_wrist: float = _NATURAL_SHARES["amplitude_wrist"]
    amplitude_elbow: float = _NATURAL_SHARES["amplitude_elbow"]
    amplitude_shoulder: float = _NATURAL_SHARES["amplitude_shoulder"]
    amplitude_fingers: float = NATURAL
    frequency_gain: float = NATURAL
    frequency_wrist: float = _NATURAL_SHARES["frequency_wrist"]
    frequency_elbow: float = _NATURAL_SHARES["frequency_elbow"]
    frequency_shoulder: float = _NATURAL_SHARES["frequency_shoulder"]
    whip: float = NATURAL
    amplitude_neck: float = NATURAL
    frequency_neck: float = NATURAL
    amplitude_head_side: float = 15.0
    amplitude_back: float = NATURAL
    frequency_back: float = NATURAL
    amplitude_side: float = 20.0
    amplitude_twist: float = NATURAL
    twist_deg_s: float = 80.0
    amplitude_gaze: float = NATURAL
    amplitude_heel: float = NATURAL
    shrug: float = 20.0
    breathing: float = NATURAL
    wing_deg: float = 0.0
    posture_deg: float = 6.0
    stand: float = 0.0
    flourish: float = 0.0
    look_around: float = 20.0
    variation: float = NATURAL
    backbeat: float = NATURAL
    chin: float = 10.0
    headbang: float = 0.0
    lay_back_ms: float = 0.0
    hunch_deg: float = 0.0
    shimmy: float = 0.0
    phrase: float = 25.0
    fill_lean: float = NATURAL
    rise: float = 0.0
    expression: float = NATURAL
    bobs_per_beat: float = 1.0
    half_time_bpm: float = 130.0
    grip_right: str = "american"
    grip_left: str = "american"
    held: str = "stick"
    heel: str = "down"
    beater: str = "rebound"
    mood: str = "focused"
    attention: str = "kit"
    drummer: str = ANYBODY
    seed: int = 1
    pieces: Mapping[Piece, float] = field(default_factory=dict)
    automation: Mapping[str, Automation] = field(default_factory=dict)

    def value(self, control: str, bars: ArrayLike) -> Array:
        """What `control` is at each place in bars from 1."""
        return self._read(control, float(getattr(self, control)), bars)

    def piece_factor(self, piece: Piece, bars: ArrayLike) -> Array:
        """What multiplies the strokes on `piece` at each place in bars."""
        return bent(self._read(word(piece), self.pieces.get(piece, NATURAL), bars) / NATURAL)

    @property
    def own_pieces(self) -> frozenset[Piece]:
        """The pieces that have an amplitude of their own somewhere."""
        return frozenset(self.pieces) | {p for p in Piece if word(p) in self.automation}

    def _read(self, name: str, unchanged: float, bars: ArrayLike) -> Array:
        """What the automation of `name` says, or `unchanged` where it says nothing."""
        points = self.automation.get(name)
        if points is None:
            return np.broadcast_to(np.float64(unchanged), np.shape(bars))
        at, values = np.array(points, np.float64).T
        return np.asarray(np.interp(np.asarray(bars, np.float64), at, values))

    def factor(self, control: str, bars: ArrayLike) -> Array:
        """What multiplies the natural movement, from a control that is natural at 50."""
        if control not in self.automation:  # one number for all bars is bent once
            return np.broadcast_to(bent(float(getattr(self, control)) / NATURAL), np.shape(bars))
        return bent(self.value(control, bars) / NATURAL)

    def joint_factor(self, kind: str, joint: str, bars: ArrayLike) -> Array:
        """What multiplies a joint's natural amplitude or frequency: its gain times its share, against the natural."""
        share = f"{kind}_{joint}"
        set_to = self.value(f"{kind}_gain", bars) * self.value(share, bars)
        return bent(set_to / (NATURAL * _NATURAL_SHARES[share]))

    def with_share(self, kind: str, joint: str, per_cent: float) -> "Style":
        """One joint's share of `kind` ("amplitude", "frequency") set; the others keep their ratio (thesis § 4.1.1)."""
        others = [j for j in JOINTS if j != joint]
        had = [float(getattr(self, f"{kind}_{j}")) for j in others]
        left = 100.0 - min(max(per_cent, 0.0), 100.0)
        total = sum(had)
        parts = [left * (h / total if total else 0.5) for h in had]
        values = {f"{kind}_{j}": p for j, p in zip(others, parts, strict=True)}
        return replace(self, **{f"{kind}_{joint}": 100.0 - left}, **values)  # type: ignore[arg-type] # floats only

    def holding_as(self, other: "Style") -> "Style":
        """The same with hands that hold what they hold in `other`: all that is left is renewed at once."""
        return replace(self, **{name: getattr(other, name) for name in HOLDS})


def bent(x: ArrayLike) -> Array:
    """`x` up to 1, and beyond it a curve with the same slope that never passes `MOST`."""
    over = np.maximum(np.asarray(x, np.float64) - 1.0, 0.0) / (MOST - 1.0)
    result: Array = np.minimum(x, 1.0) + (MOST - 1.0) * (1.0 - np.exp(-over))
    return result


NUMBERS = tuple(f.name for f in fields(Style) if f.type == "float" or f.type is float)
"""The controls that are numbers and can be automated."""
_RANGES: Mapping[str, tuple[float, float]] = MappingProxyType(
    {
        "wing_deg": (-10.0, 20.0),
        "posture_deg": (-10.0, 12.0),
        "stand": (0.0, 1.0),
        "twist_deg_s": (5.0, 100.0),
        "bobs_per_beat": (0.5, 2.0),
        "half_time_bpm": (30.0, 1000.0),
        "lay_back_ms": (-40.0, 80.0),
        "hunch_deg": (-10.0, 20.0),
    }
)
WORDS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "grip_right": ("american", "german", "french"),
        "grip_left": ("american", "german", "french", "traditional"),
        "held": ("stick", "brush", "mallet", "hand"),
        "heel": ("down", "up"),
        "beater": ("rebound", "buried"),
        "mood": ("focused", "calm", "joyful", "intense", "cool", "soulful"),
        "attention": ("kit", "hands", "friend", "audience", "above"),
        "drummer": (ANYBODY, *figure_names()),
    }
)


def range_of(control: str) -> tuple[float, float]:
    """The least and greatest value of a control that is a number."""
    return _RANGES.get(control, (0.0, 100.0))


def checked(style: Style) -> Style:
    """`style` itself; raises `BadInput` that names the control whose value is out of its range."""
    for control in NUMBERS:
        low, high = range_of(control)
        points = [v for _, v in style.automation.get(control, ())]
        for value in (getattr(style, control), *points):
            if not low <= value <= high:
                raise BadInput(style.name, control, f"expected {low:g} to {high:g}, found {value:g}")
    for control, words in WORDS.items():
        if getattr(style, control) not in words:
            raise BadInput(style.name, control, f"expected {', '.join(words)}, found {getattr(style, control)!r}")
    return style
