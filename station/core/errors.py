"""Whose fault it is: `BadInput` for a file or a user's word, `DeviceError` for the world.

A broken promise of our own is an `assert`. The command line prints either error as one line and exits with 2.
"""

from pathlib import Path

LONGEST_LINE = 400
"""Characters of an error: who and where stand at its beginning, what is wrong at its end (our choice: five lines)."""


class StationError(Exception):
    """An error that a user can read: one line, no traceback, whatever characters a file's name has.

    A longer line than `LONGEST_LINE` is shortened in the middle.
    """

    def __init__(self, line: str) -> None:
        if len(line) > LONGEST_LINE:
            half = (LONGEST_LINE - 1) // 2
            line = f"{line[:half]}…{line[-half:]}"
        super().__init__("".join(c if c.isprintable() else " " for c in line))


class BadInput(StationError):
    """A file, an argument or a peer is at fault.

    `source` names the file or argument, `place` where in it (such as "line 3, column 7"; may be empty),
    `fault` what is wrong and what was expected.
    """

    def __init__(self, source: str | Path, place: str, fault: str) -> None:
        self.source = str(source)
        self.place = place
        self.fault = fault
        super().__init__(": ".join(part for part in (self.source, place, fault) if part))

    def __reduce__(self) -> tuple[type["BadInput"], tuple[str, str, str]]:
        """Its parts, so that it crosses from one process to another."""
        return type(self), (self.source, self.place, self.fault)


class DeviceError(StationError):
    """A device, a driver, a disk or the operating system failed; the text says what to do about it."""
