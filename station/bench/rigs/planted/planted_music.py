"""The music on which faults are planted: every shipped lesson as its session lays it out, and grooves of real drummers.

A human groove is a take of the Groove MIDI Dataset (Gillick 2019, CC-BY-4.0) whose strokes are put on the nearest
sixteenth or triplet, whichever fits the take better, and whose loudness is told in three words: that is its written
score. The dataset is read where it lies beside the project (`shared/data/gmd`), and left out where it does not.
"""

import csv
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import station
from station.core.pieces import CLOSED, Dynamic, Limb, Ornament, Piece
from station.core.units import PPQ
from station.drills.library import find_lesson, lesson_names
from station.motion.kit.kit import DEFAULT_KIT, load_kit
from station.music.formats.smf.drum_tracks import score_from_midi
from station.music.formats.smf.standard_midi import read_midi
from station.music.score import Score
from station.music.tempo import TempoMap
from station.practice.session.leading_hand import with_sticking
from station.practice.session.plan import PlanOptions, plan_practice

GMD_BARS = (8, 24)
"""Fewest and most bars of a groove: a minute at 100 bpm is 24, which is also about what a lesson takes."""

_GHOST_BELOW, _ACCENT_FROM = 46, 105
"""HUMANS, Velocity and ears: ghosts 20–45, accents 105–127."""
_WRITTEN_VELOCITY = {Dynamic.GHOST: 35, Dynamic.NORMAL: 80, Dynamic.ACCENT: 115}
"""The middle of each of those classes."""


@dataclass(frozen=True, eq=False)
class Music:
    """A score as it is practised; `pass_bars` bars make a pass (None: played once), `first_bar` from 0.

    `has_sticking` where the student reads which hand plays what, so that doubles and hands can be compared.
    """

    name: str
    score: Score
    pass_bars: int | None = None
    first_bar: int = 0
    has_sticking: bool = True


@cache
def lesson(name: str) -> Music:
    """The session of a shipped lesson at its own tempo, with all its passes."""
    plan = plan_practice(find_lesson(name), PlanOptions())
    return Music(name, plan.score, plan.section.bar_count, plan.first_bar)


def lessons() -> list[Music]:
    """All shipped lessons."""
    return [lesson(name) for name in lesson_names()]


def gmd_folder() -> Path | None:
    """Where the dataset lies, None where it does not."""
    for above in Path(station.__file__).resolve().parents:
        folder = above / "shared" / "data" / "gmd"
        if (folder / "info.csv").is_file():
            return folder
    return None


@cache
def grooves() -> tuple[Music, ...]:
    """The human grooves in four quarters that are long enough; none where the dataset is not there."""
    folder = gmd_folder()
    return () if folder is None else tuple(_grooves(folder))


def _grooves(folder: Path) -> Iterator[Music]:
    with (folder / "info.csv").open(encoding="utf-8", newline="") as table:
        rows = [row for row in csv.DictReader(table) if row["beat_type"] == "beat" and row["time_signature"] == "4-4"]
    for row in rows:
        path = folder / row["midi_filename"]
        if path.is_file():
            written = on_grid(score_from_midi(read_midi(path)), float(row["bpm"]))
            if written is not None:
                kit = load_kit(DEFAULT_KIT)
                yield Music(f"gmd/{row['id']}", with_sticking(written, kit, None), has_sticking=False)


def on_grid(played: Score, tempo_bpm: float) -> Score | None:
    """What a played groove would be on paper, whole bars from its first; None where it is too short."""
    rows = played.notes[played.notes["lead_ms"] == 0]
    ticks = rows["tick"].astype(np.int64)
    step = min((PPQ // 4, PPQ // 3), key=lambda grid: float(np.mean(np.abs(ticks - _snapped(ticks, grid)) / grid)))
    tick = _snapped(ticks, step)
    first_bar = int(tick.min()) // (4 * PPQ) if len(tick) else 0
    bars = min((int(tick.max()) // (4 * PPQ) if len(tick) else 0) - first_bar, GMD_BARS[1])
    if bars < GMD_BARS[0]:
        return None
    tick = tick - first_bar * 4 * PPQ
    inside = (tick >= 0) & (tick < bars * 4 * PPQ)
    return _written(rows[inside], tick[inside], TempoMap.constant(tempo_bpm), bars * 4 * PPQ)


def _snapped(ticks: NDArray[np.int64], step: int) -> NDArray[np.int64]:
    return (ticks + step // 2) // step * step


def _written(rows: NDArray[np.void], tick: NDArray[np.int64], tempo_map: TempoMap, end_tick: int) -> Score:
    """Of several strokes of a piece on one place the loudest, its velocity that of its class."""
    rows = rows.copy()
    rows["tick"] = tick
    loudest_first = np.lexsort((-rows["velocity"].astype(np.int64), rows["piece"], tick))
    rows = rows[loudest_first]
    same = (np.diff(rows["tick"]) == 0) & (np.diff(rows["piece"].astype(np.int64)) == 0)
    rows = rows[np.concatenate([[True], ~same])]
    velocity = rows["velocity"]
    is_ghost = (velocity < _GHOST_BELOW) & (rows["piece"] == Piece.SNARE)  # a soft hi-hat is just soft
    dynamic = np.where(is_ghost, Dynamic.GHOST, Dynamic.NORMAL)
    dynamic[velocity >= _ACCENT_FROM] = Dynamic.ACCENT
    rows["dynamic"] = dynamic
    rows["velocity"] = np.array([_WRITTEN_VELOCITY[Dynamic(d)] for d in dynamic])
    hats = rows["piece"] == Piece.HIHAT
    half = np.nan_to_num(rows["openness"], nan=CLOSED) >= 0.5
    rows["openness"] = np.where(hats, half.astype(np.float32), np.nan)
    rows["ornament"], rows["limb"], rows["duration_ticks"] = Ornament.NONE, Limb.UNKNOWN, 0
    return Score.from_array(rows, tempo_map, end_tick)
