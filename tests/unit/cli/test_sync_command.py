"""`station sync`: a made-up walker fitted and tracked, and what is said of wrong input."""

import json
from pathlib import Path

import numpy as np
import pytest

from station.cli.command_line import main
from station.sync.phase.phase_tracker import ADAPTIVE

RATE_HZ, PERIOD_S = 100, 1.25


def walker(path: Path, period_s: float = PERIOD_S, posture: float = 0.0) -> Path:
    """Six seconds of two legs and an arm as a table."""
    time_s = np.arange(0, 6, 1 / RATE_HZ)
    turn = 2 * np.pi * time_s / period_s
    columns = [time_s, 20 * np.sin(turn - 1) + posture, -20 * np.sin(turn - 1) - posture, 15 * np.cos(turn)]
    np.savetxt(path, np.stack(columns, axis=1), "%.6f", ",", header="time_s,right,left,arm", comments="")
    return path


@pytest.fixture
def model(tmp_path: Path) -> Path:
    path = tmp_path / "walk.toml"
    assert main(["sync", "fit", str(walker(tmp_path / "walk.csv")), "--out", str(path)]) == 0
    return path


def test_fit_says_what_it_found(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "walk.toml"
    exemplars = [str(walker(tmp_path / "a.csv")), str(walker(tmp_path / "b.csv", posture=5.0))]
    words = [
        "sync",
        "fit",
        *exemplars,
        "--out",
        str(out),
        "--channels",
        "right,left",
        "--all-cycles",
        "--centres",
        "12",
    ]
    assert main([*words, "--reference", "arm"]) == 0
    told = capsys.readouterr()
    # a cosine rises through 0 at three quarters of its period: 0.94, 2.19, 3.44, 4.69 and 5.94 s, four cycles a file
    assert told.err == f"model    {out}: 2 channels, 12 centres, 8 cycles, period 1.250 s\n"
    assert told.out == ""


@pytest.mark.parametrize("words", [(), ("--paper",), ("--zero-mean", "high-pass"), ("--ages", "0,10")])
def test_track_prints_one_document(
    model: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], words: tuple[str, ...]
) -> None:
    signal = walker(tmp_path / "other.csv", 1.0, posture=8.0)
    capsys.readouterr()
    assert main(["sync", "track", str(model), str(signal), "--json", *words]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["schema"] == "drum-station/sync-track/1"
    assert document["channels"] == ["right", "left", "arm"]
    assert document["time_s"][:3] == [0, 0.01, 0.02]
    phase = np.array(document["phase_rad"])
    assert len(phase) == len(document["quality"]) == 600
    assert phase.min() > -np.pi
    assert phase.max() <= np.pi
    # right rises through its mean, phase 0, at (1 + 2πn) of its turn
    error = (phase - (2 * np.pi * np.array(document["time_s"]) - 1) + np.pi) % (2 * np.pi) - np.pi
    assert np.abs(error[300:]).mean() < 0.3
    assert np.median(document["quality"]) > 0.9
    assert all(document["locked"][300:])


def test_track_prints_a_table(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    capsys.readouterr()
    assert main(["sync", "track", str(model), str(model.with_name("walk.csv"))]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split() == ["time_s", "phase_rad", "quality", "confidence", "cadence_rad", "locked"]
    assert len(lines) == 601
    assert lines[-1].split()[0] == "5.9900"
    assert lines[-1].endswith(" yes")


@pytest.mark.parametrize(("period", "length_s"), [("0.5:1.75", 1.25), ("4.75:6", 1.25), ("0:6", 6)])
def test_the_period_can_be_said(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], period: str, length_s: float
) -> None:
    words = ["sync", "fit", str(walker(tmp_path / "a.csv")), "--out", str(tmp_path / "a.toml"), "--channels", "right"]
    assert main([*words, "--period", period]) == 0
    assert f"1 channel, 16 centres, 1 cycle, period {length_s:.3f} s" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "fault"),
    [
        (("fit", "{csv}", "--out", "{toml}", "--centres", "2"), "--centres: expected 3 to 4096, found 2"),
        (("fit", "{csv}", "--out", "{toml}", "--channels", "rihgt"), "no such channel: rihgt; did you mean right"),
        (("fit", "{csv}", "--out", "{toml}", "--reference", "leg"), "no such channel: leg"),
        (("fit", "{csv}", "--out", "{toml}", "--period", "9:10"), "9 to 10 s: expected at least 4 samples in a cycle"),
        (("fit", "{csv}", "--out", "{toml}", "--period", "5:7"), "5 to 7 s: expected a cycle within 0 to 6 s"),
        (("fit", "{csv}", "--out", "{toml}", "--period=-1:1"), "-1 to 1 s: expected a cycle within 0 to 6 s"),
        (("fit", "{csv}", "--out", "{toml}", "--channels", "right,right"), "expected each channel once"),
        (("fit", "{still}", "--out", "{toml}", "--period", "0:1"), "expected a motion, found every channel still"),
        (("fit", "{csv}", "--out", "{toml}", "--period", "2:1"), "expected a period that ends after it begins"),
        (("fit", "{csv}", "{csv}", "--out", "{toml}", "--period", "1:2"), "--period: expected one EXEMPLAR"),
        (("fit", "{csv}", "--out", "{toml}", "--period", "1:2", "--reference", "right"), "not allowed with"),
        (("fit", "{csv}x", "--out", "{toml}"), "expected a name that ends in"),
        (("track", "{csv}", "{csv}"), "walk.csv: line 1"),
        (("track", "{model}", "{toml}"), "expected a name that ends in"),
        (("track", "{model}", "{csv}", "--lambda", "-1"), "--lambda: expected a number from 0"),
        (("track", "{model}", "{csv}", "--cadence", "4"), "--cadence: expected a number from 0"),
        (("track", "{model}", "{csv}", "--ages", "1,2"), "--ages: expected ages of samples, each once, the first 0"),
        (("track", "{model}", "{csv}", "--feedback", "nan"), "--feedback: expected a number from 0"),
    ],
)
def test_wrong_input_is_named(
    model: Path, capsys: pytest.CaptureFixture[str], words: tuple[str, ...], fault: str
) -> None:
    places = {"csv": model.with_name("walk.csv"), "model": model, "toml": model.with_name("out.toml")}
    places["still"] = model.with_name("still.csv")
    places["still"].write_text("time_s,left\n" + "".join(f"{at / 100},5.1\n" for at in range(200)))
    capsys.readouterr()
    assert main(["sync", *(word.format(**places) for word in words)]) == 2
    told = capsys.readouterr()
    assert fault in told.err
    assert told.err.count("\n") == 1
    assert told.out == ""
    assert not places["toml"].exists()


def test_a_signal_that_is_too_slow_for_the_model(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    slow = model.with_name("slow.csv")
    slow.write_text("time_s,right,left,arm\n0,1,2,3\n1,2,3,4\n2,3,4,5\n")
    capsys.readouterr()
    assert main(["sync", "track", str(model), str(slow)]) == 2
    assert "has fewer than 2 samples in the model's period of 1.25 s" in capsys.readouterr().err


def test_help_says_the_feedback_that_is_taken(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["sync", "track", "--help"])
    assert f"changes the cadence ({ADAPTIVE.feedback})" in " ".join(capsys.readouterr().out.split())
