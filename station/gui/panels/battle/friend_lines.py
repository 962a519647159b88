"""The lines of the battle's page for a friend at another station: the port here, or who hosts and where."""

from dataclasses import replace

from imgui_bundle import imgui

from station.app.battle.friend_shown import FriendShown, HostShown
from station.app.settings.chosen_battle import ChosenBattle
from station.gui import theme

PORT_LABEL, ADDRESS_LABEL = "##battle-port", "##battle-address"
_MOST_LETTERS = 60
"""Of an address or a port that is typed (our choice: every address is shorter)."""


def way_to_friend(setup: ChosenBattle, friend: FriendShown) -> ChosenBattle:
    """Draw the lines; returns what is chosen then."""
    return _joined(setup, friend) if setup.joins else _hosted(setup)


def _hosted(setup: ChosenBattle) -> ChosenBattle:
    theme.soft("UDP port to wait at; your friend needs it only where it is another one")
    imgui.set_next_item_width(-1)
    _, port = imgui.input_text(PORT_LABEL, setup.port)
    theme.tooltip("This computer's firewall must let it in")
    return replace(setup, port=port[:_MOST_LETTERS])


def _joined(setup: ChosenBattle, friend: FriendShown) -> ChosenBattle:
    theme.soft("Who hosts on this network" if friend.hosts else "Nobody is found to host on this network yet …")
    for host in friend.hosts:
        setup = _host(host, setup)
    imgui.set_next_item_width(-1)
    _, address = imgui.input_text_with_hint(ADDRESS_LABEL, "or their address, such as 192.168.1.20", setup.address)
    theme.tooltip("Your friend's station says it while it waits")
    return replace(setup, address=address[:_MOST_LETTERS])


def _host(host: HostShown, setup: ChosenBattle) -> ChosenBattle:
    words = f"{host.title}: {host.words}{', somebody is there already' if host.is_busy else ''}"
    if theme.radio_button(f"{words}###{host.address}", host.address == setup.address) and not host.is_busy:
        setup = replace(setup, address=host.address)
    theme.tooltip(f"Join at {host.address}")
    return setup
