"""Captures, lessons, text scores and MIDI files made to do harm, given to every command that reads them.

    PYTHONPATH=. .venv/bin/python benchmarks/hostile_files.py [--files 300] [--seed 1] [--keep FOLDER]

Each command runs on each file in a process of its own, forked from one that has everything imported. It must read the
file or refuse it with one line and exit status 2, within 2 s of processor time and 300 MB of memory of its own. What
does not is printed, and kept in `--keep`. The kinds of files are the classes of docs/faults.md, lines 5, 6, 7 and 14;
the numbers in them are drawn anew with each seed.
"""

import argparse
import contextlib
import io
import json
import os
import random
import resource
import struct
import sys
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from station.cli.command_line import main as station
from station.devices.capture.capture import CaptureRecord, RecordKind, device_record, start_record
from station.drills.library import find_lesson
from station.practice.session.device_latency import Latency
from station.practice.session.event_log import PassBegan, text_of
from station.practice.session.plan import PlanOptions, plan_practice
from tests.fakes.captures import capture_bytes

LIMIT_S, LIMIT_MB = 2.0, 300.0
_STOP_S = 12
"""Of processor time, after which a command is ended."""
_ROOM = 700 << 20
"""So much address space a command may take beyond its parent's before it gets `MemoryError`."""
_DIGITS = "9" * 5000
KIT = "TD-17"
Make = Callable[[random.Random], bytes]


# --- captures ---------------------------------------------------------------------------------------------------------


def _far(draw: random.Random) -> int:
    return draw.choice((0, 1, -1, 2**31, 2**53, 2**62, 2**62 + 1, 2**63 - 1, -(2**62), -(2**63), draw.getrandbits(62)))


def _bytes(at_ns: int, data: bytes, device: int = 1) -> CaptureRecord:
    return CaptureRecord(RecordKind.BYTES, device, at_ns, data)


def _log(at_ns: int, text: str) -> CaptureRecord:
    return CaptureRecord(RecordKind.ANNOTATION, 0, at_ns, text.encode())


def _head(kit: str | None = None, preset: str = "general-midi") -> list[CaptureRecord]:
    return [start_record(0, 0), device_record(1, 0, KIT, preset, kit)]


def huge_records(draw: random.Random) -> bytes:
    """Byte records of megabytes: strokes, pedals, running status, system exclusive without end."""
    unit = draw.choice(
        (b"\x99\x26\x64", b"\x26\x64", b"\xb9\x04\x7f", b"\xf0\x41\x10", b"\xf8", b"\x99", b"\xf7\xf0", b"\x00")
    )
    data = draw.choice((b"\x99", b"", b"\xf0")) + unit * (draw.choice((10**4, 10**6, 6 * 10**6)) // len(unit))
    return capture_bytes([*_head(), *(_bytes(10**9 * (k + 1), data) for k in range(draw.choice((1, 3))))])


def many_devices(draw: random.Random) -> bytes:
    """A table of devices without end, the same again and again, or with names of a megabyte."""
    count = draw.choice((1_000, 20_000, 65_535))
    same = draw.random() < 0.5
    name = "n" * draw.choice((1, 10, 200))
    devices = [
        device_record(1 if same else k % 65_536, k, f"{name}{0 if same else k}", "general-midi") for k in range(count)
    ]
    strokes = [_bytes(k * 10**6, b"\x99\x26\x64", draw.randrange(65_536)) for k in range(500)]
    return capture_bytes([start_record(0, 0), *devices, *strokes])


def kit_tables(draw: random.Random) -> bytes:
    """A kit of the user's own whose text is hostile TOML, once or with every device anew."""
    deep = ".".join("a" * draw.choice((1, 2)) for _ in range(draw.choice((50, 2_000, 60_000))))
    text = draw.choice(
        (
            f"{deep} = 1\n",
            f"[{deep}]\nx = 1\n",
            f"base = 'general-midi'\nmask_ms = {_DIGITS}\n",
            f"base = 'general-midi'\nmask_ms = {draw.choice(('1e999', '-1', 'nan', '1e308', '0x' + 'f' * 9_000))}\n",
            "base = 'general-midi'\n" + "".join(f"[pads.p{k}]\nthreshold = 3\n" for k in range(20_000)),
            "x = " + "[" * 5_000 + "]" * 5_000,
            "x = " + "{a=" * 3_000 + "1" + "}" * 3_000,
            "\n".join(f"[[a{'.b' * (k % 300)}]]" for k in range(3_000)),
            "base = 'general-midi'\n[notes]\n" + "".join(f"{k} = 'snare'\n" for k in range(50_000)),
        )
    )
    times = draw.choice((1, 1, 300))
    return capture_bytes(
        [r for k in range(times) for r in (device_record(1, k, KIT, "own", text), _bytes(k, b"\x99\x26\x64"))]
    )


def far_times(draw: random.Random) -> bytes:
    """Strokes and everything else at times that no clock has, and at ones that lie ages apart."""
    records = _head()
    for k in range(draw.choice((2, 50, 2_000))):
        at_ns = draw.choice((k * 10**8, _far(draw)))
        kind = draw.choice((RecordKind.BYTES, RecordKind.BYTES, RecordKind.STROKE, RecordKind.ZERO, RecordKind.SETTLED))
        payload = {
            RecordKind.BYTES: b"\x99\x26\x64",
            RecordKind.STROKE: struct.pack("<BBBBf", 1, 0, 0, 90, float("nan")),
        }.get(kind, b"")
        records.append(CaptureRecord(kind, 1, max(min(at_ns, 2**63 - 1), -(2**63)), payload))
    return capture_bytes(records)


def many_records(draw: random.Random) -> bytes:
    """Very many small records of one kind, with payloads of every length."""
    kind, count = draw.choice(list(RecordKind)), draw.choice((1_000, 30_000, 100_000))
    return capture_bytes(
        [
            *_head(),
            *(
                CaptureRecord(kind, draw.choice((0, 1, 9)), k * 10**6, draw.randbytes(draw.randrange(12)))
                for k in range(count)
            ),
        ]
    )


def log_texts(draw: random.Random) -> bytes:
    """What a session said of itself, its numbers and lists driven beyond sense."""
    plan = plan_practice(find_lesson("rock-1"), PlanOptions(demonstrations=0, loops=draw.choice((1, 4))))
    fields = json.loads(text_of(PassBegan(0, plan, Latency(), draw.random() < 0.5)))
    for _ in range(draw.choice((1, 1, 2, 4))):
        key = draw.choice(list(fields))
        old = fields[key]
        fields[key] = draw.choice((2**31, 2**61, -1, 0, 1, 1e308, None, "x" * 1_000, [], {}, True, 999, 10**6, 2**32))
        if isinstance(old, list) and old and draw.random() < 0.7:
            fields[key] = draw.choice(
                (
                    old * 20_000,
                    [old[0]] * 3,
                    old[:1] * 100_000,
                    [[2**31] * len(old[0])] if isinstance(old[0], list) else old,
                )
            )
            if draw.random() < 0.4 and isinstance(old[0], list):
                row = draw.randrange(len(old))
                fields[key] = [list(one) for one in old]
                fields[key][row][draw.randrange(len(old[row]))] = draw.choice((2**31, 2**62, -1, 10**9, 1e300, None))
    text = json.dumps(fields) if draw.random() < 0.9 else json.dumps(fields).replace("1", _DIGITS, 1)
    strokes = [_bytes(3 * 10**9 + k * 10**8, b"\x99\x26\x64") for k in range(draw.choice((0, 20, 3_000)))]
    said = [_log(0, text)] * draw.choice((1, 1, 40))
    extra = draw.choice(
        (
            {"said": "unheard", "strokes": 0, "from_ns": _far(draw), "until_ns": _far(draw)},
            {"said": "pause", "strokes": 2**40, "now_ns": _far(draw), "command": []},
            {"said": "go_on", "strokes": 0, "asked": 1, "whole": 0},
            {"said": "end", "strokes": 0, "now_ns": _far(draw)},
        )
    )
    return capture_bytes(
        [*_head(), *said, CaptureRecord(RecordKind.ZERO, 0, 10**9), *strokes, _log(10**10, json.dumps(extra))]
    )


# --- lessons and text scores ------------------------------------------------------------------------------------------


def numbers_of_digits(draw: random.Random) -> bytes:
    """A number of 5,000 digits, or one that is none, wherever the format has a number."""
    shipped = Path(find_lesson_file(draw)).read_text("utf-8")
    lines = shipped.splitlines()
    places = [k for k, line in enumerate(lines) if "=" in line and any(c.isdigit() for c in line.partition("=")[2])]
    for k in draw.sample(places, min(len(places), draw.choice((1, 1, 3)))):
        lines[k] = (
            lines[k].partition("=")[0]
            + "= "
            + draw.choice(
                (
                    _DIGITS,
                    f"-{_DIGITS}",
                    "1e999",
                    "nan",
                    "-inf",
                    f"{_DIGITS}.5",
                    "0x" + "f" * 6_000,
                    "2026-99-99",
                    "[" * 3_000,
                    f"'{_DIGITS}'",
                )
            )
        )
    return "\n".join(lines).encode()


def very_many_notes(draw: random.Random) -> bytes:
    """Bars as long and as fine as the format lets them be, and as many; legal, or nearly."""
    beats, letters = draw.choice((2, 4, 7, 32)), draw.choice((1, 2, 4, 8, 16, 32))
    bars = draw.choice((1, 8, 50, 150, 199, 400))
    lines = draw.choice((_HANDS, _BOTH, (("snare", draw.choice("dz")),), _HANDS + _BOTH))
    rows = [
        f'{piece} = "| {" ".join([stroke * letters] * beats)} |{f" %{bars - 1}" if bars > 1 else ""}"'
        for piece, stroke in lines
    ]
    tempo_bpm = draw.choice((30, max(30, 200 // letters)))
    return "\n".join(('title = "x"', f"tempo_bpm = {tempo_bpm}", "[grid]", f'meter = "{beats}/4"', *rows, "")).encode()


_HANDS, _BOTH = (("hihat", "x"),), (("snare", "o"), ("kick", "o"))


def long_lessons(draw: random.Random) -> bytes:
    """A shipped lesson whose lines of characters are many times as long, or whose bars come many times."""
    lines = Path(find_lesson_file(draw)).read_text("utf-8").splitlines()
    places = [k for k, line in enumerate(lines) if "|" in line or "x" in line.partition("=")[2]]
    times = draw.choice((50, 400, 3_000))
    for k in draw.sample(places, min(len(places), draw.choice((1, 5, 99)))):
        name, _, cells = lines[k].partition("=")
        inner = cells.strip().strip("\"'")
        lines[k] = f"{name}= '{(inner + '|') * times if '|' in inner else inner * times}'"
    return "\n".join(lines)[:900_000].encode()


def text_scores(draw: random.Random) -> bytes:
    """A text score whose last stroke lies far away, or whose numbers are no music's."""
    far = draw.choice(("1e9", "86400", "3e5", "1e18", "1e300", "-5", _DIGITS, "nan", "900000.0001"))
    rows = [f"{0.25 * k} snare 80 - 0" for k in range(draw.choice((2, 50)))]
    rows.append(f"{far} snare 80 - 0")
    shipped = SCORE_TEXT.splitlines()
    notes = [k for k, line in enumerate(shipped) if line[:1].isdigit()]
    lines = list(shipped)
    if notes:
        first, _, rest = lines[notes[-1]].partition(" ")
        lines[notes[-1]] = f"{draw.choice((far, first))} {rest}"
        if draw.random() < 0.4:
            k = draw.choice(notes)
            words = lines[k].split()
            words[draw.randrange(len(words))] = draw.choice((far, _DIGITS, "snare", "", "999999"))
            lines[k] = " ".join(words)
    return "\n".join(lines if draw.random() < 0.9 else rows).encode()


def midi(draw: random.Random) -> bytes:
    """A MIDI file with a last stroke far away, tempi and meters that no music has, very many events or tracks."""
    delta = draw.choice((b"\xff\xff\xff\x7f", b"\x83\x60", b"\x00", b"\x8f\xff\xff\x7f"))
    events = [
        b"\x00\x99\x26\x64",
        delta + b"\x99\x26\x64",
        b"\x00\xff\x51\x03" + draw.randbytes(3),
        b"\x00\xff\x58\x04" + draw.randbytes(4),
    ]
    body = b"".join(draw.choice(events) for _ in range(draw.choice((3, 100, 60_000))))
    track = b"MTrk" + struct.pack(">I", len(body) + 4) + body + b"\x00\xff\x2f\x00"
    tracks = draw.choice((1, 1, 1, 200 if len(body) < 1_000 else 2))
    division = draw.choice((480, 96, 1, 32_767, 0xE728, 0))
    return b"MThd" + struct.pack(">IHHH", 6, draw.choice((0, 1)), tracks, division) + track * tracks


def find_lesson_file(draw: random.Random) -> Path:
    """A lesson that ships, drawn."""
    return draw.choice(_LESSON_FILES)


_LESSON_FILES = sorted((Path(__file__).parent.parent / "lessons").rglob("*.toml"))[::12]
SCORE_TEXT = ""


# --- the commands -----------------------------------------------------------------------------------------------------

CAPTURES = (huge_records, many_devices, kit_tables, far_times, many_records, log_texts)
LESSONS = (numbers_of_digits, very_many_notes, long_lessons)
READERS: dict[str, tuple[Make, ...]] = {
    ".capture": CAPTURES,
    ".toml": LESSONS,
    ".txt": (text_scores,),
    ".mid": (midi,),
}
_HEADLESS = ("--headless", "--virtual-student", "pro", "--loops", "1", "--no-demonstration", "--no-pictures")
_READ_ALL = {
    "assess": ("assess", "rock-1", "FILE"),
    "assess it": ("assess", "FILE", "good.mid"),
    "limbs": ("limbs", "FILE"),
    "sheet": ("sheet", "FILE", "--out", "OUT.pdf"),
    "animate .npz": ("animate", "FILE", "--seconds", "3", "--out", "OUT.npz"),
    "animate .bvh": ("animate", "FILE", "--seconds", "3", "--out", "OUT.bvh"),
    "animate .glb": ("animate", "FILE", "--seconds", "3", "--out", "OUT.glb"),
    "lesson export": ("lesson", "export", "FILE", "--out", "OUT.mid"),
    "lesson import": ("lesson", "import", "FILE", "--out", "OUT.toml"),
}
COMMANDS: dict[str, dict[str, tuple[str, ...]]] = {
    ".capture": {
        **{k: v for k, v in _READ_ALL.items() if k != "assess it"},
        "replay": ("devices", "replay", "FILE", "--json"),
    },
    ".toml": {
        **{k: v for k, v in _READ_ALL.items() if k not in ("assess", "lesson import")},
        "practice": ("practice", "FILE", *_HEADLESS, "--report", "OUTDIR"),
        "lesson check": ("lesson", "check", "FILE"),
        "lesson show": ("lesson", "show", "FILE"),
    },
    ".txt": {k: v for k, v in _READ_ALL.items() if k not in ("assess it",)},
    ".mid": _READ_ALL,
}


@dataclass
class Tally:
    """What came of one command."""

    runs: int = 0
    refused: int = 0
    slowest_s: float = 0.0
    most_mb: float = 0.0
    faults: int = 0

    @property
    def line(self) -> str:
        """All of it in words."""
        most = f"slowest {self.slowest_s:5.2f} s, most {self.most_mb:4.0f} MB"
        return f"{self.runs:5} runs, {self.refused:4} refused, {most}, {self.faults} faults"


@dataclass(frozen=True, slots=True)
class Ended:
    """How a command ended: its exit status, processor time, memory beyond its parent's, and its last words."""

    code: int
    seconds: float
    mb: float
    said: str

    @property
    def fault(self) -> str:
        """What is wrong with it, empty where nothing is."""
        if self.code < 0:
            return f"ended by signal {-self.code}"
        if "Traceback" in self.said or self.code not in (0, 1, 2):
            return f"exit {self.code}: {self.said.strip().splitlines()[-1][:200] if self.said.strip() else ''}"
        if self.seconds > LIMIT_S:
            return f"{self.seconds:.1f} s"
        return f"{self.mb:.0f} MB" if self.mb > LIMIT_MB else ""


def run(words: list[str], folder: Path) -> Ended:
    """Run a command in a fork of this process."""
    said = folder / "said"
    pid = os.fork()
    if not pid:
        _child(words, said)
    _, status, used = os.wait4(pid, 0)
    code = os.waitstatus_to_exitcode(status)
    seconds, mb = used.ru_utime + used.ru_stime, used.ru_maxrss / 1024 - _own_mb()
    return Ended(code, seconds, mb, said.read_text("utf-8", "replace") if said.exists() else "")


def _own_mb() -> float:
    pages = int(Path("/proc/self/statm").read_text("ascii").split()[1])
    return pages * resource.getpagesize() / 2**20


def _child(words: list[str], said: Path) -> None:
    taken = int(Path("/proc/self/statm").read_text("ascii").split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_CPU, (_STOP_S, _STOP_S + 1))
    resource.setrlimit(resource.RLIMIT_AS, (taken + _ROOM,) * 2)
    out, err = os.open(os.devnull, os.O_RDWR), os.open(said, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
    for standard, other in ((0, out), (1, out), (2, err)):
        os.dup2(other, standard)
    code = 70
    try:
        code = station(words)
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else 1
    except BaseException:
        import traceback  # noqa: PLC0415 - rarely

        traceback.print_exc()
    finally:
        sys.stderr.flush()
        os._exit(code)


def attack(ending: str, asked: argparse.Namespace, folder: Path) -> Iterator[tuple[str, Tally]]:
    """Give as many files of this ending as were `asked` for to its commands; the tally of each command."""
    tallies = {name: Tally() for name in COMMANDS[ending]}
    makers = READERS[ending]
    for number in range(asked.files):
        make = makers[number % len(makers)]
        path = folder / f"x{ending}"
        path.write_bytes(make(random.Random(f"{asked.seed} {ending} {number}")))
        for name in random.Random(number).sample(list(tallies), min(asked.each, len(tallies))):
            fault = _one(COMMANDS[ending][name], tallies[name], path)
            if fault:
                print(f"    {name} of {make.__name__}-{asked.seed}-{number}{ending}: {fault}", flush=True)
                if asked.keep is not None:
                    asked.keep.mkdir(parents=True, exist_ok=True)
                    (asked.keep / f"{make.__name__}-{asked.seed}-{number}{ending}").write_bytes(path.read_bytes())
    yield from tallies.items()


def _one(words: tuple[str, ...], tally: Tally, path: Path) -> str:
    """Run one command on one file; what is wrong with how it ended."""
    for old in path.parent.glob("OUT.*"):
        old.unlink()
    own = {"FILE": str(path)}
    own |= {word: str(path.parent / word) for word in words if word.startswith(("OUT", "good"))}
    ended = run([own.get(word, word) for word in words], path.parent)
    tally.runs += 1
    tally.refused += ended.code == 2
    tally.slowest_s, tally.most_mb = max(tally.slowest_s, ended.seconds), max(tally.most_mb, ended.mb)
    tally.faults += bool(ended.fault)
    return ended.fault


_FIRST: tuple[tuple[str, ...], ...] = (
    ("lesson", "export", "rock-1", "--out", "good.mid"),
    ("limbs", "rock-1", "--text", "good.txt"),
    ("sheet", "rock-1", "--out", "good.pdf"),
    ("animate", "rock-1", "--seconds", "1", "--out", "good.glb"),
    ("practice", "rock-1", *_HEADLESS, "--report", "good"),
    ("assess", "rock-1", "good.mid"),
)
"""What is run first, so that all is imported before there are forks."""


def main() -> None:
    """Attack, and print a table."""
    global SCORE_TEXT  # noqa: PLW0603 - made by the station itself, once
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--files", type=int, default=300, help="of each ending")
    parser.add_argument("--each", type=int, default=99, help="give a file to so many of the commands, drawn")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--endings", nargs="+", default=list(COMMANDS))
    parser.add_argument("--keep", type=Path, default=None)
    asked = parser.parse_args()
    asked.keep = asked.keep and asked.keep.resolve()
    faults = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        os.environ["XDG_CONFIG_HOME"] = os.environ["XDG_DATA_HOME"] = name
        os.chdir(folder)
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            for words in _FIRST:
                station(list(words))
        SCORE_TEXT = (folder / "good.txt").read_text("utf-8")
        for ending in asked.endings:
            for command, tally in attack(ending, asked, folder):
                print(f"{ending:9}{command:15}{tally.line}", flush=True)
                faults += tally.faults
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
