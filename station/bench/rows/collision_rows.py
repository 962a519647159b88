"""Benchmarks of the drummer's room: what sticks pass through, joints bent too far or moved too fast, tips off the drum.

Poses are looked at 240 times a second and at every strike (`motion.audit`). The normal run takes every style with a
spread of lessons; the long one every style with every lesson on every kit.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache, partial
from math import degrees

from station.bench.harness.benchmark import Benchmark, Measurement
from station.drills.library import find_lesson, lesson_names
from station.motion.audit import Audit, audit
from station.motion.drummer import Drummer
from station.motion.kit.kit import DEFAULT_KIT, kit_names, load_kit
from station.motion.sticking.limbs import as_led
from station.motion.style.style_file import load_style, style_names

SPREAD = ("rock-fill-1", "jazz-fill-1", "linear-fill-1", "paradiddle-diddle", "ride-bell-1", "samba-1")
"""Fills around the kit, hands that cross, a rudiment, the bell, the foot."""
_SOAK_LIMIT_S = 1800.0


def audits(kits: tuple[str, ...], lessons: tuple[str, ...]) -> Iterator[tuple[str, Audit]]:
    """The audit of every style with every one of `lessons` on each of `kits`, and what it is of."""
    for kit_name in kits:
        kit = load_kit(kit_name)
        for lesson in lessons:
            drummer = Drummer(as_led(find_lesson(lesson).score, kit), kit)
            for style in style_names():
                yield f"{lesson}, {style}, {kit_name}: ", audit(drummer.with_style(load_style(style)))


@dataclass(frozen=True, slots=True)
class _Kind:
    """A kind of `Audit` as a benchmark: its name, unit, scale and target."""

    kind: str
    name: str
    unit: str
    scale: float
    target: float


_KINDS = (
    _Kind("kit_m", "stick_in_kit", "mm", 1000.0, 3.0),
    _Kind("hands_m", "stick_in_other_hand", "mm", 1000.0, 3.0),
    _Kind("body_m", "arm_in_body_or_kit", "mm", 1000.0, 8.0),
    _Kind("limit_rad", "joint_beyond_limit", "deg", degrees(1), 1.0),
    _Kind("speed", "fastest_joint", "of the fastest people", 1.0, 1.0),
    _Kind("strike_m", "tip_off_strike", "mm", 1000.0, 1.0),
)


@cache
def _worst(kits: tuple[str, ...], lessons: tuple[str, ...]) -> Audit:
    """The worst of every kind."""
    worst = Audit()
    for where, found in audits(kits, lessons):
        worst = worst.worse(found, where)
    return worst


def _measure(kind: _Kind, kits: tuple[str, ...], lessons: tuple[str, ...]) -> Measurement:
    found_worst = getattr(_worst(kits, lessons), kind.kind)
    where = f"{found_worst.what} at {found_worst.time_s:.2f} s" if found_worst.what else ""
    return Measurement(kind.scale * found_worst.value, note=where)


BENCHMARKS = (
    *(
        Benchmark(
            f"motion_{k.name}",
            k.unit,
            k.target,
            "lower",
            None,
            partial(_measure, k, (DEFAULT_KIT,), SPREAD),
            group="spread",
        )
        for k in _KINDS
    ),
    *(
        Benchmark(
            f"motion_{k.name}_everywhere",
            k.unit,
            k.target,
            "lower",
            None,
            partial(_measure, k, tuple(kit_names()), tuple(lesson_names())),
            is_soak=True,
            limit_s=_SOAK_LIMIT_S,
            group="everywhere",
        )
        for k in _KINDS
    ),
)
