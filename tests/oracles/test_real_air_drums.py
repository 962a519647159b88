"""Zones of real strokes in the air; which piece each recording strikes is its author's word, the number in its name."""

from pathlib import Path

import pytest

from benchmarks.air_drums import recorded_strokes
from station.core.pieces import Limb, Piece
from station.sync.air.heading_tracker import HeadingTracker
from station.sync.air.zone_learning import STROKES, AskedZone, too_close, zone_of
from tests.oracles.folder import oracles

pytestmark = [pytest.mark.oracle, pytest.mark.parametrize("path", oracles("air drums"))]

PIECES = (Piece.FLOOR_TOM_1, Piece.SNARE, Piece.HIHAT)


def test_eight_strokes_teach_where_a_piece_is(path: Path) -> None:
    takes = [recorded_strokes(path.with_name(f"{number}{path.name[1:]}")) for number in (1, 2, 3)]
    asked = [AskedZone(Limb.RIGHT_HAND, piece) for piece in PIECES]
    zones = [zone_of(each, aims[:STROKES]) for each, aims in zip(asked, takes, strict=True)]
    hand = HeadingTracker(zones)
    hand.fix(0, 0, zones[0].heading_rad)
    told = [
        (zone, hand.clear_zone(0, aim.heading_rad, aim.elevation_rad))
        for zone, aims in zip(zones, takes, strict=True)
        for aim in aims[STROKES:]
    ]
    assert too_close(zones) == ()
    assert len(told) > 140
    # one player sweeps from one piece's direction into another's: what is unclear is not named
    assert sum(named is zone for zone, named in told) >= 0.85 * len(told)
    assert sum(named is not None and named is not zone for zone, named in told) <= 0.02 * len(told)
