"""Throws broken files at every importer: only `BadInput` may come out, in time and within memory.

    python -m benchmarks.fuzz_formats --inputs 100000 --seed 1 [--format DTX] [--files FOLDER …] [--whole]

Seeds are files of the station's own making in every format that it writes, and those found in FOLDER. An input is a
seed with some bytes or lines changed, cut, doubled or swapped with those of another seed, broken in the ways of its
kind (`hostile_bytes`), or a zip of such; some are files of another format. `--whole` goes on to the lesson.
Prints a table, and keeps each input that fails in `--keep`.
"""

import argparse
import io
import random
import resource
import signal
import time
import zipfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path

import mido

from benchmarks.hostile_bytes import ways_for
from station.core.errors import BadInput
from station.core.toml.schema import reading
from station.core.toml.toml_source import source_of
from station.drills.library import shipped_lessons
from station.drills.reading.lesson_file import lesson_reader
from station.drills.transcription.transcribe import transcribe
from station.drills.writing.lesson_part import part_of
from station.music.drum_part import DrumPart
from station.music.formats.clone_hero.clone_hero_format import NOTES_MIDI
from station.music.formats.format_table import FORMATS
from station.music.formats.groovescribe.groove_formats import GROOVE_TEXT, GROOVESCRIBE
from station.music.formats.music_format import MusicFormat
from station.music.formats.text_score import score_text

LIMIT_S, LIMIT_MB = 2.0, 500
_LESSONS = 12
_MOST_BYTES = 2_000_000
"""Of an input (our choice: what grows, grows no further)."""
_USUAL_BYTES, _LONG = 40_000, 0.02
"""All but so many are no longer than that: most faults need no length, and a million inputs must end (our choice)."""
_EXCERPT_BARS = 2
_NAME = "input"
_STRANGERS_BYTES = 20_000
"""Of a stranger's file that is a seed."""
_STRANGERS = 0.03
"""So many inputs are files of another format (our choice)."""
_TOLD_EVERY = 10_000
_BOMB, _BOMBS = bytes(60_000_000), 0.005
"""What some zips are given for a file: it packs to a thousandth."""
_OUR_FAULT = ("became", "internal")
"""Words of refusals that blame the file for what a writer of ours did."""


class TooSlow(Exception):
    """An input took longer than the limit."""


@dataclass
class Tally:
    """What came of the inputs of one format."""

    read: int = 0
    refused: int = 0
    slowest_s: float = 0.0
    failures: list[str] = field(default_factory=list)


def seeds_of(known: MusicFormat, folders: Sequence[Path]) -> list[bytes]:
    """Files of this format: our own, and strangers' where they can be read."""
    found: list[bytes] = []
    if known.write is not None:
        for lesson in shipped_lessons()[:: max(len(shipped_lessons()) // _LESSONS, 1)]:
            with suppress(BadInput):
                part = part_of(lesson)
                found += [known.write(_excerpt(part)).data, known.write(_excerpt(part)).data, known.write(part).data]
    files = (path for folder in folders for path in sorted(folder.rglob("*")))
    strangers = (
        p.read_bytes() for p in files if p.suffix.lower() in known.endings and p.stat().st_size < _STRANGERS_BYTES
    )
    found += [data for data in strangers if known.recognises(data)]
    if known is LESSON:
        found += [lesson.text.encode() for lesson in shipped_lessons()[::8]]
    if known.name == "text score":
        scores = [lesson.score for lesson in shipped_lessons()[::16]]
        found += [score_text(score, score.notes["limb"]).encode() for score in scores]
    if known is NOTES_MIDI:
        found.append(_game_notes())
    if known is GROOVE_TEXT:
        found += seeds_of(GROOVESCRIBE, ())
    return found or [b"station", b"<score/>", bytes(range(256))]


def _excerpt(part: DrumPart) -> DrumPart:
    """Its first bars, which have all that its format has and are read in a tenth of the time."""
    return replace(part, score=part.score.bars(0, min(_EXCERPT_BARS, part.score.bar_count) - 1), sections=())


def _game_notes() -> bytes:
    """A `notes.mid` with every number that the games' drums know, by another program's writer."""
    track = mido.MidiTrack([mido.MetaMessage("track_name", name="PART DRUMS")])
    for number in (96, 97, 98, 99, 100, 101, 109, 110, 112, 25, *range(26, 52), 126, 127, 95, 84, 85, 60, 61) * 3:
        track.append(mido.Message("note_on", note=number, velocity=1 + number % 127, time=60))
        track.append(mido.Message("note_off", note=number, time=30))
    events = mido.MidiTrack([mido.MetaMessage("track_name", name="EVENTS")])
    events += [mido.MetaMessage("text", text=f"[section {name}]", time=960) for name in ("intro", "verse")]
    midi, file = mido.MidiFile(tracks=[mido.MidiTrack([mido.MetaMessage("set_tempo")]), track, events]), io.BytesIO()
    midi.save(file=file)
    return file.getvalue()


def mutated(seeds: Sequence[bytes], rng: random.Random) -> bytes:
    """One broken file; of a zip sometimes the file within is broken, and packed again."""
    data = rng.choice(seeds)
    most = _MOST_BYTES if rng.random() < _LONG else max(_USUAL_BYTES, len(data) + 1000)
    if data[:2] == b"PK" and rng.random() < 0.7:
        return _repacked(data, rng)
    for _ in range(rng.choice((1, 1, 1, 2, 4, 16))):
        data = rng.choice(_WAYS if rng.random() < 0.5 else ways_for(data))(data, seeds, rng)[:most]
    return data


def _inputs(seeds: Sequence[bytes], strangers: Sequence[bytes], count: int, rng: random.Random) -> Iterator[bytes]:
    for _ in range(count):
        yield mutated(strangers if rng.random() < _STRANGERS else seeds, rng)


def _repacked(data: bytes, rng: random.Random) -> bytes:
    out = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as new:
        names = old.namelist()
        broken = rng.choice(names)
        for name in names:
            inside = old.read(name)
            hostile = _BOMB if rng.random() < _BOMBS else mutated([inside], rng) if name == broken else inside
            new.writestr(name, hostile)
    return out.getvalue()


def _flip(data: bytes, _: Sequence[bytes], rng: random.Random) -> bytes:
    if not data:
        return b"x"
    at = rng.randrange(len(data))
    return data[:at] + bytes([rng.randrange(256)]) + data[at + 1 :]


def _cut(data: bytes, _: Sequence[bytes], rng: random.Random) -> bytes:
    a, b = sorted(rng.randrange(len(data) + 1) for _ in range(2))
    return data[:a] + data[b:] if rng.random() < 0.7 else data[:b]


def _double(data: bytes, _: Sequence[bytes], rng: random.Random) -> bytes:
    a, b = sorted(rng.randrange(len(data) + 1) for _ in range(2))
    return data[:b] + data[a:b][:20_000] * rng.choice((1, 2, 8)) + data[b:]


def _splice(data: bytes, seeds: Sequence[bytes], rng: random.Random) -> bytes:
    other = rng.choice(seeds)
    a, b = rng.randrange(len(data) + 1), rng.randrange(len(other) + 1)
    return data[:a] + other[b : b + rng.choice((10, 100, 10_000))] + data[a:]


def _swap_lines(data: bytes, _: Sequence[bytes], rng: random.Random) -> bytes:
    lines = data.split(b"\n")
    a, b = rng.randrange(len(lines)), rng.randrange(len(lines))
    lines[a], lines[b] = lines[b], lines[a]
    return b"\n".join(lines)


_WAYS: tuple[Callable[[bytes, Sequence[bytes], random.Random], bytes], ...] = (
    _flip,
    _flip,
    _cut,
    _double,
    _splice,
    _swap_lines,
)


def run(known: MusicFormat, inputs: Iterator[bytes], then: Callable[[DrumPart], None], keep: Path) -> Tally:
    """Read every input, and do with what was read as `then` does."""
    tally = Tally()
    for count, data in enumerate(inputs, 1):
        before = time.process_time()
        signal.setitimer(signal.ITIMER_PROF, LIMIT_S)
        try:
            known.recognises(data)
            part = known.read(data, _NAME)
            then(part)
            tally.read += 1
        except BadInput as fault:
            tally.refused += 1
            if fault.source != _NAME or any(word in fault.fault for word in _OUR_FAULT):
                tally.failures.append(_kept(known, data, fault, len(tally.failures), keep))
        except Exception as fault:
            tally.failures.append(_kept(known, data, fault, len(tally.failures), keep))
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0)
        tally.slowest_s = max(tally.slowest_s, time.process_time() - before)
        if count % _TOLD_EVERY == 0:
            print(f"  {known.name}: {count} inputs, {len(tally.failures)} failed", flush=True)
    return tally


def _kept(known: MusicFormat, data: bytes, fault: Exception, number: int, keep: Path) -> str:
    """The input in a file, and a line that says where and what came of it."""
    keep.mkdir(parents=True, exist_ok=True)
    where = keep / f"{known.name.replace(' ', '-').replace('/', '-')}-{number}{known.endings[0]}"
    where.write_bytes(data)
    return f"{where}: {type(fault).__name__} {str(fault)[:150]}"


def _as_lesson(part: DrumPart) -> None:
    transcribe(part, _NAME)


def _read_lesson(data: bytes, source: str) -> DrumPart:
    """A lesson's text as its own reader has it, to be broken like any other file."""
    found = reading(source_of(data, source), lesson_reader(source))
    if found[0] is None:
        raise BadInput(source, "", found[1][0].text)
    return part_of(found[0])


LESSON = MusicFormat("lesson", (".toml",), _read_lesson, lambda _: True, 1 << 20)
"""No format of `FORMATS`, but what teachers send each other."""


def _too_slow(*_: object) -> None:
    raise TooSlow(f"longer than {LIMIT_S:g} s")


def _limit_memory() -> None:
    """No more than the limit beyond what the program itself takes."""
    used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    limit = used + LIMIT_MB * 2**20
    resource.setrlimit(resource.RLIMIT_AS, (limit, limit))


def main() -> None:
    """Read the words of the command line, and throw."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--inputs", type=int, default=10_000, help="of each format")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--format", default="", help="the name of one format")
    parser.add_argument("--files", type=Path, nargs="*", default=[])
    parser.add_argument("--keep", type=Path, default=Path("fuzz-failures"))
    parser.add_argument("--whole", action="store_true", help="on to the lesson")
    options = parser.parse_args()
    signal.signal(signal.SIGPROF, _too_slow)
    chosen = [known for known in (*FORMATS, LESSON) if options.format in ("", known.name)]
    seeds = {known.name: seeds_of(known, options.files) for known in chosen}
    _limit_memory()
    for known in chosen:
        rng = random.Random(f"{options.seed} {known.name}")
        strangers = [data for name, found in seeds.items() if name != known.name for data in found[:3]]
        inputs = _inputs(seeds[known.name], strangers or seeds[known.name], options.inputs, rng)
        tally = run(known, inputs, _as_lesson if options.whole else lambda _: None, options.keep)
        print(
            f"{known.name:14} {len(seeds[known.name]):3} seeds {tally.read:8} read {tally.refused:8} refused "
            f"{len(tally.failures):4} failed, slowest {tally.slowest_s:.2f} s",
            flush=True,
        )
        for line in tally.failures[:10]:
            print(f"  {line}", flush=True)
    peak_mb = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"peak memory of the whole program {peak_mb:.0f} MB")


if __name__ == "__main__":
    main()
