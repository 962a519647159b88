"""The motion as numbers: joint angles, world positions and every strike, for whoever computes with them (.npz).

`docs/motion.md` has every key with its shape and unit. Positions are metres in the station's axes (x to the drummer's
right, y forward, z up; origin on the floor under the throne), times seconds from the score's tick 0.
"""

import io
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from station.core.disk.files import write_whole
from station.core.pieces import Limb, Piece, Zone, word
from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.motion.kinematics.figure import PARENT, Joint
from station.motion.kinematics.pedal_motion import beater_m
from station.motion.kinematics.pose import ANGLE_NAMES
from station.motion.strokes.targets import Strike, target_of

Array = NDArray[np.float64]

SCHEMA = "drum-station-motion/1"
_ONE_INSTANT_S = 1e-6
"""So near together two poses are one: a speed taken between them would be of rounding (our choice)."""
_HANDS = {Limb.RIGHT_HAND: Joint.RIGHT_HAND, Limb.LEFT_HAND: Joint.LEFT_HAND}


def motion_arrays(drummer: Drummer, time_s: Array) -> dict[str, NDArray[Any]]:
    """Every array of the file, the poses at `time_s` (n,)."""
    rows = drummer.rows(time_s)
    joints = sorted(Joint)
    return {
        "schema": np.array(SCHEMA),
        "time_s": time_s,
        "joint_names": np.array(ANGLE_NAMES),
        "angles_rad": rows[:, frame.ANGLES],
        "point_names": np.array([j.name.lower() for j in joints]),
        "point_parents": np.array([-1 if (p := PARENT[j]) is None else int(p) for j in joints]),
        "points_m": rows[:, frame.JOINTS].reshape(-1, len(joints), 3),
        "tip_m": rows[:, frame.TIP].reshape(-1, 2, 3),
        "butt_m": rows[:, frame.BUTT].reshape(-1, 2, 3),
        "footboard_rad": rows[:, frame.BOARDS],
        "beater_rad": rows[:, frame.BEATER],
        "hat_gap_m": rows[:, frame.GAP],
        "slave_rad": rows[:, [frame.SLAVE_BOARD, frame.SLAVE_BEATER]],
        **_strikes(drummer),
    }


def write_npz(drummer: Drummer, path: Path, time_s: Array) -> None:
    """Write the poses at `time_s` (n,) and at every strike between them whole to `path`.

    Without the strikes' own instants a tip read between two poses would be a centimetre off its drum. Raises
    `DeviceError` if the disk refuses.
    """
    onsets = drummer.score.onset_s
    struck = onsets[(onsets >= time_s.min(initial=np.inf)) & (onsets <= time_s.max(initial=-np.inf))]
    buffer = io.BytesIO()
    np.savez_compressed(buffer, allow_pickle=False, **motion_arrays(drummer, _with(time_s, struck)))
    write_whole(path, buffer.getvalue())


def _with(time_s: Array, struck_s: Array) -> Array:
    """Both in order, each instant once: a pose that is due at a strike, but for rounding, is the strike's own."""
    every = np.union1d(time_s, struck_s)
    alone = np.ones(len(every), bool)
    together = np.flatnonzero(np.diff(every) < _ONE_INSTANT_S)
    alone[np.where(np.isin(every[together], struck_s), together + 1, together)] = False
    return every[alone]


def _strikes(drummer: Drummer) -> dict[str, NDArray[Any]]:
    """When, on what, by whom, and where the stick or beater touches, in order of time (m,)."""
    score, kit = drummer.score, drummer.kit
    order = np.argsort(score.onset_ns, kind="stable")
    limbs = drummer.assignment.limbs[order]
    notes = score.notes[order]
    targets = [
        target_of(kit, Strike(Piece(n["piece"]), Zone(n["zone"]), int(n["articulation"]), Limb(limb)))
        for n, limb in zip(notes, limbs.tolist(), strict=True)
    ]
    return {
        "strike_time_s": score.onset_s[order],
        "strike_piece": np.array([word(kit.stand_in(Piece(p))) for p in notes["piece"].tolist()], np.str_),
        "strike_limb": np.array([word(Limb(limb)) for limb in limbs.tolist()], np.str_),
        "strike_velocity": notes["velocity"],
        "strike_row": order,
        "strike_tip_m": _touching(drummer, order, limbs),
        "strike_centre_m": np.array([t.centre_m for t in targets]).reshape(-1, 3),
        "strike_normal": np.array([t.normal for t in targets]).reshape(-1, 3),
        "strike_radius_m": np.array([t.radius_m for t in targets]),
    }


def _touching(drummer: Drummer, order: NDArray[np.int64], limbs: NDArray[np.int8]) -> Array:
    """The point of stick, beater or upper hi-hat cymbal that touches at each strike, out of the poses themselves."""
    score, kit = drummer.score, drummer.kit
    rows = drummer.rows(score.onset_s[order])
    points = np.zeros((len(order), 3))
    joints = rows[:, frame.JOINTS].reshape(-1, len(Joint), 3)
    tips = rows[:, frame.TIP].reshape(-1, 2, 3)
    hat = kit.pieces[kit.stand_in(Piece.HIHAT)]
    for i, limb in enumerate(limbs.tolist()):
        if limb in (Limb.RIGHT_FOOT, Limb.LEFT_FOOT):
            slave = limb == kit.feet[1]
            angle = float(rows[i, frame.SLAVE_BEATER if slave else frame.BEATER])
            kicked = score.notes["piece"][order[i]] == Piece.KICK
            lifted = float(rows[i, frame.GAP]) * hat.normal
            points[i] = beater_m(kit, angle, slave) if kicked else hat.centre + lifted
            continue
        ahead = drummer.touching_m(int(order[i]))
        hand, tip = joints[i, _HANDS[Limb(limb)]], tips[i, limb]
        points[i] = hand + (tip - hand) * (ahead / np.linalg.norm(tip - hand))
    return points
