"""Two stations before their battle: who comes, who is shown out, and what is agreed."""

import msgspec
import pytest

from station.core.errors import BadInput, DeviceError, StationError
from station.core.pieces import Piece
from station.practice.battle.battle_rules import BattleMode, BattleRules
from station.practice.battle.ground import Feel, Ground
from station.practice.battle.link.link_messages import Accept, Bye, Message, Offer, Pause
from station.practice.battle.link.linked_rules import agreed, offer_of, two_players
from station.scoring.matching.hit_windows import Level
from tests.fakes.linked_stations import GUEST, Network, TwoStations, improvises

RULES = BattleRules(
    Ground(92.0, 6, 8, Feel.TRIPLET, "jazz"),
    BattleMode.IMPROVISE,
    opponent="jazz",
    rounds=5,
    has_final=True,
    bars=8,
    lives=2,
    target=0.75,
    level=Level.ADVANCED,
    first_step=3,
    seed=99,
    keeps_time=True,
)


def stations(now_ns: int = 0, dice: int = 2) -> TwoStations:
    nobody = improvises(0.0, (Piece.SNARE,))
    levels = (Level.ADVANCED, Level.BEGINNER)
    return TwoStations(RULES, Network(), (nobody, nobody), levels=levels, now_ns=now_ns, dice=dice)


def test_both_ends_have_the_hosts_rules_and_each_its_own_level() -> None:
    both = stations()
    both.run(1)
    host, guest = both.host.battle, both.guest.battle
    assert host is not None
    assert guest is not None
    assert host.agreed.as_bytes == guest.agreed.as_bytes
    assert [player.name for player in host.rules.players] == ["Ann", "Ben"]
    assert (host.rules.level, guest.rules.level) == (Level.ADVANCED, Level.BEGINNER)
    assert (host.agreed.our_side, guest.agreed.our_side) == (1, 2)
    for name in ("ground", "mode", "opponent", "rounds", "has_final", "bars", "lives", "target", "seed", "keeps_time"):
        assert getattr(host.rules, name) == getattr(guest.rules, name) == getattr(RULES, name)


@pytest.mark.parametrize("gone_at_s", [0.04, 0.08, 0.12, 0.16, 0.2, 0.24])
def test_a_guest_who_vanishes_before_the_battle_leaves_the_door_open(gone_at_s: float) -> None:
    both = stations()
    both.run(gone_at_s)
    del both.ends[GUEST]
    both.run(15)
    assert both.host.battle is None
    both.ends[GUEST] = stations(both.now_ns, dice=3).guest
    both.run(1)
    assert both.host.battle is not None


def test_a_guest_who_speaks_out_of_turn_is_shown_out() -> None:
    for said in (Pause(), Accept(), Bye("left")):
        both = stations()
        send = both.guest.line.send

        def say(message: Message, said: Message = said, send: object = send) -> None:
            assert callable(send)
            send(said)

        both.guest.line.send = say  # type: ignore[method-assign]
        with pytest.raises(StationError):  # the host hangs up, and says nothing more
            both.run(15)
        assert both.host.battle is None
        assert both.host.lobby.notices


def test_nobody_at_the_address_is_said() -> None:
    both = stations()
    both.ends = {GUEST: both.guest}
    with pytest.raises(DeviceError, match=r"nobody hosts a battle at 127\.0\.0\.1:34117"):
        both.run(10)


def test_a_busy_host_says_so() -> None:
    both = stations()
    both.run(1)
    both.ends[("127.0.0.1", 50001)] = stations(both.now_ns, dice=3).guest
    with pytest.raises(DeviceError, match="another player is there already"):
        both.run(1)


@pytest.mark.parametrize(
    ("field", "value", "fault"),
    [
        ("opponent", "nobody", "no such drummer"),
        ("tempo_bpm", 900.0, "beats a minute"),
        ("first_step", 900, "first step"),
        ("bars", 3, "bars"),
        ("rounds", 90, "rounds"),
        ("target", 0.0, "target"),
        ("lives", 50, "lives"),
    ],
)
def test_rules_that_nobody_can_play_are_refused(field: str, value: object, fault: str) -> None:
    offer: Offer = msgspec.structs.replace(offer_of(RULES), **{field: value})
    hello = stations().host.lobby._hello
    with pytest.raises(BadInput, match=fault):
        agreed(offer, hello, hello, is_host=False, own=RULES)


def test_names_that_are_one_are_told_apart() -> None:
    long = "x" * 40
    assert [player.name for player in two_players(long, long.upper())] == [long, "X" * 38 + " 2"]
    assert [player.name for player in two_players("", "")] == ["host", "guest"]
