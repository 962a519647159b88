"""Latency measured through a real server: a room that delays by a known number of frames.

What JACK itself adds is known too: the room's sound goes from and to the station's ports within the server, so that
none of the dummy's reported latency is real, and what comes back is a period old.
"""

import json
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

from station.core.measured_latency import load_calibration
from station.core.pieces import Piece
from tests.fakes.jack_room import KIT, STROKES, JackRoom
from tests.fakes.jack_server import JackServer, jackd_is_installed

pytestmark = [
    pytest.mark.jack,
    pytest.mark.skipif(not jackd_is_installed(), reason="jackd is not installed"),
]

DELAY_FRAMES, DELAY_MS = 960, 20.0
PERIOD_FRAMES, PERIOD_MS = 256, 256 / 48


def told(server: JackServer, program: str, **env: str) -> dict[str, object]:
    """What a program that measures prints; PortAudio is one for a whole process."""
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(program)],
        env={**server.env, **env},
        capture_output=True,
        text=True,
        timeout=100,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    document = json.loads(done.stdout)
    assert isinstance(document, dict)
    return document


def test_a_cables_delay_is_measured() -> None:
    """The way back is a period old; the output reports two periods and the input one, neither of which is there."""
    program = """
        import json
        from dataclasses import asdict
        from station.engine.latency_measurement import SoundRequest, loopback_rounds
        devices, estimate = loopback_rounds(SoundRequest(), lambda text: None, rounds=2)
        print(json.dumps({**asdict(devices), **asdict(estimate)}))
    """
    with JackServer(48_000, PERIOD_FRAMES) as server, JackRoom(server, "cable", DELAY_FRAMES):
        found = told(server, program)
    assert (found["output"], found["input"], found["kit"]) == ("system", "system", None)
    assert found["value_ms"] == pytest.approx(DELAY_MS + PERIOD_MS - 3 * PERIOD_MS, abs=1.0)
    assert found["count"] in range(8, 13)


def test_struck_pads_are_measured_and_stored(tmp_path: Path) -> None:
    """A stroke's MIDI is stamped within its period, its sound a period before: what the input reports and is not."""
    with JackServer(48_000, PERIOD_FRAMES) as server, JackRoom(server, "pads", DELAY_FRAMES) as room:
        options = ["--by", "strike", "--kit", "room", "--store", "--json"]
        with subprocess.Popen(
            [sys.executable, "-m", "station.cli.command_line", "devices", "calibrate", *options],
            env={**server.env, "XDG_CONFIG_HOME": str(tmp_path)},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        ) as station:
            assert station.stderr is not None
            assert any("strike each pad" in line for line in station.stderr)
            room.go()
            out, err = station.communicate(timeout=60)
    assert station.returncode == 0, err
    document = json.loads(out)
    kit = document["results"][0]
    assert (kit["what"], kit["device"]) == ("kit", f"{KIT}:out")
    assert DELAY_MS - 0.5 < kit["latency_ms"] < DELAY_MS + 2 * PERIOD_MS
    assert kit["count"] >= STROKES - 4
    assert document["stored"] is kit["trusted"]
    if kit["trusted"]:
        stored = load_calibration(tmp_path / "drum-station" / "calibration.toml").kits[f"{KIT}:out"]
        assert stored.kit.latency_ms == pytest.approx(kit["latency_ms"], abs=0.001)
        assert set(stored.pads) <= {Piece.SNARE, Piece.RIDE}


def test_a_drummer_who_follows_the_click_is_measured() -> None:
    """He hears a click two periods before it is reported to be heard, and strikes so much after it began."""
    program = """
        import json
        from dataclasses import asdict
        from station.devices.device_ports import DeviceRequest
        from station.engine.latency_measurement import SoundRequest, tapped
        devices, _, found = tapped(SoundRequest(), DeviceRequest("room"), lambda text: None, clicks=18)
        print(json.dumps({**asdict(devices), "total": asdict(found.total), "equipment": asdict(found.equipment)}))
    """
    with JackServer(48_000, PERIOD_FRAMES) as server, JackRoom(server, "drummer", 4 * DELAY_FRAMES):
        found = told(server, program)
    total, equipment = found["total"], found["equipment"]
    assert isinstance(total, dict)
    assert isinstance(equipment, dict)
    assert found["kit"] == f"{KIT}:out"
    assert 4 * DELAY_MS - 3 * PERIOD_MS < total["value_ms"] < 4 * DELAY_MS + PERIOD_MS
    assert any("habit" in doubt for doubt in equipment["doubts"])


CALIBRATION = """
[outputs.system]
latency_ms = -3.5
half_ms = 0.1
by = "loopback"
on = 2026-01-31
"""


@pytest.mark.parametrize("measured", [False, True])
def test_the_doctor_names_what_is_not_measured(tmp_path: Path, measured: bool) -> None:
    if measured:
        (tmp_path / "drum-station").mkdir()
        (tmp_path / "drum-station" / "calibration.toml").write_text(CALIBRATION)
    program = """
        import json
        from station.app.equipment.diagnostics import check_calibration
        check = check_calibration()
        print(json.dumps({"works": check.works, "finding": check.finding, "remedy": check.remedy}))
    """
    with JackServer(48_000, PERIOD_FRAMES) as server:
        found = told(server, program, XDG_CONFIG_HOME=str(tmp_path))
    if measured:
        assert found == {"works": True, "finding": "system -3.5 ms (loopback, 2026-01-31)", "remedy": ""}
    else:
        remedy = "station devices calibrate --by loopback"
        assert found == {"works": False, "finding": "system is not measured", "remedy": remedy}


def test_silence_is_told_in_one_line() -> None:
    with JackServer(48_000, PERIOD_FRAMES) as server:
        done = subprocess.run(
            [
                sys.executable,
                "-m",
                "station.cli.command_line",
                "devices",
                "calibrate",
                "--by",
                "strike",
                "--kit",
                "no such kit",
            ],
            env=server.env,
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )
    assert done.returncode == 2
    assert "no port is called 'no such kit'" in done.stderr
    assert "Traceback" not in done.stderr
