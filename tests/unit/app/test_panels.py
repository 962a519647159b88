"""What the window says without being asked."""

import pytest

from station.app.model import RoomState
from station.app.panels.transport import found


@pytest.mark.parametrize(
    ("kit", "sound", "said"),
    [
        ("TD-17", "Speakers", "TD-17 · Speakers"),
        ("", "silent", "no kit: the computer's keys play (F1) · silent"),
        ("", "", "no kit: the computer's keys play (F1)"),
    ],
)
def test_without_a_kit_the_window_says_what_plays_instead(kit: str, sound: str, said: str) -> None:
    assert found(RoomState(kit=kit, sound=sound)) == said
