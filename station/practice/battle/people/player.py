"""A player: their name, and the device that they play on.

Two kits on one computer are told apart by their devices; players without one share the kit that is there and change
seats. A device is named by part of its name in any case of letters, as `--device` has it.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from station.core.errors import BadInput
from station.practice.history.session_files import VIRTUAL_STUDENT

MOST_PLAYERS = 4
"""On one computer (our choice: whoever waits longer than three turns goes for a drink)."""
MOST_LETTERS = 40
"""Of a name on the screen (our choice: it stands in one line)."""


@dataclass(frozen=True, slots=True)
class Player:
    """`device` is part of the name of what they play on; empty for whatever is played."""

    name: str
    device: str = ""

    def plays_on(self, device: str) -> bool:
        """Whether a stroke on `device` is theirs."""
        return self.device.lower() in device.lower()


def virtual_device(side: int) -> str:
    """What the kit of a virtual player on a `side` is called."""
    return f"{_VIRTUAL_PLAYER} {side}"


def is_virtual(device: str | None) -> bool:
    """Whether a virtual player's strokes come from `device`, here or at the other end of a network."""
    return device is not None and (device == VIRTUAL_STUDENT or device.startswith(f"{_VIRTUAL_PLAYER} "))


_VIRTUAL_PLAYER = "virtual player"


def check_players(players: Sequence[Player]) -> None:
    """Raises `BadInput` where players cannot be told apart, or are too many or none."""
    if not 1 <= len(players) <= MOST_PLAYERS:
        raise BadInput("players", f"{len(players)}", f"expected 1 to {MOST_PLAYERS}")
    names = [player.name.strip().casefold() for player in players]
    for player in players:
        if not player.name.strip() or len(player.name) > MOST_LETTERS:
            raise BadInput("players", player.name, f"a name has 1 to {MOST_LETTERS} letters")
        if not (player.name + player.device).isprintable():
            raise BadInput("players", player.name, "has a letter that nobody sees")
    if len(set(names)) < len(names):
        raise BadInput("players", ", ".join(player.name for player in players), "two players bear one name")
    devices = [player.device.lower() for player in players]
    if any(devices) and not all(devices):
        raise BadInput("players", ", ".join(filter(None, devices)), "name a device for every player, or for none")
    for index, device in enumerate(devices):
        if device and any(device in other for other in devices[:index] + devices[index + 1 :]):
            raise BadInput("players", device, "this names the device of two players")


def is_hot_seat(players: Sequence[Player]) -> bool:
    """Whether several players share one kit."""
    return len(players) > 1 and not players[0].device
