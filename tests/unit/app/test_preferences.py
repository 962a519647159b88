"""How sessions go, as the practice panel sets it; what pauses is learnt from strokes and switches by hand."""

from pathlib import Path

from station.app.settings.preferences import PracticePreferences, Preferences, pause_in_words
from station.app.settings.settings_store import SettingsStore
from station.core.events import Hit, Switched
from station.core.pieces import Piece, Zone
from station.core.settings import Settings
from station.core.units import NS_PER_MS
from station.engine.messages import EngineEvent
from station.practice.control.pause_options import parse_pause


def stroke(piece: Piece, at_ms: int) -> Hit:
    return Hit(at_ms * NS_PER_MS, piece, Zone.HEAD, 90)


def desk_without_pauses() -> Preferences:
    return Preferences(SettingsStore(Path("none.toml"), {"pause": ""}))


def learnt(*events: EngineEvent) -> tuple[str, ...]:
    preferences = desk_without_pauses()
    preferences.learn(True)
    for event in events:
        preferences.handle(event)
    return preferences.now.pauses


def test_habits_are_settings_and_leave_the_others_alone() -> None:
    settings = Settings(student="Ann", kicks_start=False, pause="cc=64 crash_1+ride")
    habits = PracticePreferences.of(settings)
    assert habits.within(settings) == settings
    changed = habits.pausing_by("program=5").without("cc=64").within(settings)
    assert (changed.student, changed.kicks_start, changed.pause) == ("Ann", False, "crash_1+ride program=5")


def test_what_pauses_already_is_not_kept_twice() -> None:
    assert PracticePreferences(pauses=("cc=64", "program=5")).pausing_by("cc=64").pauses == ("program=5", "cc=64")


def test_two_pads_at_once_or_a_switch_are_learnt() -> None:
    assert learnt(stroke(Piece.RIDE, 1000), stroke(Piece.CRASH_1, 1020)) == ("ride+crash_1",)
    assert learnt(Switched(0, "cc=66")) == ("cc=66",)
    assert learnt(stroke(Piece.RIDE, 1000), stroke(Piece.CRASH_1, 1080)) == (), "one after the other"
    assert learnt(stroke(Piece.RIDE, 1000), stroke(Piece.RIDE, 1020)) == (), "a double trigger"


def test_what_is_learnt_is_what_the_setting_reads() -> None:
    [word] = learnt(stroke(Piece.FLOOR_TOM_1, 0), stroke(Piece.CRASH_2, 1))
    assert parse_pause(word).pairs == (frozenset({Piece.FLOOR_TOM_1, Piece.CRASH_2}),)


def test_while_it_learns_the_kit_commands_nothing_and_afterwards_it_does() -> None:
    preferences = desk_without_pauses()
    assert not preferences.handle(Switched(0, "cc=64"))
    preferences.learn(True)
    assert preferences.handle(Switched(0, "cc=64"))
    assert not preferences.learns
    assert preferences.now.pauses == ("cc=64",)
    assert not preferences.handle(Switched(0, "cc=64"))


def test_words() -> None:
    assert pause_in_words("crash_1+ride") == "crash and ride at once"
    assert pause_in_words("cc=64") == "foot switch, controller 64"
    assert pause_in_words("key=5") == "foot switch, key 5"
    assert pause_in_words("button=10") == "game kit, button 10"
    assert pause_in_words("program=5") == "foot switch, program 5"
