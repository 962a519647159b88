"""The command line: a table of commands, each a module of `station.cli` that is imported only when it runs.

Bad input ends with one line on standard error and exit status 2; Ctrl-C with 130. `--json` prints one document on
standard output and nothing else.
"""

import argparse
import importlib
import io
import os
import sys
from collections.abc import Callable, Sequence
from typing import NoReturn

from station.core.errors import BadInput, StationError

_COMMANDS: tuple[tuple[str, str], ...] = (
    ("practice", "practise a lesson"),
    ("assess", "align and score a recorded performance against a score"),
    ("animate", "draw the drummer who plays a score"),
    ("sheet", "write a score as a sheet to print"),
    ("limbs", "say which limb plays every note of a score"),
    ("lesson", "list, show, check, write, import and export lessons"),
    ("devices", "list, monitor, teach, calibrate, record and replay kits and sound outputs"),
    ("doctor", "say what works on this computer, and what to do about what does not"),
    ("bench", "measure this computer's station"),
)


_PLAIN = {
    "invalid float value:": "expected a number, found",
    "invalid int value:": "expected a whole number, found",
    "invalid choice:": "no such choice:",
    "unrecognized arguments:": "not understood:",
    "the following arguments are required:": "there must be",
}


class Parser(argparse.ArgumentParser):
    """A parser that raises `BadInput` in one line where argparse prints its usage and exits."""

    def error(self, message: str) -> NoReturn:
        """Raise what argparse complains of, in words that are not Python's."""
        for pythons, ours in _PLAIN.items():
            message = message.replace(pythons, ours)
        raise BadInput(self.prog.removeprefix("station").strip(), "", f"{message} (see {self.prog} --help)")


def parser() -> Parser:
    """The parser of the whole command line; a command's own options are added by its module when it is chosen."""
    top = Parser(prog="station", description="A practice room for electronic drum kits; alone it opens the window.")
    top.add_argument("--version", action="version", version=_version())
    commands = top.add_subparsers(dest="command", metavar="COMMAND")
    for name, summary in _COMMANDS:
        commands.add_parser(name, help=summary, add_help=False)
    return top


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line and return the exit status."""
    words = list(sys.argv[1:] if argv is None else argv)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):  # whatever the console's own encoding: reports are UTF-8
            stream.reconfigure(encoding="utf-8", errors="backslashreplace")
    try:
        return _run(words)
    except StationError as fault:
        print(f"station: {fault}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:
        # whoever read our output has gone; point stdout elsewhere so that Python's exit does not complain too
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1


def _run(words: list[str]) -> int:
    chosen, _ = parser().parse_known_args(words[:1])
    module = importlib.import_module(f"station.cli.{chosen.command or 'window'}")
    summary = dict(_COMMANDS).get(chosen.command, "open the practice room")
    options = Parser(prog=f"station {chosen.command or ''}".strip(), description=f"{summary.capitalize()}.")
    module.add_options(options)
    run: Callable[[argparse.Namespace], int] = module.run
    return run(options.parse_args(words[1:]))


def _version() -> str:
    from importlib.metadata import version

    return f"drum station {version('drum-station')}"


if __name__ == "__main__":
    sys.exit(main())
