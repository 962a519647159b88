"""What is in what: sticks, hands, arms, trunk, head, legs and the kit, but for contacts that drumming has."""

from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from benchmarks.examiner.body import Capsule, capsules, overlap_m
from benchmarks.examiner.findings import Findings
from benchmarks.examiner.kit_solids import Solid, hat_stand, solids, swinging
from benchmarks.examiner.take import SIDES, Take
from station.core.pieces import Articulation

Array = NDArray[np.float64]
TOUCH_M = 0.001
SKIN_M = 0.010
"""Flesh and clothes give way so far (our choice)."""
FLAT_M = 0.010
"""A forearm near its wrist is 55 mm broad and 40 thick: the butt under the palm passes so far inside a round one."""
ARM_ON_CHEST_M = 0.030
"""An upper arm that hangs lies against the ribs (our choice)."""
STROKE_M = 0.010
"""A struck head gives way 8 mm at 5 m/s (HUMANS), a stick that meets an edge lies its own thickness over it."""
STROKE_S = (0.030, 0.040)
REST_S = 0.30
"""A hand that has not struck for so long and will not may lie on the thigh."""
BARE_M = 0.028
"""A bare hand strikes with fingers that the examiner's hand, a thick capsule from wrist to grip, overstates."""
CROSS_S = 0.40
"""A cross-stick's stick lies on the head, its hand too, so long before and after (our choice)."""
SWING_EVERY = 4
"""Of the instants, where cymbals are looked at: they swing once a second."""
CHOKE_S = 0.15
"""A hand is at its cymbal so long before and after it grabs it (our choice)."""
BRUSH_M = 0.012
"""Brushes lie on the head."""


def contacts(take: Take, found: Findings) -> None:
    """Note every pair of solids that are in each other."""
    parts = capsules(take.poses, take.drummer.figure.stature_m)
    _own(take, found, parts)
    for index, solid in enumerate(solids(take.drummer.kit)):
        for part in parts.values():
            _kit(take, found, part, _now(take, solid, index))
    tube = hat_stand(take.drummer.kit)
    for name, part in parts.items() if tube else ():
        if not name.startswith(("trunk", "head", "neck")) and tube:
            _note(take, found, name, part, _still(tube, len(part.a)), TOUCH_M if "stick" in name else SKIN_M)


def _now(take: Take, solid: Solid, index: int) -> Solid:
    """The piece as it swings."""
    time_s = take.poses.time_s
    every = np.append(time_s[::SWING_EVERY], time_s[-1])
    swing = take.drummer.swings(index, every)
    if not swing.any():
        return solid
    now = np.stack([np.interp(time_s, every, swing[:, k]) for k in (0, 1)], axis=1)
    return swinging(take.drummer.kit, solid, index, now)


def _still(tube: Capsule, count: int) -> Capsule:
    return Capsule(tube.name, np.repeat(tube.a, count, 0), np.repeat(tube.b, count, 0), tube.a_m, tube.b_m)


def _note(take: Take, found: Findings, name: str, p: Capsule, q: Capsule, allowed_m: float | Array) -> None:
    _deep(take, found, f"{name} in {q.name}", overlap_m(p, q), allowed_m)


def _deep(take: Take, found: Findings, what: str, deep: Array, allowed_m: float | Array) -> None:
    beyond = deep - allowed_m
    if (beyond > 0).any():
        bound = float(np.min(allowed_m))
        deep = np.where(beyond > 0, deep, 0.0)
        found.note("through", what, deep * 1000, bound * 1000, "mm", take.poses.time_s)


def _own(take: Take, found: Findings, parts: dict[str, Capsule]) -> None:
    """The body and its sticks among themselves."""
    time_s = take.poses.time_s
    rest = {s: ~take.strikes.near(time_s, f"{s}_hand", REST_S, REST_S) for s in SIDES}
    _note(take, found, "right stick", parts["right stick"], parts["left stick"], TOUCH_M)
    for side, other in (SIDES, SIDES[::-1]):
        stick = parts[f"{side} stick"]
        for name in ("hand", "forearm", "upper arm"):
            _note(take, found, stick.name, stick, parts[f"{other} {name}"], TOUCH_M)
        own = parts[f"{side} forearm"].cut(0.0, 0.7)
        _note(take, found, stick.name, stick, own, FLAT_M)
        _note(take, found, stick.name, stick, parts[f"{side} upper arm"], TOUCH_M)
        for name in ("trunk right", "trunk left", "head", "neck"):
            _note(take, found, stick.name, stick, parts[name], TOUCH_M)
            _note(take, found, f"{side} hand", parts[f"{side} hand"], parts[name], SKIN_M)
            if "trunk" in name:
                _note(take, found, f"{side} forearm", parts[f"{side} forearm"], parts[name], SKIN_M)
                low = parts[f"{side} upper arm"].cut(0.5, 1.0)
                _note(take, found, f"{side} upper arm", low, parts[name], ARM_ON_CHEST_M)
        for leg in SIDES:
            for name in ("thigh", "shank"):
                allowed = np.where(rest[side], 0.025, TOUCH_M)
                _note(take, found, stick.name, stick, parts[f"{leg} {name}"], allowed)
                _note(take, found, f"{side} hand", parts[f"{side} hand"], parts[f"{leg} {name}"], SKIN_M)
                _note(take, found, f"{side} forearm", parts[f"{side} forearm"], parts[f"{leg} {name}"], SKIN_M)
    for a, b in (("hand", "hand"), ("hand", "forearm"), ("forearm", "hand"), ("forearm", "forearm")):
        _note(take, found, f"right {a}", parts[f"right {a}"], parts[f"left {b}"], SKIN_M)
    for a, b in combinations(("thigh", "shank", "foot"), 2):
        _note(take, found, f"right {a}", parts[f"right {a}"], parts[f"left {b}"], SKIN_M)
    _note(take, found, "right thigh", parts["right thigh"].cut(0.4, 1.0), parts["left thigh"].cut(0.4, 1.0), SKIN_M)


def _crossed(take: Take, side: str) -> NDArray[np.bool_]:
    """When the stick of `side` lies across a drum: around its cross-sticks."""
    strikes, time_s = take.strikes, take.poses.time_s
    lies = np.zeros(len(time_s), bool)
    for at in strikes.time_s[(strikes.articulation == Articulation.CROSS_STICK) & (strikes.limb == f"{side}_hand")]:
        lies |= np.abs(time_s - at) < CROSS_S
    return lies


def _kit(take: Take, found: Findings, part: Capsule, solid: Solid) -> None:
    side, _, name = part.name.partition(" ")
    deep = solid.depth_of(part)
    if not (deep > 0).any():
        return
    allowed: float | Array = TOUCH_M if name == "stick" else SKIN_M
    if name in ("stick", "hand", "forearm"):
        held = take.drummer.style.held
        strikes = take.strikes.near(take.poses.time_s, f"{side}_hand", *STROKE_S, piece=solid.name)
        if name == "stick":
            allowed = np.where(strikes, STROKE_M, TOUCH_M)
        elif held == "hand" and name == "hand":
            allowed = np.where(strikes, BARE_M, SKIN_M)
        if held == "brush" and solid.name == "snare" and name == "stick":
            allowed = np.full(len(deep), BRUSH_M)
        allowed = np.where(_crossed(take, side) & (solid.name == "snare"), 0.020, allowed)
        allowed = np.where(_choking(take, solid.name), 1.0, allowed)
    _deep(take, found, f"{part.name} in {solid.name}", deep, allowed)


def _choking(take: Take, piece: str) -> NDArray[np.bool_]:
    """When a hand grabs the cymbal `piece`."""
    strikes, time_s = take.strikes, take.poses.time_s
    grabs = np.zeros(len(time_s), bool)
    mine = (strikes.choke_s > 0) & (strikes.piece == piece)
    for at in strikes.time_s[mine] + strikes.choke_s[mine]:
        grabs |= np.abs(time_s - at) < CHOKE_S
    return grabs
