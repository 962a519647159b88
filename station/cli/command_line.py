"""The command line: a table of commands, each a module of `station.cli` that is imported only when it runs.

Bad input ends with one line on standard error and exit status 2; Ctrl-C with 130. `--json` prints one document on
standard output and nothing else.
"""

import importlib
import io
import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from station.cli.console import say, written_output
from station.cli.options.option_fields import Command, Parser, Verbs, chosen, sentence
from station.core.errors import DeviceError, StationError

_COMMANDS = {
    "practice": "practise a lesson",
    "today": "show the plan of the day",
    "book": "show the lesson book: planned, practised, and what returns",
    "history": "list and show what was practised, take it away, delete and copy it",
    "battle": "repeat what the drummer plays, or trade improvised phrases, until somebody has won",
    "exam": "one take of a piece, prepared or unseen, marked by a rubric",
    "assess": "align and score a recorded performance against a score",
    "animate": "draw the drummer who plays a score",
    "report": "make a page of one session or of a week, for a browser or to print",
    "sheet": "write a score as a sheet to print",
    "limbs": "say which limb plays every note of a score",
    "lesson": "list, show, check, write, import and export lessons",
    "song": "make a song of a drum part and a band's sound, time it by points, check it",
    "assignment": "give, take, return and answer what is to be practised",
    "devices": "list, monitor, teach, calibrate, record and replay kits and sound outputs",
    "sync": "fit a periodic model to a motion, and tell the phase of another",
    "doctor": "say what works on this computer, and what to do about what does not",
    "bench": "measure this computer's station",
}
_WINDOW = "window"
"""The module of `station` without a command."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line and return the exit status."""
    words = list(sys.argv[1:] if argv is None else argv)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):  # whatever the console's own encoding: reports are UTF-8
            stream.reconfigure(encoding="utf-8", errors="backslashreplace")
    try:
        with written_output():
            return _run(words)
    except StationError as fault:
        say(f"station: {fault}")
        return 2
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:  # whoever read our output has gone
        return 1
    except OSError as fault:  # what no reader or writer foresaw, such as a name longer than the file system takes
        say(f"station: {DeviceError(': '.join(str(part) for part in (fault.filename, fault.strerror) if part))}")
        return 2


def _run(words: list[str]) -> int:
    top = Parser(prog="station", description="A practice room for electronic drum kits; alone it opens the window.")
    top.add_argument("--version", action="version", version=_version())
    name = None if _names_file(words) else chosen(top, "COMMAND", _COMMANDS, words)
    command: Command[Any] | Verbs = importlib.import_module(f"station.cli.{name or _WINDOW}").COMMAND
    return command.main(
        f"station {name or ''}".strip(),
        sentence(_COMMANDS.get(name or "", "open the practice room")),
        words[1:] if name else words,
    )


def _names_file(words: list[str]) -> bool:
    """Whether the first word is a file to open in the window, and no command."""
    return bool(words) and words[0] not in _COMMANDS and Path(words[0]).suffix != "" and os.path.isfile(words[0])  # noqa: PTH113 - no error for long names


def _version() -> str:
    from importlib.metadata import version

    return f"drum station {version('drum-station')}"


if __name__ == "__main__":
    sys.exit(main())
