"""From written music to what the sticks are asked to do, with a human's timing and force.

Timing is Wing and Kristofferson's model with a click to lean on; a player's velocities vary by a share of themselves.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import OTHER_HAND, Articulation, Limb, Piece, Zone
from station.core.units import NS_PER_S
from station.music.score import Score
from station.simulation.sticks.swing_spec import StickStrokeSpec, StrokeKind, height_for, speed_for_velocity

FLAM_S, DRAG_S = 0.028, 0.055
"""A flam's grace stroke comes 15–40 ms early, a drag's notes are 40–70 ms apart (`shared/HUMANS.md`)."""
GRACE, ACCENT = 0.4, 1.45
"""Grace strokes have 25–50 % of the main velocity; an accent of 116 stands beside a normal 80 (`shared/HUMANS.md`)."""
FREE_S = 0.18
"""Time for a hand to strike, travel 30 cm at 3 m/s and strike again (`shared/HUMANS.md`)."""
SPEED_FOR_VELOCITY = 1.25
"""A velocity that is 1 % higher needs a tip about 1.25 % faster: `speed_for_velocity` from 40 to 112, in logarithms."""
_HANDS = (Limb.RIGHT_HAND, Limb.LEFT_HAND)
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
    """A player: the beat's own unsteadiness as a share of the interval, the hands' in s, the velocities' as a share.

    `wrong_sticking` is the share of strokes that the other hand plays where it is free; `correction` how much of an
    error to the click is taken back, per second (our choice). A professional by `shared/HUMANS.md`: 2–3 %, 4–8 ms,
    6–10 %.
    """

    clock_share: float = 0.025
    motor_s: float = 0.005
    force_share: float = 0.08
    correction: float = 2.0
    wrong_sticking: float = 0.0


PROFESSIONAL = PlayerSpec()
NOVICE = PlayerSpec(0.08, 0.008, 0.25, 1.0, 0.05)
EXACT = PlayerSpec(0.0, 0.0, 0.0)


def spec_from_score(
    score: Score, *, start_s: float = 3.0, player: PlayerSpec = EXACT, in_air: bool = False, seed: int = 0
) -> list[StickStrokeSpec]:
    """The hands' strokes of `score`, its tick 0 at `start_s`; notes without a written hand alternate, right first.

    Feet and grabbed cymbals are left out. In the air every stroke is of kind `AIR`.
    """
    limbs = _limbs(score)
    strokes = [
        StickStrokeSpec(
            at_s=start_s + float(score.onset_s[row]),
            limb=Limb(int(limbs[row])),
            piece=note.piece,
            zone=note.zone,
            speed_m_s=speed_for_velocity(note.velocity),
            kind=StrokeKind.AIR if in_air else _buzz_or_full(note.articulation),
            shoulder=note.zone is Zone.EDGE and note.piece in (Piece.CRASH_1, Piece.CRASH_2),
            lasts_s=_lasts_s(score, row),
        )
        for row, note in enumerate(score)
        if limbs[row] in _HANDS
    ]
    played = as_played_by(player, strokes, seed)
    return played if in_air else _stroke_types(played)


def spec_from_sticking(
    sticking: str, *, every_s: float, start_s: float = 3.0, times: int = 1, velocity: float = 80.0
) -> list[StickStrokeSpec]:
    """Strokes on the snare as a method book writes them, an even `every_s` apart, `times` over.

    `R` and `L` are strokes, `-` a rest, `>` after a letter accents it, `B` both hands at once; lower-case letters are
    grace strokes of the next one (a flam's `FLAM_S`, a drag's `DRAG_S` before it), spaces mean nothing. `as_played_by`
    makes a human of the machine.
    """
    strokes: list[StickStrokeSpec] = []
    place, graces = 0, ""
    text = sticking.replace(" ", "") * times
    for sign, following in zip(text, text[1:] + " ", strict=True):
        if sign in "rl":
            graces += sign
        elif sign in _HANDS_OF:
            at_s = start_s + place * every_s
            loudness = min(velocity * ACCENT, 127.0) if following == ">" else velocity
            strokes += [_struck(at_s, hand, loudness) for hand in _HANDS_OF[sign]]
            strokes += _graces(graces, at_s, velocity)
            place, graces = place + 1, ""
    return _stroke_types(as_played_by(EXACT, strokes))


def as_played_by(player: PlayerSpec, strokes: Sequence[StickStrokeSpec], seed: int = 0) -> list[StickStrokeSpec]:
    """The strokes by time with `player`'s unsteadiness: one clock for both hands, a motor delay for each stroke."""
    rng = np.random.default_rng(seed)
    ordered = sorted(strokes, key=lambda stroke: stroke.at_s)
    times, beat = np.unique([stroke.at_s for stroke in ordered], return_inverse=True)
    lean = _lean_s(np.diff(times, prepend=times[:1]), player, rng)
    played = []
    for stroke, index in zip(ordered, beat.tolist(), strict=True):
        force = float(np.exp(rng.normal(0, player.force_share)))
        speed = stroke.speed_m_s * force**SPEED_FOR_VELOCITY
        height = height_for(speed) if stroke.height_m is None else stroke.height_m
        wrong = rng.uniform() < player.wrong_sticking and _is_free(OTHER_HAND[stroke.limb], stroke.at_s, ordered)
        played.append(
            replace(
                stroke,
                at_s=stroke.at_s + float(lean[index] + rng.normal(0, player.motor_s)),
                limb=OTHER_HAND[stroke.limb] if wrong else stroke.limb,
                speed_m_s=speed,
                height_m=height * float(np.exp(rng.normal(0, player.force_share))),
            )
        )
    return sorted(played, key=lambda stroke: stroke.at_s)


def _is_free(hand: Limb, at_s: float, strokes: Sequence[StickStrokeSpec]) -> bool:
    """Whether `hand` can take over a stroke: it has none of its own within `FREE_S`."""
    return all(abs(stroke.at_s - at_s) >= FREE_S for stroke in strokes if stroke.limb is hand)


def _lean_s(gaps_s: NDArray[np.float64], player: PlayerSpec, rng: np.random.Generator) -> NDArray[np.float64]:
    """How late each beat is, (n,) in s: errors of the clock add up, and a part of them is taken back each second."""
    lean, error = np.zeros(len(gaps_s)), 0.0
    for i, gap in enumerate(gaps_s.tolist()):
        error = error * float(np.exp(-gap * player.correction)) + rng.normal(0, player.clock_share * gap)
        lean[i] = error
    return lean


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


def _limbs(score: Score) -> NDArray[np.int8]:
    """Who plays each note: as written; else a foot what feet play, and the hands in turn."""
    limbs = score.notes["limb"].copy()
    feet = np.isin(score.notes["piece"], (Piece.KICK, Piece.HIHAT_PEDAL))
    unknown = (limbs == Limb.UNKNOWN) & ~feet
    limbs[unknown] = np.where(np.arange(unknown.sum()) % 2 == 0, Limb.RIGHT_HAND, Limb.LEFT_HAND)
    limbs[feet] = Limb.RIGHT_FOOT
    result: NDArray[np.int8] = limbs
    return result


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
