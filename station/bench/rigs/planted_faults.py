"""The faults that are planted: each word's strokes, a teacher's smallest size in ms, dB or %, and how it is played.

A size is planted as a teacher would name it, or as large as an oracle needs (`planted_oracle`) where that is more;
music in which it would have to be more than `MOST` times a teacher's is left out.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from types import MappingProxyType

import numpy as np

from station.bench.rigs import planted_oracle as oracle
from station.bench.rigs.planted_player import ADDED, LEFT_OUT, Conditions, Sheet, wrong_openness
from station.bench.rigs.planted_routes import left_out_bars, repeated_bars, stopped
from station.bench.rigs.planted_strokes import Floats, Mask, Written, level_db
from station.core.pieces import Limb, Ornament, Piece, word

MOST = 2.0
"""Where the oracle needs more than twice a teacher's size, the music does not exercise the word (our choice)."""
FEWEST = 8
"""Fewer strokes no teacher judges by (our choice)."""
MOST_SHARE = {True: 0.75, False: 0.45}
"""The largest share of strokes that leans: without a click those that do not lean must be the majority."""

LEAN_MS, SWING_MS, LANDING_MS, WAIT_MS, WHOLE_MS = 25.0, 30.0, 40.0, 40.0, 40.0
"""Part 7's table; a wait and the whole against a click have no row there: HUMANS' clear fault, 40 ms."""
LIMB_SD_MS, ALL_SD_MS = 30.0, 40.0
"""Part 7's table for a limb; the whole: beyond nine of ten professional takes (HUMANS, Groove MIDI: P90 37 ms)."""
DOUBLE_SHARE, DOUBLE_DB, HAND_DB, FADE_DB = 0.2, 4.0, 3.0, 6.0
WIDE_MS, TIGHT_MS = 55.0, 5.0
"""Five ms, a flam's scatter, beyond the limits of 50 and 10 ms."""
BESIDE_DB = 1.0
"""Limits that read "less than" are passed by what the skilled just notice (HUMANS: 1 dB)."""
ACCENT_DB, GHOST_DB, GRACE_DB = 4.0 - BESIDE_DB, 8.0 - BESIDE_DB, 6.0 - BESIDE_DB
OPENNESS_SHARE, ERROR_SHARE = 0.25, 0.1
"""A quarter of the hats; a tenth of all strokes left out, added or astray (TEACHING: a pass is 90 % right)."""
TEMPO_SHARE = 0.04

_HANDS = {"left_hand": Limb.LEFT_HAND, "right_hand": Limb.RIGHT_HAND}
_LIMBS = {**_HANDS, "right_foot": Limb.RIGHT_FOOT, "left_foot": Limb.LEFT_FOOT}
_MOST_GRACES = 0.1


@dataclass(frozen=True, eq=False)
class Stage:
    """A piece of music under conditions, on which faults are planted."""

    written: Written
    conditions: Conditions

    @cached_property
    def precision(self) -> Floats:
        """What the oracle knows of the timing noise."""
        return oracle.timing_precision(self.written, self.conditions)

    def least_ms(self, shape: Floats) -> float:
        """The smallest factor of a shape (n,) that the oracle finds."""
        return oracle.smallest_shift(self.precision, shape[self.written.main])


@dataclass(frozen=True, eq=False)
class Planted:
    """A fault in one piece of music: its word, its size in its unit, and the strokes that it concerns (n,).

    `sign` is that of the change; `kind` tells time from level, so that the same strokes can be explained by other
    words of the same kind. `plant` writes it onto a sheet.
    """

    word: str
    size: float
    strokes: Mask
    sign: int
    kind: str
    plant: Callable[[Sheet, np.random.Generator], Sheet]


Maker = Callable[[Stage], Planted | None]


def timing_subjects(written: Written) -> Mapping[str, tuple[Mask, int]]:
    """Every word that says "these strokes are late or early": its strokes and the sign."""
    subjects: dict[str, Mask] = {word(p): written.piece(p) for p in written.pieces if p is not Piece.HIHAT_PEDAL}
    subjects |= {name: written.limb(limb) for name, limb in _HANDS.items()}
    subjects["offbeats"] = written.offbeats
    found = {f"{side}_{name}": (mask, sign) for name, mask in subjects.items() for side, sign in _SIDES}
    foot, inside, landing = written.piece(Piece.HIHAT_PEDAL), fill_strokes(written), landing_strokes(written)
    found |= {"slow_hihat_foot": (foot, 1), "early_hihat_foot": (foot, -1)}
    found |= {"straight_swing": (written.swung, -1), "hard_swing": (written.swung, 1)}
    found |= {"swung_straight": (written.offbeats, 1)}
    found |= {"rush_fills": (inside, -1), "drag_fills": (inside, 1)}
    found |= {"fill_lands_early": (landing, -1), "fill_lands_late": (landing, 1)}
    found |= {"drag_slow": (written.after_wait, 1), "rush_slow": (written.after_wait, -1)}
    found |= {"uneven_doubles": (written.second_of_double, -1), "lazy_doubles": (written.second_of_double, 1)}
    return found | {"early": (written.main, -1), "late": (written.main, 1)}


_SIDES = (("late", 1), ("early", -1))


def fill_strokes(written: Written) -> Mask:
    """All strokes of all fills."""
    return np.any([inside for inside, _ in written.fills], axis=0) if written.fills else written.main & False


def landing_strokes(written: Written) -> Mask:
    """All strokes of the beats after fills."""
    return np.any([after for _, after in written.fills], axis=0) if written.fills else written.main & False


def _fill_shape(written: Written) -> Floats:
    """A fill that runs off: .4 of the mean at its first stroke, 1.6 at its last."""
    shape = np.zeros(len(written.score))
    for inside, _ in written.fills:
        at_s = written.time_s[inside]
        shape[inside] = 0.4 + 1.2 * (at_s - at_s[0]) / max(float(np.ptp(at_s)), 1e-9)
    return shape


def _landing_shape(written: Written) -> Floats:
    """All of it on the one, half of it in the rest of the beat."""
    return landing_strokes(written) * np.where(written.place == 0, 1.0, 0.5)


def _shapes(name: str, written: Written, mask: Mask) -> Floats:
    if name.endswith("_fills"):
        return _fill_shape(written)
    return _landing_shape(written) if name.startswith("fill_lands") else mask.astype(np.float64)


def _teachers_ms(name: str, written: Written) -> float:
    if "swing" in name:
        return SWING_MS
    if name == "swung_straight":  # 3:2, the mildest swing that lessons write
        return max(SWING_MS, 0.1 * float(written.score.tempo_map.seconds_at(written.beat_ticks)) * 1000)
    if "doubles" in name:
        return DOUBLE_SHARE * written.double_ms
    return LANDING_MS if name.startswith("fill_lands") else WAIT_MS if name.endswith("_slow") else LEAN_MS


def _shifted(name: str) -> Maker:
    """Strokes that come late or early."""

    def make(stage: Stage) -> Planted | None:
        written = stage.written
        mask, sign = timing_subjects(written).get(name, (written.main & False, 0))
        if not FEWEST <= mask.sum() <= MOST_SHARE[stage.conditions.clocked] * written.main.sum():
            return None
        if name.endswith("_hand") and written.score.is_grace.mean() > _MOST_GRACES:
            return None  # whose graces would be late, too
        if name == "swung_straight" and not written.only_eighths:
            return None
        shape, teachers = _shapes(name, written, mask), _teachers_ms(name, written)
        size = max(teachers, stage.least_ms(shape))
        if size > MOST * teachers or (name == "straight_swing" and size > _to_straight_ms(written)):
            return None
        return Planted(name, size, mask, sign, "time", lambda sheet, _: sheet.later(sign * size * shape))

    return make


def _to_straight_ms(written: Written) -> float:
    """How much earlier a swung eighth would be straight."""
    beat_ms = float(written.score.tempo_map.seconds_at(written.beat_ticks)) * 1000
    return (float(written.place[written.swung].mean()) - 1 / 2) * beat_ms


def _whole(name: str, sign: int) -> Maker:
    def make(stage: Stage) -> Planted | None:
        if not stage.conditions.clocked:
            return None
        main = stage.written.main
        return Planted(name, WHOLE_MS, main, sign, "time", lambda sheet, _: replace(sheet, mean_ms=sign * WHOLE_MS))

    return make


def _tempo(name: str, sign: int) -> Maker:
    """A tempo that grows or sinks from beginning to end, by 4 % every eight bars."""

    def make(stage: Stage) -> Planted | None:
        written = stage.written
        if stage.conditions.clocked or written.score.bar_count < 8:
            return None
        through = written.time_s / (8 * written.score.length_ns / 1e9 / written.score.bar_count)
        run_ms = -1000 * 0.5 * through * written.time_s  # ahead by ∫ share·t, per unit of share
        size = max(TEMPO_SHARE, stage.least_ms(run_ms))
        if size > MOST * TEMPO_SHARE:
            return None
        share = sign * size
        return Planted(name, 100 * size, written.main, sign, "tempo", lambda s, _: replace(s, speed_up=share))

    return make


def _unsteady(name: str, limb: Limb | None) -> Maker:
    def make(stage: Stage) -> Planted | None:
        written, conditions = stage.written, stage.conditions
        mask = written.main if limb is None else written.limb(limb)
        others = None if limb is None else written.main & ~mask
        if mask.sum() < FEWEST or (others is not None and others.sum() < FEWEST):
            return None
        teachers = ALL_SD_MS if limb is None else LIMB_SD_MS
        size = max(teachers, 1.5 * conditions.sd_ms, oracle.smallest_sd_ms(conditions, mask, others))
        if size > MOST * teachers or size > written.short_gap_ms / 4:
            return None

        def plant(sheet: Sheet, _: np.random.Generator) -> Sheet:
            return replace(sheet, sd_ms=np.where(mask, size, sheet.sd_ms))

        return Planted(name, size, mask, 1, "spread", plant)

    return make


def _flams(name: str, lead_ms: float) -> Maker:
    def make(stage: Stage) -> Planted | None:
        mask = stage.written.flam_graces
        if mask.sum() < FEWEST:
            return None

        def plant(sheet: Sheet, _: np.random.Generator) -> Sheet:
            return replace(sheet, lead_ms=np.where(mask, lead_ms, sheet.lead_ms))

        return Planted(name, lead_ms, mask, 1, "lead", plant)

    return make


def _level(name: str, sign: int, of: Callable[[Written], tuple[Mask, Mask, float]]) -> Maker:
    """Strokes that are too loud or too soft against others; `of` says which, which others, and by how many dB."""

    def make(stage: Stage) -> Planted | None:
        mask, others, teachers = of(stage.written)
        if min(mask.sum(), others.sum()) < FEWEST or teachers <= 0:
            return None
        size = max(teachers, oracle.smallest_level_db(mask, others))
        if size > MOST * max(teachers, HAND_DB):
            return None
        return Planted(name, size, mask, sign, "level", lambda sheet, _: sheet.louder(sign * size * mask))

    return make


def _hand(hand: Limb, other: Limb) -> Callable[[Written], tuple[Mask, Mask, float]]:
    return lambda w: (w.limb(hand), w.limb(other), HAND_DB if w.compared_hands else 0.0)


def _brought_to(below_db: float, these: Mask, those: Mask, written: Written) -> float:
    """By how much `these` must change for `those` to be only `below_db` louder (negative: softer), 0 where they are."""
    if not (these.any() and those.any()):
        return 0.0
    level = level_db(written.score.notes["velocity"])
    gap = abs(float(level[those].mean() - level[these].mean()))
    return max(0.0, gap - below_db)


def _ghosts(written: Written) -> tuple[Mask, Mask, float]:
    these, those = written.ghosts_and_others
    return these, those, _brought_to(GHOST_DB, these, those, written)


def _accents(written: Written) -> tuple[Mask, Mask, float]:
    these, those = written.accents_and_taps
    return these, those, _brought_to(ACCENT_DB, these, those, written)


def _graces(written: Written) -> tuple[Mask, Mask, float]:
    these = written.score.is_grace & (written.score.notes["ornament"] != Ornament.NONE)
    those = np.zeros_like(these)
    those[written.main_of[these]] = True
    return these, those, _brought_to(GRACE_DB, these, those, written)


def _doubles(written: Written) -> tuple[Mask, Mask, float]:
    return written.second_of_double, written.first_of_double, DOUBLE_DB


def _fade(name: str, sign: int) -> Maker:
    def make(stage: Stage) -> Planted | None:
        written = stage.written
        size = max(FADE_DB, oracle.smallest_fade_db(written))

        def plant(sheet: Sheet, _: np.random.Generator) -> Sheet:
            softer = np.full(len(written.score), -size if sign > 0 else 0.0)  # grows from below, not beyond 127
            return replace(sheet.louder(softer), fade_db=sign * size)

        return None if size > MOST * FADE_DB else Planted(name, size, written.main, sign, "fade", plant)

    return make


def _hats(name: str, of: Callable[[Written], Mask]) -> Maker:
    def make(stage: Stage) -> Planted | None:
        mask = of(stage.written)
        if mask.sum() < FEWEST:
            return None
        share = max(OPENNESS_SHARE, oracle.smallest_share(int(mask.sum()), 0.01))
        if share > MOST * OPENNESS_SHARE:
            return None
        return Planted(name, 100 * share, mask, 1, "openness", lambda s, rng: wrong_openness(s, mask, share, rng))

    return make


def _errors(name: str, usual: float, planted: Callable[[Sheet, float], Sheet]) -> Maker:
    def make(stage: Stage) -> Planted | None:
        share = max(ERROR_SHARE, oracle.smallest_share(int(stage.written.main.sum()), usual))
        if share > MOST * ERROR_SHARE:
            return None
        return Planted(name, 100 * share, stage.written.main, 1, "errors", lambda sheet, _: planted(sheet, share))

    return make


def _routed(name: str, route: Callable[[Written, bool, Sheet, np.random.Generator], Sheet | None]) -> Maker:
    def make(stage: Stage) -> Planted | None:
        written, clocked = stage.written, stage.conditions.clocked
        if route(written, clocked, Sheet.as_written(written), np.random.default_rng(0)) is None:
            return None
        return Planted(name, 1, written.main, 1, "route", lambda s, rng: route(written, clocked, s, rng) or s)

    return make


_LEANS = [f"{side}_{word(p)}" for p in Piece if p is not Piece.HIHAT_PEDAL for side, _ in _SIDES]
_SHIFTED = (
    *_LEANS,
    "slow_hihat_foot early_hihat_foot late_left_hand early_left_hand late_right_hand early_right_hand late_offbeats "
    "early_offbeats straight_swing hard_swing swung_straight rush_fills drag_fills fill_lands_late fill_lands_early "
    "drag_slow rush_slow uneven_doubles lazy_doubles",
)

FAULTS: Mapping[str, Maker] = MappingProxyType(
    {name: _shifted(name) for name in " ".join(_SHIFTED).split()}
    | {"early": _whole("early", -1), "late": _whole("late", 1)}
    | {"rushing": _tempo("rushing", 1), "dragging": _tempo("dragging", -1)}
    | {"unsteady": _unsteady("unsteady", None)}
    | {f"unsteady_{name}": _unsteady(f"unsteady_{name}", limb) for name, limb in _LIMBS.items()}
    | {"wide_flams": _flams("wide_flams", WIDE_MS), "tight_flams": _flams("tight_flams", TIGHT_MS)}
    | {"weak_left": _level("weak_left", -1, _hand(Limb.LEFT_HAND, Limb.RIGHT_HAND))}
    | {"weak_right": _level("weak_right", -1, _hand(Limb.RIGHT_HAND, Limb.LEFT_HAND))}
    | {"loud_ghosts": _level("loud_ghosts", 1, _ghosts), "flat_accents": _level("flat_accents", -1, _accents)}
    | {"loud_graces": _level("loud_graces", 1, _graces), "weak_doubles": _level("weak_doubles", -1, _doubles)}
    | {"fades": _fade("fades", -1), "grows": _fade("grows", 1)}
    | {
        "open_hats": _hats("open_hats", lambda w: w.closed_hats),
        "closed_hats": _hats("closed_hats", lambda w: w.open_hats),
    }
    | {"stopped": _routed("stopped", stopped), "left_out_bars": _routed("left_out_bars", left_out_bars)}
    | {"repeated_bars": _routed("repeated_bars", repeated_bars)}
    | {"missed": _errors("missed", LEFT_OUT, lambda s, share: replace(s, left_out=np.full_like(s.left_out, share)))}
    | {"extra": _errors("extra", ADDED, lambda s, share: replace(s, added=share))}
    | {"wrong_piece": _errors("wrong_piece", 0.0, lambda s, share: replace(s, wrong=share))}
)
"""Each word of a fault, and what makes it in a piece of music; None where the music does not exercise it."""
