"""The history before a command asks it: what lies in folders comes in first, with a word on standard error."""

from station.cli.console import Progress, say
from station.core.settings import Settings


def caught_up(settings: Settings) -> Settings:
    """The settings, whose history has what lies in folders; where it cannot be reached that is said."""
    from station.practice.own_data.catching_up import catch_up

    shown: list[Progress] = []

    def progress(done: int, count: int) -> None:
        if done == 0:
            _end(shown)
            shown.append(Progress(count, "sessions"))
        shown[-1].show(done)

    try:
        lines: list[str] = []
        catch_up(settings, lines.append, progress)
    finally:
        _end(shown)
    for line in lines:
        say(line)
    return settings


def _end(shown: list[Progress]) -> None:
    if shown:
        shown.pop().close()
