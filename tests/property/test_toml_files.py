"""Whatever happens to a file of ours, reading it gives a value, or faults whose places are in the file."""

from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from station.app.toml_files import KINDS
from station.core.errors import BadInput
from station.core.toml.schema import reading
from station.core.toml.toml_faults import Fault
from station.core.toml.toml_source import Source, source_of
from tests.toml_kinds import GOOD, read_as

READERS = {kind.name: kind.reader(Path("mine.toml")) for kind in KINDS}
SLIPS = st.sampled_from(
    [
        *(
            "",
            " ",
            "\n",
            "\r\n",
            '"',
            "'",
            '"""',
            "[",
            "]",
            "[[",
            "]]",
            "{",
            "}",
            "=",
            ",",
            ".",
            "#",
            "\\",
            "\x00",
            "é",
            "\ufeff",
        ),
        *(
            "nan",
            "-inf",
            "true",
            "1e999",
            "9" * 400,
            "9" * 5000,
            "-0",
            "0x7f",
            "1979-05-27",
            "07:32:00",
            '""',
            "{}",
            "[]",
        ),
        *("title = 1\n", "[grid]\n", "[[grid]]\n", "[pads.snare]\n", "a.b.c = 1\n", "\n[a]\n[a]\n", "\ud7ff"),
    ]
)


def in_the_file(fault: Fault, data: bytes) -> bool:
    """Whether its place is that of a character of the file, or the one just after a line's end."""
    lines = data.decode(errors="replace").removeprefix("\ufeff").replace("\r\n", "\n").split("\n")
    return 1 <= fault.line <= len(lines) and 1 <= fault.column <= len(lines[fault.line - 1]) + 1


def value_or_faults(kind: str, data: bytes) -> None:
    source: Source = source_of(data, "mine.toml")
    value, faults = reading(source, READERS[kind])
    assert (value is None) is bool(faults)
    for fault in faults:
        assert in_the_file(fault, data), fault
        assert fault.text
        assert len(str(fault)) < 500


@pytest.mark.parametrize("kind", GOOD)
@given(data=st.data())
@settings(deadline=None, max_examples=60)
def test_a_slip_of_the_finger(kind: str, data: st.DataObject) -> None:
    text = GOOD[kind].text
    for _ in range(data.draw(st.integers(1, 3))):
        at, length = data.draw(st.integers(0, len(text))), data.draw(st.integers(0, 12))
        text = text[:at] + data.draw(SLIPS) + text[at + length :]
    value_or_faults(kind, text.encode())


@pytest.mark.parametrize("kind", GOOD)
@given(data=st.data())
@settings(deadline=None, max_examples=40)
def test_a_flipped_byte(kind: str, data: st.DataObject) -> None:
    raw = bytearray(GOOD[kind].text.encode())
    for _ in range(data.draw(st.integers(1, 4))):
        raw[data.draw(st.integers(0, len(raw) - 1))] = data.draw(st.integers(0, 255))
    value_or_faults(kind, bytes(raw))


@pytest.mark.parametrize("kind", GOOD)
@given(data=st.data())
@settings(deadline=None, max_examples=40)
def test_lines_in_another_order(kind: str, data: st.DataObject) -> None:
    lines = GOOD[kind].text.splitlines(keepends=True)
    value_or_faults(kind, "".join(data.draw(st.lists(st.sampled_from(lines), max_size=2 * len(lines)))).encode())


@given(kind=st.sampled_from(sorted(GOOD)), as_another=st.sampled_from(sorted(GOOD)))
@settings(deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_a_file_of_another_kind_is_refused_in_one_line(kind: str, as_another: str, tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(GOOD[kind].text, encoding="utf-8")
    if kind == as_another:
        read_as(kind, path)
        return
    with pytest.raises(BadInput) as raised:
        read_as(as_another, path)
    assert raised.value.place
    assert "\n" not in str(raised.value)
