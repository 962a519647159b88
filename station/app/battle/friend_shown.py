"""What the window shows of a friend on the network: who hosts, who is waited for, what went wrong; all in words."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class HostShown:
    """A station that hosts: the `address` that is joined, who it is, what it would play and how far it is."""

    address: str
    title: str
    words: str
    is_busy: bool = False


@dataclass(frozen=True, slots=True)
class FriendShown:
    """`hosts` that were found; `waits` says what is waited for, a line each, none where nothing is.

    `told` is what came of it last, such as why nobody was let in; empty where there is nothing to say.
    """

    hosts: tuple[HostShown, ...] = ()
    waits: tuple[str, ...] = ()
    told: str = ""
