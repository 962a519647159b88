"""Two ends of a line over a network made here: how it opens, who is kept out, and what a stranger may say."""

import random
from dataclasses import dataclass, field

import pytest
from hypothesis import given
from hypothesis import strategies as st

from station.core.units import NS_PER_MS, NS_PER_S
from station.practice.battle.link.link_datagram import HALF_BYTES, WIRE_VERSION, Drop, Kind, headed
from station.practice.battle.link.link_discovery import FoundStation, Lookout
from station.practice.battle.link.link_handshake import (
    ANSWERS_A_SECOND,
    ASK_BYTES,
    GIVE_UP_NS,
    Address,
    Door,
    Knock,
    RandomBytes,
    Refusal,
    session_key,
)
from station.practice.battle.link.link_line import LinkLine
from station.practice.battle.link.link_messages import Accept, Bye, Card, Hello, encoded
from station.scoring.matching.hit_windows import Level

HOST, ANN, BEN = ("10.0.0.1", 34117), ("10.0.0.2", 5000), ("10.0.0.3", 6000)
HELLO = Hello("Ann's room", "Ann", Level.BEGINNER, "0.1.0")


def dice(seed: int) -> RandomBytes:
    return random.Random(seed).randbytes


def card(is_busy: bool) -> bytes:
    return encoded(Card("The shed", "improvise, 100 bpm", is_busy))


@dataclass
class Net:
    """Datagrams arrive a step after they were sent, at whoever is at their address."""

    at: dict[Address, LinkLine] = field(default_factory=dict)
    now_ns: int = 0
    log: list[tuple[bytes, Address, Address]] = field(default_factory=list)

    def run(self, steps: int) -> None:
        for _ in range(steps):
            self.now_ns += 10 * NS_PER_MS
            sent = [(data, source, to) for source, line in self.at.items() for data, to in line.due(self.now_ns)]
            self.log += sent
            for data, source, to in sent:
                if to in self.at:
                    self.at[to].handle(data, source, self.now_ns)


@pytest.fixture
def net() -> Net:
    net = Net()
    net.at[HOST] = LinkLine(Door(card, dice(1)))
    net.at[ANN] = LinkLine(Knock(HOST, 0, dice(2)))
    return net


def test_a_line_opens_and_carries_what_either_end_says(net: Net) -> None:
    net.run(5)
    assert net.at[HOST].is_open
    assert net.at[ANN].is_open
    net.at[ANN].send(HELLO)
    net.at[HOST].send(Accept())
    net.run(3)
    assert list(net.at[HOST].messages()) == [HELLO]
    assert list(net.at[ANN].messages()) == [Accept()]
    assert net.at[HOST].drops.total() == net.at[ANN].drops.total() == 0


def test_nothing_is_sent_by_a_host_that_nobody_asks() -> None:
    door = LinkLine(Door(card, dice(1)))
    assert [door.due(now * NS_PER_S) for now in range(5)] == [[]] * 5


def test_a_second_joiner_is_refused_by_name_and_the_first_plays_on(net: Net) -> None:
    net.run(5)
    ben = Knock(HOST, net.now_ns, dice(3))
    net.at[BEN] = LinkLine(ben)
    net.run(5)
    assert ben.refusal is Refusal.BUSY
    assert ben.is_hopeless(net.now_ns)
    assert not net.at[BEN].is_open
    net.at[ANN].send(HELLO)
    net.run(2)
    assert list(net.at[HOST].messages()) == [HELLO]


def test_whoever_comes_after_one_who_left_is_let_in(net: Net) -> None:
    net.run(5)
    left = net.at.pop(ANN)
    net.run(300)
    assert net.at[HOST].is_cut(net.now_ns)
    net.at[HOST].hang_up()
    net.at[BEN] = LinkLine(Knock(HOST, net.now_ns, dice(3)))
    net.run(5)
    assert net.at[BEN].is_open
    net.at[ANN] = left  # the one who left comes back into a house that is taken
    net.run(5)
    assert net.at[HOST].drops[Drop.SESSION] > 0
    assert net.at[HOST].peer == BEN


@pytest.mark.parametrize("gone_at", range(8))
def test_a_joiner_may_vanish_at_any_step_and_the_door_opens_again(net: Net, gone_at: int) -> None:
    net.run(gone_at)
    del net.at[ANN]
    net.run(300)
    assert net.at[HOST].is_open is (gone_at >= 3)
    net.at[HOST].hang_up()
    net.at[BEN] = LinkLine(Knock(HOST, net.now_ns, dice(3)))
    net.run(5)
    assert net.at[BEN].is_open


def test_a_knock_that_is_sent_again_later_opens_nothing(net: Net) -> None:
    net.run(5)
    knock = next(data for data, source, _ in net.log if source == ANN and data[4] == Kind.KNOCK)
    net.at[HOST].handle(knock, ANN, net.now_ns)  # the same, heard twice: no refusal either
    assert net.at[HOST].drops[Drop.KIND] == 1
    net.at[HOST].hang_up()
    net.at[HOST].handle(knock, ANN, net.now_ns)
    assert not net.at[HOST].is_open
    assert net.at[HOST].drops[Drop.SESSION] == 1


def test_a_knock_from_another_address_than_was_welcomed_opens_nothing(net: Net) -> None:
    net.run(2)
    knock = next(data for data, _ in net.at[ANN].due(net.now_ns + 10**9) if data[4] == Kind.KNOCK)
    net.at[HOST].handle(knock, BEN, net.now_ns)
    assert not net.at[HOST].is_open


def test_a_joiner_of_another_version_is_told_so(net: Net) -> None:
    ours = Knock(HOST, 0, dice(4))
    (data,) = ours.due(0)
    theirs = data[:3] + bytes([WIRE_VERSION + 1]) + data[4:]
    net.at[HOST].handle(theirs, BEN, 0)
    (refusal,) = (reply for reply, to in net.at[HOST].due(0) if to == BEN)
    assert len(refusal) <= len(theirs)
    newer = refusal[:3] + bytes([WIRE_VERSION + 1]) + refusal[4:]  # and a host of another version tells us
    ours.handle(newer, HOST, 0)
    assert ours.refusal is Refusal.VERSION


def test_nobody_there_is_found_out() -> None:
    knock = Knock(HOST, 0, dice(2))
    line = LinkLine(knock)
    asked = sum(len(line.due(now)) for now in range(0, 2 * GIVE_UP_NS, 50 * NS_PER_MS))
    assert knock.is_hopeless(GIVE_UP_NS + 1)
    assert 20 < asked < 30


def test_a_line_survives_a_new_address_and_no_old_datagram_leads_it_away(net: Net) -> None:
    net.run(5)
    moved: Address = ("10.0.0.2", 5999)
    net.at[moved] = net.at.pop(ANN)
    old = next(data for data, source, _ in reversed(net.log) if source == ANN)
    net.run(60)  # a heart beats
    assert net.at[HOST].peer == moved
    net.at[HOST].handle(old, BEN, net.now_ns)
    assert net.at[HOST].peer == moved
    assert net.at[HOST].drops[Drop.REPLAY] == 1
    net.at[HOST].send(Accept())
    net.run(3)
    assert list(net.at[moved].messages()) == [Accept()]


def test_a_message_that_does_not_fit_ends_the_belief_in_its_sender(net: Net) -> None:
    net.run(5)
    joiner = net.at[ANN]
    assert joiner._channel is not None
    joiner._channel.send(b"\x81\xa4type\xa5hullo")
    joiner.send(HELLO)
    net.run(3)
    assert list(net.at[HOST].messages()) == []
    assert net.at[HOST].fault is not None
    assert "hullo" in str(net.at[HOST].fault)
    assert net.at[HOST].drops[Drop.MALFORMED] == 1


def test_a_flood_of_questions_is_answered_no_oftener_than_a_host_may(net: Net) -> None:
    host = net.at[HOST]
    question = headed(Kind.ASK, bytes(HALF_BYTES)).ljust(ASK_BYTES, b"\0")
    for _ in range(1000):
        host.handle(question, BEN, NS_PER_S)
    answers = [data for data, to in host.due(NS_PER_S) if to == BEN]
    assert len(answers) == ANSWERS_A_SECOND
    assert host.drops[Drop.FLOOD] == 1000 - ANSWERS_A_SECOND
    assert max(map(len, answers)) <= ASK_BYTES


@given(st.lists(st.tuples(st.sampled_from(list(Kind)), st.binary(max_size=80), st.booleans()), max_size=30))
def test_no_datagram_of_a_stranger_opens_a_door(said: list[tuple[Kind, bytes, bool]]) -> None:
    host, joiner = LinkLine(Door(card, dice(1))), LinkLine(Knock(HOST, 0, dice(2)))
    for kind, noise, is_padded in said:
        data = headed(kind, noise)
        for line in (host, joiner):
            line.handle(data.ljust(ASK_BYTES if is_padded else 0, b"\0"), BEN, NS_PER_S)
    assert not host.is_open
    assert not joiner.is_open
    assert sum(host.drops.values()) + len(host.due(NS_PER_S)) == len(said)


def test_the_halves_make_a_key_that_neither_has_alone() -> None:
    ours, theirs = session_key(b"a" * 16, b"b" * 16, True), session_key(b"a" * 16, b"b" * 16, False)
    assert (ours.session, ours.secret) == (theirs.session, theirs.secret)
    others = {session_key(b"b" * 16, b"a" * 16, True).secret, session_key(b"a" * 16, b"c" * 16, True).secret}
    assert ours.secret not in others
    assert len(ours.secret) == 32


# --- who hosts -------------------------------------------------------------------------------------------------------


def look(host: LinkLine, now_ns: int) -> Lookout:
    lookout = Lookout((HOST,), dice(5))
    ((question, to),) = lookout.due(now_ns)
    assert to == HOST
    host.handle(question, BEN, now_ns)
    for data in [data for data, to in host.due(now_ns) if to == BEN]:
        assert lookout.handle(data, HOST, now_ns + 4 * NS_PER_MS) is None
    return lookout


def test_a_host_that_is_asked_says_what_it_plays_and_whether_it_is_free(net: Net) -> None:
    free = FoundStation(HOST, "The shed", "improvise, 100 bpm", False, 4.0)
    assert look(net.at[HOST], net.now_ns).found == (free,)
    net.run(5)
    assert [found.is_busy for found in look(net.at[HOST], net.now_ns).found] == [True]


def test_answers_that_nobody_asked_for_and_cards_that_lie_about_their_form_are_dropped() -> None:
    lookout = Lookout((HOST,), dice(5))
    ((question, _),) = lookout.due(0)
    nonce = question[5 : 5 + HALF_BYTES]
    assert lookout.due(NS_PER_S // 2) == []
    assert lookout.handle(headed(Kind.HERE, bytes(HALF_BYTES), card(False)), HOST, 1) is Drop.SESSION
    assert lookout.handle(headed(Kind.HERE, nonce, b"\xff"), HOST, 1) is Drop.MALFORMED
    hidden = encoded(Card("x", "", False)).replace(b"\xa1x", b"\xa4\xe2\x80\xaex")  # turns the direction of writing
    assert lookout.handle(headed(Kind.HERE, nonce, hidden), HOST, 1) is Drop.MALFORMED
    assert lookout.handle(headed(Kind.WELCOME, nonce), HOST, 1) is Drop.KIND
    assert lookout.found == ()
    for port in range(1000):
        lookout.handle(headed(Kind.HERE, nonce, card(False)), ("10.0.0.9", port), 1)
    assert len(lookout.found) == 64


def test_leaving_is_said_and_delivered(net: Net) -> None:
    net.run(5)
    net.at[ANN].send(Bye("left"))
    assert not net.at[ANN].is_delivered
    net.run(3)
    assert net.at[ANN].is_delivered
    assert list(net.at[HOST].messages()) == [Bye("left")]
