"""A lesson that is written for a right-handed player, read by an open-handed one: what drummers do, written by hand."""

import pytest

from station.core.pieces import Limb, Piece, Zone
from station.core.units import PPQ
from station.motion.kit.kit import load_kit
from station.motion.sticking.hand_notes import Hands
from station.motion.sticking.limbs import as_led
from station.music.score import Note, Score
from station.music.tempo import TempoMap

PIECES = {"h": Piece.HIHAT, "s": Piece.SNARE, "t": Piece.TOM_1, "k": Piece.KICK}
LIMBS = {"R": Limb.RIGHT_HAND, "L": Limb.LEFT_HAND, "r": Limb.RIGHT_FOOT, "-": Limb.UNKNOWN}


def bars_of(text: str) -> Score:
    """Eighths in 4/4: a word a cell, in it each stroke's piece and limb."""
    notes = [
        Note(cell * PPQ // 2, PIECES[piece], Zone.HEAD, limb=LIMBS[limb])
        for cell, word in enumerate(text.split())
        for piece, limb in zip(word[::2], word[1::2], strict=True)
    ]
    return Score.from_notes(notes, TempoMap.constant(100))


@pytest.mark.parametrize(
    ("written", "read"),
    [
        ("hRkr hR hRsL hR hRkr hR hRsL hR", "hLkr hL hLsR hL hLkr hL hLsR hL"),  # a groove uncrosses
        ("hR sL hR hRsL tR tL tR tL", "hL sR hL hLsR tR tL tR tL"),  # a fill begins as it is written
        ("hR hL sR hL hR hL sR hL", "hR hL sR hL hR hL sR hL"),  # both hands on the hat: nothing is crossed
        ("hL hLsR hL hL", "hL hLsR hL hL"),  # written for open hands
        ("hR s- hR hR", "hL s- hL hL"),  # what is free stays free
        ("sR sL tR tL hR sL hR sL hR hR", "sR sL tR tL hL sR hL sL hL hL"),  # the last of bar 1 lies behind its hat
    ],
)
def test_the_left_hand_keeps_time_on_the_hat(written: str, read: str) -> None:
    led = as_led(bars_of(written), load_kit(), Hands.OPEN)
    assert led.notes["limb"].tolist() == bars_of(read).notes["limb"].tolist()


def test_who_is_not_open_handed_reads_what_is_written() -> None:
    score = bars_of("hR hRsL")
    assert as_led(score, load_kit(), Hands.RIGHT) is score


def test_a_left_handed_kit_is_crossed_as_it_is_built() -> None:
    led = as_led(bars_of("hR hRsL"), load_kit("left_handed"), Hands.OPEN)
    assert led.notes["limb"].tolist() == bars_of("hL hLsR").notes["limb"].tolist()
