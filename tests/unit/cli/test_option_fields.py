"""Options as dataclasses: what is said, what is not, what cannot be understood."""

from dataclasses import dataclass
from pathlib import Path

import pytest

from station.cli.devices import RecordOptions
from station.cli.input.device_listening import ListenOptions
from station.cli.options.option_fields import (
    HIDDEN,
    argument,
    arguments,
    choice,
    flag,
    group,
    number,
    option,
    optional_argument,
    read_options,
    repeated,
    required,
    said,
    switch,
    whole_number,
)
from station.cli.practising.practice_options import PracticeOptions
from station.core.errors import BadInput
from station.core.settings import Settings


@dataclass(frozen=True, slots=True, kw_only=True)
class Shared:
    weight: float = option("KG", "how heavy", number, 1.0)
    colour: int = choice({"red": 1, "green": 2}, "which colour", 1)


@dataclass(frozen=True, slots=True, kw_only=True)
class Everything:
    source: str = argument("SOURCE", "from where", str)
    further: str | None = optional_argument("FURTHER", "and then")
    out: Path = required("FILE", "to where", Path)
    count: int | None = option("--number --howmany N", "how many", whole_number, None)
    devices: tuple[str, ...] = repeated("--device --kit PORT", "which")
    loud: bool = flag("loud", rivals="sound")
    quiet: bool = flag("quiet", rivals="sound")
    guide: bool | None = switch("with or without")
    secret: int = option("N", HIDDEN, whole_number, 0)
    shared: Shared = group(Shared, "shared")
    said: frozenset[str] = said()


def read(*words: str) -> Everything:
    return read_options(Everything, words)


def refused(*words: str) -> str:
    with pytest.raises(BadInput) as fault:
        read(*words)
    return str(fault.value)


def test_what_is_not_said_is_the_default() -> None:
    assert read("a", "--out", "b") == Everything(
        source="a", out=Path("b"), shared=Shared(), said=frozenset({"source", "out"})
    )


def test_what_is_said_has_its_type() -> None:
    words = ("a", "c", "--out", "b", "--number", "3", "--loud", "--no-guide", "--weight", "2.5", "--colour", "green")
    got = read(*words, "--device", "x", "--kit", "y", "--secret", "7")
    assert (got.further, got.count, got.loud, got.quiet, got.guide) == ("c", 3, True, False, False)
    assert (got.shared, got.devices, got.secret) == (Shared(weight=2.5, colour=2), ("x", "y"), 7)
    assert {"further", "count", "weight"} <= got.said
    assert "quiet" not in got.said


def test_one_or_more_words() -> None:
    @dataclass(frozen=True, slots=True, kw_only=True)
    class Paths:
        paths: tuple[str, ...] = arguments("PATH", "which")

    assert read_options(Paths, ("a", "b")).paths == ("a", "b")
    with pytest.raises(BadInput, match="PATH"):
        read_options(Paths, ())


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("--number", "2.5"), "argument --number: expected a whole number, found '2.5'"),
        (("--weight", "heavy"), "argument --weight: expected a number, found 'heavy'"),
        (("--colour", "gren"), "argument --colour: no such choice: 'gren'; did you mean green?"),
        (("--colour", "x"), "no such choice: 'x'; there are red, green"),
        (("--loud", "--quiet"), "argument --quiet: not allowed with argument --loud"),
        (("--wieght", "2"), "no such option: --wieght; did you mean --weight?"),
        (("--secrt", "2"), "no such option: --secrt"),
        (("c", "d", "e"), "not understood: "),  # before Python 3.13 no optional argument comes after an option
    ],
)
def test_what_cannot_be_understood_is_named(words: tuple[str, ...], named: str) -> None:
    told = refused("a", "--out", "b", *words)
    assert named in told
    assert "secret" not in told


def test_what_is_missing_is_named() -> None:
    assert "--out" in refused("a")


def test_a_wrong_word_of_any_length_is_a_line_that_can_be_read() -> None:
    told = refused("a", "--out", "b", "--number", "x" * 7_000)
    assert len(told) <= 400
    assert "argument --number: expected a whole number, found 'xxx" in told
    assert told.endswith("--help)")


def test_an_old_name_works_and_is_not_shown(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        read("--help")
    out = capsys.readouterr().out
    assert "--number N" in out
    assert not any(name in out for name in ("--howmany", "--kit", "--secret"))


def test_kits_are_devices_by_both_names() -> None:
    assert read_options(ListenOptions, ("--device", "TD-17", "--kit", "serial:x")).device == ("TD-17", "serial:x")
    assert read_options(RecordOptions, ("x.capture", "--seconds", "2")).seconds == 2.0


def test_sound_is_said_by_the_settings_names() -> None:
    words = ("--rate", "44100", "--sounds", "brushes", "--click", "count", "--click-sound", "wood", "--no-own-sound")
    settings = read_options(PracticeOptions, words).sound.settings()
    assert settings == {
        "rate_hz": 44_100,
        "drums": "brushes",
        "click_pattern": "count",
        "click": "wood",
        "own_sound": False,
    }
    assert settings.keys() <= set(Settings.__dataclass_fields__)
