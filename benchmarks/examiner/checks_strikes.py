"""Strikes in place and time, feet on their boards, waiting hands, the grip, strokes that are never the same."""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from benchmarks.examiner.findings import Findings
from benchmarks.examiner.kit_solids import solids
from benchmarks.examiner.take import SIDES, Take, sampled
from station.core.pieces import Articulation, Piece
from station.motion.kit.kit import Pedal

Array = NDArray[np.float64]
ABOVE_M, INTO_M = 0.006, 0.010
"""A stick at its strike is no higher over the surface, no deeper in it (a head gives way 8 mm, HUMANS)."""
RAISED_M = 0.030
"""Bells, rims and edges stand so far over or under the flat disc that the examiner takes a cymbal for."""
_SAID = {Articulation.CROSS_STICK, Articulation.BUZZ}
FALL_S, FALL_M = 0.008, 0.002
"""A stick falls at least 2 mm in the 8 ms before it strikes: a quarter of a metre a second."""


def strikes_land(take: Take, found: Findings) -> None:
    """The stick is on its piece at each strike, and was coming down."""
    strikes = take.strikes
    pieces = {solid.name: solid for solid in solids(take.drummer.kit)}
    for i, side in enumerate(SIDES):
        mine = strikes.of(f"{side}_hand")
        if not len(mine):
            continue
        at, before = sampled(take.drummer, strikes.time_s[mine]), sampled(take.drummer, strikes.time_s[mine] - FALL_S)
        share = np.linspace(0, 1, 60)[:, None, None]
        now, then = (p.butt_m[:, i] + share * (p.tip_m[:, i] - p.butt_m[:, i]) for p in (at, before))
        gap, fallen = np.zeros(len(mine)), np.full(len(mine), 1.0)
        for k, row in enumerate(mine):
            solid = pieces.get(strikes.piece[row])
            if solid is None or take.drummer.style.held == "hand":
                continue
            distance = solid.distance(now[:, k])
            gap[k] = distance.min() if distance.min() > 0 else min(0.0, -solid.distance(now[-1:, k])[0] - INTO_M)
            raised = RAISED_M if solid.is_thin or strikes.radius_m[row] < 0.5 * solid.radius_m else ABOVE_M
            gap[k] = max(0.0, gap[k] - raised)
            if strikes.articulation[row] not in _SAID:
                fallen[k] = solid.distance(then[:, k]).min() - distance.min()
        found.note("strike", f"{side} stick away from its piece", 1000 * gap, 0.0, "mm", strikes.time_s[mine])
        if take.drummer.style.held != "brush":
            short = 1000 * np.maximum(0.0, FALL_M - fallen)
            found.note("strike", f"{side} stick not coming down", short, 0.0, "mm", strikes.time_s[mine])


PRESSED_DEG, LIFTED_DEG = 2.0, 3.0
"""A board is down at its strike, and was up so far within the 150 ms before."""
LIFT_S = 0.15
BOARD_HALF_M = 0.045
"""Footboards are 8–10 cm wide."""
SOLE_M = 0.030
"""A shoe's sole and the ball of the foot under the published toe; the toe stays within so much of the board."""


def feet(take: Take, found: Findings) -> None:
    """Each foot strike presses its own board, which was up before; toes are on their boards."""
    poses, strikes = take.poses, take.strikes
    for i, side in enumerate(SIDES):
        mine = strikes.of(f"{side}_foot")
        kicked = strikes.written[mine] == Piece.KICK
        on_slave = kicked & (_leads(take) != side)
        for name, which, board, beater in (
            (f"{side} board", ~on_slave, poses.boards_rad[:, i], poses.beater_rad),
            ("slave board", on_slave, poses.slave_rad[:, 0], poses.slave_rad[:, 1]),
        ):
            times = strikes.time_s[mine][which]
            if not len(times):
                continue
            index = np.clip(np.rint((times - poses.time_s[0]) * 1000).astype(int), 0, len(board) - 1)
            deg = np.degrees(board)
            found.note("foot", f"{name} not pressed at its strike", deg[index], PRESSED_DEG, "°", times)
            starts = np.maximum(index - int(LIFT_S * 1000), np.concatenate(([0], index[:-1])))
            lifted = np.array([deg[a : b + 1].max() - deg[b] for a, b in zip(starts, index, strict=True)])
            low = np.where(np.diff(times, prepend=-9) > 0.06, np.maximum(0.0, LIFTED_DEG - lifted), 0.0)
            found.note("foot", f"{name} not lifted before its strike", low, 0.0, "°", times)
            off = np.where(kicked[which], np.degrees(np.abs(beater[index])), 0.0)
            found.note("foot", f"{name}'s beater off the head", off, 3.0, "°", times)
        _on_board(take, found, side)


def _leads(take: Take) -> str:
    """The side whose foot has the kick's own pedal."""
    return "left" if take.drummer.kit.left_handed else "right"


def _boards(take: Take) -> Iterator[tuple[Pedal, Array]]:
    """Every board and how far it is raised, (n,)."""
    kit, poses = take.drummer.kit, take.poses
    kick, hat = (1, 0) if kit.left_handed else (0, 1)
    yield kit.pedals[Piece.KICK], poses.boards_rad[:, kick]
    yield kit.pedals[Piece.HIHAT_PEDAL], poses.boards_rad[:, hat]
    if kit.slave:
        yield kit.slave, poses.slave_rad[:, 0]


def _on_board(take: Take, found: Findings, side: str) -> None:
    """A toe over a board is not in it, and where its foot does not travel, not far above."""
    toe = take.poses.point(f"{side}_toe")
    slow = np.linalg.norm(np.gradient(toe[:, :2], axis=0), axis=1) * 1000 < 0.05
    for pedal, raised in _boards(take):
        heel, flat = np.array(pedal.heel_m), np.array(pedal.toe_m)
        length = float(np.linalg.norm(flat - heel))
        along = (flat - heel) / length
        board = along * np.cos(raised[:, None]) + np.array([0, 0, 1.0]) * np.sin(raised[:, None])
        aside = np.cross(along, [0, 0, 1.0])
        over = (np.abs((toe - heel) @ aside) < BOARD_HALF_M) & ((toe - heel) @ along < length + 0.02)
        height = 1000 * ((toe - heel) * np.cross(aside, board)).sum(1)
        high = np.where(over & slow, height, 0.0)
        found.note("foot", f"{side} toe high over its board", high, 1000 * 2 * SOLE_M, "mm", take.poses.time_s)
        deep = np.where(over, -height, 0.0)
        found.note("foot", f"{side} toe through a board", deep, 1.0, "mm", take.poses.time_s)


WAIT_S = 2.0
FROZEN_M, HIGH_M, FAR_M = 0.0005, 0.25, 0.45
"""A waiting hand that moves less than half a millimetre in a second is frozen: people sway and breathe by more; one
whose stick's middle is 25 cm over snare and thighs, or 45 cm from both, hangs in the air."""


def waiting(take: Take, found: Findings) -> None:
    """Hands that have nothing to do for two seconds neither freeze nor hang."""
    poses = take.poses
    snare = next(s for s in solids(take.drummer.kit) if s.name == "snare").centre
    for i, side in enumerate(SIDES):
        times = take.strikes.time_s[take.strikes.of(f"{side}_hand")]
        edges = np.concatenate(([poses.time_s[0]], times, [poses.time_s[-1]]))
        for start, end in pairwise(edges.tolist()):
            if end - start < WAIT_S:
                continue
            inside = (poses.time_s > start + 0.8) & (poses.time_s < end - 0.8)
            if not inside.any():
                continue
            hand = poses.point(f"{side}_hand")[inside]
            at, middle_s = poses.time_s[inside], np.array([(start + end) / 2])
            spans = [np.ptp(hand[k : k + 1000], axis=0).max() for k in range(0, max(1, len(hand) - 999), 500)]
            if len(hand) >= 400 and min(spans) < FROZEN_M:
                length = np.array([1000 * (end - start)])
                found.note("waiting", f"{side} hand frozen in a rest", length, 1000 * WAIT_S, "ms", middle_s)
            stick = 0.5 * (poses.butt_m[inside, i] + poses.tip_m[inside, i])
            knee = poses.point(f"{side}_knee")[inside]
            lap = 0.5 * (poses.point(f"{side}_hip")[inside] + knee)
            ground = np.maximum(snare[2], knee[:, 2] + 0.06)
            away = np.minimum(
                np.linalg.norm((stick - snare)[:, :2], axis=1), np.linalg.norm((stick - lap)[:, :2], axis=1)
            )
            still = slice(len(at) // 4, max(len(at) // 4 + 1, 3 * len(at) // 4))
            high = float(np.median(stick[still, 2] - ground[still]))
            found.note(
                "waiting", f"{side} stick high in a rest", np.array([1000 * high]), 1000 * HIGH_M, "mm", middle_s
            )
            far = 1000 * float(np.median(away[still]))
            found.note("waiting", f"{side} stick far off in a rest", np.array([far]), 1000 * FAR_M, "mm", middle_s)


FULCRUM_M = 0.005
GRIP_SHARE = (0.22, 0.45)
"""The fulcrum is about a third from the butt (HUMANS), in quick playing some fingers' breadths to and fro."""
WEB_SHARE = (0.12, 0.40)
"""In the web of the thumb the butt stands 5–8 cm out behind."""
BEHIND_M = 0.010
"""In matched grips the butt may come as far to the knuckles' side of the wrist-to-fulcrum line (fingers open)."""


def grip(take: Take, found: Findings) -> None:
    """The stick passes the fulcrum, a third from its butt, and its butt lies on the palm's side."""
    poses, style = take.poses, take.drummer.style
    if style.held == "hand":
        return
    for i, side in enumerate(SIDES):
        fist, wrist = poses.point(f"{side}_hand"), poses.point(f"{side}_wrist")
        stick = poses.tip_m[:, i] - poses.butt_m[:, i]
        length = np.linalg.norm(stick, axis=1)
        along = ((fist - poses.butt_m[:, i]) * stick).sum(1) / length
        off = np.linalg.norm(fist - poses.butt_m[:, i] - (along / length)[:, None] * stick, axis=1)
        found.note("grip", f"{side} stick off its fulcrum", 1000 * off, 1000 * FULCRUM_M, "mm", poses.time_s)
        if style.held == "stick" and style.flourish == 0:
            web = (style.grip_left if side == "left" else style.grip_right) == "traditional"
            share, (least, most) = along / length, WEB_SHARE if web else GRIP_SHARE
            off = 1000 * length * np.maximum(least - share, share - most)
            found.note("grip", f"{side} fulcrum not a third from the butt", off, 0.0, "mm", poses.time_s)
            if not web:
                behind = ((poses.butt_m[:, i] - fist) * poses.back[:, i]).sum(1)
                off = 1000 * behind
                found.note("grip", f"{side} butt on the knuckles' side", off, 1000 * BEHIND_M, "mm", poses.time_s)
                hand = (wrist - fist) / np.linalg.norm(wrist - fist, axis=1, keepdims=True)
                past = ((poses.butt_m[:, i] - fist) * hand).sum(1)
                off = 1000 * (0.03 - past)
                found.note("grip", f"{side} butt not towards the heel of the hand", off, 0.0, "mm", poses.time_s)


TAP_LONGEST_S, TAP_VELOCITY = 0.22, 100
"""Quick unaccented strokes of one hand: nearer together than this, no louder."""
TAP_M_S2, TAP_M = 80.0, 0.010
"""A tip that swings to a height h and back in T is accelerated by 2 π² h / T²; 80 m/s² allow 10 cm at 200 a minute in
sixteenths of two hands, 5 cm for one hand's ten a second, 20 cm at 70 in sixteenths of one hand (our choice, between
marching practice's taps of 7.5 cm and forte of 23, HUMANS), and a centimetre for the piece's tilt."""


def fast_taps(take: Take, found: Findings) -> None:
    """Unaccented quick strokes stay low."""
    poses, strikes = take.poses, take.strikes
    for i, side in enumerate(SIDES):
        mine = strikes.of(f"{side}_hand")
        times, piece = strikes.time_s[mine], strikes.piece[mine]
        rise, at = [], []
        for k in range(len(mine) - 1):
            gap = times[k + 1] - times[k]
            soft = max(strikes.velocity[mine[k : k + 2]]) <= TAP_VELOCITY
            if piece[k] != piece[k + 1] or not soft or not 0.05 < gap < TAP_LONGEST_S:
                continue
            a, b = np.searchsorted(poses.time_s, times[k : k + 2])
            if b - a < 10 or b >= len(poses.time_s):
                continue
            height = poses.tip_m[a:b, i, 2].max() - max(poses.tip_m[a, i, 2], poses.tip_m[b, i, 2])
            bound = TAP_M + TAP_M_S2 * gap * gap / (2 * np.pi**2)
            rise.append(1000 * (height - bound))
            at.append(times[k])
        found.note("height", f"{side} quick tap too high, beyond its bound", np.array(rise), 0.0, "mm", np.array(at))


def variation_mm(take: Take) -> float | None:
    """How much equal strokes differ: median spread (standard deviation) of the tip's height 60 ms before, mm."""
    strikes, spreads = take.strikes, []
    for i, side in enumerate(SIDES):
        mine = strikes.of(f"{side}_hand")
        gaps = np.diff(strikes.time_s[mine], prepend=-9)
        keys: dict[tuple[str, float, int], list[float]] = {}
        for k, row in enumerate(mine):
            if 0.15 < gaps[k] < 1.0:
                key = (str(strikes.piece[row]), float(strikes.velocity[row]), round(gaps[k] * 100))
                keys.setdefault(key, []).append(float(strikes.time_s[row]))
        for times in keys.values():
            if len(times) >= 4:
                lead = sampled(take.drummer, np.array(times) - 0.06).tip_m[:, i, 2]
                spreads.append(1000 * float(np.std(lead)))
    return float(np.median(spreads)) if spreads else None


ALIKE_MM, SEEDS_MM = 1.0, 1.0
"""Equal strokes of 15 cm differ by some per cent, 5–15 mm (Dahl 2004, read off her figures, mem): less than one is a
machine's; so is a second take of the same music by another seed."""


def alike(take: Take, variation: float | None, seeds: float, found: Findings) -> None:
    """Note strokes, and seeds, that are the same for ever."""
    at = take.poses.time_s[:1]
    if variation is not None:
        found.note("alike", "equal strokes, short of a millimetre", np.array([ALIKE_MM - variation]), 0.0, "mm", at)
    if len(take.strikes.time_s):
        found.note("alike", "two seeds, short of a millimetre", np.array([SEEDS_MM - seeds]), 0.0, "mm", at)
