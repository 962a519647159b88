"""The help names every key that the window obeys, and none that it does not: compared with the code that asks imgui."""

import inspect
import re

import pytest

from station.gui import keyboard_kit, player_keys, view_keys, window
from station.gui.keyboard_kit import COMMANDS, KEYS, SLOT_KEYS, VIEW_KEYS
from station.gui.panels.editor.editor_keys import EDITOR_HELP, EDITOR_KEYS

NAMES = {
    "esc": "escape",
    "comma": "comma",
    ",": "comma",
    ".": "period",
    "[": "left_bracket",
    "]": "right_bracket",
    "-": "minus",
    "=": "equal",
    ";": "semicolon",
}
"""What is written on a key, as imgui calls it, where that is another word."""
IMGUI_S_OWN = {"tab", "arrows"}
"""imgui goes from control to control by itself."""


def named(cap: str) -> set[str]:
    """The keys of a line of the help: "F2 to F9", "Ctrl+= and Ctrl+-", ", and .", "I, O, U"."""
    run = re.fullmatch(r"(?:(?:Ctrl|Shift)\+)*(F?)(\d) to F?(\d)", cap)
    if run:
        return {f"{run[1].lower() or '_'}{digit}" for digit in range(int(run[2]), int(run[3]) + 1)}
    parts = cap.split(" and ") if " and " in cap else cap.split(", ")
    keys = {re.sub(r"^((Ctrl|Shift)\+)+", "", part).lower() for part in parts}
    return {NAMES.get(key, key) for key in keys}


def asked() -> set[str]:
    """Every key that these modules name, those of tables included."""
    sources = [inspect.getsource(module) for module in (keyboard_kit, player_keys, view_keys, window)]
    words = {word for source in sources for word in re.findall(r"imgui\.Key\.(\w+)", source)}
    words |= {key.name for table in (VIEW_KEYS, KEYS) for key in table} | {key.name for key in SLOT_KEYS}
    return words


def test_every_key_of_the_window_is_in_the_help_and_no_other() -> None:
    told = set().union(*(named(cap) for cap, _ in COMMANDS)) | {key.name for key in KEYS}
    assert told - IMGUI_S_OWN == asked()


def test_keys_of_the_kit_bear_their_own_names() -> None:
    for key, stroke in KEYS.items():
        assert NAMES.get(stroke.cap, stroke.cap.lower()) == key.name


def test_the_editor_s_keys_are_those_of_its_table() -> None:
    told = {part for cap, _ in EDITOR_HELP for part in cap.split(", ")}
    letters_and_views = {"x o g f …", "-", "F2 to F9"}
    assert told - letters_and_views == {part for _, _, words in EDITOR_KEYS for part in words.split(", ")}


@pytest.mark.parametrize("table", [COMMANDS, EDITOR_HELP])
def test_no_key_is_told_twice(table: tuple[tuple[str, str], ...]) -> None:
    caps = [cap for cap, _ in table]
    assert len(caps) == len(set(caps))
