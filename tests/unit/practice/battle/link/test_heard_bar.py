"""A bar of the other's turn as a phrase, by hand: at 120 bpm a bar of four quarters lasts two seconds."""

import pytest

from station.core.events import Choke, Hit
from station.core.pieces import Articulation, Dynamic, Limb, Piece, Zone
from station.core.units import NS_PER_MS, NS_PER_S
from station.music.performance import Performance
from station.practice.battle.ground import Ground
from station.practice.battle.link.heard_bar import bar_of, heard_bar
from station.practice.battle.link.link_messages import Claim, Figure
from station.practice.battle.link.linked_claims import agree

GROUND, EARLY_NS = Ground(120.0), 60 * NS_PER_MS


def at(ms: float, piece: Piece = Piece.SNARE) -> Hit:
    return Hit(round(ms * NS_PER_MS), piece, Zone.HEAD, 90)


def test_each_stroke_belongs_to_one_bar() -> None:
    played = Performance.from_hits([at(-59), at(0), at(1939), at(1941), at(2000), at(3939), at(3941)])
    bars = [[hit.at_ns // NS_PER_MS for hit in bar_of(played, bar, GROUND, EARLY_NS)] for bar in range(3)]
    assert bars == [[-59, 0, 1939], [1941, 2000, 3939], [3941]]


def test_a_bar_sounds_as_it_was_played() -> None:
    hits = [
        Hit(1_950 * NS_PER_MS, Piece.KICK, Zone.HEAD, 30, limb=Limb.RIGHT_FOOT, midi_note=36),
        Hit(2_123_456_789, Piece.HIHAT, Zone.EDGE, 101, Articulation.NORMAL, 0.4, 26),
        Hit(2_500 * NS_PER_MS, Piece.CRASH_1, Zone.EDGE, 120),
    ]
    played = Performance.from_hits(hits, [Choke(3 * NS_PER_S, Piece.CRASH_1)])
    phrase = heard_bar(played, 1, GROUND)
    assert phrase.bars == 1
    assert phrase.score.onset_ns.tolist() == pytest.approx([-50e6, 123_456_789, 500e6], abs=5_000)  # a tick
    kick, hat, crash = phrase.score
    assert (kick.velocity, kick.limb, kick.midi_note, kick.openness) == (30, Limb.RIGHT_FOOT, 36, None)
    assert (hat.zone, hat.velocity) == (Zone.EDGE, 101)
    assert hat.openness == pytest.approx(0.4)
    assert {note.dynamic for note in phrase.score} == {Dynamic.NORMAL}, "no note stands in brackets: velocities say it"
    assert crash.choke_ticks == GROUND.bar_ticks // 4  # half a second


def test_an_empty_bar_is_a_bar_of_rest() -> None:
    assert heard_bar(Performance.from_hits([]), 3, GROUND).bars == 1


CLAIM = Claim(61.5, True, (Figure("right", 12.0), Figure("mean_ms", None)))


@pytest.mark.parametrize(
    ("other", "is_same"),
    [
        (CLAIM, True),
        (Claim(61.500001, True, CLAIM.figures), True),  # the last place of a rounding
        (Claim(61.50001, True, CLAIM.figures), False),
        (Claim(None, True, CLAIM.figures), False),
        (Claim(61.5, False, CLAIM.figures), False),
        (Claim(61.5, True, CLAIM.figures[:1]), False),
        (Claim(61.5, True, (CLAIM.figures[0], Figure("mean_ms", 0.0))), False),
        (Claim(61.5, True, (Figure("wrong", 12.0), CLAIM.figures[1])), False),
    ],
)
def test_claims_agree_where_every_figure_does(other: Claim, is_same: bool) -> None:
    assert agree(CLAIM, other) is is_same
    assert agree(other, CLAIM) is is_same
