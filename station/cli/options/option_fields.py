"""The options of a command: a frozen dataclass, each of whose fields says how it is written on the command line.

    @dataclass(frozen=True, slots=True, kw_only=True)
    class SheetOptions:
        score: str = argument("SCORE", "a lesson or a MIDI file", str)
        start_bar: int = option("A", "the first bar, from 1 (1)", whole_number, 1)
        no_sticking: bool = flag("no R and L below the notes")

What is not said keeps the field's default. argparse reads the words; its namespace goes no further than this module.
"""

import argparse
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields
from datetime import date
from typing import Any, Generic, NoReturn, TypeVar

from station.core.did_you_mean import did_you_mean, nearest
from station.core.errors import BadInput

HIDDEN = argparse.SUPPRESS
"""The help of an option that helps nobody but our own programs."""
_KEY = "command line"
_T = TypeVar("_T")
_Add = Callable[..., argparse.Action]


@dataclass(frozen=True, slots=True)
class _Spec:
    """How a field is written: argparse's words for it, and of an option the names if they are not the field's."""

    keywords: Mapping[str, Any]
    is_option: bool = True
    names: tuple[str, ...] = ()
    rivals: str = ""


@dataclass(frozen=True, slots=True)
class _OptionGroup:
    options: type[Any]
    title: str


# --- fields of a dataclass of options ---------------------------------------------------------------------------------
#
# What the command line shows of an option is its `form`: `METAVAR`, or `--name METAVAR` where the name is not the
# field's; further names that stand there are old ones, which still work. `read` makes the value, or complains.


def argument(metavar: str, words: str, read: Callable[[str], _T]) -> _T:
    """A word of its own, known by its place."""
    made: _T = field(metadata={_KEY: _Spec({"metavar": metavar, "help": words, "type": read}, is_option=False)})
    return made


def optional_argument(metavar: str, words: str) -> str | None:
    """A word of its own that need not be there."""
    return field(default=None, metadata={_KEY: _Spec({"metavar": metavar, "help": words, "nargs": "?"}, False)})


def arguments(metavar: str, words: str) -> tuple[str, ...]:
    """One or more words."""
    made: tuple[str, ...] = field(metadata={_KEY: _Spec({"metavar": metavar, "help": words, "nargs": "+"}, False)})
    return made


def required(form: str, words: str, read: Callable[[str], _T]) -> _T:
    """An option that has to be given."""
    made: _T = field(metadata={_KEY: _formed(form, {"help": words, "type": read, "required": True})})
    return made


def option(form: str, words: str, read: Callable[[str], _T], default: _T, *, rivals: str = "") -> _T:
    """An option with a value; of those that share their `rivals` one alone can be given."""
    return field(default=default, metadata={_KEY: _formed(form, {"help": words, "type": read}, rivals)})


def option_alone(form: str, words: str, read: Callable[[str], _T], alone: _T) -> _T | None:
    """An option whose value may be left out: it is `alone` then, and None where the option was not given."""
    return field(
        default=None, metadata={_KEY: _formed(form, {"help": words, "type": read, "nargs": "?", "const": alone})}
    )


def repeated(form: str, words: str) -> tuple[str, ...]:
    """An option that may be given several times."""
    return field(default=(), metadata={_KEY: _formed(form, {"help": words, "action": "append"})})


def choice(of: Mapping[str, _T], words: str, default: _T, *, name: str = "") -> _T:
    """An option that takes one of some words, and what a mapping says of it."""
    return option(f"{name} {{{','.join(of)}}}", words, one_of(of), default)


def flag(words: str, *, rivals: str = "") -> bool:
    """An option without a value: whether it was given."""
    return field(default=False, metadata={_KEY: _Spec({"help": words, "action": "store_true"}, rivals=rivals)})


def switch(words: str) -> bool | None:
    """An option that can be denied (`--no-…`); None where neither was said."""
    keywords = {"help": words, "action": argparse.BooleanOptionalAction}
    return field(default=None, metadata={_KEY: _Spec(keywords)})


def group(options: type[_T], title: str = "") -> _T:
    """Options that several commands share: a dataclass of their own, under a title of their own if they have one."""
    made: _T = field(metadata={_KEY: _OptionGroup(options, title)})
    return made


def said() -> frozenset[str]:
    """The names of the fields that were said on the command line."""
    return field(default=frozenset())


def _formed(form: str, keywords: Mapping[str, Any], rivals: str = "") -> _Spec:
    *names, metavar = form.split()
    return _Spec({**keywords, "metavar": metavar}, names=tuple(names), rivals=rivals)


# --- what reads a value; their complaints name the word ---------------------------------------------------------------


def number(text: str) -> float:
    """A number."""
    try:
        return float(text)
    except ValueError:
        raise unread("a number", text) from None


def whole_number(text: str) -> int:
    """A whole number."""
    try:
        return int(text)
    except ValueError:
        raise unread("a whole number", text) from None


def day(text: str) -> date:
    """A day."""
    try:
        return date.fromisoformat(text)
    except ValueError:
        raise unread("a day such as 2026-12-01", text) from None


def unread(expected: str, text: str) -> argparse.ArgumentTypeError:
    """The error of a value that cannot be read, which argparse reports with the option's name."""
    return argparse.ArgumentTypeError(f"expected {expected}, found {text!r}")


def checked(read: Callable[[str], _T]) -> Callable[[str], _T]:
    """`read`, whose `BadInput` argparse tells of with the option's name."""

    def reading(text: str) -> _T:
        try:
            return read(text)
        except BadInput as fault:
            raise argparse.ArgumentTypeError(str(fault)) from None

    return reading


def one_of(values: Mapping[str, _T], noun: str = "choice") -> Callable[[str], _T]:
    """What reads one of some words."""

    def read(text: str) -> _T:
        if text not in values:
            raise argparse.ArgumentTypeError(f"no such {noun}: {text!r}{did_you_mean(text, values)}")
        return values[text]

    return read


# --- reading the words ------------------------------------------------------------------------------------------------


class Parser(argparse.ArgumentParser):
    """A parser that raises `BadInput` in one line where argparse prints its usage and exits."""

    def error(self, message: str) -> NoReturn:
        """Raise what is wrong, with the way to the help."""
        raise BadInput(self.prog.removeprefix("station").strip(), "", f"{message} (see {self.prog} --help)")


@dataclass(frozen=True, slots=True)
class NoOptions:
    """Of a command that takes nothing but --help."""


@dataclass(frozen=True, slots=True)
class Command(Generic[_T]):
    """A command: its options, and what runs with them and returns the exit status."""

    options: type[_T]
    run: Callable[[_T], int]

    def main(self, name: str, about: str, words: Sequence[str]) -> int:
        """Run it as `name` with these words; raises `BadInput`."""
        return self.run(read_options(self.options, words, Parser(prog=name, description=about)))


@dataclass(frozen=True, slots=True)
class Verbs:
    """A command whose next word says what to do: that word, its summary and its command, a row each.

    Without such a word it does what is `usual`, where anything is.
    """

    table: tuple[tuple[str, str, Command[Any]], ...]
    usual: str = ""

    def main(self, name: str, about: str, words: Sequence[str]) -> int:
        """Run the one that the first of the words names; raises `BadInput`."""
        menu = Parser(prog=name, description=about)
        said = chosen(menu, "VERB", {verb: summary for verb, summary, _ in self.table}, words)
        verb = said or self.usual
        if not verb:
            menu.error(f"say what to do: {', '.join(verb for verb, _, _ in self.table)}")
        summary, command = next((summary, command) for known, summary, command in self.table if known == verb)
        return command.main(f"{name} {verb}", sentence(summary), words[1:] if said else words)


def sentence(summary: str) -> str:
    """A summary as the first sentence of a help page."""
    return f"{summary[:1].upper()}{summary[1:]}."


def chosen(menu: Parser, metavar: str, summaries: Mapping[str, str], words: Sequence[str]) -> str | None:
    """The command that the first of `words` names, None where there is none; `menu`'s help lists the `summaries`."""
    commands = menu.add_subparsers(dest="chosen", metavar=metavar)
    for name, summary in summaries.items():
        commands.add_parser(name, help=summary, add_help=False)
    first = words[0] if words else ""
    if first and not first.startswith("-") and first not in summaries:
        menu.error(f"no such {metavar.lower()}: {first}{did_you_mean(first, summaries)}")
    name = menu.parse_known_args(words[:1])[0].chosen
    assert name is None or isinstance(name, str)
    return name


def read_options(options: type[_T], words: Sequence[str], parser: Parser | None = None) -> _T:
    """The options that `words` say; raises `BadInput` for what cannot be understood."""
    reader = Parser() if parser is None else parser
    _add(reader, options)
    found, unknown = reader.parse_known_args(words)
    if unknown:
        name = unknown[0].partition("=")[0]
        what = "no such option" if name.startswith("-") else "not understood"
        reader.error(f"{what}: {unknown[0]}{nearest(name, _names(options))}")
    return _built(options, vars(found))


def _add(to: "argparse.ArgumentParser | argparse._ArgumentGroup", options: type[Any]) -> None:
    rivals: dict[str, argparse._MutuallyExclusiveGroup] = {}
    for one in fields(options):
        match one.metadata.get(_KEY):
            case _OptionGroup(options=shared, title=title):
                _add(to.add_argument_group(title) if title else to, shared)
            case _Spec(is_option=False, keywords=keywords):
                to.add_argument(one.name, default=argparse.SUPPRESS, **_plain(keywords))
            case _Spec(rivals=name) as spec:
                if name and name not in rivals:
                    rivals[name] = to.add_mutually_exclusive_group()
                _add_option((rivals[name] if name else to).add_argument, one.name, spec)


def _add_option(add: _Add, field_name: str, spec: _Spec) -> None:
    keywords = {**_plain(spec.keywords), "dest": field_name, "default": argparse.SUPPRESS}
    add(_name(field_name, spec), **keywords)
    for old in spec.names[1:]:
        add(old, **{**keywords, "help": HIDDEN})


def _plain(keywords: Mapping[str, Any]) -> dict[str, Any]:
    """The keywords with their help as it is to be read: a percent sign is one."""
    return {**keywords, "help": keywords["help"].replace("%", "%%")}


def _name(field_name: str, spec: _Spec) -> str:
    return spec.names[0] if spec.names else f"--{field_name.replace('_', '-')}"


def _names(options: type[Any]) -> Iterator[str]:
    """The names that the help shows."""
    for one in fields(options):
        match one.metadata.get(_KEY):
            case _OptionGroup(options=shared):
                yield from _names(shared)
            case _Spec(is_option=True, keywords=keywords) as spec if keywords["help"] != HIDDEN:
                yield _name(one.name, spec)


def _built(options: type[_T], found: Mapping[str, Any]) -> _T:
    """The options of what was `found`, which holds nothing but what was said."""
    values: dict[str, Any] = {}
    for one in fields(options):  # type: ignore[arg-type]
        match one.metadata.get(_KEY):
            case _OptionGroup(options=shared):
                values[one.name] = _built(shared, found)
            case None:
                values[one.name] = frozenset(found)
            case _ if one.name in found:
                value = found[one.name]
                values[one.name] = tuple(value) if isinstance(value, list) else value
    return options(**values)
