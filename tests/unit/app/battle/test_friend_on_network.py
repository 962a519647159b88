"""Two stations behind their windows on one network: met over real sockets of loopback, played on a clock by hand."""

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from station.app.actions.battle_actions import BeginBattle, CallOff, ChooseBattle, CloseBattle
from station.app.actions.practice_actions import EndSession, Pause
from station.app.battle.battle_choice import battle_choice
from station.app.battle.battle_shown import BattleShown, BattleStage
from station.app.battle.friend_meeting import FriendMeeting
from station.app.battle.friend_shown import FriendShown, HostShown
from station.app.settings.chosen_battle import ChosenBattle, People
from station.practice.battle.battle_rules import BattleMode
from station.practice.battle.battle_view import Doing
from station.practice.battle.link.link_socket import LinkSocket
from tests.fakes.friend_station import LOOPBACK, End, Room


@pytest.fixture
def room(tmp_path: Path) -> Iterator[Room]:
    room = Room(End(tmp_path / "ann", "Ann"), End(tmp_path / "ben", "Ben"))
    room.run(0.1)
    yield room
    for end in (room.ann, room.ben):
        end.station.close()


def kept(end: End) -> dict[str, dict[str, object]]:
    (document,) = end.folder.rglob("battle.json")
    read: dict[str, dict[str, object]] = json.loads(document.read_text())
    return read


@pytest.mark.parametrize("mode", BattleMode, ids=lambda mode: mode.value)
def test_a_host_and_a_guest_play_a_whole_battle(room: Room, mode: BattleMode) -> None:
    room.meet(mode=mode)
    assert not room.ann.shown.covers_picture, "the stage is seen"
    room.run_until(BattleStage.OVER)
    ours, theirs = kept(room.ann)["network"], kept(room.ben)["network"]
    assert (ours["ended"], ours["agree"], ours["hosts"]) == ("complete", True, True)
    assert (theirs["digest"], theirs["hosts"]) == (ours["digest"], False)
    assert len(list(room.ann.folder.rglob("battle.txt"))) == 1
    for end, friend in ((room.ann, "Ben"), (room.ben, "Ann")):
        result = end.shown.result
        assert result is not None
        assert result.names == ("Ann", "Ben")
        assert result.told.startswith(f"With {friend} over the network: it was played to its end; both stations")
        assert not result.films
        assert result.judged_as is None
        assert f"Waiting for {friend}." in end.said
    assert [row.title for row in room.ann.shown.result.rows][1:] == ["1", "Final, ×2"]  # type: ignore[union-attr] # it is there
    assert {verdict.side for verdict in room.ben.shown.result.rows[1].verdicts} == {"Ann", "Ben"}  # type: ignore[union-attr] # so is it


def test_the_host_is_found_and_gone_when_called_off(room: Room) -> None:
    room.ann.begin()
    host, port = room.address().split(":")
    looking = FriendMeeting(((host, int(port)),))
    looking.look(on=True)
    for _ in range(20):
        room.run(0.1)
        looking.advance(room.now_ns)
    (found,) = looking.view().hosts
    assert (found.address, found.is_busy) == (room.address(), False)
    assert found.words.startswith("Ann: improvise, 240 bpm")
    room.ann.station.dispatch(CallOff())
    assert room.ann.shown.friend.waits == ()
    assert room.ann.shown.setup.people is People.NETWORK, "nothing that was chosen is lost"
    for _ in range(60):
        room.run(0.1)
        looking.advance(room.now_ns)
    assert looking.view().hosts == (), "the list forgets who is gone"
    looking.close()


def test_pads_choose_among_the_hosts_that_are_free() -> None:
    setup = ChosenBattle(people=People.NETWORK, joins=True)
    hosts = (HostShown("1.2.3.4:5", "The shed", "Ann"), HostShown("1.2.3.4:6", "The attic", "Cy", is_busy=True))
    shown = BattleShown(BattleStage.CHOOSING, setup, friend=FriendShown(hosts))
    choice = battle_choice(shown, 0, (), kit_starts=True)
    assert choice is not None
    assert [option.label for option in choice.options[:2]] == ["Join", "The shed"]
    assert choice.options[1].action == ChooseBattle(replace(setup, address="1.2.3.4:5"))


def test_nobody_at_the_address_is_told_on_the_page(room: Room) -> None:
    with LinkSocket(LOOPBACK) as gone:
        nobody = f"{LOOPBACK}:{gone.address[1]}"
    room.ben.begin(joins=True, address=nobody)
    assert room.ben.shown.friend.waits[0] == f"Asking {nobody} to let you in …"
    room.run(9, room.ben)
    assert f"nobody hosts a battle at {nobody}" in room.ben.shown.friend.told
    assert not room.ben.shown.friend.waits
    assert room.ben.shown.setup.address == nobody


def test_a_third_who_comes_is_refused_and_told_so(room: Room, tmp_path: Path) -> None:
    room.ann.begin()
    address = room.address()
    room.ben.begin(joins=True, address=address)
    room.run_until(BattleStage.PLAYING)
    cy = End(tmp_path / "cy", "Cy")
    cy.begin(joins=True, address=address)
    room.run(1, room.ann, room.ben, cy)
    assert "another player is there already" in cy.shown.friend.told
    assert room.ann.shown.stage is BattleStage.PLAYING
    cy.station.close()


def test_a_port_that_is_taken_is_told_on_the_page(room: Room) -> None:
    with LinkSocket() as taken:
        room.ann.begin(port=f"{taken.address[1]}")
        assert f"port {taken.address[1]} of UDP cannot be opened" in room.ann.shown.friend.told
    room.ann.station.dispatch(BeginBattle())
    assert room.ann.shown.friend.waits, "it is free again"
    assert room.ann.shown.friend.told == ""


@pytest.mark.parametrize(
    ("chosen", "fault"),
    [
        ({"joins": True}, "choose a host"),
        ({"port": "70000"}, "a port is a number up to 65535"),
        ({"port": ""}, "a port is a number up to 65535"),
    ],
)
def test_what_cannot_be_is_said_before_anything_is_opened(room: Room, chosen: dict[str, object], fault: str) -> None:
    room.ann.begin(**chosen)
    assert fault in room.ann.shown.fault
    assert room.ann.shown.friend.waits == ()


def test_a_name_is_no_address_here(room: Room) -> None:
    room.ben.begin(joins=True, address="station.local")
    assert "no such address" in room.ben.shown.friend.told, "to look a name up would stop the picture"


def test_stop_ends_it_for_both_and_the_host_may_host_again(room: Room) -> None:
    room.meet()
    room.run(3)
    room.ben.station.dispatch(EndSession())
    room.run_until(BattleStage.OVER)
    assert kept(room.ben)["network"]["ended"] == "stopped"
    assert kept(room.ann)["network"]["ended"] == "left"
    assert "the other player left" in room.ann.shown.result.told  # type: ignore[union-attr] # it is there
    room.ann.station.dispatch(BeginBattle())
    assert room.ann.shown.friend.waits


def test_a_cut_line_is_said_and_it_goes_on_by_itself(room: Room) -> None:
    room.meet(rounds=8)
    room.run(3)
    room.run(6, room.ann)
    assert room.ann.shown.board.headline == "The line to Ben is cut: waiting for Ben."
    assert room.ann.session.view().doing is Doing.PAUSED
    room.run(12)
    assert room.ann.session.view().doing is not Doing.PAUSED
    assert room.ann.shown.stage is room.ben.shown.stage is BattleStage.PLAYING


def test_a_pause_is_asked_of_both(room: Room) -> None:
    room.meet(rounds=8)
    room.run(2)
    room.ann.station.dispatch(Pause())
    room.run(6)
    assert room.ann.station.view().room.paused
    assert room.ben.shown.board.headline == "A pause, asked for by Ann."
    room.ann.station.dispatch(Pause())
    room.run(6)
    assert not room.ann.station.view().room.paused
    assert room.ben.session.view().doing is not Doing.PAUSED


def test_escape_calls_off_first_and_no_choice_of_a_host_that_waits_is_turned(room: Room) -> None:
    room.ann.begin()
    room.ann.station.dispatch(ChooseBattle(ChosenBattle()))
    assert room.ann.shown.setup.is_linked
    assert room.ann.station.view().choice is None, "whoever tries their kit calls nothing off"
    room.ann.station.dispatch(CloseBattle())
    assert (room.ann.shown.stage, room.ann.shown.friend.waits) == (BattleStage.CHOOSING, ())
    room.ann.station.dispatch(CloseBattle())
    assert room.ann.shown.stage is BattleStage.CLOSED


def test_an_engine_that_dies_ends_it_for_the_friend_too(room: Room) -> None:
    room.meet()
    room.run(2)
    room.ann.line.dead = True
    room.run_until(BattleStage.OVER)
    assert kept(room.ben)["network"]["ended"] == "left"
