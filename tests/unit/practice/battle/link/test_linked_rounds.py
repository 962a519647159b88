"""What the other end may say, in any order: it is taken, or refused by name, and nothing else happens."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from station.core.errors import BadInput
from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.music.performance import Performance
from station.practice.battle.battle_rules import BattleMode, BattleRules
from station.practice.battle.ground import Ground
from station.practice.battle.link.link_messages import (
    Called,
    Checked,
    Claim,
    Hello,
    PlayedBar,
    PlayedStroke,
    PlayedTurn,
    WrittenStroke,
    decoded,
    encoded,
)
from station.practice.battle.link.linked_rounds import LinkedRounds
from station.practice.battle.link.linked_rules import agreed, offer_of
from station.practice.battle.phrase import Turn
from station.practice.battle.turn_plan import TurnKind
from station.scoring.matching.hit_windows import Level
from tests.fakes.linked_stations import drum

HELLO = Hello("shed", "Ann", Level.STUDIO, "1")
ROUND = st.integers(1, 4)
CLAIM = Claim(50.0, None, ())

played = st.builds(
    PlayedStroke,
    at_ns=st.integers(-(10**8), 5 * 10**9),
    piece=st.sampled_from(Piece),
    zone=st.sampled_from(Zone),
    articulation=st.sampled_from(Articulation),
    velocity=st.integers(1, 127),
    velocity_fraction=st.just(0.0),
    limb=st.sampled_from(Limb),
    midi_note=st.integers(0, 127),
    openness=st.none() | st.floats(0, 1),
    position=st.none(),
)
written = st.builds(
    WrittenStroke,
    tick=st.integers(0, 9 * PPQ),
    piece=st.sampled_from(Piece),
    zone=st.sampled_from(Zone),
    articulation=st.sampled_from(Articulation),
    velocity=st.integers(1, 127),
    dynamic=st.sampled_from(Dynamic),
    ornament=st.sampled_from(Ornament),
    limb=st.sampled_from(Limb),
    midi_note=st.just(0),
    duration_ticks=st.integers(0, 9 * PPQ),
    choke_ticks=st.integers(0, 9 * PPQ),
    swing_ticks=st.just(0),
    lead_ms=st.just(0.0),
    late_ms=st.floats(-60, 60),
    openness=st.none(),
)
strokes = st.lists(played, max_size=3).map(tuple)
said = st.one_of(
    st.builds(PlayedBar, round=ROUND, bar=st.integers(0, 2), strokes=strokes, chokes=st.just(())),
    st.builds(PlayedTurn, round=ROUND, strokes=strokes, chokes=st.just(()), unheard=st.just(()), claim=st.just(CLAIM)),
    st.builds(Checked, round=ROUND, claim=st.just(CLAIM)),
    st.builds(
        Called,
        round=ROUND,
        step=st.integers(0, 1000),
        bars=st.integers(1, 3),
        strokes=st.lists(written, max_size=3).map(tuple),
        landing=st.just(()),
        words=st.just(""),
    ),
)


def rounds_of(mode: BattleMode, is_host: bool) -> LinkedRounds:
    rules = BattleRules(Ground(120.0), mode, rounds=3, bars=2, has_final=False)
    return LinkedRounds(agreed(offer_of(rules), HELLO, HELLO, is_host, rules), drum)


@settings(max_examples=60)
@given(mode=st.sampled_from(BattleMode), is_host=st.booleans(), messages=st.lists(said, max_size=12))
def test_whatever_fits_its_type_is_taken_or_refused_by_name(mode: BattleMode, is_host: bool, messages: list) -> None:  # type: ignore[type-arg]
    rounds, bar = rounds_of(mode, is_host), 0
    blamed = "the other station"
    for now_ns, message in enumerate(messages):
        turn = rounds.next_turn(bar, now_ns)
        if turn is not None:
            assert turn.first_bar == bar
            bar = turn.end_bar
        if turn is not None and turn.kind is TurnKind.ANSWER:
            rounds.turn_played(turn.round, Turn(rounds.rules.ground, turn.bars, Performance.from_hits([])), ())
        back = decoded(encoded(message), "them")
        try:
            rounds.take(back, now_ns)  # type: ignore[arg-type]
        except BadInput as fault:
            blamed = fault.source
            break
    assert blamed == "the other station"
    assert len(rounds.shared.digest) == 32


@pytest.mark.parametrize("mode", BattleMode)
def test_a_guest_waits_until_the_host_has_called_or_played(mode: BattleMode) -> None:
    rounds = rounds_of(mode, is_host=False)
    kinds = [turn.kind for bar in range(5) if (turn := rounds.next_turn(bar, 0)) is not None]
    assert kinds == [TurnKind.CHANGEOVER] * 5
    assert rounds.is_waiting


def test_a_turn_begins_with_a_bar_that_came_early_enough_and_goes_on_with_what_has_come() -> None:
    rounds = rounds_of(BattleMode.IMPROVISE, is_host=False)
    rounds.take(PlayedBar(1, 0, (), ()), now_ns=100)
    first = rounds.next_turn(0, in_time_ns=99)  # it came a moment ago: the next might be late
    second = rounds.next_turn(1, in_time_ns=100)
    rounds.take(PlayedBar(1, 1, (), ()), now_ns=200)
    third = rounds.next_turn(2, in_time_ns=100)  # inside a turn there is no margin to wait for
    fourth = rounds.next_turn(3, in_time_ns=100)
    kinds = [turn.kind for turn in (first, second, third, fourth) if turn is not None]
    assert kinds == [TurnKind.CHANGEOVER, TurnKind.CALL, TurnKind.CALL, TurnKind.ANSWER]
