"""The command line: documents on standard output, bad input as one line on standard error and exit status 2."""

import json
import re
import wave
from dataclasses import replace
from pathlib import Path
from random import Random
from typing import cast

import mido
import numpy as np
import pytest

from station.cli.command_line import _COMMANDS, main
from station.core.events import Hit
from station.core.settings import Settings, load_settings, save_settings
from station.devices.capture.capture import RecordKind, read_capture
from station.drills.library import find_lesson
from station.music.formats.smf.track_writer import write_performance
from station.music.performance import Performance
from tests.fakes.captures import capture_bytes
from tests.fakes.kept_sessions import users_history


@pytest.fixture(autouse=True)
def own_settings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nobody's own settings or sessions are touched."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("XDG_DOCUMENTS_DIR", str(tmp_path / "Documents"))
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)


def refused(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    """Run a command that must be refused; the one line that it says."""
    assert main(words) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("station: ")
    assert err.count("\n") == 1
    assert "Traceback" not in err
    return err


def practise(
    capsys: pytest.CaptureFixture[str], *words: str, student: str = "seed=1,sd_ms=12,bias_ms=-8,miss_pct=3,extra_pct=2"
) -> dict[str, object]:
    assert (
        main(["practice", "rock-1", "--headless", "--virtual-student", student, "--json", "--no-pictures", *words]) == 0
    )
    document = json.loads(capsys.readouterr().out)
    assert isinstance(document, dict)
    return document


def test_practice_prints_one_document_and_leaves_a_session(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    document = practise(capsys, "--loops", "2", "--report", str(tmp_path / "session"))
    assert document["schema"] == "drum-station/assessment/1"
    counts = document["counts"]
    assert isinstance(counts, dict)
    assert counts["notes"] == 2 * 24  # rock 1: 8 hi-hats, 2 kicks, 2 snares a bar, 2 bars, 2 loops
    assert counts["notes"] == counts["matched"] + counts["misses"] + counts["wrong_piece"]
    assert counts["hits"] == counts["matched"] + counts["extras"] + counts["wrong_piece"] + counts["ignored"]
    names = {path.name for path in (tmp_path / "session").iterdir()}
    assert {"session.capture", "report.json", "report.txt", "pairs.csv"} <= names
    assert json.loads((tmp_path / "session" / "report.json").read_text()) == document


def test_the_same_seed_is_the_same_session(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    first = practise(capsys, "--report", str(tmp_path / "a"))
    second = practise(capsys, "--report", str(tmp_path / "b"))
    assert first == second


def test_the_tempo_follows_the_student_where_it_is_asked_to(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    first = practise(capsys, "--adapt", "--loops", "3", "--student", "anna")
    second = practise(capsys, "--adapt", "--loops", "1", "--student", "anna")
    nobody = practise(capsys, "--adapt", "--loops", "1")
    tempi = [one["mastery"]["passes"][0]["tempo_bpm"] for one in (first, second, nobody)]  # type: ignore[index]
    assert tempi[0] == tempi[2] < tempi[1]
    assert first["counts"]["notes"] == 3 * 24  # type: ignore[index]
    assert [(row.lesson, row.first_bar, row.last_bar) for row in users_history().mastery("anna")] == [("rock-1", 0, 1)]
    assert [each.name for each in users_history().students() if users_history().mastery(each.name)] == ["anna"]


def test_where_the_history_is_away_a_line_says_so_and_the_session_is_taken_in_later(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    (tmp_path / "plain-file").touch()
    away = save_settings(Settings(history=f"sqlite:///{tmp_path}/plain-file/history", sessions=str(tmp_path / "s")))
    words = ["practice", "rock-1", "--headless", "--adapt", "--loops", "1", "--no-pictures", "--student", "anna"]
    assert main([*words, "--virtual-student", "pro,seed=1"]) == 0
    out, err = capsys.readouterr()
    assert "Score" in out
    assert [err.count(words) for words in ("practice goes on", "mastery begins anew", "another day")] == [1, 1, 1]
    assert "Traceback" not in err
    away.unlink()
    save_settings(Settings(sessions=str(tmp_path / "s")))
    assert main(["today", "--student", "anna"]) == 0
    assert "1 session taken into the history" in capsys.readouterr().err
    assert [row.lesson for row in users_history().mastery("anna")] == ["rock-1"]


def test_a_session_has_a_folder_of_the_students_own(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    practise(capsys, "--loops", "1", "--student", "Gene K. / 2")
    folders = list(tmp_path.rglob("report.json"))
    assert len(folders) == 1
    assert re.fullmatch(r"Gene-K\.---2-[0-9a-f]{8}", folders[0].parent.parent.name), "marked: a folder lacks the slash"
    assert folders[0].parent.name.endswith("_rock-1")


def test_a_capture_can_be_assessed_again_by_the_session_s_click(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """The report of the session, but for what only the session knows; a late player stays late."""
    document = practise(capsys, "--loops", "2", "--report", str(tmp_path / "session"), student="seed=2,bias_ms=45")
    assert main(["assess", "rock-1", str(tmp_path / "session" / "session.capture"), "--json"]) == 0
    again = json.loads(capsys.readouterr().out)
    assert (again["reference"], again["score"]) == ("click", document["score"])
    assert all(document[key] == told for key, told in again.items())


def test_a_capture_of_some_bars_is_assessed_as_those_bars(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    document = practise(capsys, "--bars", "2-2", "--loops", "3", "--report", str(tmp_path / "session"))
    assert main(["assess", "rock-1", str(tmp_path / "session" / "session.capture"), "--json"]) == 0
    again = json.loads(capsys.readouterr().out)
    assert again["counts"]["notes"] == 3 * 12
    assert all(document[key] == told for key, told in again.items())


LANDING_LESSON = """
title = "Two bars and a landing"
tempo_bpm = 100
meter = ["3+2+2/8", "2/4"]
loop = [3, 4]
passes = 2
demonstrations = 0
[goals]
faults = {late_kick = 15}
[hints]
late_kick = "Heel down."
[landing]
crash = "X"
kick = "o"
[[grid]]
times = 2
tempo_to_bpm = 70
ride = "xxx xx xx | x x"
kick = "o-- o- -- | o o"
"""


@pytest.mark.parametrize(
    ("ways", "loops", "landings"), [((), 2, 1), (("--adapt", "--loops", "2"), 4, 2)], ids=["at once", "pass by pass"]
)
def test_a_capture_with_ramps_meters_and_a_landing_is_assessed_as_its_report(
    ways: tuple[str, ...], loops: int, landings: int, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """Pass by pass a loop of two bars is played twice, and each pass lands."""
    lesson = tmp_path / "landing.toml"
    lesson.write_text(LANDING_LESSON)
    said = ["practice", str(lesson), "--headless", "--virtual-student", "pro", "--no-pictures", "--json", *ways]
    assert main([*said, "--report", str(tmp_path / "session")]) == 0
    document = json.loads(capsys.readouterr().out)
    assert main(["assess", str(lesson), str(tmp_path / "session" / "session.capture"), "--json"]) == 0
    again = json.loads(capsys.readouterr().out)
    in_loop = 7 + 2 + 2 + 2  # ride and kick of both bars
    assert again["counts"]["notes"] == loops * in_loop + 2 * landings
    assert (again["reference"], again["score"], again["counts"]) == ("click", document["score"], document["counts"])


def test_a_session_of_another_lesson_is_assessed_by_the_player_s_own_tempo(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """Its click was another's; where its clock begins is chance, so that no lean of the whole can be told."""
    practise(capsys, "--loops", "1", "--report", str(tmp_path / "session"))
    assert main(["assess", "rock-2", str(tmp_path / "session" / "session.capture"), "--json"]) == 0
    again = json.loads(capsys.readouterr().out)
    assert again["reference"] == "player"
    assert {"late", "early"}.isdisjoint(advice["fault"] for advice in again["advice"])
    assert main(["assess", "rock-2", str(tmp_path / "session" / "session.capture")]) == 0
    assert "about your own tempo; without a click" in capsys.readouterr().out


def test_a_session_s_capture_is_a_score_too_in_the_lesson_s_bars(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    practised = practise(capsys, "--loops", "1", "--report", str(tmp_path / "session"))
    assert main(["limbs", str(tmp_path / "session" / "session.capture"), "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    counts = cast(dict[str, int], practised["counts"])
    assert len(document["notes"]) == counts["hits"]
    bar_s = 4 * 60 / 80  # rock-1 in 80 bpm, whose count-in and demonstrations are whole bars
    assert all(abs((8 * note["time_s"] / bar_s + 0.5) % 1 - 0.5) < 0.15 for note in document["notes"]), "on its eighths"


def test_a_take_is_written_as_a_midi_file_in_the_lesson_s_bars(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """Read back by mido: as many notes as hits, each within half of 16 µs of the take, 80 bpm in the file."""
    practise(capsys, "--loops", "1", "--report", str(tmp_path / "session"))
    capture = str(tmp_path / "session" / "session.capture")
    assert main(["limbs", capture, "--json"]) == 0
    heard = [note["time_s"] for note in json.loads(capsys.readouterr().out)["notes"]]
    assert main(["lesson", "export", capture, "--out", str(tmp_path / "take.mid")]) == 0
    file = mido.MidiFile(tmp_path / "take.mid")
    now, onsets = 0.0, []
    for message in file:
        now += message.time
        if message.type == "note_on" and message.velocity:
            onsets.append(now)
    assert np.allclose(sorted(onsets), sorted(heard), atol=3e-5)
    assert {round(mido.tempo2bpm(m.tempo)) for m in file if m.type == "set_tempo"} == {80}


@pytest.mark.parametrize("data", [b"", capture_bytes([])])
def test_a_capture_without_a_stroke_is_no_score(
    data: bytes, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    (tmp_path / "empty.capture").write_bytes(data)
    assert main(["animate", str(tmp_path / "empty.capture"), "--out", str(tmp_path / "x.npz")]) == 2
    said = capsys.readouterr().err
    assert "empty.capture" in said
    assert said.count("\n") == 1
    assert not (tmp_path / "x.npz").exists()


def test_limbs_say_who_plays_every_note(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["limbs", "rock-1", "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["schema"] == "drum-station/limbs/1"
    assert len(document["notes"]) == 24
    assert {(n["piece"], n["limb"]) for n in document["notes"]} == {
        ("kick", "right_foot"),
        ("snare", "left_hand"),
        ("hihat", "right_hand"),
    }


def test_limbs_are_told_in_the_drummers_words(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["limbs", "rock-1"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 24
    assert any(" hi-hat " in line and " right hand " in line for line in lines)
    assert not any("hihat" in line or "_" in line for line in lines)


def test_a_lesson_goes_to_midi_and_back(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    midi, toml = tmp_path / "rock.mid", tmp_path / "rock.toml"
    assert main(["lesson", "export", "rock-1", "--out", str(midi)]) == 0
    assert main(["lesson", "import", str(midi), "--out", str(toml)]) == 0
    assert main(["lesson", "check", str(toml)]) == 0
    capsys.readouterr()
    assert main(["assess", str(toml), str(midi), "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert (document["counts"]["matched"], document["score"]) == (24, 100.0)


def test_a_lesson_is_not_overwritten_unasked(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    midi, toml = tmp_path / "rock.mid", tmp_path / "mine.toml"
    assert main(["lesson", "export", "rock-1", "--out", str(midi)]) == 0
    toml.write_text("an evening's work")
    capsys.readouterr()
    assert main(["lesson", "import", str(midi), "--out", str(toml)]) == 2
    assert "is there already" in capsys.readouterr().err
    assert toml.read_text() == "an evening's work"
    assert main(["lesson", "import", str(midi), "--out", str(toml), "--overwrite"]) == 0
    assert main(["lesson", "check", str(toml)]) == 0


def test_a_new_lesson_is_a_lesson(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert main(["lesson", "new"]) == 0
    file = tmp_path / "mine.toml"
    file.write_text(capsys.readouterr().out)
    assert main(["lesson", "check", str(file)]) == 0


def test_a_drill_of_a_family_is_a_lesson_and_its_file_is_kept(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    file = tmp_path / "drill.toml"
    words = ["lesson", "new", "linear", "--level", "3", "--seed", "5"]
    assert main([*words, "--out", str(file)]) == 0
    assert main(["lesson", "check", str(file)]) == 0
    assert main([*words, "--out", str(file)]) == 2
    assert "is there already" in capsys.readouterr().err
    assert main(words) == 0
    assert capsys.readouterr().out == file.read_text()


def test_a_lesson_to_start_from_has_no_seed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["lesson", "new", "--seed", "5"]) == 2
    assert "of which family" in capsys.readouterr().err


def test_check_names_every_fault_and_exits_with_2(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text('title = "x"\ntempo_bmp = 90\n[grid]\nsnare = "| -?-- |"\n')
    assert main(["lesson", "check", str(file)]) == 2
    out, err = capsys.readouterr()
    assert [line.split(": ")[1] for line in out.splitlines()] == ["line 2, column 1", "line 4, column 13"]
    assert err.count("\n") == 1


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("practice", "rokc-1", "--headless"), "rokc-1: no such lesson; the nearest"),
        (("practice", "rock-1", "--tempo", "0"), "--tempo: 0"),
        (("practice", "rock-1", "--tempo", "fast"), "--tempo"),
        (("practice", "rock-1", "--loops", "-1"), "--loops: -1"),
        (("practice", "rock-1", "--bars", "3-9"), "--bars: 3-9"),
        (
            ("practice", "rock-1", "--tempo", "80bpm"),
            "argument --tempo: expected a number, or tap to tap it, found '80bpm'",
        ),
        (("practice", "rock-1", "--loops", "2.5"), "argument --loops: expected a whole number, found '2.5'"),
        (("practice", "rock-1", "--virtual-student", "seed=x"), "expected a whole number from 0 to 4294967295"),
        (("assess", "rock-1", "pyproject.toml"), "pyproject.toml: neither a MIDI file (.mid, .midi, .smf, .kar) nor"),
        (("practice", "rock-1", "--bars", "one"), "--bars"),
        (("practice", "rock-1", "--virtual-student", "sd_ms=much"), "sd_ms"),
        (("assess", "rock-1", "nowhere.mid"), "nowhere.mid: no such file"),
        (("assess", "nowhere.mid", "nowhere.mid"), "nowhere.mid: no such file"),
        (("limbs", "."), "."),
        (("lesson", "show", "rokc-1"), "rokc-1"),
        (("lesson", "import", "x.pdf", "--out", "x.toml"), "x.pdf"),
        (("devices", "replay", "nowhere.capture"), "nowhere.capture: no such file"),
        (("juggle",), "juggle"),
        (("practice", "--juggle"), "--juggle"),
    ],
)
def test_bad_input_is_one_line(capsys: pytest.CaptureFixture[str], words: tuple[str, ...], named: str) -> None:
    assert named in refused(capsys, *words)


@pytest.mark.parametrize("command", ["assess", "limbs"])
def test_garbage_is_refused(capsys: pytest.CaptureFixture[str], tmp_path: Path, command: str) -> None:
    garbage = tmp_path / "garbage.mid"
    garbage.write_bytes(bytes(range(256)) * 8)
    words = [command, str(garbage)] + ([str(garbage)] if command == "assess" else [])
    assert "garbage.mid" in refused(capsys, *words)


def test_a_broken_lesson_names_the_line(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    broken = tmp_path / "broken.toml"
    broken.write_text('title = "x\n')
    assert "broken.toml: line 1" in refused(capsys, "practice", str(broken), "--headless")


def test_a_folder_that_cannot_be_made_is_told_before_anybody_plays(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    taken = tmp_path / "taken"
    taken.write_text("a file")
    words = ("practice", "rock-1", "--virtual-student", "pro", "--report", str(taken / "session"))
    assert "no folder can be made" in refused(capsys, *words)


def test_bad_settings_name_the_key_and_are_not_written_over(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    settings = tmp_path / "config" / "drum-station" / "settings.toml"
    settings.parent.mkdir(parents=True)
    settings.write_text('kitt = "TD-17"\n')
    assert main(["practice", "rock-1", "--headless", "--virtual-student", "pro", "--no-pictures"]) == 0
    assert "no such setting: kitt; did you mean kit?" in capsys.readouterr().err
    assert "no such setting: kitt; did you mean kit?" in refused(
        capsys, "practice", "rock-1", "--headless", "--remember", "--guide"
    )


def test_a_settings_folder_that_is_a_file_keeps_nobody_from_practising(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    (tmp_path / "config").write_text("a file")
    assert main(["practice", "rock-1", "--headless", "--virtual-student", "pro", "--no-pictures"]) == 0
    assert "settings.toml: cannot be read: Not a directory" in capsys.readouterr().err


def test_help_needs_no_command(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as leaving:
        main(["--help"])
    assert leaving.value.code == 0
    assert "practice" in capsys.readouterr().out


@pytest.mark.parametrize("name", _COMMANDS)
def test_every_command_has_a_help(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as leaving:
        main([name, "--help"])
    assert leaving.value.code == 0
    assert f"station {name}" in capsys.readouterr().out


def test_a_percent_sign_of_a_help_is_one(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["practice", "--help"])
    assert "such as 60%\n" in capsys.readouterr().out
    with pytest.raises(SystemExit):
        main(["animate", "--help"])
    assert "%05d.png" in capsys.readouterr().out


def test_a_folder_holds_one_session(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    practise(capsys, "--loops", "1", "--report", str(tmp_path / "session"))
    before = (tmp_path / "session" / "session.capture").read_bytes()
    words = ("practice", "rock-1", "--virtual-student", "pro", "--report", str(tmp_path / "session"))
    assert "there is a session in this folder already" in refused(capsys, *words)
    assert (tmp_path / "session" / "session.capture").read_bytes() == before


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no /dev/full")
def test_a_full_disk_costs_no_hit(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The report leads to a device that is always full, and there is no spare disk."""
    folder = tmp_path / "session"
    folder.mkdir()
    (folder / "report.txt").symlink_to("/dev/full")
    (tmp_path / "no folder").touch()
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "no folder"))
    words = ["practice", "rock-1", "--virtual-student", "pro", "--loops", "1", "--report", str(folder)]
    assert main(words) == 2
    out, err = capsys.readouterr()
    assert "No space left" in err
    assert out.count("\nmatch,") == 24  # every note of two bars of rock 1, played by a flawless pro


def test_words_that_no_encoding_knows_are_written(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    document = practise(capsys, "--loops", "1", "--student", "\udcff", "--report", str(tmp_path / "session"))
    assert document == json.loads((tmp_path / "session" / "report.json").read_text())


def test_a_name_longer_than_file_systems_take_is_no_lesson(capsys: pytest.CaptureFixture[str]) -> None:
    assert "no such lesson" in refused(capsys, "lesson", "show", "x" * 5000)


def test_block_sizes_have_limits(capsys: pytest.CaptureFixture[str]) -> None:
    words = ("practice", "rock-1", "--virtual-student", "pro", "--block-frames", "-5")
    assert "block_frames" in refused(capsys, *words)


def test_truth_speaks_of_what_the_report_speaks_of(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    document = practise(capsys, "--loops", "4", "--report", str(tmp_path / "session"))
    truth = document["truth"]
    assert isinstance(truth, dict)
    assert {"score", "counts", "timing", "advice", "spec"} <= truth.keys()
    assert isinstance(truth["score"], float)


def test_a_loop_that_was_played_four_times_is_assessed_as_such(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    document = practise(capsys, "--loops", "4", "--report", str(tmp_path / "session"))
    assert main(["assess", "rock-1", str(tmp_path / "session" / "session.capture"), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["counts"] == document["counts"]


def test_limbs_can_be_edited_as_text(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    text = tmp_path / "rock.txt"
    assert main(["limbs", "rock-1", "--text", str(text)]) == 0
    text.write_text(text.read_text().replace("left_hand", "right_hand", 1))
    capsys.readouterr()
    assert main(["limbs", str(text), "--json"]) == 0
    limbs = [note["limb"] for note in json.loads(capsys.readouterr().out)["notes"] if note["piece"] == "snare"]
    assert limbs == ["right_hand", "left_hand", "left_hand", "left_hand"]


def test_animate_draws_the_drummer_who_is_asked_for(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "x.npz"
    assert main(["animate", "rock-1", "--end-bar", "1", "--fps", "10", "--stature", "1.5", "--out", str(out)]) == 0
    with np.load(out) as read:
        names = read["point_names"].tolist()
        arm = read["points_m"][:, names.index("right_elbow")] - read["points_m"][:, names.index("right_shoulder")]
    assert np.linalg.norm(arm, axis=1) == pytest.approx(0.186 * 1.5)  # Winter's share of the stature
    capsys.readouterr()
    assert "expected 0.8 to 2.4 metres" in refused(capsys, "animate", "rock-1", "--stature", "17", "--out", str(out))
    assert "the score has bars 1 to 2" in refused(capsys, "animate", "rock-1", "--end-bar", "0", "--out", str(out))
    assert "no such drummer; there is beard" in refused(
        capsys, "animate", "rock-1", "--drummer", "bear", "--out", str(out)
    )


def test_animate_takes_the_style_that_the_score_suggests(tmp_path: Path) -> None:
    first, second = tmp_path / "a.npz", tmp_path / "b.npz"
    for out, words in ((first, ["--style", "proposed"]), (second, [])):
        assert main(["animate", "jazz-ride-1", "--end-bar", "1", "--fps", "10", "--out", str(out), *words]) == 0
    with np.load(first) as proposed, np.load(second) as natural:
        assert np.abs(proposed["points_m"] - natural["points_m"]).max() > 0.005


def test_what_sounds_is_chosen_checked_and_remembered(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    practice = (
        "practice",
        "rock-1",
        "--virtual-student",
        "pro",
        "--no-pictures",
        "--report",
        str(tmp_path / "session"),
    )
    for words, named in (
        (("--click", "on=3"), "on=3"),
        (("--levels", "drums=1"), "drums=1"),
        (("--track-speed", "80"), "--track-speed"),
        (("--track", "song.mp3", "--adapt"), "--track"),
        (("--block-frames", "8"), "16 to 8192"),
    ):
        assert named in refused(capsys, *practice, *words)
    chosen = ("--click", "parts=2,count", "--levels", "click=0.5", "--sounds", "brushes", "--guide", "--no-own-sound")
    assert main([*practice, *chosen, "--midi-out", "TD", "--remember"]) == 0
    kept = load_settings(tmp_path / "drum-station" / "settings.toml")
    assert (kept.click_pattern, kept.levels, kept.drums) == ("parts=2,count", "click=0.5", "brushes")
    assert (kept.guide, kept.own_sound, kept.midi_out) == (True, False, "TD")


def test_a_distance_that_is_none_is_refused_by_its_own_name(capsys: pytest.CaptureFixture[str]) -> None:
    said = refused(capsys, "devices", "calibrate", "--by", "strike", "--distance", "x")
    assert "--distance: expected 0 to 10 metres, found 'x'" in said


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("--track", "nothere.mp3"), "nothere.mp3: no such file"),
        (("--track", "pyproject.toml"), "pyproject.toml: cannot be read as sound"),
        (("--track", "examples"), "examples: is a folder"),
        (("--sounds", "nokit"), "nokit: no such drum kit; there are"),
        (("--sounds", "pyproject.toml"), "pyproject.toml: is no drum kit"),
    ],
)
def test_a_virtual_session_too_refuses_what_cannot_sound(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, words: tuple[str, ...], named: str
) -> None:
    """And nothing is remembered of what is refused."""
    practice = ("practice", "rock-1", "--headless", "--virtual-student", "pro", "--remember", *words)
    assert main(practice) == 2
    assert named in capsys.readouterr().err
    assert load_settings().drums == "acoustic"
    assert not list(tmp_path.rglob("*.capture"))


def test_a_virtual_session_too_refuses_a_part_that_its_track_lacks(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    track = tmp_path / "eight.wav"
    with wave.open(str(track), "wb") as file:
        file.setparams((1, 2, 8000, 0, "NONE", ""))
        file.writeframes(bytes(2 * 8 * 8000))  # eight seconds of silence
    practice = ("practice", "rock-1", "--headless", "--virtual-student", "pro", "--track", str(track))
    assert "eight.wav: loop 5-3: a loop lies within 8.0 s" in refused(capsys, *practice, "--track-loop", "5-3")
    assert "eight.wav: start: expected 0 to 8.0 s" in refused(capsys, *practice, "--track-start", "9")
    assert "eight.wav: speed: expected 50% to 150%" in refused(capsys, *practice, "--track-speed", "500")


@pytest.mark.parametrize(
    ("line", "named"),
    [
        ('drums = "nokit"', "nokit: no such drum kit"),
        ('levels = "x"', "settings.toml: levels"),
        ('pause = "banana+ride"', "settings.toml: pause: banana+ride: expected two pads"),
        ('theme = "pink"', "theme: expected one of"),
        ('click = "banana"', "banana: no such click; there are"),
    ],
)
def test_a_virtual_session_too_refuses_settings_that_mean_nothing(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, line: str, named: str
) -> None:
    settings = tmp_path / "config" / "drum-station" / "settings.toml"
    settings.parent.mkdir(parents=True)
    settings.write_text(f"{line}\n")
    assert named in refused(capsys, "practice", "rock-1", "--headless", "--virtual-student", "pro")


def test_a_remark_that_cannot_be_read_keeps_no_stroke_from_being_replayed(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    practise(capsys, "--loops", "1", "--report", str(tmp_path / "session"))
    path = tmp_path / "session" / "session.capture"
    assert main(["devices", "replay", str(path), "--json"]) == 0
    before = json.loads(capsys.readouterr().out)
    records = [
        replace(one, payload=b"of a later version") if one.kind == RecordKind.ANNOTATION else one
        for one in read_capture(path).records
    ]
    path.write_bytes(capture_bytes(records))
    assert main(["devices", "replay", str(path), "--json"]) == 0
    out, said = capsys.readouterr()
    after = json.loads(out)
    assert after["events"] == before["events"]
    assert [len(before["sessions"]), after["sessions"]] == [1, []]
    assert f"{path}: remark at" in said


def test_an_empty_file_is_no_capture(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    empty = tmp_path / "empty.mid"
    empty.touch()
    assert "empty.mid: the file is empty" in refused(capsys, "devices", "replay", str(empty))


@pytest.mark.parametrize("option", ["--style", "--drums"])
def test_a_file_that_is_no_text_is_told_in_a_teachers_words(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, option: str
) -> None:
    binary = tmp_path / "binary.toml"
    binary.write_bytes(b"\n\xff\xfe")
    words = ("animate", "rock-1", option, str(binary), "--out", str(tmp_path / "x.npz"))
    assert "binary.toml: line 2, column 1: not UTF-8 text" in refused(capsys, *words)


def test_a_lesson_is_shown_as_it_was_written(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path = tmp_path / "own.toml"
    path.write_text('title = "T"   # mine\n[grid]\ntimes = 2\nsnare="o---"\n')
    assert main(["lesson", "show", str(path)]) == 0
    rows = ['title = "T"   # mine', "[grid]", "times = 2", "#          1 2 3 4", 'snare = "| o - - - |"']
    assert capsys.readouterr().out.splitlines() == rows


def test_a_lesson_at_fault_is_not_shown_but_its_first_fault(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path = tmp_path / "own.toml"
    path.write_text('title = "T"\n[grid]\nsnare = "oq"\nkick = "oq"\n')
    assert "line 3, column 11: 'q' is no letter" in refused(capsys, "lesson", "show", str(path))


def test_the_schema_of_lessons_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["lesson", "schema"]) == 0
    assert json.loads(capsys.readouterr().out)["properties"]["title"]["type"] == "string"


@pytest.mark.parametrize("command", [("practice",), ("lesson", "show")])
def test_a_midi_file_is_shown_the_way_to_a_lesson(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, command: tuple[str, ...]
) -> None:
    midi = tmp_path / "beat.mid"
    assert main(["lesson", "export", "rock-1", "--out", str(midi)]) == 0
    capsys.readouterr()
    assert f"`station lesson import {midi} --out beat.toml`" in refused(capsys, *command, str(midi))


def test_a_table_of_pairs_goes_into_a_folder_that_is_there(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    nowhere = tmp_path / "nowhere" / "pairs.csv"
    said = refused(capsys, "assess", "rock-1", "whatever.mid", "--pairs", str(nowhere))
    assert f"{nowhere}: there is no such folder" in said
    assert not nowhere.parent.exists()


def test_a_track_that_is_not_there_is_missed_before_its_speed(capsys: pytest.CaptureFixture[str]) -> None:
    said = refused(capsys, "practice", "rock-1", "--tempo", "30", "--track", "missing.wav", "--headless")
    assert "missing.wav: no such file" in said


def test_a_virtual_student_says_that_it_sends_nothing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ("--virtual-student", "pro", "--loops", "1", "--no-pictures", "--report", str(tmp_path / "x"))
    assert main(["practice", "rock-1", "--headless", *words, "--midi-out", "Nope"]) == 0
    assert "without sound" in capsys.readouterr().err


@pytest.mark.parametrize(("first_ms", "is_told"), [(0, True), (5, False)])
def test_a_recording_that_may_be_cut_at_its_first_stroke_is_told_to_be(
    first_ms: int, is_told: bool, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    score = find_lesson("rock-1").score
    rng = Random(3)
    late_ns = [round(rng.gauss(12, 6) * 1e6) for _ in score]
    late_ns[0] = first_ms * 1_000_000
    hits = [
        Hit(int(at) + late, n.piece, n.zone, 80) for at, late, n in zip(score.onset_ns, late_ns, score, strict=True)
    ]
    write_performance(Performance.from_hits(hits), tmp_path / "take.mid")
    assert main(["assess", "rock-1", str(tmp_path / "take.mid")]) == 0
    assert ("first stroke lies at its very beginning" in capsys.readouterr().err) is is_told


def test_a_recording_without_a_stroke_is_assessed_as_nothing_but_misses(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write_performance(Performance.from_hits([]), tmp_path / "silent.mid")
    assert main(["assess", "rock-1", str(tmp_path / "silent.mid"), "--json"]) == 0
    told = capsys.readouterr()
    assert json.loads(told.out)["counts"]["hits"] == 0
    assert told.err == ""


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("pracitce",), "no such command: pracitce; did you mean practice? (see station --help)"),
        (("--juggle",), "no such option: --juggle"),
        (("devices",), "devices: say what to do: list, monitor,"),
        (("devices", "lst"), "devices: no such verb: lst; did you mean list?"),
        (("practice", "--temop", "80"), "no such option: --temop; did you mean --tempo?"),
        (("sheet", "rock-1", "--out", "x.pdf", "--paper", "leter"), "'leter'; did you mean letter?"),
        (("devices", "learn", "--touch", "snaer"), "no such piece: 'snaer'; did you mean snare?"),
    ],
)
def test_what_was_meant_is_asked(capsys: pytest.CaptureFixture[str], words: tuple[str, ...], named: str) -> None:
    assert named in refused(capsys, *words)


@pytest.mark.parametrize(
    "words",
    [
        ("practice", "x" * 7_000),
        ("practice", "rock-1", "--virtual-student", "x" * 7_000),
        ("practice", "rock-1", "--click", "x" * 7_000),
        ("animate", "rock-1", "--out", "x.png", "--view", "x" * 7_000),
        ("x" * 7_000,),
        ("practice", f"--{'x' * 7_000}"),
    ],
)
def test_a_wrong_word_of_any_length_is_a_line_that_can_be_read(
    capsys: pytest.CaptureFixture[str], words: tuple[str, ...]
) -> None:
    assert len(refused(capsys, *words)) < 420
