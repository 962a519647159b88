"""Ten minutes, 20,000 strokes, while the real window draws: what is lost, what has no sound, how late it is.

    PYTHONPATH=. .venv/bin/python benchmarks/ten_minutes.py [--seconds 600] [--a-second 33.4] [--period 128]

A kit in a process of its own plays through JACK into `station practice`, the program as a student starts it: its window
on a screen (Xvfb's where there is none), its engine, its session and its report. Nothing of the station is called from
here. Counted are the strokes that were sent, those in the session's capture, those that the window's session judged
(its report), as against the capture judged again, those that a frame showed, and those of which JACK got a sound, each
stroke its own. A server of its own has a client that does nothing, in the same minutes: the periods that even it was
late for, and the time that a host took from this machine, tell what of ours is ours.

Targets (DESIGN § 8; a period of P ms): none lost, none without a sound, no more late periods than the client that does
nothing; stroke to sound median ≤ P + 0.7 and p99 ≤ P + 2 ms; stroke to picture p99 ≤ a frame + 5 ms with a graphics
card, + 20 ms without.
"""

import argparse
import json
import re
import subprocess
import sys
import tempfile
import time
from collections import Counter
from dataclasses import dataclass
from math import ceil
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from benchmarks.hit_to_sound import MATCH_NS, RATE_HZ, BareClient, onsets_ns, pulse_kit, stolen_s, strokes
from station.bench.rigs.devices.jack_server import JackServer
from station.bench.rigs.xvfb import a_screen, installed
from station.bench.rows.window_rows import late_ms
from station.core.events import Hit
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.capture.capture import read_capture
from station.devices.capture.replay import replay
from station.practice.history.session_files import CAPTURE_NAME, DOCUMENT_NAME
from station.practice.records.rejudge import judge_again
from tests.fakes.jack_recorder import JackRecorder
from tests.fakes.kit_player import KitPlayer, Stroke

KIT = "TD-17 fake kit"
_KICK, _HAT = 36, 42
_VELOCITIES = range(40, 128)
_FIRST_S = 4.0
"""The strokes begin so long after the two kicks that begin the session: in its count-in, or soon after."""
_FOUND_S, _ENDS_S, _SOUNDS_WITHIN_S = 3.0, 30.0, 60.0
_PASS_S = 6.0
"""Two bars of the first lesson at its own tempo."""
_LATE = re.compile(r"XRun: client = (\S+)")


@dataclass(frozen=True, eq=False)
class Run:
    """What came of it: when which velocity was sent, what the window reported, where the session lies, the sounds."""

    sent: list[tuple[int, int]]
    watched: dict[str, list[list[int]]]
    sessions: Path
    sounds_ns: NDArray[np.int64]
    late: Counter[str]
    beside: str


def plan(seconds: float, a_second: float) -> list[Stroke]:
    """Two kicks that begin the session, then strokes at random times, each known again by its velocity."""
    kicks = [Stroke(at_ns, bytes((0x99, _KICK, 100))) for at_ns in (0, 400 * NS_PER_MS)]
    hats = [
        Stroke(round(_FIRST_S * NS_PER_S) + at_ns, bytes((0x99, _HAT, _VELOCITIES[index % len(_VELOCITIES)])))
        for index, (at_ns, _) in enumerate(strokes(seconds, a_second))
    ]
    return [*kicks, *hats]


def play(home: Path, period: int, seconds: float, a_second: float) -> Run:
    """Play it all, at `home`; raises `RuntimeError` where the window does not end in order."""
    lasts_s = _FOUND_S + _FIRST_S + seconds + _ENDS_S
    with (
        a_screen() as screen,
        JackServer(RATE_HZ, period) as server,
        BareClient(period) as bare,
    ):
        if screen is None:
            raise RuntimeError("no screen, and no Xvfb to make one")
        (home / "kit").mkdir()
        (home / "drum-station").mkdir()
        (home / "drum-station" / "settings.toml").write_text(
            f"welcomed = true\nsessions = '{home}/sessions'\nkit = '{KIT}'\noutput = 'jack'\n"
            f"drums = '{pulse_kit(home / 'kit')}'\nlevels = 'click=0 demonstration=0'\n",
            "utf-8",
        )
        environment = {
            **installed(str(home)),
            **server.env,
            **screen,
            "XDG_CONFIG_HOME": str(home),
            "XDG_DATA_HOME": str(home),
        }
        words = ["practice", "--watch-seconds", f"{lasts_s:g}", "--no-demonstration", "--no-adapt"]
        words += ["--loops", str(ceil((seconds + _FIRST_S) / _PASS_S))]
        with (
            KitPlayer(server, KIT, plan(seconds, a_second), home) as kit,
            JackRecorder(server, home) as recorder,
            subprocess.Popen(
                [sys.executable, "-m", "station.cli.command_line", *words],
                stdout=subprocess.PIPE,
                text=True,
                env=environment,
            ) as window,
        ):
            assert window.stdout is not None
            window.stdout.readline()  # its first frame
            _until_sounding(server)
            recorder.connect("PortAudio:.*")
            time.sleep(_FOUND_S)
            bare.begin()
            stolen_before_s, late_before = stolen_s(), _late_periods(server)
            kit.play(time.monotonic_ns() + NS_PER_S // 10)
            sent = [(stroke.at_ns, stroke.data[2]) for stroke in kit.truth() if stroke.data[1] == _HAT]
            late = _late_periods(server) - late_before
            beside = f"{bare.underflows()} of a client that does nothing, {stolen_s() - stolen_before_s:.1f} s stolen"
            said = window.stdout.readlines()  # until its time is over
            heard = recorder.stop()
        if window.returncode:
            raise RuntimeError(f"the window ended with exit status {window.returncode}")
        return Run(sent, json.loads(said[-1]), home / "sessions", onsets_ns(heard), late, beside)


def _until_sounding(server: JackServer) -> None:
    """Wait until the station plays into JACK, and its kit is connected; raises `RuntimeError` where that takes long."""
    import jack  # noqa: PLC0415 - needs JACK's library, which a machine may lack

    give_up_s = time.monotonic() + _SOUNDS_WITHIN_S
    with jack.Client("asks", servername=server.name, no_start_server=True) as client:
        while time.monotonic() < give_up_s:
            kit = client.get_ports(f"{KIT}.*", is_midi=True, is_output=True)
            if client.get_ports("PortAudio:.*") and any(client.get_all_connections(port) for port in kit):
                return
            time.sleep(0.1)
    raise RuntimeError(f"the station does not sound within {_SOUNDS_WITHIN_S:g} s")


def _late_periods(server: JackServer) -> Counter[str]:
    """How often the server says that it went on without which of its clients."""
    return Counter(_LATE.findall(server._read_log()))


def report(run: Run, period: int) -> None:
    """Print what was measured, a line a figure."""
    sent_ns = np.array([at_ns for at_ns, _ in run.sent], np.int64)
    period_ms = 1000.0 * period / RATE_HZ
    minutes = (sent_ns[-1] - sent_ns[0]) / NS_PER_S / 60.0
    print(f"{len(sent_ns)} strokes in {minutes:.1f} min, {period} frames, a period of {period_ms:.2f} ms")
    _print_kept(run)
    sounds_ns = run.sounds_ns
    place = np.minimum(np.searchsorted(sounds_ns, sent_ns), len(sounds_ns) - 1)
    wait_ns = sounds_ns[place] - sent_ns
    sounded = (wait_ns >= 0) & (wait_ns < MATCH_NS)
    own = len(np.unique(place[sounded]))
    wait_ms = wait_ns[sounded] / NS_PER_MS
    print(f"  without a sound {len(sent_ns) - own}")
    print(f"  late periods    {dict(run.late) or 0} ({run.beside})")
    print(f"  stroke to sound median {np.median(wait_ms):.2f} ms (≤ {period_ms + 0.7:.2f})", end="")
    print(f", p99 {np.percentile(wait_ms, 99):.2f} ms (≤ {period_ms + 2.0:.2f})")
    shown_ns = np.array(run.watched["shown_ns"], np.int64)
    during = shown_ns[(shown_ns > sent_ns[0]) & (shown_ns < sent_ns[-1])]
    frame_ms = float(np.median(np.diff(during))) / NS_PER_MS
    late = late_ms(run.sent, [(at_ns, velocity) for at_ns, velocity in run.watched["lit"] if at_ns > sent_ns[0]])
    print(f"  frames          {len(during)}, {1000 / frame_ms:.1f} a second; a frame {frame_ms:.1f} ms")
    median, p99 = np.percentile(late, (50, 99))
    print(f"  stroke to picture median {median:.1f} ms, p99 {p99:.1f} (a frame + 20: {frame_ms + 20:.1f})", end="")
    print(f"; {len(late)} of {len(sent_ns)} strokes were seen on a frame", flush=True)


def _print_kept(run: Run) -> None:
    """What is in the capture, and what the session in the window was told of it."""
    (path,) = run.sessions.rglob(CAPTURE_NAME)
    capture = read_capture(path)
    hats = [event for event in replay(capture) if isinstance(event, Hit) and event.midi_note == _HAT]
    in_order = [hit.velocity for hit in hats] == [velocity for _, velocity in run.sent]
    print(f"  in the capture  {len(hats)}, {'all in order' if in_order else 'NOT ALL'}, complete: {capture.complete}")
    document = json.loads((path.parent / DOCUMENT_NAME).read_text("utf-8"))
    (again,) = judge_again(capture)
    counts = document["counts"]
    unheard = document["session"]["unheard"]
    print(f"  judged live     {counts['hits']} hits; of the capture {len(again.result().performance)}", end="")
    print(f"; unknown {counts['unknown']}, unheard {unheard}")


def main() -> None:
    """Play and report."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=600.0)
    parser.add_argument("--a-second", type=float, default=33.4)
    parser.add_argument("--period", type=int, default=128)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as home:
        report(play(Path(home), arguments.period, arguments.seconds, arguments.a_second), arguments.period)


if __name__ == "__main__":
    main()
