"""Two stations, one battle, over a network made here that delays, loses, cuts and lies."""

import random
from functools import cache

import msgspec
import pytest

from station.core.events import DeviceFound
from station.core.pieces import Piece
from station.core.units import NS_PER_MS, NS_PER_S
from station.practice.battle.battle_rules import BattleMode, BattleRules
from station.practice.battle.battle_view import Doing
from station.practice.battle.ground import Ground
from station.practice.battle.link.link_datagram import Kind, headed
from station.practice.battle.link.link_messages import Claim, Message, PlayedBar, PlayedTurn
from station.practice.battle.link.linked_battle import LONGEST_CUT_NS, LinkedBattle, LinkEnd
from station.practice.battle.link.linked_document import linked_result, network_fields, network_report
from station.practice.battle.link.linked_view import linked_view
from station.practice.battle.turn_plan import TurnKind
from station.scoring.matching.hit_windows import Level
from tests.fakes.linked_stations import GUEST, HOST, Network, Player, TwoStations, improvises, repeats

GROUND = Ground(120.0)
"""A bar lasts two seconds."""
CUT_S = (16.0, 26.0)


def rules(mode: BattleMode, rounds: int = 3) -> BattleRules:
    return BattleRules(GROUND, mode, rounds=rounds, bars=2, has_final=False, lives=9)


PLAYERS: dict[BattleMode, tuple[Player, Player]] = {
    BattleMode.REPEAT: (repeats(12.0), repeats(30.0, dropped=0.1)),
    BattleMode.IMPROVISE: (
        improvises(8.0, (Piece.SNARE, Piece.KICK, Piece.TOM_1)),
        improvises(25.0, (Piece.SNARE, Piece.HIHAT)),
    ),
}


def bad_network(seed: int = 1) -> Network:
    """200 ms, 5 % loss and a cut of 10 s."""
    cut = (round(CUT_S[0] * NS_PER_S), round(CUT_S[1] * NS_PER_S))
    return Network(seed, delay_ns=200 * NS_PER_MS, loss=0.05, cuts=(cut,))


def two(mode: BattleMode, network: Network | None = None, rounds: int = 3) -> TwoStations:
    return TwoStations(rules(mode, rounds), network or Network(), PLAYERS[mode])


@cache
def played(mode: BattleMode, is_bad: bool, rounds: int = 3) -> TwoStations:
    """A battle that was played to its end; nobody may change it."""
    stations = two(mode, bad_network() if is_bad else None, rounds)
    stations.run(300)
    return stations


def battles(stations: TwoStations) -> tuple[LinkedBattle, LinkedBattle]:
    host, guest = stations.host.battle, stations.guest.battle
    assert host is not None
    assert guest is not None
    return host, guest


def claims(battle: LinkedBattle) -> list[tuple[int, int, Claim, Claim | None]]:
    return [(one.round, one.side, one.claim, one.checked) for one in battle.rounds.shared.standing()]


@pytest.fixture(params=BattleMode, ids=lambda mode: mode.value)
def mode(request: pytest.FixtureRequest) -> BattleMode:
    found: BattleMode = request.param
    return found


def test_over_a_bad_network_both_ends_agree_on_every_judgement(mode: BattleMode) -> None:
    stations = played(mode, True)
    host, guest = battles(stations)
    assert host.ended is guest.ended is LinkEnd.COMPLETE
    assert stations.network.lost > 40  # two heart beats a second of each end for ten seconds
    assert claims(host) == claims(guest)
    assert len(claims(host)) == 2 * 3
    assert all(claim == checked for _, _, claim, checked in claims(host))
    assert host.rounds.shared.digest == guest.rounds.shared.digest == host.their_digest == guest.their_digest
    ours, theirs = network_fields(host), network_fields(guest)
    assert ours["agree"] is theirs["agree"] is True
    assert ours["turns"] == theirs["turns"]
    assert linked_result(host).standings == linked_result(guest).standings
    assert linked_result(host).winner == linked_result(guest).winner
    assert f"Record {host.their_digest}: the other station has the same." in network_report(guest)


def test_the_networks_delay_counts_in_no_judgement(mode: BattleMode) -> None:
    """Whoever plays the same is judged the same, over whatever network."""
    quick, slow = played(mode, False), played(mode, True)
    assert slow.now_ns > quick.now_ns
    assert claims(battles(quick)[0]) == claims(battles(slow)[0])
    assert battles(quick)[0].rounds.shared.digest == battles(slow)[1].rounds.shared.digest


@pytest.mark.parametrize("cut_s", [4, 11, 19])
def test_wherever_the_cut_falls_the_record_is_the_same(mode: BattleMode, cut_s: int) -> None:
    cuts = ((cut_s * NS_PER_S, (cut_s + 10) * NS_PER_S),)
    stations = two(mode, Network(cut_s, delay_ns=300 * NS_PER_MS, loss=0.1, cuts=cuts))
    stations.run(300)
    host, guest = battles(stations)
    assert host.ended is guest.ended is LinkEnd.COMPLETE
    assert host.rounds.shared.digest == guest.rounds.shared.digest
    assert claims(host) == claims(guest) == claims(battles(played(mode, False))[0])


@pytest.mark.parametrize("stalls_at_s", [5.0, 8.3, 12.1, 15.4])
def test_a_station_that_stalls_for_seconds_begins_no_turn_in_the_past(mode: BattleMode, stalls_at_s: float) -> None:
    """What would have begun meanwhile begins on a bar line that comes: nobody misses what they never heard."""
    stations = two(mode)
    stations.run(stalls_at_s)
    host, guest = battles(stations)
    stalled = stations.ends.pop(HOST)
    stations.run(4)
    stations.ends[HOST] = stalled
    before = len(host.plan)
    stations.run(1)
    at_ns = host.at_ns
    if at_ns is not None and len(host.plan) > before:
        begun = [turn for turn in host.plan[before:] if turn.kind is not TurnKind.CHANGEOVER]
        assert all(turn.first_bar * host.rules.bar_ns > at_ns - NS_PER_S for turn in begun)
    stations.run(200)
    assert claims(host) == claims(guest) == claims(battles(played(mode, False))[0])
    assert host.rounds.shared.digest == guest.rounds.shared.digest


def test_bars_run_on_without_a_gap_and_a_cut_is_stood_out_with_a_count_in(mode: BattleMode) -> None:
    stations = played(mode, True)
    cut_ns, back_ns = (round(at * NS_PER_S) for at in CUT_S)
    stood = [span for station in (stations.host, stations.guest) for span in station.standings]
    assert stood
    for stopped_ns, went_on_ns in stood:
        assert cut_ns + 2 * NS_PER_S < stopped_ns < back_ns + NS_PER_S  # once it was known, and the turn was over
        assert back_ns <= went_on_ns < back_ns + 2 * NS_PER_S  # a heart beat in half a second, and was not lost twice
    for battle in battles(stations):
        plan = battle.plan
        assert [turn.first_bar for turn in plan[1:]] == [turn.end_bar for turn in plan[:-1]]


def test_a_trade_is_heard_bar_by_bar_without_a_hole_and_answered_on_the_next_bar_line() -> None:
    stations = played(BattleMode.IMPROVISE, True)
    for battle in battles(stations):
        for before, after in zip(battle.plan, battle.plan[1:], strict=False):
            if before.kind is TurnKind.CALL and before.round == after.round and after.kind is TurnKind.CHANGEOVER:
                heard = [turn for turn in battle.plan if turn.kind is TurnKind.CALL and turn.round == before.round]
                assert before is heard[-1]  # waiting only once a turn is over
        own = [turn for turn in battle.plan if turn.kind is TurnKind.ANSWER]
        assert [turn.bars for turn in own] == [2] * 3
        for turn in own[1:]:
            assert battle.plan[turn.index - 1].kind is TurnKind.CALL


def test_what_is_heard_of_the_other_is_what_they_played() -> None:
    host, guest = battles(played(BattleMode.IMPROVISE, False))
    (whole,) = [one for one in host.rounds.shared.standing() if (one.round, one.side) == (1, 1)]
    heard = [turn.phrase for turn in guest.plan if turn.kind is TurnKind.CALL and turn.round == 1]
    sounded = [
        (round(bar * 2e9) + at_ns, note.piece, note.velocity)
        for bar, phrase in enumerate(heard)
        if phrase is not None
        for at_ns, note in zip(phrase.score.onset_ns.tolist(), phrase.score, strict=True)
    ]
    strokes = [(hit.at_ns, hit.piece, hit.velocity) for hit in whole.turn.played]
    assert [stroke[1:] for stroke in sounded] == [stroke[1:] for stroke in strokes]
    assert all(abs(one[0] - other[0]) < 10_000 for one, other in zip(sounded, strokes, strict=True))  # a tick is 5 µs


# --- pauses and ends -------------------------------------------------------------------------------------------------


def test_a_pause_of_either_stops_both_and_only_they_end_it(mode: BattleMode) -> None:
    stations = two(mode)
    stations.run(9)
    host, guest = battles(stations)
    guest.pause()
    stations.run(12)
    assert (host.standing, guest.standing) == (True, True)
    assert linked_view(host).message == "A pause, asked for by Ben."
    assert linked_view(guest).message == "A pause, asked for by you."
    host.resume()  # it is not the host's
    stations.run(5)
    assert (host.standing, guest.standing) == (True, True)
    guest.resume()
    stations.run(200)
    assert host.ended is guest.ended is LinkEnd.COMPLETE
    assert host.rounds.shared.digest == guest.rounds.shared.digest
    assert claims(host) == claims(battles(played(mode, False))[0])


@pytest.mark.parametrize("gone_at_s", [1.0, 3.0, 9.0, 14.5])
def test_who_vanishes_ends_the_battle_for_the_other_and_what_stands_is_kept(mode: BattleMode, gone_at_s: float) -> None:
    stations = two(mode, rounds=4)
    stations.run(gone_at_s)
    guest = stations.ends.pop(GUEST)
    stations.run(30)
    host = stations.host.battle
    assert host is not None
    assert linked_view(host).doing is Doing.PAUSED
    assert linked_view(host).message == "The line to Ben is cut: waiting for Ben."
    stations.now_ns += LONGEST_CUT_NS
    stations.run(1)
    assert host.ended is LinkEnd.CUT
    assert guest.battle is not None
    kept = claims(host)
    assert kept == claims(guest.battle)[: len(kept)]
    assert network_fields(host)["agree"] is False  # nobody said what they have
    assert not linked_result(host).is_complete


def test_who_has_played_nothing_has_no_device_in_the_record() -> None:
    stations = TwoStations(
        rules(BattleMode.IMPROVISE, 1), Network(), (PLAYERS[BattleMode.IMPROVISE][0], lambda turn, chance: ())
    )
    stations.run(5)
    battles(stations)[1].handle(DeviceFound(stations.now_ns, "a kit"))
    stations.run(300)
    host, guest = (linked_result(battle) for battle in battles(stations))
    assert host.devices[1] is not None
    assert guest.devices == (None, None, None), "a kit that is plugged in is no stroke"
    assert host.is_played
    assert guest.is_played, "the other's strokes came over the line"


def test_who_leaves_says_so(mode: BattleMode) -> None:
    stations = two(mode)
    stations.run(10)
    host, guest = battles(stations)
    guest.stop()
    stations.run(2, ends_with_them=False)
    assert guest.ended is LinkEnd.STOPPED
    assert host.ended is LinkEnd.LEFT
    assert stations.guest.line.is_delivered


def test_a_child_may_beat_a_parent_by_windows_of_their_own() -> None:
    sloppy = TwoStations(
        rules(BattleMode.REPEAT), Network(), (repeats(20.0), repeats(40.0)), levels=(Level.STUDIO, Level.BEGINNER)
    )
    strict = TwoStations(rules(BattleMode.REPEAT), Network(), (repeats(20.0), repeats(40.0)))
    for pair in (sloppy, strict):
        pair.run(100)
    points = [[side.points for side in linked_result(battles(pair)[1]).standings[1:]] for pair in (sloppy, strict)]
    assert points[0][0] < points[1][0]  # ±5 ms instead of ±15
    assert points[0][1] > points[1][1]  # ±30 ms instead of ±15


def test_two_players_of_one_name_are_told_apart() -> None:
    stations = TwoStations(rules(BattleMode.REPEAT), Network(), PLAYERS[BattleMode.REPEAT], names=("Sam", "sam"))
    stations.run(5)
    assert [side.name for side in linked_view(battles(stations)[0]).sides[1:]] == ["Sam", "sam 2"]


# --- who lies --------------------------------------------------------------------------------------------------------


def lying(stations: TwoStations, bend: dict[type[Message], object]) -> None:
    """The guest's messages, bent on their way out."""
    line = stations.guest.line
    send = line.send

    def say(message: Message) -> None:
        bent = bend.get(type(message))
        send(bent(message) if callable(bent) else message)

    line.send = say  # type: ignore[method-assign]


def test_a_claim_that_the_strokes_do_not_bear_out_counts_for_nobody_and_is_shown(mode: BattleMode) -> None:
    stations = two(mode)
    stations.run(1)
    lying(stations, {PlayedTurn: lambda said: msgspec.structs.replace(said, claim=Claim(100.0, True, ()))})
    stations.run(200)
    host, guest = battles(stations)
    assert [one.side for one in host.rounds.shared.disputed] == [2, 2, 2]
    assert host.rounds.shared.digest != guest.rounds.shared.digest  # whatever the guest's own record says
    assert network_fields(host)["agree"] is network_fields(guest)["agree"] is False
    assert "Round 2, Ben: the stations judge it otherwise" in network_report(host)
    sides = linked_view(host).sides
    assert sides[2].points == 0
    assert (sides[1].points or 0) > 0


def test_strokes_that_were_heard_cannot_be_taken_back() -> None:
    stations = two(BattleMode.IMPROVISE)
    stations.run(1)
    lying(stations, {PlayedTurn: lambda said: msgspec.structs.replace(said, strokes=said.strokes[1:])})
    stations.run(60)
    host, guest = battles(stations)
    assert host.ended is LinkEnd.FAULT
    assert "lacks strokes that were heard" in host.fault
    assert guest.ended is LinkEnd.LEFT


@pytest.mark.parametrize(
    ("bend", "fault"),
    [
        (lambda said: msgspec.structs.replace(said, round=99), "round 99"),
        (lambda said: msgspec.structs.replace(said, bar=1), "not its turn"),
        (
            lambda said: msgspec.structs.replace(
                said, strokes=(msgspec.structs.replace(said.strokes[0], at_ns=4 * NS_PER_S),)
            ),
            "outside its bars",
        ),
    ],
)
def test_bars_that_cannot_be_end_the_belief_in_whoever_sends_them(bend: object, fault: str) -> None:
    stations = two(BattleMode.IMPROVISE)
    stations.run(1)
    lying(stations, {PlayedBar: bend})
    stations.run(60)
    host, _ = battles(stations)
    assert host.ended is LinkEnd.FAULT
    assert fault in host.fault


def test_strangers_who_flood_both_ends_change_nothing(mode: BattleMode) -> None:
    stations, chance = two(mode), random.Random(5)
    seen: list[bytes] = []
    for _ in range(120):
        stations.run(0.5)
        for _ in range(30):
            noise = headed(chance.choice(list(Kind)), chance.randbytes(chance.randrange(600)))
            for station, source in ((stations.host, GUEST), (stations.guest, HOST)):
                station.line.handle(chance.choice([noise, *seen[-5:]]), source, stations.now_ns)
        seen += [data for data, _ in stations.guest.line.due(stations.now_ns)]  # lost, and played back
    stations.run(100)
    host, guest = battles(stations)
    assert host.ended is guest.ended is LinkEnd.COMPLETE
    assert stations.host.line.drops.total() > 1000
    assert claims(host) == claims(guest) == claims(battles(played(mode, False))[0])
