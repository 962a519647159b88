"""From written music to what the sticks are asked to do, with a human's timing and force.

Timing is Wing and Kristofferson's model with a click to lean on; a player's velocities vary by a share of themselves.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Limb, Ornament, Piece, Zone
from station.core.units import NS_PER_S
from station.music.score import Score
from station.simulation.sticks.swing_spec import StickStrokeSpec, StrokeKind, height_for, speed_for_velocity

FLAM_S, DRAG_S = 0.028, 0.055
"""A flam's grace stroke comes 15–40 ms early, a drag's notes are 40–70 ms apart (`shared/HUMANS.md`)."""
GRACE, ACCENT = 0.4, 1.45
"""Grace strokes have 25–50 % of the main velocity; an accent of 116 stands beside a normal 80 (`shared/HUMANS.md`)."""
_HANDS_OF = {
    "R": (Limb.RIGHT_HAND,),
    "L": (Limb.LEFT_HAND,),
    "B": (Limb.RIGHT_HAND, Limb.LEFT_HAND),
    "-": (),
}

LOW_M = 0.09
"""Stick height up to which a stroke starts low: 3 in a tap, 4.5 between (marching practice)."""


@dataclass(frozen=True, slots=True)
class PlayerSpec:
    """A player: the beat's own unsteadiness as a share of the interval, the hands' in s, the forces' as a share.

    `wrong_sticking` is the share of hand strokes that the other hand plays; `correction` how much of an error to the
    click the next beat takes back. A professional by `shared/HUMANS.md`: 2–3 %, 4–8 ms, 6–10 %.
    """

    clock_share: float = 0.025
    motor_s: float = 0.005
    force_share: float = 0.08
    correction: float = 0.4
    wrong_sticking: float = 0.0


PROFESSIONAL = PlayerSpec()
NOVICE = PlayerSpec(0.08, 0.008, 0.25, 0.3, 0.05)
EXACT = PlayerSpec(0.0, 0.0, 0.0)


def spec_from_score(
    score: Score, *, start_s: float = 3.0, player: PlayerSpec = EXACT, in_air: bool = False, seed: int = 0
) -> list[StickStrokeSpec]:
    """The hands' strokes of `score`, its tick 0 at `start_s`; notes without a written hand alternate, right first.

    Feet and grabbed cymbals are left out. In the air every stroke is of kind `AIR`.
    """
    rng = np.random.default_rng(seed)
    limbs = _limbs(score, player, rng)
    onset_s = start_s + _played_s(score, player, rng)
    hands = np.flatnonzero(np.isin(limbs, (Limb.RIGHT_HAND, Limb.LEFT_HAND)))
    strokes = []
    for row in hands[np.argsort(onset_s[hands], kind="stable")].tolist():
        note = score[row]
        velocity = float(np.clip(note.velocity * (1 + rng.normal(0, player.force_share)), 8, 127))
        speed = speed_for_velocity(velocity)
        strokes.append(
            StickStrokeSpec(
                at_s=float(onset_s[row]),
                limb=Limb(int(limbs[row])),
                piece=note.piece,
                zone=note.zone,
                speed_m_s=speed,
                height_m=height_for(speed) * float(np.exp(rng.normal(0, player.force_share))),
                kind=StrokeKind.AIR if in_air else _buzz_or_full(note.articulation),
                shoulder=note.zone is Zone.EDGE and note.piece in (Piece.CRASH_1, Piece.CRASH_2),
                lasts_s=_lasts_s(score, row),
            )
        )
    return strokes if in_air else _stroke_types(strokes)


def spec_from_sticking(
    sticking: str, *, every_s: float, start_s: float = 3.0, times: int = 1, velocity: float = 80.0
) -> list[StickStrokeSpec]:
    """Strokes on the snare as a method book writes them, an even `every_s` apart, `times` over.

    `R` and `L` are strokes, `-` a rest, `>` after a letter accents it, `B` both hands at once; lower-case letters are
    grace strokes of the next one (a flam's `FLAM_S`, a drag's `DRAG_S` before it), spaces mean nothing.
    """
    strokes: list[StickStrokeSpec] = []
    place, graces = 0, ""
    text = (sticking.replace(" ", "") + " ") * times
    for sign, following in zip(text, text[1:] + " ", strict=True):
        if sign in "rl":
            graces += sign
        elif sign in "RLB-":
            at_s = start_s + place * every_s
            loudness = min(velocity * ACCENT, 127.0) if following == ">" else velocity
            strokes += [_struck(at_s, hand, loudness) for hand in _HANDS_OF[sign]]
            strokes += _graces(graces, at_s, velocity)
            place, graces = place + 1, ""
    return sorted(strokes, key=lambda stroke: stroke.at_s)


def _struck(at_s: float, limb: Limb, velocity: float) -> StickStrokeSpec:
    return StickStrokeSpec(at_s, limb, speed_m_s=speed_for_velocity(velocity))


def _graces(graces: str, at_s: float, velocity: float) -> list[StickStrokeSpec]:
    apart = FLAM_S if len(graces) == 1 else DRAG_S
    return [
        _struck(at_s - apart * (len(graces) - i), _HANDS_OF[sign.upper()][0], GRACE * velocity)
        for i, sign in enumerate(graces)
    ]


def _buzz_or_full(articulation: Articulation) -> StrokeKind:
    return StrokeKind.BUZZ if articulation is Articulation.BUZZ else StrokeKind.FULL


def _lasts_s(score: Score, row: int) -> float:
    tick, ticks = int(score.notes["tick"][row]), int(score.notes["duration_ticks"][row])
    return float(score.tempo_map.ns_at(tick + ticks) - score.tempo_map.ns_at(tick)) / NS_PER_S


def _limbs(score: Score, player: PlayerSpec, rng: np.random.Generator) -> NDArray[np.int8]:
    limbs = score.notes["limb"].copy()
    feet = np.isin(score.notes["piece"], (Piece.KICK, Piece.HIHAT_PEDAL))
    unknown = (limbs == Limb.UNKNOWN) & ~feet
    limbs[unknown] = np.where(np.arange(unknown.sum()) % 2 == 0, Limb.RIGHT_HAND, Limb.LEFT_HAND)
    limbs[feet] = Limb.RIGHT_FOOT
    hands = np.isin(limbs, (Limb.RIGHT_HAND, Limb.LEFT_HAND))
    wrong = hands & (rng.uniform(size=len(limbs)) < player.wrong_sticking)
    limbs[wrong] = np.where(limbs[wrong] == Limb.RIGHT_HAND, Limb.LEFT_HAND, Limb.RIGHT_HAND)
    result: NDArray[np.int8] = limbs
    return result


def _played_s(score: Score, player: PlayerSpec, rng: np.random.Generator) -> NDArray[np.float64]:
    """When each note is played, in s from tick 0: one clock for all limbs, a motor delay for each stroke."""
    ticks, inverse = np.unique(score.notes["tick"], return_inverse=True)
    beats_s = np.array(score.tempo_map.ns_at(ticks)) / NS_PER_S
    gaps = np.diff(beats_s, prepend=beats_s[0] if len(beats_s) else 0.0)
    lean = np.zeros(len(beats_s))
    error = 0.0
    for i, gap in enumerate(gaps.tolist()):
        error = (1 - player.correction) * error + rng.normal(0, player.clock_share * gap)
        lean[i] = error
    hand = rng.normal(0, player.motor_s, len(score.notes))
    hand[score.notes["ornament"] == Ornament.DIDDLE] *= 0.5  # a bounce follows its stroke
    return np.asarray(score.onset_s + lean[inverse] + hand)


def _stroke_types(strokes: list[StickStrokeSpec]) -> list[StickStrokeSpec]:
    """Full, down, tap and up: by where each stroke starts and where the same hand's next one does."""
    typed = list(strokes)
    coming: dict[Limb, float] = {}
    for index in range(len(strokes) - 1, -1, -1):
        stroke = strokes[index]
        height = stroke.height_m or 0.0
        high, then_high = height > LOW_M, coming.get(stroke.limb, height) > LOW_M
        kind = {(True, True): StrokeKind.FULL, (True, False): StrokeKind.DOWN, (False, True): StrokeKind.UP}
        if stroke.kind is not StrokeKind.BUZZ:
            typed[index] = replace(stroke, kind=kind.get((high, then_high), StrokeKind.TAP))
        coming[stroke.limb] = height
    return typed
