"""Both hands on neighbouring spots, one under a cymbal, one at rest: they and the kit stay apart (3 mm)."""

from math import radians

import numpy as np
import pytest

from station.core.pieces import Articulation, Limb, Piece, Zone
from station.core.units import PPQ
from station.motion.audit import audit
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import load_figure
from station.motion.kit.kit import load_kit
from station.motion.sticking.limbs import as_led, assign_limbs
from station.motion.strokes.hand_events import WAIT, hand_events
from station.music.score import Note, Score
from station.music.tempo import TempoMap

R, L = Limb.RIGHT_HAND, Limb.LEFT_HAND
Struck = tuple[Piece, Zone, Articulation]
HEAD: Struck = (Piece.SNARE, Zone.HEAD, Articulation.NORMAL)
LAID: Struck = (Piece.SNARE, Zone.RIM, Articulation.CROSS_STICK)
BOW: Struck = (Piece.HIHAT, Zone.BOW, Articulation.NORMAL)
EDGE: Struck = (Piece.HIHAT, Zone.EDGE, Articulation.NORMAL)
FLOOR: Struck = (Piece.FLOOR_TOM_1, Zone.HEAD, Articulation.NORMAL)
FLOOR_RIM: Struck = (Piece.FLOOR_TOM_1, Zone.RIM, Articulation.NORMAL)
CRASH: Struck = (Piece.CRASH_1, Zone.EDGE, Articulation.NORMAL)


def alternating(right: list[Struck], left: list[Struck], each_ticks: int = PPQ // 2, bpm: float = 100) -> Score:
    """Right and left in turn, each going through its own list, four times."""
    count = 4 * max(len(right), len(left))
    notes = []
    for i in range(count):
        for k, (limb, struck) in enumerate(((R, right), (L, left))):
            piece, zone, articulation = struck[i % len(struck)]
            notes.append(Note((2 * i + k) * each_ticks, piece, zone, 70, limb=limb, articulation=articulation))
    return Score.from_notes(notes, TempoMap.constant(bpm))


@pytest.mark.parametrize("kit", ["four_piece", "seven_piece", "left_handed"])
@pytest.mark.parametrize(
    ("right", "left"),
    [
        ([EDGE], [BOW]),
        ([BOW], [EDGE]),
        ([EDGE], [EDGE]),
        ([HEAD], [LAID]),
        ([BOW], [LAID]),
        ([FLOOR], [FLOOR_RIM]),
        ([CRASH], [CRASH]),
    ],
    ids=["edge-bow", "bow-edge", "edges", "head-laid", "hat-laid", "floor-rim", "crashes"],
)
def test_hands_on_one_piece_stay_apart(kit: str, right: list[Struck], left: list[Struck]) -> None:
    played = load_kit(kit)
    found = audit(Drummer(as_led(alternating(right, left), played), played))
    assert found.hands_m.value <= 0.003, found.hands_m
    assert found.kit_m.value <= 0.003, found.kit_m


def test_crossed_hands_hold_one_stick_steeper() -> None:
    """Right on the left tom, left on the right one, as a lesson may write it: neither hand travels out of the way."""
    crossed = alternating([(Piece.TOM_1, *HEAD[1:])], [(Piece.TOM_2, *HEAD[1:])])
    drummer = Drummer(crossed, load_kit("seven_piece"))
    found = audit(drummer)
    assert found.hands_m.value <= 0.003, found.hands_m
    assert found.limit_rad.value <= 0.02, found.limit_rad
    assert found.strike_m.value <= 1e-6


@pytest.mark.parametrize("limb", [R, L])
def test_a_hand_that_has_laid_its_stick_comes_up_past_the_hat(limb: Limb) -> None:
    """The end of a right hand's cross-stick would lie under the hi-hat."""
    notes = [
        Note(i * PPQ, piece, zone, 90, limb=limb, articulation=how)
        for i, (piece, zone, how) in enumerate(4 * [LAID, EDGE])
    ]
    found = audit(Drummer(Score.from_notes(notes, TempoMap.constant(120))))
    assert found.kit_m.value <= 0.003, found.kit_m


def test_the_hand_that_does_not_lead_lays_the_cross_stick() -> None:
    """Alone in time, on the beat, where natural sticking has the leading hand: drummers keep that on the cymbal."""
    notes = [Note(2 * i * PPQ, *LAID[:2], 80, articulation=LAID[2]) for i in range(8)]
    score = Score.from_notes(notes, TempoMap.constant(100))
    assert set(assign_limbs(score, load_kit()).limbs.tolist()) == {int(L)}
    assert set(assign_limbs(score, load_kit("left_handed")).limbs.tolist()) == {int(R)}


def test_a_hand_does_not_go_home_past_the_other() -> None:
    """Home is the snare; with the left hand on the floor tom the right one stays there beside it, alone it goes."""
    stays = [Note(0, Piece.FLOOR_TOM_1, limb=R)]
    others = [Note(i * PPQ, Piece.FLOOR_TOM_1, limb=L) for i in range(1, 5)]
    later = [Note(5 * PPQ - PPQ // 4, Piece.FLOOR_TOM_1, limb=R)]
    for notes, waits in ((stays + later, True), (stays + others + later, False)):
        score = Score.from_notes(notes, TempoMap.constant(100))
        right, _ = hand_events(score, score.notes["limb"])
        struck = np.flatnonzero(right.key[:, 2] == 0)
        assert bool(np.any(right.key[struck[0] : struck[-1], 2] == WAIT)) is waits


@pytest.mark.parametrize("idle", [False, True], ids=["rests", "never plays"])
@pytest.mark.parametrize("kit", ["seven_piece", "left_handed", "four_piece"])
def test_a_waiting_hand_comes_along_when_a_small_drummer_leans(kit: str, idle: bool) -> None:
    """At 1.62 m the far cymbals are struck leaning: the other shoulder comes over where its hand waits."""
    played, figure = load_kit(kit), load_figure("ponytail")
    far = Piece.CRASH_2 if Piece.CRASH_2 in played.pieces else Piece.RIDE
    zone = Zone.EDGE if far is Piece.CRASH_2 else Zone.BOW
    lead, other = (L, R) if played.left_handed else (R, L)
    notes = [] if idle else [Note(2 * PPQ, *EDGE[:2], 80, limb=other), Note(16 * PPQ, *HEAD[:2], 80, limb=other)]
    notes += [Note(4 * PPQ + i * PPQ, far, zone, 100, limb=lead) for i in range(8)]
    found = audit(Drummer(Score.from_notes(notes, TempoMap.constant(100)), played, figure))
    assert found.limit_rad.value <= radians(1), found.limit_rad
    assert found.kit_m.value <= 0.003, found.kit_m
    assert found.hands_m.value <= 0.003, found.hands_m
