"""A song of four minutes from its files to a verdict: prints what each step takes and how far it is off.

    python benchmarks/song_practice.py [--songs N] [--first SEED] [--length S]

A virtual band (`station.simulation.bands`) drifts; its part is written as MIDI at one tempo, its sound as OGG. `station
song new` makes a song of both and five points. Then some of its bars are looped at 60 %: their sound is made ready, and
a virtual student plays them, 15 ms behind a band whose true beats are known. What the judgement says of them is held
against the truth: the station's own idea of the band must not hide it. Everything has a seed.
"""

import argparse
import contextlib
import io
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

import numpy as np
import soundfile

from station.cli.command_line import main as station
from station.core.units import PPQ
from station.drills.songs.band_tempo import tempo_map_of
from station.drills.songs.song_lesson import read_song_lesson
from station.music.drum_part import DrumPart
from station.music.formats.smf.midi_part import MIDI
from station.practice.session.backing_track import song_request
from station.practice.session.plan import Plan, PlanOptions, plan_practice
from station.scoring.align import align
from station.simulation.bands.band_sound import RATE_HZ
from station.simulation.bands.band_timing import BandDrift
from station.simulation.bands.made_song import MadeSong, SongSpec, made_song
from station.simulation.student_spec import parse_spec
from station.simulation.virtual_student import play
from station.sound.track_file import prepare

T = TypeVar("T")
SPEED, BARS, LOOPS = 0.6, 8, 4
LATE_MS, SD_MS = 15.0, 5.0
CARD_HZ = 48_000
POINTS = 5


def main(arguments: Sequence[str]) -> None:
    """Make the songs, synchronise and practise them, print a row for each."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0] if __doc__ else None)
    parser.add_argument("--songs", type=int, default=3)
    parser.add_argument("--first", type=int, default=300, help="seed of the first song")
    parser.add_argument("--length", type=float, default=240.0, help="seconds")
    options = parser.parse_args(arguments)
    head = "Seed | Beats | P50 | P95 | Within 10 ms | Bars | Beats lie | Student | Judged | song new | track | judging"
    print(f"| {head} |\n|{'---|' * (head.count('|') + 1)}")
    for seed in range(options.first, options.first + options.songs):
        with tempfile.TemporaryDirectory() as folder:
            print(_row(seed, options.length, Path(folder)), flush=True)


def _row(seed: int, length_s: float, folder: Path) -> str:
    rng = np.random.default_rng(seed)
    bpm = float(rng.uniform(85.0, 150.0))
    song = made_song(SongSpec(seed, length_s, bpm, float(round(bpm)), BandDrift(walk=0.025)))
    path, new_s = _timed(lambda: _new_song(song, folder))
    lesson = read_song_lesson(path)
    assert lesson.band is not None
    found_s = lesson.band.start_s + lesson.score.tempo_map.seconds_at(song.beat_ticks)
    miss_ms = 1e3 * (found_s - song.beat_s)
    first = 1 + 4 * int(rng.integers(0, (lesson.score.bar_count - BARS) // 4))
    own = PlanOptions(lesson.tempo_bpm * SPEED, LOOPS, (first, first + BARS - 1))
    plan = plan_practice(lesson, own)
    request = song_request(plan)
    assert request is not None
    track, track_s = _timed(lambda: prepare(request.track(plan, CARD_HZ), folder / "tracks"))
    assert track.turns == LOOPS
    judged_ms, session_s = _timed(lambda: _judged_ms(plan, request.start_s, song))
    here = slice(4 * (first - 1), 4 * (first - 1 + BARS))
    off = np.abs(miss_ms)
    beats = f"{len(off)} | {np.median(off):.1f} | {np.quantile(off, 0.95):.1f} | {100 * np.mean(off < 10.0):.1f} %"
    bars = f"{first}–{first + BARS - 1} | {np.mean(miss_ms[here]) / SPEED:+.1f} | {LATE_MS:+.1f} | {judged_ms:+.1f}"
    return f"| {seed} | {beats} | {bars} | {new_s:.1f} s | {track_s:.1f} s | {session_s:.1f} s |"


def _new_song(song: MadeSong, folder: Path) -> Path:
    """What `station song new` makes of the files of a song and five points of it."""
    assert MIDI.write is not None
    (folder / "part.mid").write_bytes(MIDI.write(DrumPart(song.score)).data)
    with soundfile.SoundFile(folder / "band.ogg", "w", RATE_HZ, 1) as file:
        for first in range(0, len(song.mono), RATE_HZ):  # libvorbis fails on minutes at once
            file.write(song.mono[first : first + RATE_HZ])
    beats = np.rint(np.linspace(0, len(song.beat_s) - 9, POINTS) / 4).astype(int) * 4
    points = [word for beat in beats for word in ("--point", f"{beat // 4 + 1}.1={song.beat_s[beat]:.3f}")]
    path = folder / "song.song"
    files = ["--part", str(folder / "part.mid"), "--sound", str(folder / "band.ogg"), "--out", str(path)]
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()) as said:
        assert station(["song", "new", *files, *points]) == 0, said.getvalue()
    return path


def _judged_ms(plan: Plan, start_s: float, song: MadeSong) -> float:
    """How late the judgement takes a student to be who is `LATE_MS` behind the true band, as it sounds from `start_s`.

    They play along to the bars of the sound, slowed and looped; what they are judged by is the station's own idea.
    """
    first = int(plan.lesson.score.tempo_map.bar_start(plan.first_bar))
    ticks = [*range(0, plan.score.end_tick, PPQ), plan.score.end_tick]
    passes, within = np.divmod(ticks, plan.section.end_tick)
    turn_s = float(plan.section.tempo_map.seconds_at(plan.section.end_tick))
    true_s = passes * turn_s + (song.seconds_at(first + within) - start_s) / SPEED
    tempo_map, begin_s = tempo_map_of(plan.score.tempo_map, ticks, true_s.tolist())
    spec = parse_spec(f"seed=5,bias_ms={LATE_MS + 1e3 * begin_s:.3f},sd_ms={SD_MS:g}")
    take = play(replace(plan.score, tempo_map=tempo_map), spec).performance
    return float(np.mean(align(plan.score, take, clocked=True).asynchrony_ns)) / 1e6


def _timed(act: Callable[[], T]) -> tuple[T, float]:
    begin_s = time.perf_counter()
    return act(), time.perf_counter() - begin_s


if __name__ == "__main__":
    main(sys.argv[1:])
