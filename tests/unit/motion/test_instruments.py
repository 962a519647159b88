"""How instruments answer: cymbals rock at the rates of HUMANS and settle, drums shake, heads give way, all flash."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece, Zone
from station.core.units import PPQ
from station.motion.drummer import Drummer
from station.motion.kit.instruments import NUMBERS, Instrument, _instrument, _Strokes
from station.motion.kit.kit import kit_names, load_kit
from station.motion.kit.piece import KitPiece
from station.motion.kit.swing_room import INCH_M, swing_room
from station.music.score import Note, Score
from station.music.tempo import TempoMap

Array = NDArray[np.float64]
AT = np.arange(0.0, 8.0, 0.001)
ROOM = math.radians(30.0)


def answer(
    piece: KitPiece, at_s: list[float], velocity: float = 127.0, share: float = 0.95, free: float = 1.0
) -> Instrument:
    """What strokes on the near side do, `share` of the radius out."""
    near = np.add(piece.centre, [0.0, -share * piece.radius_m, 0.0])
    n = len(at_s)
    strokes = _Strokes(np.array(at_s), np.full(n, velocity), np.tile(near, (n, 1)), np.full(n, free))
    return _instrument(piece, strokes, ROOM)


def piece_of(inches: float, kind: str = "cymbal") -> KitPiece:
    return KitPiece(Piece.CRASH_1, kind, (0.0, 0.8, 1.0), 0.5 * inches * INCH_M, 0.02)


def struck(inches: float, velocity: float = 127.0, kind: str = "cymbal", share: float = 0.95) -> Array:
    """Rows of what one stroke does, by `AT`."""
    instrument = answer(piece_of(inches, kind), [0.0], velocity, share)
    return np.array([instrument.at(t) for t in AT.tolist()])


def tipped_deg(rows: Array) -> Array:
    """How far the piece is tipped, whichever way."""
    return np.degrees(np.hypot(rows[:, 0], rows[:, 1]))


@pytest.mark.parametrize(
    ("inches", "low", "high"), [(14, 0.68, 0.92), (16, 0.59, 0.82), (18, 0.53, 0.73), (20, 0.48, 0.66)]
)
def test_cymbals_rock_at_the_rate_of_their_size(inches: int, low: float, high: float) -> None:
    tip = tipped_deg(struck(inches))[400:]  # once it has stopped to shiver
    still = AT[401:-1][(tip[1:-1] < tip[:-2]) & (tip[1:-1] <= tip[2:])]
    assert low <= 0.5 / float(np.diff(still[:4]).mean()) <= high


def test_they_settle_in_one_to_two_seconds() -> None:
    tip = tipped_deg(struck(16))
    peaks = [tip[i : i + 1500].max() for i in (300, 1800, 3300)]
    assert 1.0 <= 1.5 / np.log(peaks[0] / peaks[1]) <= 2.0
    assert peaks[2] < 0.15 * peaks[0]


def test_a_crash_tips_by_15_to_30_degrees_under_full_force_and_a_ride_s_bow_by_little() -> None:
    """Drummers' crashes on loose felts; a ride that is played on its bow hardly moves."""
    for inches in (16, 18):
        assert 15.0 <= tipped_deg(struck(inches)).max() <= 30.0
    assert tipped_deg(struck(20, share=0.6)).max() < 8.0
    assert tipped_deg(struck(20, 80.0, share=0.6)).max() < 4.0
    assert tipped_deg(struck(14, kind="hihat")).max() < 10.0


def test_harder_strokes_and_smaller_cymbals_swing_farther() -> None:
    assert tipped_deg(struck(16, 60.0)).max() < 0.6 * tipped_deg(struck(16, 127.0)).max()
    assert tipped_deg(struck(20)).max() < tipped_deg(struck(14)).max()


def test_the_near_edge_goes_down_first_and_the_swing_goes_round() -> None:
    rows = struck(16)
    assert rows[100, 0] > 0.0
    ways = np.arctan2(rows[[350, 1750], 1], rows[[350, 1750], 0])
    assert math.radians(30) < (ways[1] - ways[0]) % math.pi < math.radians(70)


def test_the_edge_shivers_right_after_the_stroke_and_soon_no_more() -> None:
    """Quick motion is what a tenth of a second's mean leaves."""
    tip = struck(16)[:, 0]
    quick = np.abs(tip - np.convolve(np.pad(tip, 50, mode="edge"), np.ones(100) / 100, "valid")[: len(tip)])
    assert quick[20:120].max() > math.radians(0.7)
    assert quick[600:].max() < math.radians(0.3)


def test_toms_shake_little_and_briefly() -> None:
    swing = tipped_deg(struck(12, kind="drum"))
    assert 0.0 < swing.max() < 1.5
    assert swing[1000:].max() < 0.01 * swing.max()


def test_heads_give_way_and_everything_flashes_by_force() -> None:
    soft, loud = struck(12, 40.0, "drum"), struck(12, 127.0, "drum")
    assert loud[0, 3] == pytest.approx(0.008)  # HUMANS: 8 mm at 5 m/s
    assert soft[0, 3] < loud[0, 3]
    assert loud[7, 4:7] == pytest.approx((0.0, -0.95 * 6 * INCH_M, 0.007))  # where it was struck, and since when
    assert soft[0, 2] < loud[0, 2] <= 1.0
    assert loud[500, 2] < 0.05
    assert struck(16).shape[1] == NUMBERS
    assert struck(16)[0, 3] == 0.0  # a cymbal has no head


@pytest.mark.parametrize("gap_s", [0.03, 0.125, 0.25, 0.7, 1.0, 1.9, 3.3])
def test_at_every_stroke_the_piece_lies_where_the_stick_meets_it(gap_s: float) -> None:
    """A tenth of a millimetre at the edge of a 20-inch ride, whatever the strokes before have left."""
    for kind, inches in (("cymbal", 16), ("cymbal", 20), ("drum", 13)):
        times = [0.0, gap_s, 2 * gap_s, 2.5 * gap_s, 4 * gap_s]
        instrument = answer(piece_of(inches, kind), times)
        for at in times:
            for t in (at - 1e-9, at):
                assert math.hypot(*instrument.at(t)[:2]) * 0.254 < 1e-4


def test_however_often_it_is_struck_it_stays_in_its_room() -> None:
    for gap_s in (0.2, 0.35, 0.7, 1.0, 1.4):
        instrument = answer(piece_of(14), [gap_s * k for k in range(20)])
        rows = np.array([instrument.at(t) for t in AT.tolist()])
        assert tipped_deg(rows).max() <= 30.0 + 1e-6


def test_a_choke_stops_it() -> None:
    tempo = TempoMap.constant(60.0)
    note = Note(PPQ, Piece.CRASH_1, Zone.EDGE, velocity=120, limb=Limb.RIGHT_HAND, choke_ticks=PPQ)
    drummer = Drummer(Score.from_notes([note], tempo))
    crash = list(drummer.kit.pieces).index(Piece.CRASH_1)
    tip = tipped_deg(drummer.swings(crash, np.linspace(0.0, 5.0, 501)))
    assert tip[100:200].max() > 10.0
    assert tip[200:].max() < 1e-9


def test_a_shut_hi_hat_moves_less_than_an_open_one_and_the_foot_stills_it() -> None:
    tempo = TempoMap.constant(60.0)
    most = []
    for openness in (0.0, 1.0):
        notes = [
            Note(PPQ, Piece.HIHAT, Zone.EDGE, velocity=120, limb=Limb.RIGHT_HAND, openness=openness),
            Note(2 * PPQ, Piece.HIHAT_PEDAL, Zone.PEDAL),
        ]
        drummer = Drummer(Score.from_notes(notes, tempo))
        hat = list(drummer.kit.pieces).index(Piece.HIHAT)
        tip = tipped_deg(drummer.swings(hat, np.linspace(0.0, 5.0, 501)))
        most.append(float(tip.max()))
        assert tip[200:].max() < 1e-9
    assert 0.0 < most[0] < 0.2 * most[1]


@pytest.mark.parametrize("name", kit_names())
def test_swinging_cymbals_clear_each_other_and_the_drums(name: str) -> None:
    """Edges of both at their farthest, any two ways, are apart."""
    kit = load_kit(name)
    room = swing_room(kit)
    cymbals = [p for p in kit.pieces.values() if p.piece in room]
    around = np.linspace(0, 2 * np.pi, 16, endpoint=False)
    discs = {p.piece: [_disc(p, way, room[p.piece] * s) for way in around for s in (0.0, 0.5, 1.0)] for p in cymbals}
    for one in cymbals:
        for other in kit.pieces.values():
            if other.piece in room and other.piece != one.piece and math.dist(one.centre_m, other.centre_m) < 0.6:
                for centre, normal, _ in discs[one.piece]:
                    for _, _, edge in discs[other.piece]:
                        off = edge - centre
                        height = off @ normal
                        inside = np.sqrt((off**2).sum(1) - height**2) < one.radius_m
                        assert not (inside[:-1] & inside[1:] & (height[:-1] * height[1:] < 0)).any()


def _disc(piece: KitPiece, way: float, tip: float) -> tuple[Array, Array, Array]:
    """Centre, normal and edge of a cymbal that is tipped by `tip` to `way`."""
    right, away, normal = piece.axes
    to = math.cos(way) * right + math.sin(way) * away
    side = np.cross(normal, to)
    leaned = math.cos(tip) * to - math.sin(tip) * normal
    a = np.linspace(0, 2 * np.pi, 32)
    edge = piece.centre + piece.radius_m * (np.cos(a)[:, None] * leaned + np.sin(a)[:, None] * side)
    return piece.centre, np.cross(leaned, side), edge


def test_rides_and_crashes_of_the_shipped_kits_have_room() -> None:
    """A crash that its neighbours hold would look screwed down."""
    for name in kit_names():
        for piece, room in swing_room(load_kit(name)).items():
            if piece in (Piece.CRASH_1, Piece.CRASH_2):
                assert math.degrees(room) >= 15.0, (name, piece)
