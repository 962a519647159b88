"""Benchmarks of the motion on five minutes of 16th-note grooves with fills at 120 bpm, on the default kit."""

import gc
import math
import time
import tracemalloc
from collections.abc import Iterator
from dataclasses import replace
from functools import cache, partial

import numpy as np

from station.bench.harness.benchmark import Benchmark, Measurement, median_s
from station.bench.rigs.scoring_work import grooves
from station.core.pieces import Piece
from station.motion.drummer import Drummer
from station.motion.kit.kit import load_kit
from station.motion.sticking.limbs import assign_limbs
from station.motion.style.style import NUMBERS, Style, range_of

_NOTES = 3_000
"""Some 310 s of them."""
_POSES, _ROUNDS = 2_000, 5
_RENEWALS = 3
_FRAMES_A_SECOND = 60
_LENGTHS = (1_000, 8_000)
_ONE = "one drummer"


@cache
def _drummer() -> Drummer:
    """One of five minutes."""
    return Drummer(grooves(_NOTES))


def _pose() -> Measurement:
    """Every joint and instrument, at random times; the best round beside the median, for a machine that is shared."""
    drummer = _drummer()
    times = np.random.default_rng(1).uniform(0.0, drummer.score.length_ns / 1e9, _POSES).tolist()
    rounds = []
    for _ in range(_ROUNDS):
        start = time.process_time()
        for at in times:
            drummer.pose(at)
        rounds.append(1e6 * (time.process_time() - start) / _POSES)
    return Measurement(sorted(rounds)[_ROUNDS // 2], note=f"best round {min(rounds):.0f} µs")


def _moved(style: Style) -> Iterator[tuple[str, Style]]:
    """Every control of `style` moved alone, by its name.

    Grips and heels, for which hands are planned anew, are choices, no sliders.
    """
    for control in NUMBERS:
        low, high = range_of(control)
        yield control, replace(style, **{control: low + 0.37 * (high - low)})  # type: ignore[arg-type] # floats only
    yield "beater", replace(style, beater="buried")
    yield "seed", replace(style, seed=style.seed + 1)
    yield "pieces", replace(style, pieces={Piece.SNARE: 80.0})
    for control in ("amplitude_gain", "posture_deg"):
        points = ((1.0, range_of(control)[0]), (40.0, range_of(control)[1]))
        yield f"{control} over the bars", replace(style, automation={control: points})


def _renewal_ms(drummer: Drummer, style: Style) -> float:
    return 1e3 * median_s(lambda: drummer.with_style(style).pose(1.0), _RENEWALS)


def _slider() -> Measurement:
    """The slowest control, from its change to the first pose: all its keyframes are there."""
    drummer = _drummer()
    taken = {control: _renewal_ms(drummer, style) for control, style in _moved(drummer.style)}
    worst = max(taken, key=lambda control: taken[control])
    start = time.perf_counter()
    drummer.with_style(replace(drummer.style, grip_left="traditional")).pose(1.0)
    grip = f"another grip, for which every contact is solved again, {time.perf_counter() - start:.1f} s"
    return Measurement(taken[worst], note=f"{worst}, of {len(taken)} controls; {grip}")


def _memory() -> Measurement:
    """The most that a drummer takes while it is made, as tracemalloc counts it without the score; and what it keeps."""
    score = grooves(_NOTES)
    Drummer(grooves(100)).pose(1.0)
    tracemalloc.start()
    drummer = Drummer(score)
    drummer.pose(1.0)
    gc.collect()
    held, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return Measurement(peak / 1e6, note=f"{held / 1e6:.0f} MB of them kept")


def _limbs() -> Measurement:
    """How the time of an assignment grows with the score's length, ours beside the thesis's."""
    return Measurement(_growth("station"), _growth("smed"))


def _growth(method: str) -> float:
    kit, scores = load_kit(), [grooves(notes) for notes in _LENGTHS]
    short_s, long_s = (median_s(partial(assign_limbs, score, kit, method), _RENEWALS) for score in scores)
    return math.log(long_s / short_s) / math.log(len(scores[1]) / len(scores[0]))


def _rows() -> Measurement:
    """Poses a second as an export takes them, five minutes at 60 a second at once."""
    drummer = _drummer()
    times = np.arange(0.0, drummer.score.length_ns / 1e9, 1 / _FRAMES_A_SECOND)
    return Measurement(len(times) / median_s(lambda: drummer.rows(times), _RENEWALS))


BENCHMARKS = (
    Benchmark("pose_at_a_random_time", "µs", 50, "lower", None, _pose, group=_ONE),
    Benchmark("slider_renews_5_minutes_worst", "ms", 10, "lower", None, _slider, group=_ONE),
    Benchmark("export_poses", "poses/s", None, "higher", None, _rows, group=_ONE),
    Benchmark("drummer_5_minutes_made", "MB", 40, "lower", None, _memory),
    Benchmark("limb_assignment_growth_exponent", "", 1.1, "lower", "smed", _limbs),
)
