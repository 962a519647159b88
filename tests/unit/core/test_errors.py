"""What a user reads when something is wrong."""

import pickle
from pathlib import Path

import pytest

from station.core.errors import BadInput, DeviceError, StationError


def test_bad_input_reads_as_source_place_fault() -> None:
    assert str(BadInput(Path("a.toml"), "line 3, column 7", "expected x")) == "a.toml: line 3, column 7: expected x"


def test_an_unknown_place_is_left_out() -> None:
    assert str(BadInput("a.mid", "", "no such file")) == "a.mid: no such file"


def test_the_parts_can_be_told_apart() -> None:
    fault = BadInput(Path("a.mid"), "byte 3", "odd")
    assert (fault.source, fault.place, fault.fault) == ("a.mid", "byte 3", "odd")


@pytest.mark.parametrize("break_", ["\n", "\r\n", "\x0b", "\x1b[2J", "\u2028", "\x85"])
def test_it_stays_one_line_whatever_the_file_is_called(break_: str) -> None:
    line = str(BadInput(f"a{break_}b.mid", "", f"is {break_} odd"))
    assert line.splitlines() == [line]
    assert line.isprintable()


@pytest.mark.parametrize("kind", [BadInput("a", "b", "c"), DeviceError("d")])
def test_both_are_errors_that_the_command_line_prints(kind: StationError) -> None:
    assert isinstance(kind, StationError)


def test_a_device_error_stays_one_line_too() -> None:
    assert str(DeviceError("port\nlost")) == "port lost"


def test_bad_input_crosses_from_one_process_to_another() -> None:
    fault = pickle.loads(pickle.dumps(BadInput("a.mid", "byte 3", "odd")))
    assert (fault.source, fault.place, fault.fault, str(fault)) == ("a.mid", "byte 3", "odd", "a.mid: byte 3: odd")
