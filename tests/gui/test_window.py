"""The window as a user has it: imgui's test engine clicks, types and drags on a screen of the test's own.

Each scenario of `scenarios.py` runs in a process of its own; what it saw is compared here with what a user expects.
"""

import json
import os
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from station.practice.exchange.note_file import StrokeVerdict, read_note
from tests.gui.x_server import screen

pytestmark = [pytest.mark.gui, pytest.mark.timeout(400)]

ROOT = Path(__file__).parents[2]
DRIVE = Path(__file__).with_name("play_scenarios.py")
TIMEOUT_S = 360.0  # everything is drawn without a graphics card, on a machine that may be busy


@pytest.fixture(scope="module")
def environment() -> Iterator[dict[str, str]]:
    for found in screen():
        yield {**found, "PYTHONPATH": str(ROOT)}


def alone(environment: dict[str, str], folder: Path) -> dict[str, str]:
    """The same with settings and kits that are nobody's own, and this test's alone."""
    return {**environment, "XDG_CONFIG_HOME": str(folder / "config"), "XDG_DATA_HOME": str(folder / "data")}


def run(scenario: str, environment: dict[str, str], folder: Path) -> dict[str, Any]:
    """What one scenario saw in a window of its own."""
    seen: dict[str, Any] = run_in_turn([scenario], environment, folder)[scenario]
    return seen


def run_in_turn(scenarios: list[str], environment: dict[str, str], folder: Path) -> dict[str, Any]:
    """What each scenario saw, all in one window."""
    out = folder / "seen.json"
    command = [sys.executable, str(DRIVE), "+".join(scenarios), str(folder / "sessions"), str(out)]
    done = subprocess.run(
        command,
        env=alone(environment, folder),
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=TIMEOUT_S,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-3000:]
    seen: dict[str, Any] = json.loads(out.read_text())
    for name, one in seen.items():
        assert "traceback" not in one, f"{name}: {one['traceback']}\n{done.stdout[-3000:]}"
    assert list(seen) == scenarios
    assert "Error" not in done.stdout, done.stdout[-3000:]
    return seen


def test_a_settings_folder_that_is_a_file_keeps_no_window_from_opening(
    environment: dict[str, str], tmp_path: Path
) -> None:
    (tmp_path / "config").write_text("a file")
    command = [sys.executable, "-m", "station.cli.command_line", "--watch-frames", "3"]
    at = {**alone(environment, tmp_path), "HOME": str(tmp_path)}
    done = subprocess.run(command, env=at, cwd=tmp_path, capture_output=True, text=True, timeout=TIMEOUT_S, check=False)
    assert done.returncode == 0, done.stderr[-3000:]
    assert (tmp_path / "config").read_text() == "a file"


def test_a_lesson_is_chosen_played_and_judged(environment: dict[str, str], tmp_path: Path) -> None:
    seen = run("practise", environment, tmp_path)
    assert seen["started"] == "PLAYING"
    assert seen["title"] == "Rock 2: the kick moves"
    assert (seen["suggested"], seen["level"]) == ("beginner", "advanced")
    assert "judged as advanced, ±10 ms" in seen["told"]
    assert "rushed, on, or dragged?" in seen["asked"]
    assert not seen["told before"], "the result waits for the answer"
    assert seen["notes"] == 26  # two bars: 16 on the hi-hat, 4 on the snare, 6 on the kick
    assert seen["points"] > 80, "a professional plays this well"
    assert seen["after"] == "IDLE"
    assert list((tmp_path / "sessions").rglob("*.json")), "the session is kept"


@pytest.mark.parametrize("scenario", ["whose", "whose_in_a_large_window"])
def test_students_take_turns_and_start_stays_where_it_is(
    environment: dict[str, str], tmp_path: Path, scenario: str
) -> None:
    seen = run(scenario, environment, tmp_path)
    assert seen["plays"] == ["Bea Bell", "student"]
    assert seen["levels"] == ["studio", "beginner", "studio"], "each has their own"
    assert seen["listed"] == [["Bea Bell", "snare"], ["student", "high tom"], ["Cem", "floor tom"]]
    assert seen["start"] == [seen["start"][0]] * len(seen["start"])
    assert seen["unread"] == []


def test_search_keys_and_faults_in_one_window(environment: dict[str, str], tmp_path: Path) -> None:
    seen = run_in_turn(
        ["devices", "calibration", "sticks", "habits", "imports", "search", "fault", "keys", "just_play"],
        environment,
        tmp_path,
    )
    how_sessions_go_is_ticked_and_learnt(seen["habits"])
    music_comes_in_and_is_chosen(seen["imports"])
    the_kit_is_seen_and_set_by_looking(seen["devices"])
    a_stick_is_seen_and_put_in_a_hand(seen["sticks"])
    latency_is_measured_and_kept_when_asked(seen["calibration"])
    typing_into_the_search_plays_nothing(seen["search"])
    a_course_lists_its_lessons_in_their_order(seen["search"])
    a_fault_is_said_in_one_line(seen["fault"])
    keys_play_the_kit_and_escape_stops(seen["keys"])
    a_free_take_is_recorded_and_heard_again(seen["just_play"])


def test_a_question_is_answered_and_what_comes_next_begins_by_pad_key_and_mouse(
    environment: dict[str, str], tmp_path: Path
) -> None:
    """The second step is once more; where nothing is played nothing else is offered."""
    seen = run("choices", environment, tmp_path)
    assert not seen["answered by the music"], "a stroke right after the end is no answer"
    assert seen["answered by a pad"]
    assert seen["pads"][:2] == [["SNARE"], ["TOM_1"]]
    assert seen["unread"] == []
    assert seen["strays"] == "RESULT", "no kick of a groove begins anything"
    assert seen["meant"] == 1
    assert [seen[by].split()[0] for by in ("by key", "by mouse", "by enter", "by kicks")] == [
        seen["by pad"].split()[0]
    ] * 4


def test_a_newcomer_answers_three_questions_by_keyboard_and_plays(environment: dict[str, str], tmp_path: Path) -> None:
    seen = run("newcomer", environment, tmp_path)
    assert seen["asked"]
    assert seen["gone"], seen["answers"]
    assert seen["kept"] == ["Ann Lee", False, "left", True], "and never asked again"
    assert seen["levels"] == [["STUDENT", 0.0]], "the module sounds, so we do not"
    assert seen["keys"] == 0, "the letters of a name strike nothing"
    assert seen["left-handed"], "the drummer leads with the student's hand"
    assert seen["stage"] == "PLAYING"
    assert [seen["helped"], seen["helped playing"]] == ["Lessons", "Playing"]
    assert "Listen first" in seen["told"]


def test_the_first_minute_on_late_equipment_is_judged_fairly(environment: dict[str, str], tmp_path: Path) -> None:
    seen = run("first_minute", environment, tmp_path)
    assert seen["stage"] == "PLAYING", "one button, and the groove is heard"
    assert seen["seconds"] < 70
    assert abs(seen["lag"] - 95) <= 10
    assert seen["asked"] == "", "one question at a time"
    assert seen["fair"] > 50
    assert [seen["answered"], seen["after"]] == [None, seen["fair"]]
    assert "taken out" in seen["toast"]


def test_views_and_score_in_one_window(environment: dict[str, str], tmp_path: Path) -> None:
    seen = run_in_turn(["viewpoints", "look", "score", "worn"], environment, tmp_path)
    viewpoints_are_kept_by_keys_and_in_the_popup(seen["viewpoints"])
    every_viewpoint_can_be_chosen_and_turned(seen["look"])
    the_score_s_four_forms(seen["score"])
    colours_and_sizes_are_worn_and_kept(seen["worn"])


def test_panels_follow_the_window_s_size(environment: dict[str, str], tmp_path: Path) -> None:
    seen = run("resized", environment, tmp_path)
    large, small = seen["1280"], seen["760"]
    assert (large["letters"], small["letters"]) == (1.0, 0.84375), "17 and 14 pixels"
    assert large["lessons"] == pytest.approx(0.26, abs=0.01)
    assert small["lessons"] == pytest.approx(0.37, abs=0.01), "as many letters, so a larger share"
    for size in (large, small):
        assert size["unread"] == []
        assert [size[f"help {scale}"] for scale in ("1", "2.5", "0.75")] == [True] * 3
        for scale in ("1", "2.5", "0.75"):
            high, bottom = size[f"list {scale}"]
            assert high > 2 * 17 * float(scale), "two lines of the list are seen at least"
            assert bottom <= size[f"start {scale}"], "Start lies below the list"


def a_stick_is_seen_and_put_in_a_hand(seen: dict[str, Any]) -> None:
    assert seen["facts"][:2] == ["x-IMU3, 200 Hz", "none lost"]
    assert "last stroke" in seen["facts"][2]
    assert seen["drawn"]
    assert [seen["hand"], seen["shown"]] == ["LEFT_HAND", "LEFT_HAND"], "the file, and the engine that read it"
    assert seen["silent"] in (["it has fallen silent"], ["nothing has come from it yet"])
    assert seen["asks"].startswith("Lay both sticks")
    assert seen["given up"]
    assert seen["follows"]
    assert seen["sounds"]
    assert seen["watched"] == [True, False]
    assert "expected serial:PATH@BAUD" in seen["refused"]


def a_free_take_is_recorded_and_heard_again(seen: dict[str, Any]) -> None:
    assert seen["stage"] == "PLAYING"
    assert seen["pieces"] == ["SNARE", "KICK", "HIHAT"]
    assert seen["after"] == "IDLE", "there is no result"
    assert seen["listening"]
    assert set(seen["lit"]) & {"SNARE", "KICK", "HIHAT"}, "what sounds lights the kit"
    assert seen["filmed"], "as a video beside its capture, made of it"
    assert seen["midi"] == ["SNARE", "KICK", "HIHAT"], "as MIDI too"
    assert seen["lesson"][0] == "Just play", "and as a lesson of one's own"
    assert seen["ended"], "it ends by itself"


def test_what_is_set_on_the_page_of_sounds_is_heard_and_kept(environment: dict[str, str], tmp_path: Path) -> None:
    seen = run("sound", environment, tmp_path)
    assert seen["heard"], "a bar of what clicks"
    assert seen["levels"] == [["SetLevel", 0.5], ["SetLevel", 0.0]]
    assert seen["alone"] == 19, "every piece but the kick is silent"
    assert seen["tried"] == [True, "acoustic"], "to look at a kit chooses none"
    assert seen["sounds"] == ["brushes", "acoustic", "electronic", "electronic"][: len(seen["sounds"])]
    assert seen["sounds"][-1] == "electronic"
    assert seen["track"][0], "a sound that is dropped on this page is the track"
    assert seen["track"][1:] == [pytest.approx(100.0, abs=0.2), pytest.approx(1.0, abs=0.01)]
    assert seen["nudged"] == pytest.approx(0.01)
    assert seen["silent"] == [0.0]
    assert seen["flashes"], "what is not heard is seen"
    assert seen["import"]
    assert seen["kept"] == ["parts=2,accents=1+3,off=2,count", "click=0.5 student=0", "electronic", "nothing", True]
    assert seen["unread"] == []


def test_a_part_is_pinned_to_a_band_and_kept(environment: dict[str, str], tmp_path: Path) -> None:
    seen = run("song", environment, tmp_path)
    assert seen["pins"] == [1, 4, 6, 8]
    assert seen["off"] == [False, False, True, False], "the third lies a beat off"
    assert seen["unread"] == []
    assert seen["chosen"], "it is among the lessons"


def test_player_graph_and_figure_in_one_window(environment: dict[str, str], tmp_path: Path) -> None:
    seen = run_in_turn(["player", "figure", "graph", "phase", "legible"], environment, tmp_path)
    the_demonstration_is_watched_as_in_a_player(seen["player"])
    the_demonstrator_is_made_to_move_otherwise(seen["figure"])
    the_graph_follows_and_is_zoomed(seen["graph"])
    a_motion_walks_and_sounds(seen["phase"])
    nothing_is_cut_off_nor_written_over(seen["legible"])
    assert (tmp_path / "sessions" / "styles" / "slots.toml").exists()


def nothing_is_cut_off_nor_written_over(seen: dict[str, Any]) -> None:
    looked_at = {name: faults for name, faults in seen.items() if " at " in name}
    assert len(looked_at) >= 14, "seven tools in two sizes"
    assert not any(looked_at.values()), {name: faults for name, faults in looked_at.items() if faults}


def the_demonstration_is_watched_as_in_a_player(seen: dict[str, Any]) -> None:
    """Rock 1: two bars at 80 beats a minute, 750 ms a beat."""
    assert seen["plays"]
    assert seen["moves"]
    assert seen["stands"]
    assert seen["stepped"] == [0, 750, 1500, 750, 6000], "start, a beat on, a beat on, a beat back, end"
    assert seen["back"]
    assert (seen["flag"], seen["speed"]) == (6000, 50)
    assert (seen["loop"], seen["bars"]) == ([1, 1], [2, 2]), "the bar that was dragged over is practised too"
    assert seen["sought"] == pytest.approx(4500, abs=9), "in the middle of the second bar, to half a pixel of the ruler"
    assert (seen["counts"], seen["counts no more"]) == ([True, "Count-in"], False)
    assert seen["cues"] == 32, "24 strokes and 8 clicks"
    assert seen["commands"] == ["Play", "Stop", "Play", "Stop", "Play"], "silent by steps and backwards"


def the_demonstrator_is_made_to_move_otherwise(seen: dict[str, Any]) -> None:
    assert seen["gain"] == 90.0
    assert seen["moves so"] == 90.0, "at once"
    assert seen["chosen"] == ["jazz", False]
    assert seen["kept"] == "jazz"
    assert seen["slot"] == 90.0
    bars, values = zip(*seen["drawn"], strict=True)
    assert bars == (1.5, 1.75, 2.0), "a point on every beat from a quarter to the middle of two bars"
    assert values == pytest.approx((25, 50, 75), abs=3)
    bars, values = zip(*seen["dragged"], strict=True)
    assert bars == (1.5, 1.75, 2.0)
    assert values == pytest.approx((25, 90, 75), abs=3)
    assert seen["lane"] == seen["dragged"][:2], "a right click takes a point away"
    assert seen["kept lane"] == seen["lane"]
    assert seen["saved"][0].endswith("styles/My own.toml")
    assert seen["saved"][1:] == ["My own", False]
    assert seen["unconstrained"] == [80.0, 30.0, 30.0]
    assert seen["shared"] == [57.143, 21.429, 21.429], "80, 30 and 30 of 140"
    assert not seen["reset"]
    assert seen["proposed"] == "proposed"
    assert seen["again"] == "My own"
    assert seen["hands"] == ["left", True]


def the_graph_follows_and_is_zoomed(seen: dict[str, Any]) -> None:
    assert seen["beat"] == 750_000_000, "a beat after the start of the song or of the loop"
    assert seen["middle"] == pytest.approx(0.0, abs=1e-6), "the play line stands in the middle"
    assert seen["zoomed"] < 0.95
    assert 50 < seen["dragged"] < 80, "the line stays under the mouse, which moved by 60 pixels"
    assert seen["during"] == "PLAYING"
    assert seen["result"]


def a_motion_walks_and_sounds(seen: dict[str, Any]) -> None:
    assert seen["opened"] == "1_01.amc"
    assert seen["plays"]
    assert seen["at_s"] > 0.5
    assert seen["stopped"]
    assert seen["unread"] == []


def keys_play_the_kit_and_escape_stops(seen: dict[str, Any]) -> None:
    assert seen["pieces"] == ["SNARE", "KICK", "HIHAT", "CRASH_1"]
    assert seen["rising"], "each key has the time of its own frame"
    assert "Stop" in seen["commands"]
    assert seen["after"] == "RESULT"


def the_kit_is_seen_and_set_by_looking(seen: dict[str, Any]) -> None:
    assert seen["pads"] == ["KICK", "SNARE", "HIHAT"]
    assert seen["raw"] == "99 26 0a"
    assert seen["held back"] == [False, False, True], "10 is softer than the threshold of 30, once that is set"
    assert seen["kept"] == 30
    assert "ReloadDevice" in seen["taken"]
    assert seen["told"], "where it is kept, or that the engine took it"
    assert seen["still listens"] == [True, False]
    assert seen["unknown"] == [[10, 14]]
    assert seen["named"] == "note 14 (channel 10) is the high tom, rim"
    assert seen["asks"] == "hit it now, once: ride, bell"
    assert seen["learnt"] == ["note 36 (channel 10) is the ride, bell now; it was the kick before", "IDLE"]
    assert seen["undone"] == "KICK"
    assert not seen["given up"], "Esc gives up"
    assert seen["touch"] == [32, 116], "18 and 82 are the medians of what was played"


def how_sessions_go_is_ticked_and_learnt(seen: dict[str, Any]) -> None:
    assert seen["kept"] == [False, "crash_1+crash_2 ride+crash_1"], "49 is a crash and 51 a ride in General MIDI"
    assert seen["stage"] == "IDLE", "two kicks start nothing now"
    assert (seen["learns"], seen["learns unseen"]) == (True, False)
    assert "take-along/rock-1_1-2.mid; 1 lost" in seen["taken"], "MIDI has no word for a sticking"
    assert seen["printed"].endswith("take-along/rock-1_1-2.pdf")


def music_comes_in_and_is_chosen(seen: dict[str, Any]) -> None:
    for way in ("typed", "dropped", "copied"):
        title, kind, _ = seen[way]
        assert (title, kind) == (way.title(), ""), "a lesson of one's own, and on the player"
    assert seen["fault"].endswith("none.mid: no such file")


def latency_is_measured_and_kept_when_asked(seen: dict[str, Any]) -> None:
    assert seen["rests"] == [True, ""], "the engine has let the kit go"
    assert seen["found"] == [False, "virtual student", False], "and has it again; what was found is doubtful"
    assert not seen["kept unasked"]
    assert seen["kept"] == [4.0, "strike", "the strokes scatter by 8 ms"]
    assert seen["told"].startswith("kept in ")


def typing_into_the_search_plays_nothing(seen: dict[str, Any]) -> None:
    assert seen["keys"] == 0
    assert seen["shown"]
    assert all("paradiddle" in title.casefold() for title in seen["shown"])


def a_course_lists_its_lessons_in_their_order(seen: dict[str, Any]) -> None:
    course = tomllib.loads((ROOT / "lessons" / "courses" / "funk.course.toml").read_text(encoding="utf-8"))
    names = [name for part in course["part"] for name in part["lessons"]]
    assert seen["funk"] == names
    assert seen["chosen in funk"] == names[0]
    assert len(seen["none"]) > 80, "all lessons again"


def every_viewpoint_can_be_chosen_and_turned(seen: dict[str, Any]) -> None:
    for view in ("FRONT", "SHOULDER", "EYES", "TOP", "HANDS", "FEET", "LEFT_HAND", "RIGHT_HAND"):
        assert seen[view] == view
    assert seen["mirrored"]
    assert abs(seen["turned"]) > 0.1
    red, green, blue = seen["button"]
    assert blue < 100 < green < 200 < red, "the orange button is on the screen, over the picture"
    assert seen["picture"] > 10, "and the picture beside it"


def viewpoints_are_kept_by_keys_and_in_the_popup(seen: dict[str, Any]) -> None:
    for view in ("FRONT", "LEFT_HAND", "RIGHT_HAND"):
        assert seen[view] == view
    assert seen["told"] == "viewpoint 3 is kept: 3 comes back to it"
    assert seen["left"]
    assert seen["back"], "viewpoint 3 is where it was kept"
    assert seen["slots"] == [3, 8]
    assert seen["kept"] == ["TOP", True, True], "the settings hold the view, the mirror and the second picture"
    assert seen["kept_there"]
    assert seen["double"] == ["NOWHERE", "OVER", "OVER", "BESIDE"], "the double: popup, settings, key"


def colours_and_sizes_are_worn_and_kept(seen: dict[str, Any]) -> None:
    assert seen["light"]
    assert seen["letters"] == 1.0625, "two steps of a quarter up, and one down; 85 % of it in so small a window"
    assert seen["kept"] == ["day", 1.25]
    assert seen["strip"] <= 2 * 38 + 9 + 2 * 14 + 1, "two lines, however large"
    assert (seen["mirrored"], seen["speed"]) == (True, 70), "what has no room in them is behind two buttons"
    assert 0.42 < seen["panels"] < 0.48, "as much of the window as the lessons may have"


def the_score_s_four_forms(seen: dict[str, Any]) -> None:
    assert seen["by_key"] == ["HIGHWAY", "FALLING", "SCROLLING", "PAGED"], "from the pages that everybody begins with"
    assert seen["chosen"] == ["FALLING", False]
    assert seen["kept"] == ["falling", False]


def a_fault_is_said_in_one_line(seen: dict[str, Any]) -> None:
    assert seen["news"] == "the engine has ended"
    assert seen["after"] == "IDLE"


def test_a_session_is_played_on_the_highway(environment: dict[str, str], tmp_path: Path) -> None:
    assert run("highway", environment, tmp_path)["stage"] == "PLAYING"


def test_a_click_on_a_bar_of_the_result_drills_it(environment: dict[str, str], tmp_path: Path) -> None:
    seen = run("drill", environment, tmp_path)
    assert sum(seen["cells"].values()) == 26, "every note of both bars: 16 on the hi-hat, 4 snare, 6 kick"
    assert sum(notes for cell, notes in seen["cells"].items() if cell.endswith("FOOT")) == 6
    assert seen["heard Teacher"]
    assert seen["heard You"]
    assert [seen["seen Teacher"], seen["seen You"]] == [False, True], "one's own sticks over the teacher's"
    assert seen["quiet"]
    assert seen["pointed"].startswith("Bar 1, beat 1, ")
    assert seen["clicked"] == 2, "the bar of the stroke"
    assert seen["stage"] == "PLAYING"
    assert seen["subtitle"].startswith("1 pass of bar 2 at")


def test_a_session_is_kept_when_the_window_is_closed_in_its_middle(environment: dict[str, str], tmp_path: Path) -> None:
    seen = run_in_turn(["unplugged", "closes"], environment, tmp_path)
    without_its_monitor_the_window_comes_back(seen["unplugged"])
    assert seen["closes"]["at_the_end"] == "PLAYING"
    assert list((tmp_path / "sessions").rglob("*.json")), "the session is kept"


def without_its_monitor_the_window_comes_back(seen: dict[str, Any]) -> None:
    assert seen["outside"], "the screen does not show it"
    assert not seen["told before"]
    assert seen["shown"] == 1.0, "the whole of it"
    assert (
        seen["told"]
        == "the monitor that showed the window has gone: here it is again, and nothing that was played is lost"
    )
    assert seen["stage"] == "PLAYING", "the session goes on"


def fault_of(scenario: str, environment: dict[str, str], folder: Path) -> str:
    """The last line that a window says which cannot go on."""
    command = [sys.executable, str(DRIVE), scenario, str(folder / "sessions"), str(folder / "seen.json")]
    done = subprocess.run(
        command,
        env=alone(environment, folder),
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=TIMEOUT_S,
        check=False,
    )
    assert done.returncode == 1, (done.returncode, done.stderr[-3000:])
    return done.stderr.strip().splitlines()[-1]


def test_a_session_is_kept_when_the_driver_loses_the_window(environment: dict[str, str], tmp_path: Path) -> None:
    fault = fault_of("lost", environment, tmp_path)
    assert "DeviceError: the graphics driver has lost the window: start the station again" in fault
    assert list((tmp_path / "sessions").rglob("*.json")), "the session is kept"


def test_without_opengl_one_line_says_so(environment: dict[str, str], tmp_path: Path) -> None:
    """A screen there is, but its OpenGL is of 2006: Mesa says so when it is asked to."""
    fault = fault_of("look", {**environment, "MESA_GL_VERSION_OVERRIDE": "2.1"}, tmp_path)
    assert "DeviceError: no window can be opened: is there a screen, and OpenGL?" in fault


def test_without_a_screen_one_line_says_so(tmp_path: Path) -> None:
    bare = {name: value for name, value in os.environ.items() if name not in {"DISPLAY", "WAYLAND_DISPLAY"}}
    fault = fault_of("look", {**bare, "PYTHONPATH": str(ROOT)}, tmp_path)
    assert "DeviceError: no window can be opened: is there a screen" in fault


def test_the_plan_of_the_day_is_begun_left_out_and_written_about(environment: dict[str, str], tmp_path: Path) -> None:
    seen = run("planned_day", environment, tmp_path)
    assert seen["kinds"][0] == "warm-up"
    assert seen["kinds"][-1] == "play"
    assert seen["minutes"] == 20
    assert seen["begun"] == seen["planned"]
    assert seen["practised"] == seen["planned"][:1]
    assert seen["left out"]
    assert seen["line"] == "The left hand is late"
    for name in ("unread", "unread while playing", "unread of the book", "unread of practice"):
        assert seen[name] == [], name


def test_the_history_is_looked_through_and_a_session_opened_from_it(
    environment: dict[str, str], tmp_path: Path
) -> None:
    seen = run("history", environment, tmp_path)
    assert seen["day"] == [True, "Sessions"]
    assert seen["found"] == 1
    assert seen["opening"], "another process judges it, and the window goes on"
    assert seen["opened"][0].startswith("you, ")
    assert seen["opened"][1] == seen["score"]
    assert seen["moved"] == 0, "the rows stay where they were when one is opened"
    assert seen["pieces"] == ["piece", 7]
    unread = {name: lines for name, lines in seen.items() if name.startswith("unread")}
    assert len(unread) == 13
    assert unread == {name: [] for name in unread}


def test_an_assignment_goes_to_a_student_and_comes_back_answered(environment: dict[str, str], tmp_path: Path) -> None:
    seen = run("there_and_back", {**environment, "HOME": str(tmp_path)}, tmp_path)
    assert seen["given"]
    assert seen["due"].endswith(", 8 days left")
    assert seen["listed"] == ["Tuesday", "student", "rock-1", seen["score"], "bar 2 is hard"]
    assert seen["differences"] == [], "the report is what the capture gives"
    assert [seen["heat"], seen["heard"], seen["teacher heard"]] == [True, True, True]
    assert "Play" in seen["sounds"]
    note, counts = seen["stroke"]
    read = read_note(tmp_path / "zoe.drum-note")
    (verdict,) = read.sessions
    assert (verdict.reached, verdict.strokes) == (True, (StrokeVerdict(counts, note=note),))
    assert (read.words, read.next) == ("Well done.", "the same at 100")
    told = "accepted" if counts else "not accepted"
    assert seen["note"] == [
        "Well done.",
        f"rock-1, session 1: goals reached, strokes: 1 {told}",
        "Next: the same at 100",
    ]
    faults = {name: faults for name, faults in seen.items() if name.startswith("unread") and faults}
    assert not faults, faults
