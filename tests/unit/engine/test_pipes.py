"""The engine's ears: what comes over the pipe of commands, and its end."""

import threading
from multiprocessing import Pipe

import pytest

from station.engine.messages import Stop
from station.engine.pipes import Inbox


def until_it_hears_no_more() -> None:
    for thread in threading.enumerate():
        if thread.name == "commands":
            thread.join()


def test_commands_are_taken_in_order_and_the_parents_end_closes_it() -> None:
    ours, theirs = Pipe(duplex=False)
    inbox = Inbox(ours)
    theirs.send(Stop())
    theirs.close()
    until_it_hears_no_more()
    assert inbox.is_closed
    assert inbox.pop_all() == [Stop()]
    assert inbox.pop_all() == []


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_an_engine_that_can_hear_no_more_is_closed_whatever_the_reason() -> None:
    """Else it would play on for ever, deaf to its parent and to its parent's end."""
    ours, theirs = Pipe(duplex=False)
    inbox = Inbox(ours)
    theirs.send_bytes(b"no command at all")
    until_it_hears_no_more()
    assert inbox.is_closed
    theirs.close()
