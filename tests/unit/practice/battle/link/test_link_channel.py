"""A channel over a network that loses, doubles and reorders: what was sent arrives once, whole and in order."""

from itertools import count

import pytest
from hypothesis import given
from hypothesis import strategies as st

from station.core.errors import DeviceError
from station.core.units import NS_PER_MS, NS_PER_S
from station.practice.battle.link.link_channel import (
    CUT_NS,
    HEARTBEAT_NS,
    MOST_HELD_BYTES,
    MOST_MESSAGE_BYTES,
    REPLAY_WINDOW,
    WINDOW,
    LinkChannel,
    ReplayGuard,
    RoundTrips,
)
from station.practice.battle.link.link_datagram import (
    FRAGMENT_BYTES,
    HEAD_BYTES,
    MOST_BYTES,
    Carry,
    Drop,
    SessionKey,
    kind_of,
    opened,
    packed,
)

HOST = SessionKey(b"session!", b"k" * 32, True)
JOINER = SessionKey(b"session!", b"k" * 32, False)
STEP_NS = 10 * NS_PER_MS


def pair() -> tuple[LinkChannel, LinkChannel]:
    return LinkChannel(HOST, 0), LinkChannel(JOINER, 0)


def exchange(ends: tuple[LinkChannel, LinkChannel], now_ns: int) -> None:
    """All that is due arrives at once."""
    for sender, receiver in (ends, ends[::-1]):
        for data in sender.due(now_ns):
            receiver.handle(data, now_ns)


FATES = st.sampled_from(["arrives", "arrives", "lost", "twice", "late"])


@given(
    messages=st.lists(st.binary(max_size=3 * FRAGMENT_BYTES), max_size=8),
    fates=st.lists(FATES, max_size=60),
)
def test_what_was_sent_arrives_once_whole_and_in_order(messages: list[bytes], fates: list[str]) -> None:
    ends = pair()
    host, joiner = ends
    fate = iter(fates)
    late: list[tuple[LinkChannel, bytes]] = []
    came: list[bytes] = []
    for message in messages:
        host.send(message)
    for step in range(1200):
        now_ns = step * STEP_NS
        held, late = late, []
        for sender, receiver in (ends, ends[::-1]):
            for data in sender.due(now_ns):
                what = next(fate, "arrives")
                for _ in range({"arrives": 1, "twice": 2}.get(what, 0)):
                    receiver.handle(data, now_ns)
                if what == "late":
                    late.append((receiver, data))
        for receiver, data in reversed(held):
            receiver.handle(data, now_ns)
        came += joiner.messages()
        if host.is_delivered and not late:
            break
    assert came == messages
    assert host.is_delivered


def test_both_ways_at_once() -> None:
    host, joiner = ends = pair()
    host.send(b"to the joiner")
    joiner.send(b"to the host")
    exchange(ends, 0)
    exchange(ends, 1)
    assert (host.messages(), joiner.messages()) == ([b"to the host"], [b"to the joiner"])
    assert host.is_delivered
    assert joiner.is_delivered


def test_the_longest_message_crosses_in_datagrams_that_no_network_breaks() -> None:
    host, joiner = ends = pair()
    message = bytes(range(256)) * (MOST_MESSAGE_BYTES // 256)
    host.send(message)
    sizes = list[int]()
    for now_ns in range(0, 10 * STEP_NS, STEP_NS):
        sent = host.due(now_ns)
        sizes += map(len, sent)
        for data in sent:
            joiner.handle(data, now_ns)
        exchange(ends, now_ns)
    assert joiner.messages() == [message]
    assert max(sizes) == MOST_BYTES
    assert len(sizes) == -(-MOST_MESSAGE_BYTES // FRAGMENT_BYTES)  # none was sent twice


def test_a_cut_line_is_silent_and_goes_on_where_it_was() -> None:
    host, joiner = ends = pair()
    exchange(ends, 0)
    host.send(b"said into the void")
    for now_ns in range(0, 10 * NS_PER_S, STEP_NS):
        host.due(now_ns)
        joiner.due(now_ns)
    assert not joiner.is_cut(CUT_NS)
    assert joiner.is_cut(CUT_NS + 1)
    assert host.is_cut(10 * NS_PER_S)
    now_ns = 10 * NS_PER_S
    for _ in range(HEARTBEAT_NS // STEP_NS + 2):  # a heart beats, then all is sent again at once
        exchange(ends, now_ns)
        now_ns += STEP_NS
    assert not host.is_cut(now_ns)
    assert joiner.messages() == [b"said into the void"]


def test_an_end_with_nothing_to_say_beats_its_heart_twice_a_second() -> None:
    host, _ = pair()
    host.due(0)
    beats = [now for now in range(0, 5 * NS_PER_S, STEP_NS) if host.due(now)]
    assert beats == [n * HEARTBEAT_NS for n in range(1, 10)]


# --- the hostile -----------------------------------------------------------------------------------------------------


def test_each_fault_has_its_name() -> None:
    host, joiner = pair()
    joiner.send(b"true")
    (data,) = joiner.due(0)
    forged = SessionKey(HOST.session, b"x" * 32, False)
    elsewhere = SessionKey(b"another!", HOST.secret, False)
    assert host.handle(data[:-1] + bytes([data[-1] ^ 1]), 0) is Drop.MAC
    assert host.handle(data[:HEAD_BYTES], 0) is Drop.LENGTH
    assert host.handle(data + bytes(MOST_BYTES), 0) is Drop.LENGTH
    assert host.handle(packed(Carry(0, 0, 0), forged), 0) is Drop.MAC
    assert host.handle(packed(Carry(0, 0, 0), elsewhere), 0) is Drop.SESSION
    assert host.handle(packed(Carry(0, 0, 0), HOST), 0) is Drop.REPLAY  # its own, sent back
    assert host.handle(packed(Carry(9, 1, 0), JOINER), 0) is Drop.RANGE  # acknowledges what was never sent
    assert host.handle(packed(Carry(10, 0, 0, WINDOW + 1, True, b""), JOINER), 0) is Drop.RANGE
    assert host.messages() == []
    assert isinstance(host.handle(data, 0), Carry)
    assert host.handle(data, 0) is Drop.REPLAY
    assert host.messages() == [b"true"]


@pytest.mark.parametrize(
    ("data", "fault"),
    [
        (b"", Drop.FOREIGN),
        (b"DSB\1", Drop.FOREIGN),
        (b"GET / HTTP/1.1\r\n", Drop.FOREIGN),
        (b"DSB\2\7" + bytes(80), Drop.VERSION),
        (b"DSB\1\0", Drop.KIND),
        (b"DSB\1\377", Drop.KIND),
        (b"DSB\1\7" + bytes(MOST_BYTES), Drop.LENGTH),
    ],
)
def test_a_head_that_is_not_ours(data: bytes, fault: Drop) -> None:
    assert kind_of(data) is fault


def test_flags_that_mean_nothing_are_malformed() -> None:
    assert isinstance(opened(packed(Carry(0, 0, 0, 0, True, b"x"), JOINER), HOST), Carry)
    assert opened(packed(Carry(0, 0, 0, 0, True, None), JOINER), HOST) is Drop.MALFORMED


@given(st.binary(max_size=200), st.integers(0, 1 << 20))
def test_no_bytes_confuse_an_end(noise: bytes, at: int) -> None:
    host, joiner = pair()
    joiner.send(b"true")
    (data,) = joiner.due(0)
    place = at % len(data)
    bent = data[:place] + noise + data[place + len(noise) :]
    found = host.handle(bent, 0)
    assert isinstance(found, Drop) or bent == data
    host.handle(data, 0)
    assert host.messages() == [b"true"]


def test_a_flood_of_messages_that_nobody_takes_stays_bounded() -> None:
    host, joiner = ends = pair()
    for now_ns in range(0, 600 * STEP_NS, STEP_NS):
        while joiner._waiting_bytes < MOST_HELD_BYTES // 2:
            joiner.send(bytes(FRAGMENT_BYTES))
        exchange(ends, now_ns)
    held = host.messages()
    assert MOST_HELD_BYTES / 2 < sum(map(len, held)) < MOST_HELD_BYTES + 2 * MOST_MESSAGE_BYTES
    for now_ns in range(600 * STEP_NS, 1200 * STEP_NS, STEP_NS):  # what is taken makes room
        exchange(ends, now_ns)
    assert host.messages()


def test_a_message_without_end_is_the_others_fault() -> None:
    host, _ = pair()
    for number in count():
        host.handle(packed(Carry(number, 0, 0, number, False, bytes(FRAGMENT_BYTES)), JOINER), 0)
        if host.fault is not None:
            break
    assert number == MOST_MESSAGE_BYTES // FRAGMENT_BYTES  # the first that makes it longer than it may be
    assert host.handle(packed(Carry(number + 1, 0, 0, number + 1, True, b""), JOINER), 0) is Drop.FLOOD


def test_an_end_that_takes_nothing_is_told_so_before_memory_ends() -> None:
    host, _ = pair()
    for _ in range(MOST_HELD_BYTES // MOST_MESSAGE_BYTES):
        host.send(bytes(MOST_MESSAGE_BYTES))
    with pytest.raises(DeviceError, match="takes nothing"):
        host.send(b"x")


@given(st.lists(st.integers(0, 3 * REPLAY_WINDOW), max_size=40))
def test_the_guard_lets_each_number_in_once(numbers: list[int]) -> None:
    guard, seen = ReplayGuard(), set[int]()
    for number in numbers:
        new = number not in seen and number > max(seen, default=-1) - REPLAY_WINDOW
        assert guard.is_new(number) is new
        seen.add(number)
        assert guard.is_newest(number) is (number == max(seen))


def test_waiting_times_are_those_of_rfc_6298() -> None:
    trips = RoundTrips()
    assert trips.resend_after_ns(1) == NS_PER_S  # 2.1
    trips.measured(400 * NS_PER_MS)
    assert trips.resend_after_ns(1) == 400 * NS_PER_MS + 4 * 200 * NS_PER_MS  # 2.2
    trips.measured(400 * NS_PER_MS)
    assert trips.resend_after_ns(1) == 400 * NS_PER_MS + 4 * 150 * NS_PER_MS  # 2.3
    assert trips.resend_after_ns(2) == 2 * NS_PER_S  # 5.5, up to our own bound
