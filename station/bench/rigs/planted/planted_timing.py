"""Planted faults of time: strokes that come late or early, tempo that runs off, scatter, flams.

Sizes are those of part 7's table where it has a row; the others say where they come from.
"""

from dataclasses import replace

import numpy as np

from station.bench.rigs.planted.planted_oracle import smallest_sd_ms
from station.bench.rigs.planted.planted_player import Sheet
from station.bench.rigs.planted.planted_shapes import HANDS
from station.bench.rigs.planted.planted_stage import FEWEST, MOST, Maker, Planted, Stage
from station.bench.rigs.planted.planted_strokes import Written
from station.core.pieces import Limb
from station.core.units import NS_PER_S

LEAN_MS, SWING_MS, LANDING_MS = 25.0, 30.0, 40.0
WAIT_MS, WHOLE_MS = 40.0, 40.0
"""No row of their own: HUMANS' clear fault, 40 ms."""
LIMB_SD_MS, LIMB_SD_TIMES, ALL_SD_MS = 30.0, 1.5, 40.0
"""The whole has no row of its own: beyond nine of ten professional takes (HUMANS, Groove MIDI: P90 37 ms)."""
DOUBLE_SHARE, TEMPO_SHARE, TEMPO_BARS = 0.2, 0.04, 8
WIDE_MS, TIGHT_MS = 55.0, 5.0
"""A flam's scatter, 5 ms, beyond the limits of 50 and 10 ms."""
LIMBS = {**HANDS, "right_foot": Limb.RIGHT_FOOT, "left_foot": Limb.LEFT_FOOT}

_MOST_SHARE = {True: 0.75, False: 0.45}
"""The largest share of strokes that leans: without a click those that do not lean must be the majority."""
_MOST_GRACES = 0.1
"""Where more strokes are graces, no hand leans: a grace would have to lean with its main stroke, the other hand's."""
_FEWEST_FILLS = 3
"""Once or twice is no habit; our choice."""
_SWUNG_PLACE = 0.6
"""3:2, the mildest swing that lessons write."""
_SD_OF_GAP = 0.25
"""Strokes that scatter by more of the shortest intervals change places."""


def shifted(name: str) -> Maker:
    """Strokes that come late or early."""

    def make(stage: Stage) -> Planted | None:
        written, shape = stage.written, stage.shapes["time"].get(name)
        if shape is None:
            return None
        strokes, teachers = shape != 0, _teachers_ms(name, written)
        most = _MOST_SHARE[stage.conditions.clocked] * written.main.sum()
        if not (FEWEST <= strokes.sum() <= most and _is_habit(name, written)):
            return None
        size = max(teachers, stage.least("time", shape))
        if size > MOST * teachers or (name == "straight_swing" and size > _beat_ms(written) * _late_share(written)):
            return None
        planted_ms = stage.times * size
        return Planted(name, planted_ms, strokes, "time", lambda sheet, _: sheet.later(planted_ms * shape))

    return make


def _is_habit(name: str, written: Written) -> bool:
    """Whether the music lets a player have such a habit at all."""
    if name.endswith("_hand"):
        return bool(written.score.is_grace.mean() <= _MOST_GRACES)
    if "fill" in name:
        return len(written.fills) >= _FEWEST_FILLS
    return written.only_eighths if name == "swung_straight" else True


def _teachers_ms(name: str, written: Written) -> float:
    if name == "swung_straight":
        return max(SWING_MS, (_SWUNG_PLACE - 1 / 2) * _beat_ms(written))
    if name.endswith("_swing"):
        return SWING_MS
    if name.endswith("_doubles"):
        return DOUBLE_SHARE * written.double_ms
    return LANDING_MS if name.startswith("fill_lands") else WAIT_MS if name.endswith("_slow") else LEAN_MS


def _beat_ms(written: Written) -> float:
    return float(written.score.tempo_map.seconds_at(written.beat_ticks)) * 1000


def _late_share(written: Written) -> float:
    """By how much of a beat a swung eighth stands behind a straight one."""
    return float(written.place[written.swung].mean()) - 1 / 2


def whole(name: str, sign: int) -> Maker:
    """All strokes late or early against a click."""

    def make(stage: Stage) -> Planted | None:
        if not stage.conditions.clocked:
            return None
        mean_ms = sign * stage.times * WHOLE_MS
        return Planted(name, abs(mean_ms), stage.written.main, "time", lambda sheet, _: replace(sheet, mean_ms=mean_ms))

    return make


def tempo(name: str, sign: int) -> Maker:
    """A tempo that grows or sinks from beginning to end, by 4 % every eight bars."""

    def make(stage: Stage) -> Planted | None:
        written = stage.written
        if stage.conditions.clocked or written.score.bar_count < TEMPO_BARS:
            return None
        bars_s = TEMPO_BARS * written.score.length_ns / NS_PER_S / written.score.bar_count
        ahead_ms = 1000 * written.time_s**2 / (2 * bars_s)  # ∫ t/T dt for each unit of share
        share = max(TEMPO_SHARE, stage.least("time", ahead_ms))
        if share > MOST * TEMPO_SHARE:
            return None
        grows = sign * stage.times * share
        return Planted(name, 100 * abs(grows), written.main, "tempo", lambda s, _: replace(s, speed_up=grows))

    return make


def unsteady(name: str, limb: Limb | None) -> Maker:
    """A limb, or everybody, that scatters."""

    def make(stage: Stage) -> Planted | None:
        written, usual_ms = stage.written, stage.conditions.sd_ms
        strokes = written.main if limb is None else written.limb(limb)
        others = None if limb is None else written.main & ~strokes
        if strokes.sum() < FEWEST or (others is not None and others.sum() < FEWEST):
            return None
        teachers = ALL_SD_MS if limb is None else max(LIMB_SD_MS, LIMB_SD_TIMES * usual_ms)
        size = max(teachers, smallest_sd_ms(stage.conditions, strokes, others))
        if size > min(MOST * teachers, _SD_OF_GAP * written.short_gap_ms):
            return None

        def plant(sheet: Sheet, _: np.random.Generator) -> Sheet:
            return replace(sheet, sd_ms=np.where(strokes, stage.times * size, sheet.sd_ms))

        return Planted(name, stage.times * size, strokes, "spread", plant)

    return make


def flams(name: str, lead_ms: float) -> Maker:
    """Flams whose graces stand that far ahead."""

    def make(stage: Stage) -> Planted | None:
        strokes = stage.written.flam_graces
        if strokes.sum() < FEWEST:
            return None

        def plant(sheet: Sheet, _: np.random.Generator) -> Sheet:
            return replace(sheet, lead_ms=np.where(strokes, lead_ms, sheet.lead_ms))

        return Planted(name, lead_ms, strokes, "lead", plant)

    return make
