"""Throws hostile assignments, returns and notes at what reads them: a value or one line comes out, in time and memory.

    python -m benchmarks.parcels.fuzz_parcels --inputs 1000000 --seed 1 --kinds assignment return

Each input has its own source of chance, made of the seed and its number: `--first` goes on where a run was ended, and
throws a single one again with `--inputs 1`. The kinds take turns. An assignment that can be read has its lessons read
too. Some files are kept in a home of their own, where afterwards nothing may lie but what keeping leaves; of some
returns a session is judged again. Time is the process's own, memory what reading takes.
Prints a table, and keeps each input that does harm in `--keep`.
"""

import argparse
import random
import resource
import shutil
import signal
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from pathlib import Path

from benchmarks.parcels.hostile_parcels import hostile, seeds
from station.core.disk.file_names import folder_name
from station.core.disk.files import write_whole
from station.core.errors import BadInput
from station.core.settings import Settings
from station.drills.library import find_lesson
from station.practice.exchange.assignment_file import (
    AssignedLesson,
    Assignment,
    assignment_bytes,
    lessons_of,
    parse_assignment,
)
from station.practice.exchange.assignment_file import readme_text as assignment_words
from station.practice.exchange.note_file import Note, parse_note
from station.practice.exchange.parcel import KINDS, Kind
from station.practice.exchange.return_file import parse_return
from station.practice.exchange.return_file import readme_text as return_words
from station.practice.exchange.return_judging import judge_returned
from station.practice.exchange.student_store import keep_note, take
from station.practice.exchange.teacher_store import receive
from station.practice.history.session_files import write_document
from station.practice.records.assigned_lessons import Taken, write_taken

LIMIT_S, LIMIT_MB = 1.0, 300
_JUDGED, _KEPT = 0.1, 0.05
"""Shares of returns that are judged again, and of all files that are kept (our choice: a million must end)."""
_KEPT_ENDINGS = (".json", ".toml", *(kind.ending for kind in Kind))
_NOW = datetime(2026, 11, 23)
_ASKED = Assignment(
    "a" * 32, 1, "Week 3", "Ms O", _NOW.astimezone(UTC), (AssignedLesson("rock-1", "Rock", find_lesson("rock-1").text),)
)
"""What the teacher gave, by whose words returns are judged."""
_JUDGING_S = 5.0
_LONGEST_LINE = 400
_TOLD_EVERY = 10_000


class TooSlow(BaseException):
    """An input took longer than its limit: nothing that catches an `Exception` may hide it."""


@dataclass
class Tally:
    """What came of the inputs of one kind."""

    read: int = 0
    refused: int = 0
    slowest_s: float = 0.0
    failures: list[str] = field(default_factory=list)


def _use(kind: Kind, data: bytes, rng: random.Random) -> None:
    match kind:
        case Kind.ASSIGNMENT:
            assignment = parse_assignment(data, "input")
            lessons_of(assignment, "input")
            _check_shown(assignment_words(assignment).split("\n"))
            if rng.random() < _KEPT:
                _keep(kind, data, lambda path, settings: take(path, settings, _NOW))
        case Kind.RETURN:
            returned = parse_return(data, "input")
            _check_shown(return_words(returned).split("\n"))
            if rng.random() < _KEPT:
                _keep(kind, data, receive)
            if rng.random() < _JUDGED:
                number = rng.randint(1, len(returned.sessions))
                signal.setitimer(signal.ITIMER_PROF, _JUDGING_S)
                _check_shown(judge_returned(returned, number, "input", Settings(), _ASKED).differences)
        case Kind.NOTE:
            note = parse_note(data, "input")
            _check_shown(note.lines)
            if rng.random() < _KEPT:
                _keep(kind, data, lambda path, settings: _answered(path, note, settings))


def _check_shown(lines: Iterable[str]) -> None:
    """What people are shown of a file has nothing that a terminal obeys."""
    assert all(line.isprintable() for line in lines), "what is shown cannot be printed"


def _answered(path: Path, note: Note, settings: Settings) -> None:
    """Keep a note where there is what it answers, as far as its own words can be believed."""
    folder = settings.sessions_dir / folder_name(settings.student) / "assignments" / "x"
    asked = replace(_ASKED, id=note.assignment_id)
    write_whole(folder / "assignment.drum-assignment", assignment_bytes(asked))
    write_taken(folder, Taken(asked.id, 1, _NOW.isoformat(), (("rock-1", "rock-1"),)))
    write_document(folder / "returns" / f"{note.return_id}.json", {"played": ["2026-11-23T14:00:00 rock-1"]})
    keep_note(path, settings)


def _keep(kind: Kind, data: bytes, keep: Callable[[Path, Settings], object]) -> None:
    """Keep it in a home of its own, twice, and see that nothing lies where nothing should."""
    home = Path(tempfile.mkdtemp(prefix="kept-"))
    try:
        (home / "in").mkdir()
        path = home / "in" / f"x{kind.ending}"
        path.write_bytes(data)
        for _ in range(2):
            keep(path, Settings(student="Zoë", sessions=str(home / "out")))
        kept = [each for each in (home / "out").rglob("*") if not each.is_dir()]
        assert all(each.suffix in _KEPT_ENDINGS for each in kept), kept
        assert sorted(each.name for each in home.iterdir()) == ["in", "out"], "it lies beside its home"
    finally:
        shutil.rmtree(home)


def _tried(kind: Kind, data: bytes, rng: random.Random, tally: Tally) -> str | None:
    """Read one input; why it did harm, None where it did none."""
    began_s = time.process_time()
    signal.setitimer(signal.ITIMER_PROF, LIMIT_S)
    try:
        with _limited_memory():
            _use(kind, data, rng)
        tally.read += 1
    except BadInput as fault:
        tally.refused += 1
        line = str(fault)
        if not line.isprintable() or len(line) > _LONGEST_LINE or "internal" in line:
            return f"says {line!r}"
    except (Exception, TooSlow) as fault:
        return f"{type(fault).__name__}: {str(fault)[:200]}"
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        tally.slowest_s = max(tally.slowest_s, time.process_time() - began_s)
    return None


def _too_slow(*_: object) -> None:
    raise TooSlow


@contextmanager
def _limited_memory() -> Iterator[None]:
    """Within, the process may have so much more; what is thrown was made before."""
    used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    _, most = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (used + LIMIT_MB * 2**20, most))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (most, most))


@dataclass(frozen=True, slots=True)
class Throw:
    """What is thrown: inputs `first` to `last` of a `seed`, these `kinds` in turn; what does harm goes to `keep`."""

    first: int
    last: int
    seed: int
    kinds: tuple[Kind, ...]
    keep: Path


def run(throw: Throw, tell: Callable[[str], None]) -> dict[Kind, Tally]:
    """Throw them; every ten thousand one line is told."""
    of = {kind: [seed for seed in seeds() if seed.kind is kind] for kind in throw.kinds}
    tallies = {kind: Tally() for kind in Kind}
    for index in range(throw.first, throw.last + 1):
        rng = random.Random(f"{throw.seed}-{index}")
        kind, data = hostile(of[throw.kinds[index % len(throw.kinds)]], rng)
        why = _tried(kind, data, rng, tallies[kind])
        if why is not None:
            name = f"{throw.seed}-{index}"
            tallies[kind].failures.append(f"{name}: {why}")
            throw.keep.mkdir(parents=True, exist_ok=True)
            (throw.keep / f"{name}{kind.ending}").write_bytes(data)
            tell(f"FAILED {kind.name} {name}: {why}")
        if index % _TOLD_EVERY == 0:
            tell(f"{index} of {throw.last}: {_sum_of(tallies)}")
    return tallies


def _sum_of(tallies: dict[Kind, Tally]) -> str:
    failed = sum(len(one.failures) for one in tallies.values())
    slowest_s = max(one.slowest_s for one in tallies.values())
    peak_mb = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return f"{failed} failed, slowest {slowest_s:.2f} s, peak {peak_mb:.0f} MB, {time.process_time():.0f} s in all"


def main() -> None:
    """Read the words of the command line, and throw."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--inputs", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--kinds", nargs="+", choices=sorted(KINDS), default=sorted(KINDS))
    parser.add_argument("--keep", type=Path, default=Path("fuzz-failures"))
    options = parser.parse_args()
    signal.signal(signal.SIGPROF, _too_slow)
    kinds = tuple(KINDS[word] for word in options.kinds)
    throw = Throw(options.first, options.first + options.inputs - 1, options.seed, kinds, options.keep)
    tallies = run(throw, lambda line: print(line, flush=True))
    for kind, tally in tallies.items():
        print(
            f"{kind.name:11} {tally.read:8} read {tally.refused:8} refused {len(tally.failures):4} failed, "
            f"slowest {tally.slowest_s:.2f} s of its own time"
        )
    print(_sum_of(tallies))


if __name__ == "__main__":
    main()
