"""The takes of the Groove MIDI Dataset as beats: what the battle's model is trained and measured on."""

import csv
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from station.music.formats.smf.standard_midi import performance_from_midi, read_midi, score_from_midi
from station.music.performance import Performance
from station.practice.battle.ground import Feel, Ground
from station.practice.battle.improvising.beat_steps import Music, styles_of
from station.practice.battle.improvising.played_beats import Beats, beats_of, joined
from station.practice.battle.phrase import Turn

WINDOW_BARS = 8
"""A take is read in turns of so many bars: as long as the longest that are traded, and its lean may change."""
SWUNG = frozenset({"jazz", "shuffle"})
"""Styles whose beats are triplets where the playing leaves it open."""
NO_CLICK = frozenset({"drummer2/session2/7_rock_130_beat_4-4.mid"})
"""Takes whose strokes lie anywhere in the beat of their file's tempo: they were played to no click that it tells."""


@dataclass(frozen=True, eq=False)
class GrooveTake:
    """A take: whose it is, its file, its music, whether it is one of the grooves that several drummers play.

    `played` is as the file has it, `beats` what it is read as, from bar `first_bar` of the file on.
    """

    drummer: str
    file: str
    ground: Ground
    music: Music
    played: Performance
    beats: Beats
    first_bar: int
    is_shared: bool

    @property
    def is_triplet(self) -> bool:
        """Whether most beats that say something are divided by three."""
        return bool(np.mean(np.isin(self.beats.division, (3, 6))) > 0.5)

    @property
    def is_straight_four(self) -> bool:
        """Whether it is one of those that a grid of sixteenths can hold."""
        return self.ground.beats == 4 and not self.is_triplet


def groove_takes(data: Path) -> list[GrooveTake]:
    """All takes under `data`, by their files' names."""
    with (data / "info.csv").open(encoding="utf-8") as file:
        told = {row["midi_filename"]: row for row in csv.DictReader(file)}
    files = sorted(path.relative_to(data).as_posix() for path in data.rglob("*.mid"))
    return [_take(data, name, told[name]["style"]) for name in files if name not in NO_CLICK]


def _take(data: Path, name: str, style: str) -> GrooveTake:
    midi = read_midi(data / name)
    tempo_map = score_from_midi(midi).tempo_map
    meter = tempo_map.meters[0]
    styles = styles_of(style)
    feel = Feel.TRIPLET if styles & SWUNG else Feel.STRAIGHT
    ground = Ground(round(tempo_map.tempos[0].tempo_bpm, 2), meter.beats, meter.unit, feel, style)
    played = performance_from_midi(midi)
    bar_ns = ground.ns_of_bars(1)
    first_bar = int(max(played.hits["at_ns"].min() / bar_ns, 0))
    last_bar = int(played.hits["at_ns"].max() / bar_ns + 0.25)  # what comes late is the last bar's landing
    last_bar = max(last_bar, first_bar + 1)
    beats = joined(
        [
            beats_of(Turn(ground, min(WINDOW_BARS, last_bar - bar), played.shifted(-ground.ns_of_bars(bar))))
            for bar in range(first_bar, last_bar, WINDOW_BARS)
        ]
    )
    is_fill = "_fill_" in name and beats.bars < 4
    music = Music(styles, feel, ground.beats_a_minute, phrase_bar=3 if is_fill else 0)
    drummer = name.split("/", maxsplit=1)[0]
    return GrooveTake(drummer, name, ground, music, played, beats, first_bar, "eval_session" in name)


def turn_of(take: GrooveTake, bar: int, bars: int) -> Turn:
    """So many bars of the take from bar `bar` of its beats on, as a turn."""
    return Turn(take.ground, bars, take.played.shifted(-take.ground.ns_of_bars(take.first_bar + bar)))


def on_sixteenths(take: GrooveTake) -> GrooveTake:
    """The take with every beat in four cells, strokes on the nearest: what a grid of sixteenths makes of it."""
    beats = Beats.silent(len(take.beats), take.beats.beats_a_bar)
    for beat, cell, instrument in np.argwhere(take.beats.struck).tolist():
        place = round(4 * cell / int(take.beats.division[beat]) + 1e-9)
        at = min(beat + place // 4, len(beats) - 1), place % 4 if beat + place // 4 < len(beats) else 3, instrument
        beats.struck[at], beats.velocity[at] = True, take.beats.velocity[beat, cell, instrument]
    return replace(take, beats=beats)


def weights_of(takes: Sequence[GrooveTake]) -> list[float]:
    """How much each take's steps count in training: the longer it goes on, the less a bar more tells."""
    return [float(min(1.0, (32 / take.beats.bars) ** 0.5)) for take in takes]
