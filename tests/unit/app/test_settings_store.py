"""The settings of a run: whose they are, which of them reach the file, and what a faulty file costs."""

from dataclasses import replace
from pathlib import Path

import pytest

from station.app.settings.settings_store import SettingsStore
from station.core.errors import BadInput, DeviceError
from station.core.settings import Settings, load_settings, save_settings


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return save_settings(Settings(student="Bob"), tmp_path / "settings.toml")


def put(store: SettingsStore, **changed: object) -> None:
    """A change by the user, written at once."""
    store.update(lambda settings: replace(settings, **changed))  # type: ignore[arg-type] # what a test chooses
    store.write()


def test_what_a_call_says_holds_and_is_never_written(path: Path) -> None:
    store = SettingsStore(path, {"student": "Ann", "guide": True})
    assert (store.now.student, store.now.guide) == ("Ann", True)
    put(store, theme="day")
    assert (store.now.student, store.now.guide, store.now.theme) == ("Ann", True, "day")
    assert load_settings(path) == Settings(student="Bob", theme="day")


def test_what_the_user_changes_himself_is_written_though_a_call_had_said_it(path: Path) -> None:
    save_settings(Settings(student="Bob", guide=True), path)
    store = SettingsStore(path, {"guide": True, "student": "Ann"})
    put(store, guide=False)
    assert load_settings(path) == Settings(student="Bob", guide=False)


def test_what_is_changed_back_is_written_back(path: Path) -> None:
    store = SettingsStore(path)
    put(store, theme="day")
    put(store, theme="night")
    assert load_settings(path) == Settings(student="Bob")


def test_what_another_process_has_written_meanwhile_stays(path: Path) -> None:
    store = SettingsStore(path)
    save_settings(Settings(student="Bob", drums="brushes"), path)
    put(store, theme="day")
    assert load_settings(path) == Settings(student="Bob", drums="brushes", theme="day")


def test_a_change_to_what_is_already_so_writes_nothing(path: Path) -> None:
    store = SettingsStore(path)
    before = path.stat().st_mtime_ns
    put(store, student="Bob")
    assert not store.is_due
    assert path.stat().st_mtime_ns == before


def test_a_faulty_file_is_told_and_left_alone_and_changes_hold_for_this_run(path: Path) -> None:
    path.write_text('kitt = "TD-17"\n')
    store = SettingsStore(path)
    assert "no such setting: kitt" in str(store.fault)
    assert store.now == Settings(welcomed=True), "the questions of the first start are not asked again"
    with pytest.raises(BadInput, match="kitt"):
        put(store, theme="day")
    assert store.now.theme == "day"
    assert not store.is_due, "it is said once"
    assert path.read_text() == 'kitt = "TD-17"\n'


def test_a_change_that_could_not_be_written_is_written_with_the_next(path: Path) -> None:
    store = SettingsStore(path)
    mended = path.read_text()
    path.write_text("broken")
    with pytest.raises(BadInput):
        put(store, theme="day")
    path.write_text(mended)
    put(store, guide=True)
    assert load_settings(path) == Settings(student="Bob", theme="day", guide=True)


def test_where_the_folder_is_a_file_the_defaults_hold(tmp_path: Path) -> None:
    (tmp_path / "config").write_text("a file")
    store = SettingsStore(tmp_path / "config" / "drum-station" / "settings.toml")
    assert store.now == Settings(welcomed=True), "the questions of the first start are not asked again"
    assert store.fault is not None
    with pytest.raises((BadInput, DeviceError)):
        put(store, theme="day")
    assert store.now.theme == "day"


def test_what_is_said_out_of_range_is_refused(path: Path) -> None:
    with pytest.raises(BadInput, match="practice: rate_hz"):
        SettingsStore(path, {"rate_hz": 1}, "practice")
