"""A drill as a periodic model: what the sensors on the drummer's sticks would measure over one loop of it.

The model is the paper's (`sync.phase.periodic_model`): circular Gaussians, 16 centres and more for each stroke of the
busiest hand. It spans the loop's shortest repeat (`loop_repeats`), for no more can be told apart. A drummer who plays
slower does not play the same motion stretched: strokes stay quick and the rests between them grow. So the drummer plays
the loop at several tempi, and each is a model of its own.

Channels are made zero-mean and divided by their SD, but not by less than `FLOOR`, for a stick that rests would else be
all noise; forces count less than rates (`COUNTS`). Model and student go through the same low-pass, a Gaussian in time
as wide as half a centre.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.imu import Mounting
from station.core.units import NS_PER_S
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import Figure, figure_of
from station.motion.kit.kit import DEFAULT_KIT, Kit, load_kit
from station.motion.style.style import Style
from station.music.score import Score
from station.sync.drill.drill_model import CENTRES_A_STROKE, HANDS, DrillModel, channel_names
from station.sync.drill.loop_repeats import repeats
from station.sync.drill.stick_grid import levelled
from station.sync.drill.stick_signals import stick_signals
from station.sync.phase.periodic_model import TURN, Exemplar, PeriodicModel, fitted

Array = NDArray[np.float64]

TEMPI = (0.5, 0.7, 1.0, 1.4, 2.0)
"""At which parts of the tempo the drummer is watched: half an octave apart, so that one model serves what lies between
(docs/drill-phase.md)."""
COARSEST_S = 0.025
"""Centres are at least so near: a slow drill's strokes are as quick as others (our choice)."""
MOST_CENTRES = 1024
"""64 strokes of one hand that do not repeat: beyond, a step would take too much of a core (our choice)."""
LONGEST_S = MOST_CENTRES * COARSEST_S
"""The model of a longer section takes many seconds, to be refused at last unless it repeats."""
SMOOTHING_S = (0.005, 0.012)
"""The low-pass is never narrower than the contact, nor so wide that its delay, three of it, is seen (our choice)."""
FLOOR = np.tile([3.0, 3.0, 3.0, 1.0, 1.0, 1.0], 2)
"""m/s² and rad/s: a third of g, and a slow turn of the wrist. Less is a hand at rest (our choice)."""
COUNTS = np.tile([0.2, 0.2, 0.2, 1.0, 1.0, 1.0], 2)
"""How much a channel counts beside its SD. Two hands turn their sticks alike at a stroke, but what a sensor is pushed
hangs on its place, the grip and the head: against simulated sticks, which know nothing of this drummer, the rates agree
by .85 to .89 and the forces by .0 to .3 (docs/drill-phase.md)."""
SAMPLE_HZ = 1000.0
_PASSES = 3
"""The drummer plays the loop so often, and the middle one counts: before the first and after the last they rest."""


@dataclass(frozen=True, slots=True)
class Demonstrated:
    """Who plays the loop, where and how."""

    kit: Kit
    figure: Figure
    style: Style


def drill_model(section: Score, played: Demonstrated, mountings: Sequence[Mounting] = ()) -> DrillModel:
    """The model of a section that is played in a loop; the sensors sit on the sticks as `mountings` say.

    Raises `BadInput` for a section in which no hand plays, or one too long to be told apart.
    """
    steady = replace(played, style=replace(played.style, variation=0.0, flourish=0.0, look_around=0.0))
    drummer = _drummer(section, steady)
    limb = drummer.assignment.limbs[: len(section)]
    strokes = [int(np.count_nonzero(limb == hand)) for hand in HANDS]
    loop_s = section.length_ns / NS_PER_S
    count, smoothing_s = _resolution(strokes, loop_s)
    first = _loop(drummer, loop_s, smoothing_s, mountings)
    parts = repeats((first - first.mean(axis=0)) / _scale([first]), strokes)
    count = 2 * -(-count // (2 * parts))  # even, so that a centre lies at the beginning
    if count > MOST_CENTRES:
        raise BadInput("the section", "", "is too long for its phase to be followed; choose fewer bars")
    loops = [first if tempo == 1.0 else _at(section, tempo, steady, smoothing_s, mountings) for tempo in TEMPI]
    mean, scale = np.mean([loop.mean(axis=0) for loop in loops], axis=0), _scale(loops)
    return DrillModel(
        loop_s=loop_s,
        repeats=parts,
        tempi=TEMPI,
        models=tuple(
            _fitted((loop - mean) / scale, parts, count, loop_s / tempo)
            for loop, tempo in zip(loops, TEMPI, strict=True)
        ),
        mean=mean,
        scale=scale,
        smoothing_s=smoothing_s,
        onset_s=section.onset_s,
        piece=section.notes["piece"].astype(np.int64),
        limb=limb.astype(np.int64),
    )


def shipped_model(section: Score) -> DrillModel:
    """The model of a section as the shipped drummer plays it on the shipped kit: it depends on the section alone.

    Raises `BadInput` as `drill_model` does.
    """
    return drill_model(section, Demonstrated(load_kit(DEFAULT_KIT), figure_of(), Style()))


def is_soon_made(section: Score) -> bool:
    """Whether the model of a section may be made unasked: in some seconds, on a computer with nothing else to do."""
    return section.length_ns <= LONGEST_S * NS_PER_S


def _scale(loops: Sequence[Array]) -> Array:
    """The SD of each channel (12,), the mean of all loops', though not less than `FLOOR`."""
    spread = np.maximum(np.mean([loop.std(axis=0) for loop in loops], axis=0), FLOOR)
    return np.asarray(spread / COUNTS)


def _resolution(strokes: Sequence[int], loop_s: float) -> tuple[int, float]:
    """How many centres the whole loop takes, and how wide the low-pass is."""
    if not any(strokes):
        raise BadInput("the section", "", "no hand plays in it, so there is no phase for sticks to follow")
    count = max(CENTRES_A_STROKE * max(strokes), int(np.ceil(loop_s / COARSEST_S)))
    return count, float(np.clip(0.5 * loop_s / count, *SMOOTHING_S))


def _drummer(section: Score, played: Demonstrated) -> Drummer:
    return Drummer(section.repeated(_PASSES), played.kit, played.figure, played.style)


def _at(section: Score, tempo: float, played: Demonstrated, smoothing_s: float, mountings: Sequence[Mounting]) -> Array:
    """The loop at another tempo."""
    score = section.at_speed(tempo)
    return _loop(_drummer(score, played), score.length_ns / NS_PER_S, smoothing_s, mountings)


def _loop(drummer: Drummer, loop_s: float, smoothing_s: float, mountings: Sequence[Mounting]) -> Array:
    """The middle pass through the low-pass, (n, 12), evenly from its beginning on."""
    spare = np.ceil(4 * smoothing_s * SAMPLE_HZ) / SAMPLE_HZ
    count = round(loop_s * SAMPLE_HZ)
    signals = stick_signals(drummer, loop_s - spare, 2 * loop_s + spare, mountings, SAMPLE_HZ)
    measured = low_passed(signals.channels(), smoothing_s * SAMPLE_HZ)[:count]
    sticks = np.split(measured, len(HANDS), axis=1)
    return np.concatenate([levelled(stick, stick[:, 1:3].mean(axis=0)) for stick in sticks], axis=1)


def low_passed(values: Array, sd: float) -> Array:
    """`values` (n, c) through a Gaussian of `sd` samples, shorter by four of them at each end."""
    reach = int(np.ceil(4 * sd))
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sd) ** 2)
    return np.stack([np.convolve(column, weights / weights.sum(), "valid") for column in values.T], axis=1)


def _fitted(loop: Array, parts: int, count: int, loop_s: float) -> PeriodicModel:
    """The model of one tempo, of its repeats' mean; two samples a centre, for the low-pass left no more."""
    turn = np.arange(2 * count) / (2 * count)
    return fitted(channel_names(), [Exemplar(_repeat(loop, parts, turn), TURN * turn, loop_s / parts)], count)


def _repeat(loop: Array, parts: int, turn: Array) -> Array:
    """The mean of a loop's repeats at `turn` (m,) of one, (m, c)."""
    at = (turn[:, None] + np.arange(parts)) / parts
    grid = np.arange(len(loop)) / len(loop)
    return np.stack([np.interp(at, grid, column, period=1.0).mean(axis=1) for column in loop.T], axis=1)
