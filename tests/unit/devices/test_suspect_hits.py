"""Hits in milliseconds, and what of them looks like a ghost; expected by hand."""

from station.core.events import Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS
from station.devices.mapping.suspect_hits import Suspects
from station.devices.mapping.trigger_filter import HeldBack

SNARE, KICK, HAT, FOOT = Piece.SNARE, Piece.KICK, Piece.HIHAT, Piece.HIHAT_PEDAL


def seen(*hits: tuple[float, Piece, int]) -> list[tuple[HeldBack, Piece, Piece, float]]:
    """Why, who, by whom, and how many ms after."""
    suspects, found = Suspects(), []
    for ms, piece, velocity in hits:
        found += suspects.look(Hit(round(ms * NS_PER_MS), piece, Zone.HEAD, velocity))
    return [(s.why, s.hit.piece, s.cause.piece, s.after_ns / NS_PER_MS) for s in found]


def test_plain_playing_is_above_suspicion() -> None:
    assert seen((0, KICK, 100), (0, HAT, 70), (125, HAT, 60), (250, SNARE, 30), (250, HAT, 70), (290, SNARE, 25)) == []


def test_a_softer_stroke_just_after_on_the_same_pad_is_suspect() -> None:
    assert seen((0, SNARE, 100), (8, SNARE, 60)) == [(HeldBack.DOUBLE, SNARE, SNARE, 8)]
    assert seen((0, SNARE, 100), (8, SNARE, 90), (40, SNARE, 50)) == []


def test_a_much_softer_neighbour_is_suspect_before_and_after() -> None:
    assert seen((0, KICK, 100), (12, SNARE, 25)) == [(HeldBack.CROSSTALK, SNARE, KICK, 12)]
    assert seen((0, SNARE, 25), (6, KICK, 100)) == [(HeldBack.CROSSTALK, SNARE, KICK, -6)]
    assert seen((0, SNARE, 25), (11, KICK, 100)) == []


def test_a_soft_stomp_just_after_a_hi_hat_stroke_is_suspect() -> None:
    assert seen((0, HAT, 100), (40, FOOT, 50)) == [(HeldBack.FALSE_STOMP, FOOT, HAT, 40)]
    assert seen((0, FOOT, 100), (40, HAT, 50)) == []
