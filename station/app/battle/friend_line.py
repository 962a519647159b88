"""The page's side of a friend on the network: who is asked for what is chosen, when it begins, and when it is left."""

from collections.abc import Callable

from station.app.battle.friend_meeting import FriendMeeting
from station.app.battle.friend_shown import FriendShown
from station.app.settings.chosen_battle import ChosenBattle, port_of
from station.core.errors import BadInput, StationError
from station.practice.battle.battle_rules import BattleRules
from station.practice.battle.link.linked_rules import Agreed
from station.practice.battle.link.linked_station import LinkedStation, introduction

Begin = Callable[[LinkedStation, Agreed], None]
"""Begins the battle that was agreed on; raises `StationError`."""


class FriendLine:
    """A friend is met by `meeting`, then `begin` begins."""

    def __init__(self, begin: Begin, meeting: FriendMeeting) -> None:
        self._begin, self._meeting = begin, meeting
        self._station: LinkedStation | None = None  # on which the battle is played

    @property
    def waits(self) -> bool:
        """Whether somebody is waited for."""
        return self._meeting.waits

    @property
    def is_lively(self) -> bool:
        """Whether datagrams may come at any moment, also while nobody plays."""
        return self._meeting.is_lively

    def view(self) -> FriendShown:
        """What is shown of it."""
        return self._meeting.view()

    def ask(self, setup: ChosenBattle, rules: BattleRules) -> None:
        """Host by these rules, or join; raises `BadInput` where what was typed cannot be."""
        hello = introduction(rules.players[0].name, rules)
        if setup.is_guest:
            self._meeting.join(hello, rules, address_in(setup))
            return
        self._meeting.host(hello, rules, port_of(setup), not setup.guest_begins)

    def call_off(self) -> None:
        """Wait for nobody any more."""
        self._meeting.call_off()

    def advance(self, now_ns: int, looks: bool, plays: bool) -> None:
        """Move on: look for hosts while somebody `looks`, begin once a friend is there.

        A battle that is not played any more (`plays`) is left. Raises `StationError` where it cannot begin.
        """
        if self._station is not None and not plays:
            self._meeting.leave(self._station)
            self._station = None
        self._meeting.look(looks and not self.waits)
        met = self._meeting.advance(now_ns)
        if met is None:
            return
        self._station, agreed = met
        try:
            self._begin(self._station, agreed)
        except StationError:
            self._meeting.decline(self._station)
            self._station = None
            raise

    def close(self) -> None:
        """The window closes: whoever plays or waits there hears of it."""
        if self._station is not None:
            self._meeting.leave(self._station)
            self._station = None
        self._meeting.close()


def address_in(setup: ChosenBattle) -> str:
    """The address that was typed or pressed; raises `BadInput` where none was."""
    if not setup.address.strip():
        raise BadInput("address", "", "choose a host from the list, or type the address that their station says")
    return setup.address
