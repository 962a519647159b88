"""What each style and each control does, measured on the motion itself: writes docs/styles.md.

    python -m tools.style_table

Angles in degrees, lengths in centimetres, times in milliseconds. Every control is moved from its least to its greatest
value while the others stay natural, on the score that shows it best.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece, Zone
from station.core.units import PPQ
from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.motion.kinematics.figure import Joint
from station.motion.kinematics.pose import ANGLE_NAMES
from station.motion.style.style import NUMBERS, Style, range_of
from station.motion.style.style_file import load_style, style_names
from station.music.score import Note, Score
from station.music.tempo import TempoMap

Array = NDArray[np.float64]
Measure = Callable[[Array], float]
"""Rows of poses, 100 a second, in the layout of `frame` to one number."""

PAGE = Path(__file__).parent.parent / "docs" / "styles.md"
STEPS = (0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0)
"""Places in a control's range."""
_RATE_HZ = 100.0


def _score(strokes: list[tuple[float, Piece, Zone, Limb]], bpm: float = 60.0, velocity: int = 80) -> Score:
    """Strokes at beats from 0; the tempo is constant."""
    notes = [Note(round(beat * PPQ), piece, zone, velocity, limb=limb) for beat, piece, zone, limb in strokes]
    return Score.from_notes(notes, TempoMap.constant(bpm))


_R, _L, _K = Limb.RIGHT_HAND, Limb.LEFT_HAND, Limb.RIGHT_FOOT
_FAR = ((Piece.CRASH_1, Zone.EDGE, _L), (Piece.FLOOR_TOM_1, Zone.HEAD, _R))
_STROKES = _score([(float(i), Piece.SNARE, Zone.HEAD, _R) for i in range(8)], velocity=120)
_TURNS = _score([(8.0 * i, *_FAR[i % 2]) for i in range(6)])
_RESTS = _score([(6.0 * i, Piece.SNARE, Zone.HEAD, _R) for i in range(40)], 120.0)
_SWINGS = _score([(2.0 * i + 0.125 * k, *_FAR[i % 2]) for i in range(12) for k in range(12)], 120.0)
_GROOVE = _score(
    [(0.5 * i, Piece.HIHAT, Zone.BOW, _R) for i in range(32)]
    + [(2.0 * i + 1, Piece.SNARE, Zone.HEAD, _L) for i in range(8)]
    + [(2.0 * i, Piece.KICK, Zone.HEAD, _K) for i in range(8)]
    + [(15.0, Piece.TOM_1, Zone.HEAD, _L), (15.5, Piece.FLOOR_TOM_1, Zone.HEAD, _R)],
    100.0,
)
_FILL = _score(
    [(0.5 * i, Piece.HIHAT, Zone.BOW, _R) for i in range(24)]
    + [(12.0 + 0.25 * i, Piece.TOM_1, Zone.HEAD, (_R, _L)[i % 2]) for i in range(16)]
    + [(16.0, Piece.CRASH_1, Zone.EDGE, _L), (18.0, Piece.SNARE, Zone.HEAD, _R)],
    120.0,
    100,
)
"""Single strokes, wide turns, long rests, quick turns; eighths, backbeat and the beginning of a fill; a fill
and a crash."""


@cache
def _drummer(score: Score) -> Drummer:
    return Drummer(score)


def rows(score: Score, style: Style) -> Array:
    """The poses while `score` is played, in `style`."""
    return _drummer(score).with_style(style).rows(np.arange(0.0, float(score.onset_s[-1]), 1 / _RATE_HZ))


def _angle(poses: Array, name: str) -> Array:
    return np.degrees(poses[:, frame.ANGLES.start + ANGLE_NAMES.index(name)])


def extent(name: str) -> Measure:
    """How far the angle goes."""
    return lambda poses: float(np.ptp(_angle(poses, name)))


def speed(name: str) -> Measure:
    """The angle's greatest speed, degrees a second."""
    return lambda poses: float(np.abs(np.diff(_angle(poses, name))).max() * _RATE_HZ)


def mean(name: str) -> Measure:
    """The angle's mean."""
    return lambda poses: float(_angle(poses, name).mean())


def _height(joint: Joint, how: Callable[[Array], np.float64]) -> Measure:
    return lambda poses: 100 * float(how(poses[:, frame.JOINTS.start + 3 * joint + 2]))


def _whip_ms(poses: Array) -> float:
    """From the shoulder's top to the wrist's before the strikes, in the mean."""
    beats = [slice(int(k * _RATE_HZ) - 60, int(k * _RATE_HZ)) for k in range(2, 7)]
    tops = [[int(_angle(poses[b], f"right_{j}").argmax()) for j in ("shoulder", "wrist")] for b in beats]
    return float(np.mean([wrist - shoulder for shoulder, wrist in tops]) * 1000 / _RATE_HZ)


def _late(name: str) -> Measure:
    """When half of the fall onto the beats 2 to 6 of single strokes is done, in per cent of the half beat before."""

    def share(poses: Array) -> float:
        at, beat = _angle(poses, name), int(_RATE_HZ)
        found = []
        for end in range(2 * beat, 7 * beat, beat):
            fall = at[end - beat : end + 1]
            low = int(np.argmin(fall))
            done = (fall[low:] - fall[low]) / (fall[-1] - fall[low])
            half = low + float(np.interp(0.5, done, np.arange(len(done))))
            found.append(100 * (1 - (beat - half) / (beat / 2)))
        return float(np.mean(found))

    return share


def _aside(poses: Array) -> float:
    """How far the right elbow is from the shoulder, to the right, in the mean."""
    away = poses[:, 3 * Joint.RIGHT_ELBOW] - poses[:, 3 * Joint.RIGHT_SHOULDER]
    return 100 * float(away.mean())


def _times_over(name: str, degrees: float) -> Measure:
    """How often the angle has risen over so many degrees."""
    return lambda poses: float((np.diff((np.abs(_angle(poses, name)) > degrees).astype(int)) > 0).sum())


def _shown(poses: Array) -> float:
    """How often the right hand has gone up to where sticks are spun and tossed."""
    high = poses[:, frame.JOINTS.start + 3 * Joint.RIGHT_HAND + 2] > _SHOWN_M
    return float((np.diff(high.astype(int)) > 0).sum())


def _tops(poses: Array) -> Array:
    """How high the right tip rises before each of the strokes on the beats 1 to 6."""
    z = poses[:, frame.TIP.start + 2]
    return np.asarray([z[int(k * _RATE_HZ) : int((k + 1) * _RATE_HZ)].max() for k in range(6)] - z.min())


def _scatter(poses: Array) -> float:
    tops = _tops(poses)
    return 100 * float(tops.std() / tops.mean())


def _backbeat(poses: Array) -> float:
    nod = _angle(poses, "head_nod")[:: int(_RATE_HZ)]
    return float(nod[1:6:2].mean() - nod[2:7:2].mean())


def _push(poses: Array) -> float:
    """How far the head moves to and fro over the neck."""
    neck, head = (poses[:, 3 * joint : 3 * joint + 3] for joint in (Joint.NECK, Joint.HEAD))
    return 100 * float(np.ptp((head - neck)[:, 1]))


def _behind_ms(poses: Array) -> float:
    """From beat 3 to the deepest nod beside it."""
    near = slice(int(2.8 * _RATE_HZ), int(3.2 * _RATE_HZ))
    at = np.arange(len(poses))[near] / _RATE_HZ
    nod = _angle(poses, "head_nod")[near]
    k = int(np.argmax(nod))
    a, b, c = nod[k - 1 : k + 2]  # the parabola through the three highest
    return 1000 * float(at[k] - 3.0 + 0.5 * (a - c) / (a - 2 * b + c) / _RATE_HZ)


def _rounding(poses: Array) -> float:
    """The mean angle of the upper back over the lower one, forward."""
    pelvis, spine, neck = (poses[:, 3 * j : 3 * j + 3] for j in (Joint.PELVIS, Joint.SPINE, Joint.NECK))
    lower, upper = spine - pelvis, neck - spine
    tips = [np.degrees(np.arctan2(v[:, 1], v[:, 2])) for v in (lower, upper)]
    return float((tips[1] - tips[0]).mean())


def _brow(poses: Array) -> float:
    return 100 * float(np.ptp(poses[:, frame.FACE.start]))


_SHOWN_M = 1.05
"""A hand so high over the floor shows a flourish: no stroke on the snare raises it so far."""


_SWAYING = Style(breathing=0.0, variation=0.0, phrase=0.0, fill_lean=0.0, look_around=0.0)
_STILL = replace(_SWAYING, shrug=0.0, amplitude_back=0.0, amplitude_side=0.0, amplitude_twist=0.0)


@dataclass(frozen=True, slots=True)
class Effect:
    """What is measured of a control, in which unit, on which score, with what else set."""

    says: str
    measure: Measure
    score: Score
    also: Style = _STILL
    steps: bool = False
    """Whether it goes by chance or in steps, so that not every part of its range can count."""


_NO_LOOK = replace(_SWAYING, amplitude_gaze=0.0)
EFFECTS = {
    **{
        f"amplitude_{j}": Effect(f"{j}'s extent, °", extent(f"right_{j}"), _STROKES)
        for j in ("wrist", "elbow", "shoulder")
    },
    **{
        f"frequency_{j}": Effect(f"{j}'s top speed, °/s", speed(f"right_{j}"), _STROKES)
        for j in ("wrist", "elbow", "shoulder")
    },
    "amplitude_gain": Effect("elbow's extent, °", extent("right_elbow"), _STROKES),
    "frequency_gain": Effect("elbow's top speed, °/s", speed("right_elbow"), _STROKES),
    "amplitude_fingers": Effect("stick's extent in the hand, °", extent("right_stick"), _STROKES),
    "whip": Effect("shoulder's top to wrist's, ms", _whip_ms, _STROKES),
    "amplitude_neck": Effect("nod's extent, °", extent("head_nod"), _GROOVE, _NO_LOOK),
    "frequency_neck": Effect("half of the fall done, % of the half beat", _late("head_nod"), _STROKES, _NO_LOOK),
    "amplitude_head_side": Effect("head tilt's extent, °", extent("head_tilt"), _GROOVE, _NO_LOOK),
    "amplitude_back": Effect("lean's extent, °", extent("torso_lean"), _STROKES, _SWAYING),
    "frequency_back": Effect("half of the fall done, % of the half beat", _late("torso_lean"), _STROKES, _SWAYING),
    "amplitude_side": Effect("side sway's extent, °", extent("torso_side"), _GROOVE),
    "amplitude_twist": Effect("twist's extent, °", extent("torso_twist"), _TURNS, _SWAYING),
    "amplitude_heel": Effect("left ankle's rise, cm", _height(Joint.LEFT_ANKLE, np.ptp), _GROOVE),
    "twist_deg_s": Effect(
        "twist's top speed, °/s", speed("torso_twist"), _SWINGS, replace(_SWAYING, amplitude_twist=100.0)
    ),
    "amplitude_gaze": Effect(
        "head turn's extent, °", extent("head_turn"), _TURNS, replace(_SWAYING, amplitude_twist=0.0)
    ),
    "shrug": Effect("shoulder's rise, cm", _height(Joint.RIGHT_SHOULDER, np.ptp), _STROKES),
    "breathing": Effect("shoulder's rise, cm", _height(Joint.RIGHT_SHOULDER, np.ptp), _STROKES),
    "wing_deg": Effect("elbow outward, cm", _aside, _STROKES),
    "posture_deg": Effect("mean lean, °", mean("torso_lean"), _STROKES),
    "stand": Effect("pelvis over the floor, cm", _height(Joint.PELVIS, np.mean), _STROKES),
    "flourish": Effect("turned sticks in 39 rests", _shown, _RESTS, steps=True),
    "look_around": Effect(
        "looks in 39 rests",
        _times_over("head_turn", 12.0),
        _RESTS,
        replace(_SWAYING, amplitude_gaze=100.0, amplitude_twist=0.0),
        steps=True,
    ),
    "variation": Effect("tops of equal strokes, scatter in %", _scatter, _STROKES),
    "backbeat": Effect("nod on 2 and 4 over 1 and 3, °", _backbeat, _STROKES, _NO_LOOK),
    "chin": Effect("neck's push, cm", _push, _STROKES),
    "headbang": Effect("nod's extent, °", extent("head_nod"), _GROOVE, _NO_LOOK),
    "lay_back_ms": Effect("deepest nod after the beat, ms", _behind_ms, _STROKES, _NO_LOOK),
    "hunch_deg": Effect("upper back over the lower, °", _rounding, _STROKES),
    "shimmy": Effect("twist's extent, °", extent("torso_twist"), _STROKES, _SWAYING),
    "phrase": Effect("side sway's extent, °", extent("torso_side"), _GROOVE, replace(_STILL, amplitude_side=0.0)),
    "fill_lean": Effect("lean's extent, °", extent("torso_lean"), _FILL),
    "rise": Effect("pelvis' rise, cm", _height(Joint.PELVIS, np.ptp), _FILL),
    "expression": Effect("brow's extent, %", _brow, _FILL),
    "bobs_per_beat": Effect("nod's top speed, °/s", speed("head_nod"), _GROOVE, _NO_LOOK, steps=True),
    "half_time_bpm": Effect("lean's top speed, °/s", speed("torso_lean"), _GROOVE, _SWAYING, steps=True),
}
"""One for every control that is a number."""


def effects(control: str, steps: tuple[float, ...] = STEPS) -> list[float]:
    """The measure of `control` at each place in its range."""
    effect, (low, high) = EFFECTS[control], range_of(control)
    styles = (replace(effect.also, **{control: low + share * (high - low)}) for share in steps)  # type: ignore[arg-type] # numbers only
    return [effect.measure(rows(effect.score, style)) for style in styles]


_COLUMNS: tuple[tuple[str, Measure], ...] = (
    ("shoulder", extent("right_shoulder")),
    ("elbow", extent("right_elbow")),
    ("wrist", extent("right_wrist")),
    ("wrist, °/s", speed("right_wrist")),
    ("back", extent("torso_lean")),
    ("side", extent("torso_side")),
    ("twist", extent("torso_twist")),
    ("nod", extent("head_nod")),
    ("nod, °/s", speed("head_nod")),
    ("head's tilt", extent("head_tilt")),
    ("head's turn", extent("head_turn")),
)


def style_rows() -> dict[str, list[float]]:
    """The measures of every shipped style on the groove, in the order of the table's columns."""
    found = {}
    for name in style_names():
        poses = rows(_GROOVE, load_style(name))
        found[name] = [measure(poses) for _, measure in _COLUMNS]
    return found


def page() -> str:
    """The whole page."""
    names = [name for name, _ in _COLUMNS]
    lines = [
        "# Styles and controls, measured",
        "",
        "Made by `python -m tools.style_table` from the motion itself; do not edit.",
        "",
        "## Styles",
        "Eighths on the hi-hat, a backbeat and the beginning of a fill at 100 bpm: how far each angle goes, in degrees",
        "(right arm), and top speeds.",
        "",
        f"| style | {' | '.join(names)} |",
        f"|---|{'---|' * len(names)}",
        *(f"| {name} | {' | '.join(f'{v:.0f}' for v in values)} |" for name, values in style_rows().items()),
        "",
        "## Controls",
        "Each control from the least to the greatest of its range, all others natural. The last four go in steps or by",
        "chance.",
        "",
        f"| control | range | natural | measured | {' | '.join(f'{100 * s:.0f} %' for s in STEPS)} |",
        f"|---|---|---|---|{'---|' * len(STEPS)}",
    ]
    for control, effect in EFFECTS.items():
        low, high = range_of(control)
        cells = " | ".join(f"{v:.1f}" for v in effects(control))
        natural = f"{getattr(Style(), control):g}"
        lines.append(f"| `{control}` | {low:g}–{high:g} | {natural} | {effect.says} | {cells} |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    assert set(EFFECTS) == set(NUMBERS)
    PAGE.write_text(page(), encoding="utf-8")
