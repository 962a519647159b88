"""How instruments answer: cymbals rock at the rates of HUMANS and settle, drums shake, heads give way, all flash."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece, Zone
from station.motion.kit.instruments import INCH_M, Instrument, _instrument
from station.motion.kit.kit import load_kit
from station.motion.kit.piece import KitPiece

Array = NDArray[np.float64]
AT = np.arange(0.0, 8.0, 0.001)


def struck(inches: float, velocity: float = 127.0, kind: str = "cymbal") -> Array:
    """Rows of swing about two axes, flash and ripple after one stroke on the near edge."""
    piece = KitPiece(Piece.CRASH_1, kind, (0.0, 0.8, 1.0), 0.5 * inches * INCH_M, 0.02)
    instrument: Instrument = _instrument(
        piece, np.array([0.0]), np.array([velocity]), np.add(piece.centre, [[0.0, -0.9 * piece.radius_m, 0.0]])
    )
    return np.array([instrument.at(t) for t in AT.tolist()])


@pytest.mark.parametrize(
    ("inches", "low", "high"), [(14, 0.68, 0.92), (16, 0.59, 0.82), (18, 0.53, 0.73), (20, 0.48, 0.66)]
)
def test_cymbals_rock_at_the_rate_of_their_size(inches: int, low: float, high: float) -> None:
    swing = struck(inches)[:, 0]
    crossings = AT[1:][np.diff(np.sign(swing)) != 0]
    assert low <= 0.5 / float(np.diff(crossings[1:5]).mean()) <= high


def test_they_settle_in_one_to_two_seconds() -> None:
    swing = np.abs(struck(16)[:, 0])
    peaks = [swing[i : i + 1500].max() for i in (0, 1500, 3000)]
    decay_s = 1.5 / np.log(peaks[0] / peaks[1])
    assert 1.0 <= decay_s <= 2.0
    assert peaks[2] < 0.15 * peaks[0]


def test_harder_strokes_and_smaller_cymbals_swing_farther() -> None:
    assert np.abs(struck(16, 60.0)[:, 0]).max() < 0.6 * np.abs(struck(16, 127.0)[:, 0]).max()
    assert np.abs(struck(20)[:, 0]).max() < np.abs(struck(14)[:, 0]).max()


def test_the_near_edge_goes_down_first() -> None:
    assert struck(16)[100, 0] > 0.0


def test_toms_shake_little_and_briefly() -> None:
    swing = np.abs(struck(12, kind="drum")[:, 0])
    assert 0.0 < np.degrees(swing.max()) < 1.5
    assert swing[1000:].max() < 0.01 * swing.max()


def test_heads_give_way_and_everything_flashes_by_force() -> None:
    soft, loud = struck(12, 40.0, "drum"), struck(12, 127.0, "drum")
    assert loud[0, 3] == pytest.approx(0.008)  # HUMANS: 8 mm at 5 m/s
    assert soft[0, 3] < loud[0, 3]
    assert soft[0, 2] < loud[0, 2] <= 1.0
    assert loud[500, 2] < 0.05
    assert struck(16)[0, 3] == 0.0  # a cymbal has no head


def test_strokes_add_up() -> None:
    crash = load_kit().pieces[Piece.CRASH_1]
    point = crash.target(Zone.EDGE, Limb.LEFT_HAND).point_m
    two = _instrument(crash, np.array([0.0, 0.1]), np.array([100.0, 100.0]), np.stack([point, point]))
    one, other = (_instrument(crash, np.array([t]), np.array([100.0]), point[None]) for t in (0.0, 0.1))
    assert two.at(0.7)[:2] == pytest.approx(np.add(one.at(0.7)[:2], other.at(0.7)[:2]))
