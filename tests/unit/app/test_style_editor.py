"""What the figure panel sets: when it is kept, and under which name. Shipped styles are read from their own files."""

from dataclasses import replace
from pathlib import Path

import pytest

from station.app.actions.style_actions import EditStyle, KeepSlot, LoadStyle, SaveStyle
from station.app.settings.settings_store import SettingsStore
from station.app.style_editor import StyleEditor
from station.core.errors import BadInput
from station.core.settings import Settings, load_settings, save_settings
from station.drills.library import find_lesson
from station.motion.kinematics.figure import load_figure
from station.motion.style.style_file import load_style
from station.scenes.demonstrator import demonstrator_of

SCORE = find_lesson("rock-1").score


def editor(folder: Path) -> tuple[StyleEditor, SettingsStore]:
    store = SettingsStore(save_settings(Settings(sessions=str(folder)), folder / "settings.toml"))
    told: list[str] = []
    made = StyleEditor(store, told.append)
    assert told == []
    return made, store


def test_a_control_that_is_held_moves_the_demonstrator_and_is_kept_when_it_is_let_go(tmp_path: Path) -> None:
    made, store = editor(tmp_path)
    options = made.view().options.put("amplitude_gain", 90.0)
    made.act(EditStyle(options, held=True), SCORE)
    made.keep()
    assert (made.demonstrator.style.amplitude_gain, store.now.style) == (90.0, "natural")
    made.act(EditStyle(options), SCORE)
    made.keep()
    assert load_style(store.now.style).amplitude_gain == 90.0


def test_a_style_of_the_list_is_kept_by_its_name_and_one_from_a_slot_as_the_latest(tmp_path: Path) -> None:
    made, store = editor(tmp_path)
    made.act(KeepSlot(0, "mine"), SCORE)
    made.act(LoadStyle("jazz"), SCORE)
    made.keep()
    assert store.now.style == "jazz"
    made.act(EditStyle(made.view().options.recall(0)), SCORE)
    made.keep()
    assert Path(store.now.style).name == "latest.toml"


def test_a_saved_style_is_no_change_any_more(tmp_path: Path) -> None:
    made, store = editor(tmp_path)
    made.act(EditStyle(made.view().options.put("amplitude_neck", 12.0)), SCORE)
    made.act(SaveStyle("My own"), SCORE)
    made.keep()
    store.write()
    assert not made.view().options.is_changed
    assert load_style(load_settings(tmp_path / "settings.toml").style).amplitude_neck == 12.0


def test_a_style_brings_its_drummer_unless_one_is_chosen(tmp_path: Path) -> None:
    made, store = editor(tmp_path)
    mine = tmp_path / "mine.toml"
    mine.write_text('drummer = "curls"\namplitude_gain = 60.0\n')
    assert made.demonstrator.figure == load_figure("headphones")
    made.act(LoadStyle(str(mine)), SCORE)
    assert made.demonstrator.figure == load_figure("curls")
    body = made.demonstrator.figure
    made.act(EditStyle(made.view().options.put("amplitude_gain", 90.0)), SCORE)
    assert made.demonstrator.figure is body, "a slider makes no new drummer"
    made.embody("beard")
    assert made.demonstrator.figure == load_figure("beard")
    made.act(LoadStyle("natural"), SCORE)
    made.act(LoadStyle(str(mine)), SCORE)
    assert made.demonstrator.figure == load_figure("beard")
    made.embody("")
    assert made.demonstrator.figure == load_figure("curls")
    assert demonstrator_of(replace(store.now, style=str(mine)), print).figure == load_figure("curls")


def test_a_style_that_names_nobody_there_is_refused(tmp_path: Path) -> None:
    made, _ = editor(tmp_path)
    mine = tmp_path / "mine.toml"
    mine.write_text('drummer = "curl"\n')
    with pytest.raises(BadInput, match="curls"):
        made.act(LoadStyle(str(mine)), SCORE)
