"""Two stations before their battle: they introduce themselves, the host offers its rules, the joiner takes them.

Pure, as the line is. A host waits until somebody comes; who comes and says nothing, or what cannot be, is shown out,
and the door is open again.
"""

from station.core.errors import BadInput, DeviceError
from station.core.units import NS_PER_S
from station.practice.battle.battle_rules import BattleRules
from station.practice.battle.link.link_handshake import Knock, Refusal
from station.practice.battle.link.link_line import WHO, LinkLine
from station.practice.battle.link.link_messages import Accept, Bye, Hello, Message, Offer
from station.practice.battle.link.linked_rules import Agreed, agreed, offer_of

PATIENCE_NS = 10 * NS_PER_S
"""For an introduction or an acceptance, once the line is open (our choice: no person is asked meanwhile)."""
_REFUSED = {
    Refusal.BUSY: "another player is there already",
    Refusal.VERSION: "it speaks another version of the station's protocol: install the same version on both",
}


class HostLobby:
    """The host's: `advance` until it gives what both agree on. `notices` say who came and went."""

    def __init__(self, line: LinkLine, hello: Hello, rules: BattleRules, host_begins: bool = True) -> None:
        self.notices: list[str] = []
        self._line, self._hello, self._rules = line, hello, rules
        self._offer = offer_of(rules, host_begins)
        self._guest: Hello | None = None
        self._since_ns: int | None = None

    def advance(self, now_ns: int) -> Agreed | None:
        """Move on; what was agreed, None while nobody has."""
        if not self._line.is_open:
            return None
        if self._since_ns is None:
            self._since_ns = now_ns
        try:
            while (message := self._line.message()) is not None:
                if (found := self._take(message)) is not None:
                    return found
            self._check(now_ns)
        except BadInput as fault:
            self._show_out(str(fault))
        return None

    def _check(self, now_ns: int) -> None:
        if self._line.fault is not None:
            self._show_out(self._line.fault)
        elif self._since_ns is not None and now_ns - self._since_ns > PATIENCE_NS:
            self._show_out("whoever came says nothing more")

    def _take(self, message: Message) -> Agreed | None:
        match message:
            case Hello() if self._guest is None:
                self._guest = message
                self.notices.append(f"{message.player} at {message.station} has come")
                self._line.send(self._hello)
                self._line.send(self._offer)
            case Accept() if self._guest is not None:
                return agreed(self._offer, self._hello, self._guest, is_host=True, own=self._rules)
            case Bye():
                self._show_out("whoever came has left")
            case _:
                raise BadInput(WHO, type(message).__name__.lower(), "it is not its turn")
        return None

    def _show_out(self, why: str) -> None:
        self.notices.append(why)
        self._line.hang_up()
        self._guest = self._since_ns = None


class GuestLobby:
    """The joiner's: `advance` until it gives what both agree on; it accepts what can be played.

    `notices` say whose battle it is.
    """

    def __init__(self, line: LinkLine, knock: Knock, hello: Hello, own: BattleRules) -> None:
        self.notices: list[str] = []
        self._line, self._knock, self._hello, self._own = line, knock, hello, own
        self._host: Hello | None = None
        self._since_ns: int | None = None

    def advance(self, now_ns: int) -> Agreed | None:
        """Move on; what was agreed, None while nothing is.

        Raises `DeviceError` where the host is not there or does not open, `BadInput` where it says what cannot be.
        """
        where = f"{self._knock.host[0]}:{self._knock.host[1]}"
        if self._knock.refusal is not None:
            raise DeviceError(f"{where} does not let you in: {_REFUSED[self._knock.refusal]}")
        if self._knock.is_hopeless(now_ns):
            raise DeviceError(f"nobody hosts a battle at {where}: is it the right address, and is the port open there?")
        if not self._line.is_open:
            return None
        if self._since_ns is None:
            self._since_ns = now_ns
            self._line.send(self._hello)
        while (message := self._line.message()) is not None:
            if (found := self._take(message)) is not None:
                return found
        if self._line.fault is not None:
            raise BadInput(where, "", self._line.fault)
        if now_ns - self._since_ns > PATIENCE_NS:
            raise DeviceError(f"{where} let you in and says nothing more")
        return None

    def _take(self, message: Message) -> Agreed | None:
        match message:
            case Hello() if self._host is None:
                self._host = message
                self.notices.append(f"{message.player} at {message.station} hosts")
            case Offer() if self._host is not None:
                found = agreed(message, self._host, self._hello, is_host=False, own=self._own)
                self._line.send(Accept())
                return found
            case Bye():
                raise DeviceError("the host has left")
            case _:
                raise BadInput(WHO, type(message).__name__.lower(), "it is not its turn")
        return None
