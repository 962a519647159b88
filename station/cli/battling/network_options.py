"""The options of `station battle` for two stations on one network."""

from dataclasses import dataclass

from station.cli.options.option_fields import flag, option, unread, whole_number
from station.practice.battle.link.link_discovery import DEFAULT_PORT
from station.practice.battle.link.link_socket import MOST_PORT

LIST = "list"


def _port(text: str) -> int:
    port = whole_number(text)
    if not 0 <= port <= MOST_PORT:
        raise unread(f"a UDP port up to {MOST_PORT}, or 0 for any that is free", text)
    return port


@dataclass(frozen=True, slots=True, kw_only=True)
class NetworkOptions:
    """Whether this station hosts a battle or joins one, and by which way."""

    host: bool = flag("host a battle, for somebody at another station of this network", rivals="ends")
    join: str | None = option(
        f"ADDRESS|{LIST}", "join the battle that is hosted there; `list` shows who hosts", str, None, rivals="ends"
    )
    name: str | None = option("NAME", "what this station is called (the computer's name)", str, None)
    port: int = option("N", f"the host's UDP port ({DEFAULT_PORT})", _port, DEFAULT_PORT)
    bind: str = option("ADDRESS", "host on this address of the computer alone, such as 127.0.0.1 (all)", str, "")
    guest_begins: bool = flag("the one who joins begins, when phrases are traded")

    @property
    def is_wanted(self) -> bool:
        """Whether two stations play."""
        return self.host or self.join is not None
