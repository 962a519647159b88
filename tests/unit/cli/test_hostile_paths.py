"""What is no plain file, given where a command reads or writes one: a pipe, a terminal, a device without end, a link to
itself, a folder, a socket, a file that may not be read. Each ends with one line and exit status 2, and nothing waits.

The commands and their words are taken from the command line itself: a new command is covered as soon as it is there,
and a new word that may name a file has to be said in `NO_FILES` or `SAMPLES`.
"""

import importlib
import os
import pty
import signal
import socket
from collections.abc import Callable, Iterator
from dataclasses import fields
from pathlib import Path
from types import FrameType
from typing import Any, NamedTuple

import pytest

from station.cli.command_line import _COMMANDS, main
from station.cli.options.option_fields import _KEY, Command, _name, _OptionGroup, _Spec
from station.drills.library import find_lesson
from station.drills.writing.lesson_part import part_of
from station.music.formats.smf.midi_part import MIDI
from station.practice.headless.virtual_session import practise_virtually
from station.practice.session.plan import PlanOptions, plan_practice
from station.simulation.student_spec import parse_spec
from tests.fakes.captures import capture_bytes

WITHIN_S = 60
"""So long may a command take on a busy computer before it counts as waiting for ever."""

pytestmark = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no such files")


# --- what the commands take -------------------------------------------------------------------------------------------


class Word(NamedTuple):
    """A word of a command: the command's own words, the field, its spec."""

    command: tuple[str, ...]
    field: str
    spec: _Spec

    @property
    def metavar(self) -> str:
        return str(self.spec.keywords["metavar"])

    def written(self, value: str) -> list[str]:
        return [_name(self.field, self.spec), value] if self.spec.is_option else [value]


def words_of(command: tuple[str, ...], options: type[Any]) -> Iterator[Word]:
    for one in fields(options):
        match one.metadata.get(_KEY):
            case _OptionGroup(options=shared):
                yield from words_of(command, shared)
            case _Spec() as spec if "metavar" in spec.keywords:
                yield Word(command, one.name, spec)


def commands() -> Iterator[tuple[tuple[str, ...], type[Any]]]:
    for name in _COMMANDS:
        found = importlib.import_module(f"station.cli.{name}").COMMAND
        if isinstance(found, Command):
            yield (name,), found.options
        else:
            yield from (((name, verb), one.options) for verb, _, one in found.table)


WORDS = [word for command, options in commands() for word in words_of(command, options)]
READ = {"LESSON", "SCORE", "PERFORMANCE", "PATH", "SOURCE", "SONG", "MODEL", "SIGNAL", "EXEMPLAR", "SESSION"}
"""What such a word names is read."""
NO_FILES = {
    *(
        "BPM",
        "PERCENT",
        "BPM/BARS[:TOP]",
        "N",
        "A-B",
        "ON/OFF|random[:SHARE]",
        "ON/OFF",
        "PIECES",
        "SPEC",
        "HZ",
        "CLICK",
        "N/U",
        "WORD",
        "ADDRESS",
        "ADDRESS|list",
        "NAME[=PORT],…",
    ),
    *(
        "LEVELS",
        "S",
        "L",
        "SECONDS",
        "TEXT",
        "A",
        "B",
        "M",
        "T",
        "WxH",
        "KIND",
        "FAMILY",
        "BAR.BEAT=SECONDS",
        "ID",
        "DAY",
    ),
    *(
        "LESSON:KEY=VALUE,…",
        "LESSON:NAME",
        "RETURN",
        "N:KEY=VALUE,…",
        "PAD",
        "PIECE",
        "BAUD",
        "NAMES",
        "CHANNEL",
        "RAD",
    ),
    *("URL", "START:END", "PART", "N,N", "PHASE=WHAT", "CHANNEL=CONTROLLER", "KIT", "PORT"),
}
"""Such a word names no file; `KIT` is a name alone, a `PORT` a device, for which the engine's own tests are, and
a `URL` a database, for which the store's are."""
NAMES_OF_FILES = {
    ("animate", "style"),
    ("animate", "drummer"),
    ("animate", "drums"),
    ("limbs", "drums"),
    ("assignment", "new", "lesson"),
}
"""Words called NAME that may be a file's too."""
OUTPUTS = {"out", "pairs", "text"}
FOLDERS = {"report", "recover"}


def is_file(word: Word) -> bool:
    if word.metavar.startswith("{"):
        return False
    if word.metavar == "NAME":
        return (*word.command, word.field) in NAMES_OF_FILES
    return word.metavar in READ or word.metavar.startswith(("FILE", "MODEL.toml", "DIR"))


def test_of_every_word_it_is_known_whether_it_names_a_file() -> None:
    unknown = {w.metavar for w in WORDS if not is_file(w)} - NO_FILES - {"NAME"}
    assert {metavar for metavar in unknown if not metavar.startswith("{")} == set()


# --- good files, for the other words ----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def shelf(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("good")
    assert MIDI.write is not None
    (folder / "good.mid").write_bytes(MIDI.write(part_of(find_lesson("rock-1"))).data)
    (folder / "good.capture").write_bytes(capture_bytes([]))
    plan = plan_practice(find_lesson("rock-1"), PlanOptions(loops=1, demonstrations=0))
    practise_virtually(plan, parse_spec("intermediate,seed=1"), folder / "session.capture")
    rows = "\n".join(f"{i / 100:.2f},{(i % 50) / 50:.3f}" for i in range(400))
    (folder / "good.csv").write_text(f"time_s,x\n{rows}\n")
    return folder


SAMPLES: dict[str, str] = {
    **dict.fromkeys(("LESSON", "SCORE", "FAMILY"), "rock-1"),
    **{
        "PERFORMANCE": "good.mid",
        "EXEMPLAR": "good.csv",
        "SIGNAL": "good.csv",
        "SOURCE": "good.mid",
        "PATH": "good.mid",
        "SESSION": "session.capture",
    },
    **{"ID": "nothing", "RETURN": "nothing"},
}


def others(word: Word, shelf: Path, out: Path) -> list[str]:
    """What the command needs besides `word`."""
    said: list[str] = []
    for other in WORDS:
        if other.command != word.command or other.field == word.field:
            continue
        keywords = other.spec.keywords
        is_needed = keywords.get("required") or (not other.spec.is_option and keywords.get("nargs") != "?")
        if is_needed or other.field in NEEDED.get(word.command, ()):
            said += other.written(str(_sample(other, shelf, out)))
    return said


NEEDED: dict[tuple[str, ...], tuple[str, ...]] = {
    ("assignment", "new"): ("lesson", "title"),
    ("song", "new"): ("sound",),
    ("report",): ("session",),
}


def _sample(word: Word, shelf: Path, out: Path) -> Path | str:
    if word.field in OUTPUTS:
        return out / f"made{ENDING.get(word.command, '.mid')}"
    sample = SAMPLES.get(word.metavar, "rock-1")
    return shelf / sample if "." in sample else sample


ENDING = {
    ("animate",): ".npz",
    ("sheet",): ".pdf",
    ("report",): ".html",
    ("limbs",): ".txt",
    ("assess",): ".csv",
    ("lesson", "new"): ".toml",
    ("lesson", "import"): ".toml",
    ("song", "new"): ".song",
    ("assignment", "return"): ".drum-return",
    ("assignment", "new"): ".drum-assignment",
    ("assignment", "answer"): ".drum-note",
    ("sync", "fit"): ".toml",
    ("sync", "sonify"): ".mid",
    ("history", "export"): ".zip",
    ("history", "backup"): ".sqlite3",
}


# --- hostile ones -----------------------------------------------------------------------------------------------------


def _pipe(path: Path) -> None:
    os.mkfifo(path)


def _terminal(path: Path) -> None:
    _, slave = pty.openpty()
    path.symlink_to(os.ttyname(slave))


def _endless(path: Path) -> None:
    path.symlink_to("/dev/zero")


def _loop(path: Path) -> None:
    path.symlink_to(path)


def _socket(path: Path) -> None:
    os.chdir(path.parent)  # its name may not be long
    with socket.socket(socket.AF_UNIX) as listens:
        listens.bind(path.name)


def _unreadable(path: Path) -> None:
    path.write_bytes(b"x")
    path.chmod(0)


def _dangling(path: Path) -> None:
    path.symlink_to(path.parent / "nothing" / "there")


HOSTILE: dict[str, Callable[[Path], None]] = {
    "pipe": _pipe,
    "terminal": _terminal,
    "endless": _endless,
    "loop": _loop,
    "folder": Path.mkdir,
    "socket": _socket,
    "unreadable": _unreadable,
    "dangling": _dangling,
}
IS_ROOT = hasattr(os, "geteuid") and os.geteuid() == 0


class Waits(BaseException):
    """A command waited, or did not end."""


def _too_long(_: int, frame: FrameType | None) -> None:
    raise Waits


def ended(words: list[str]) -> int:
    """The exit status; fails for a command that does not end."""
    before = signal.signal(signal.SIGALRM, _too_long)
    signal.alarm(WITHIN_S)
    try:
        return main(words)
    except Waits:
        pass
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)
    pytest.fail(f"it waits: {words}")


FILES = [word for word in WORDS if is_file(word)]


@pytest.mark.parametrize("kind", HOSTILE)
@pytest.mark.parametrize("word", FILES, ids=[f"{'-'.join(word.command)}-{word.field}" for word in FILES])
def test_what_is_no_plain_file_ends_with_one_line(
    word: Word,
    kind: str,
    shelf: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    path = tmp_path / f"x{_ending(word)}"
    HOSTILE[kind](path)
    needed = others(word, shelf, tmp_path)
    code = ended([*word.command, *needed, *word.written(str(path)), *EXTRA.get(word.command, ())])
    said = capsys.readouterr()
    assert "Traceback" not in said.err
    assert len([line for line in said.err.splitlines() if line.startswith("station:")]) <= 1, said.err
    assert code == 2 or (code == 0 and kind in HARMLESS.get(word.field, ())), said


HARMLESS = {
    **dict.fromkeys(OUTPUTS, ("endless", "dangling", *(["unreadable"] if IS_ROOT else []))),
    "report": ("folder", "dangling"),
    "file": ("unreadable",) if IS_ROOT else (),
}
"""What may be done all the same: to write into what takes all, into a folder, where a link leads."""
EXTRA: dict[tuple[str, ...], tuple[str, ...]] = {
    ("practice",): ("--headless", "--virtual-student", "pro", "--loops", "1", "--no-demonstration", "--no-pictures"),
    ("exam",): ("--virtual-student", "pro"),
}


def _ending(word: Word) -> str:
    if word.field in OUTPUTS:
        return ENDING.get(word.command, ".mid")
    return ENDING_OF.get(word.metavar) or ENDING_OF_FIELD.get(word.field, ".wav")


ENDING_OF = {
    "PERFORMANCE": ".capture",
    "SONG": ".song",
    "EXEMPLAR": ".csv",
    "SIGNAL": ".csv",
    "SOURCE": ".mid",
    **dict.fromkeys(("LESSON", "SCORE", "MODEL", "PATH", "NAME"), ".toml"),
}
ENDING_OF_FIELD = {"file": ".drum-assignment", "replaces": ".drum-assignment", "files": ".drum-return"}
