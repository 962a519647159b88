"""The history before a command asks it: what lies in folders comes in first, with a word on standard error."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from station.cli.console import Progress, say
from station.core.settings import Settings

_MANY = 100
"""So many sessions take a few seconds (our choice): it is said that they are taken in, also where nobody looks."""


def caught_up(settings: Settings) -> Settings:
    """The settings, whose history has what lies in folders; where it cannot be reached that is said."""
    from station.practice.own_data.catching_up import catch_up

    lines: list[str] = []
    with shown_intake() as progress:
        catch_up(settings, lines.append, progress)
    for line in lines:
        say(line)
    return settings


@contextmanager
def shown_intake() -> Iterator[Callable[[int, int], None]]:
    """Shows how many folders of how many are taken in, of one student after another."""
    shown: list[Progress] = []

    def progress(done: int, count: int) -> None:
        if done == 0:
            _end(shown)
            if count >= _MANY:
                say(f"taking {count} sessions into the history…")
            shown.append(Progress(count, "sessions"))
        shown[-1].show(done)

    try:
        yield progress
    finally:
        _end(shown)


def _end(shown: list[Progress]) -> None:
    if shown:
        shown.pop().close()
