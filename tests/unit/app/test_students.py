"""Students take turns: each with their own course, hand, progress and levels; nothing of the one before is left."""

from dataclasses import replace
from pathlib import Path

import pytest

from station.app.actions.practice_actions import Begin, EndSession, JudgeAt
from station.app.actions.settings_actions import AskWhoPlays, PlayAs
from station.app.controller import Controller
from station.app.room_state import Stage
from station.app.sessions.launch import Launch
from station.app.settings.students import plain_name, switched
from station.core.errors import BadInput
from station.core.events import Hit, Switched
from station.core.pieces import Piece, Zone
from station.core.settings import Settings, StudentSettings, load_settings
from station.core.units import NS_PER_MS, NS_PER_S
from station.drills.library import find_lesson
from station.engine.messages import Started
from station.practice.session.plan import PlanOptions, plan_practice
from station.scoring.matching.hit_windows import Level
from tests.fakes.stations import Line, just_play, room, station_on, store_with

PLAN = plan_practice(find_lesson("rock-1"), PlanOptions(tempo_bpm=80.0, loops=1, demonstrations=0))


def station_with(sessions: Path, **chosen: object) -> tuple[Controller, Line]:
    line = Line()
    station = station_on([line], store_with(sessions, **chosen), Launch(PLAN))
    station.update(0)
    return station, line


def strike(station: Controller, line: Line, at_ns: int, *pieces: Piece) -> None:
    line.says += [Hit(at_ns, piece, Zone.HEAD, 90) for piece in pieces]
    station.update(at_ns + 1)


def test_what_is_ones_own_is_put_away_and_comes_back() -> None:
    ann = Settings(student="Ann", hands="left", course="funk", drums="jazz", theme="day")
    bea = switched(ann, "Bea")
    assert (bea.student, bea.hands, bea.course, bea.drums, bea.theme) == ("Bea", "", "", "jazz", "day")
    assert replace(switched(replace(bea, hands="open"), "Ann"), students=()) == ann
    again = switched(switched(replace(bea, hands="open"), "Ann"), "Bea")
    assert (again.student, again.hands) == ("Bea", "open")
    assert [each.name for each in again.students] == ["Bea", "Ann"], "who played last is the first"
    assert switched(ann, "Ann") is ann


@pytest.mark.parametrize("name", ["", "  ", "a\u202eb", "a\0b", "x" * 41])
def test_no_such_name_is_taken(name: str) -> None:
    with pytest.raises(BadInput, match="the name"):
        plain_name(name)


def test_blanks_of_a_name_are_made_one() -> None:
    assert plain_name("  Ann \t Lee\n") == "Ann Lee"


def test_a_switch_is_at_once_and_is_kept(tmp_path: Path) -> None:
    station, _ = station_with(tmp_path, student="Ann", hands="left")
    station.dispatch(JudgeAt("rock-1", Level.STUDIO))
    station.dispatch(PlayAs("Bea"))
    station.update(1)
    assert station.view().toast == "Bea plays"
    assert station.view().settings.hands == ""
    lesson = find_lesson("rock-1")
    assert station.parts.sessions.catalog.level(lesson) is Level.BEGINNER, "the lesson's own, and not Ann's"
    station.close()
    kept = load_settings(tmp_path / "settings.toml")
    assert kept.student == "Bea"
    assert kept.students == (StudentSettings("Bea"), StudentSettings("Ann", "left"))


def test_levels_are_a_students_and_a_lessons(tmp_path: Path) -> None:
    station, _ = station_with(tmp_path, student="Ann")
    catalog, one, other = station.parts.sessions.catalog, find_lesson("rock-1"), find_lesson("rock-2")
    station.dispatch(JudgeAt("rock-1", Level.STUDIO))
    assert [catalog.level(one), catalog.level(other)] == [Level.STUDIO, Level.BEGINNER]
    station.dispatch(PlayAs("Bea"))
    station.dispatch(JudgeAt("rock-1", Level.ADVANCED))
    assert catalog.level(one) is Level.ADVANCED
    station.dispatch(PlayAs("Ann"))
    assert [catalog.level(one), catalog.level(other)] == [Level.STUDIO, Level.BEGINNER]


def test_nobody_comes_in_the_middle_of_a_session(tmp_path: Path) -> None:
    station, _ = station_with(tmp_path, student="Ann")
    station.dispatch(Begin())
    assert room(station).stage is Stage.PLAYING
    for action in (PlayAs("Bea"), AskWhoPlays(on=True)):
        station.dispatch(action)
        station.update(1)
        assert "end the session first" in station.view().toast
        assert station.view().settings.student == "Ann"
        assert not station.view().students.asks


def test_a_name_that_would_share_a_folder_is_told(tmp_path: Path) -> None:
    station, _ = station_with(tmp_path, student="Ann Lee")
    station.dispatch(PlayAs("ann-lee"))
    station.update(1)
    assert "would share a folder with Ann Lee" in station.view().toast
    assert station.view().settings.student == "Ann Lee"


def test_the_take_of_the_one_before_is_put_away(tmp_path: Path) -> None:
    station, line = station_with(tmp_path, student="Ann")
    just_play(station)
    line.says.append(Started(NS_PER_S // 2))
    strike(station, line, NS_PER_S, Piece.SNARE)
    station.dispatch(EndSession())
    station.update(2 * NS_PER_S)
    assert room(station).take is not None
    station.dispatch(PlayAs("Bea"))
    station.update(3 * NS_PER_S)
    assert room(station).take is None
    assert station.view().report is None
    assert list((tmp_path / "Ann").iterdir()), "and is Ann's all the same"
    assert not (tmp_path / "Bea").exists()


# --- by the kit -------------------------------------------------------------------------------------------------------


def asked(sessions: Path, **chosen: object) -> tuple[Controller, Line]:
    """The list is open since a foot switch was pressed at 5 s; Ann plays, Bea and Cem have the next pads."""
    others = (StudentSettings("Bea"), StudentSettings("Cem"))
    station, line = station_with(sessions, student="Ann", students=others, **chosen)
    station.update(5 * NS_PER_S - 1)
    line.says.append(Switched(5 * NS_PER_S, "cc=64"))
    for frame in range(3):
        station.update(5 * NS_PER_S + frame)
    return station, line


def test_the_kit_asks_and_a_pad_chooses(tmp_path: Path) -> None:
    station, line = asked(tmp_path)
    lines = station.view().students.lines
    assert [(each.name, each.pad) for each in lines] == [
        ("Ann", "snare"), ("Bea", "high tom"), ("Cem", "floor tom")
    ]  # fmt: skip
    assert lines[1].played == "nothing played yet"
    strike(station, line, 7 * NS_PER_S, Piece.TOM_1)
    assert [each.is_meant for each in station.view().students.lines] == [False, True, False]
    station.update(8 * NS_PER_S)
    assert station.view().settings.student == "Bea"
    assert not station.view().students.asks


def test_music_and_kicks_choose_nobody_while_the_list_is_open(tmp_path: Path) -> None:
    station, line = asked(tmp_path)
    strike(station, line, 5 * NS_PER_S + 200 * NS_PER_MS, Piece.TOM_1)
    station.update(6 * NS_PER_S)
    for step in range(8):
        strike(station, line, 7 * NS_PER_S + step * NS_PER_S // 4, Piece.TOM_1)
    for at_ns in (12 * NS_PER_S, 12 * NS_PER_S + NS_PER_S // 2):
        strike(station, line, at_ns, Piece.KICK)
    station.update(15 * NS_PER_S)
    assert station.view().settings.student == "Ann"
    assert room(station).stage is Stage.IDLE
    assert station.view().students.asks
    line.says.append(Switched(16 * NS_PER_S, "cc=64"))
    station.update(16 * NS_PER_S)
    assert not station.view().students.asks, "what brought it up puts it away"


def test_two_crashes_that_end_a_fill_ask_nothing_and_two_out_of_silence_do(tmp_path: Path) -> None:
    station, line = station_with(tmp_path)
    for at_ns in (5_000, 5_300, 5_600):
        strike(station, line, at_ns * NS_PER_MS, Piece.SNARE)
    strike(station, line, 5_900 * NS_PER_MS, Piece.CRASH_1, Piece.CRASH_2)
    assert not station.view().students.asks
    strike(station, line, 9_000 * NS_PER_MS, Piece.CRASH_1, Piece.CRASH_2)
    assert station.view().students.asks


def test_the_kit_asks_nothing_where_that_is_switched_off(tmp_path: Path) -> None:
    station, _ = asked(tmp_path, pads_switch=False)
    assert not station.view().students.asks
