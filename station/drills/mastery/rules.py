"""Every number of the mastery policy in one table, which a teacher can change.

Tempi are percent of the target tempo (steps too: 70 %, 75 %, 80 % …), shares 0–1, times real milliseconds at any
practice speed. Where a line names no source the number is our choice; `TEACHING` is the evidence in docs/mastery.md.
"""

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, replace
from typing import Any

from station.core.did_you_mean import did_you_mean
from station.core.errors import BadInput
from station.drills.lesson import Lesson
from station.drills.mastery.pass_measures.asked_parts import AskedPart, Part, asked_parts
from station.drills.mastery.pass_measures.pass_mark import PASS_MARKS
from station.music.swing import STRAIGHT
from station.scoring.matching.hit_windows import Level

_MIDDLE = PASS_MARKS[Level.INTERMEDIATE]


@dataclass(frozen=True, slots=True)
class Rules:
    """The policy's numbers; raises `BadInput` for values that contradict themselves."""

    # --- what makes a pass clean (TEACHING, Defaults) ---
    min_right: float = _MIDDLE.min_right
    """Share of the notes that are right; strokes too many count like notes left out."""
    broken_right: float = 0.80
    """With less the tempo falls at once and further: errors are prevented, not repeated (TEACHING, Duke 2009)."""
    notes_a_wrong_pad: int = 50
    """One wrong pad is forgiven in so many notes, and one in a pass with fewer."""
    sd_floor_ms: float = _MIDDLE.sd_floor_ms
    sd_interval_share: float = _MIDDLE.sd_interval_share
    sd_ceiling_ms: float = _MIDDLE.sd_ceiling_ms
    """Spread ≤ min(ceiling, max(floor, share of the interval)); professionals play 26–28 ms."""
    loose_share: float = 0.12
    """A pass that is right but for its spread may climb if that is within this share of the interval: long waits are
    hard to keep (HUMANS: σ_C grows with the interval), so that slowing down would not help. It is not clean."""
    max_sd_ms: float | None = None
    max_lean_ms: float | None = None
    max_swing_error: float | None = None
    swing_ratio: float = STRAIGHT
    min_points: float | None = None
    max_loudness_error_db: float | None = None
    """A lesson's own goals; None leaves it to the lines above and judges neither lean, swing, points nor loudness."""
    parts: tuple[AskedPart, ...] = ()
    """What a lesson asks of limbs and bars besides; only a lesson can."""

    # --- the tempo's ladder (TEACHING) ---
    start_pct: float = 70.0
    floor_pct: float = 40.0
    """Slower still, a click is no pulse any more; Drumroll stops at 50 %, where beginners are still lost."""
    up_pct: float = 5.0
    down_pct: float = 8.0
    clean_to_climb: int = 2
    bad_to_drop: int = 2
    broken_drops: int = 2
    """A broken pass goes down so many steps."""

    # --- probes (TEACHING) ---
    passes_a_probe: int = 5
    """Every so many passes one is blind: nothing is said while it is played."""
    rungs_a_target_probe: int = 4
    """So many rungs up, the target tempo is tried once."""
    probes_to_be_stable: int = 2
    """Probes of the target tempo in a row, all clean, that make an item stable."""

    # --- feedback that fades (TEACHING) ---
    fades: tuple[float, ...] = (1.0, 0.5, 0.25, 0.0)
    """Shares of the passes on which early and late are shown; wrong pads and misses show on all but probes."""
    clean_to_fade: int = 4
    """Clean passes at one of these levels that lead to the next."""

    # --- a click that falls silent (TEACHING) ---
    gaps: tuple[tuple[int, int], ...] = ((4, 1), (2, 2), (1, 3))
    """Bars with a click and bars without, level after level, once an item is stable."""
    clean_to_gap: int = 2
    """Clean passes in a row at one level that lead to the next; our choice, as many as lead up the ladder."""

    # --- weak bars ---
    chunk_bars: int = 1
    chunk_passes: int = 8
    """A weak bar is left after so many passes, clean or not."""
    clean_to_return: int = 2
    weak_faults: float = 3.0
    weak_share: float = 0.20
    weak_contrast: float = 1.5
    """A bar is weak with so many faults of late, this share of its notes, and so many times the other bars' share."""
    tally_kept: float = 0.6
    """A pass weighs so much less than the next one in a bar's tally."""
    least_bars: int = 2
    least_notes: int = 16
    """What is shorter is played several times a pass, so that a pass says something (TEACHING: loops of 2–4 bars)."""

    # --- plateaus, interleaving, variation (TEACHING) ---
    passes_a_run: int = 8
    runs_to_leave: int = 5
    """So many runs without a step forward, and the item is left for the day."""
    vary_pct: float = 10.0
    """Stable items vary in tempo by so much about the target."""

    # --- reviews (TEACHING) ---
    review_days: tuple[int, ...] = (1, 3, 7, 21)
    """Days after it was mastered on which an item is asked for again."""

    # --- faults that no practice mends ---
    calibrate_ms: float = 60.0
    calibrate_passes: int = 3
    """Leaning so far in so many passes in a row is latency rather than habit (HUMANS: people lean 10–30 ms)."""
    swap_share: float = 0.75
    swap_strokes: int = 6
    """Two pads that answer for each other in this share of at least so many strokes each are swapped cables."""

    def __post_init__(self) -> None:
        for name, is_fine, wanted in _checks(self):
            if not is_fine:
                raise BadInput("mastery rules", name, f"{getattr(self, name)} is not {wanted}")

    def for_lesson(self, lesson: Lesson, level: Level) -> "Rules":
        """These rules with the pass mark of `level`, and before it what the lesson asks for itself."""
        goals = lesson.goals
        marked = replace(self, **asdict(PASS_MARKS[level]))
        return replace(
            marked,
            min_right=marked.min_right if goals.min_accuracy is None else goals.min_accuracy,
            max_sd_ms=goals.max_sd_ms,
            max_lean_ms=goals.max_lean_ms,
            max_swing_error=goals.max_swing_error,
            swing_ratio=lesson.swing_ratio,
            min_points=goals.min_score,
            max_loudness_error_db=goals.max_loudness_error_db,
            parts=asked_parts(lesson),
        )

    @property
    def asked(self) -> tuple[Part, ...]:
        """The parts of which a lesson asks something."""
        return tuple(each.part for each in self.parts)

    def changed(self, changes: Mapping[str, Any]) -> "Rules":
        """These rules with a teacher's `changes` by name; raises `BadInput` for a name or value that cannot be."""
        known = {field.name for field in fields(self)} - {"parts"}
        for name, value in changes.items():
            if name not in known:
                raise BadInput("mastery rules", name, f"no such rule{did_you_mean(name, sorted(known))}")
            if not _fits(value, getattr(DEFAULT_RULES, name)):
                raise BadInput("mastery rules", name, f"{value!r} is not like {getattr(DEFAULT_RULES, name)!r}")
        values: dict[str, Any] = {name: _tuples(value) for name, value in changes.items()}
        return replace(self, **values)

    def sd_limit_ms(self, interval_ms: float | None) -> float:
        """The widest spread of a clean pass with this usual interval (None, unknown: the widest of all)."""
        if self.max_sd_ms is not None:
            return self.max_sd_ms
        if interval_ms is None:
            return self.sd_ceiling_ms
        return min(self.sd_ceiling_ms, max(self.sd_floor_ms, self.sd_interval_share * interval_ms))


_COUNTS = (
    *("notes_a_wrong_pad", "clean_to_climb", "bad_to_drop", "passes_a_probe", "rungs_a_target_probe"),
    *(
        "probes_to_be_stable",
        "clean_to_fade",
        "clean_to_gap",
        "chunk_bars",
        "chunk_passes",
        "clean_to_return",
        "least_bars",
    ),
    *(
        "least_notes",
        "passes_a_run",
        "runs_to_leave",
        "broken_drops",
        "calibrate_passes",
        "swap_strokes",
    ),
)
_SHARES = ("min_right", "broken_right", "loose_share", "sd_interval_share", "weak_share", "tally_kept", "swap_share")
_SIZES = (*("sd_floor_ms", "sd_ceiling_ms", "up_pct", "down_pct", "weak_faults", "weak_contrast", "calibrate_ms"),)


def _checks(rules: Rules) -> list[tuple[str, bool, str]]:
    """Of every rule that can be wrong its name, whether it is fine, and what it must be."""
    counts = [(name, getattr(rules, name) >= 1, "a count from 1") for name in _COUNTS]
    shares = [(name, 0 <= getattr(rules, name) <= 1, "a share from 0 to 1") for name in _SHARES]
    sizes = [(name, 0 < getattr(rules, name) < math.inf, "above 0") for name in _SIZES]
    days = rules.review_days
    return [
        *(counts + shares + sizes),
        ("start_pct", rules.floor_pct <= rules.start_pct <= 100, f"from {rules.floor_pct:g} (the floor) to 100"),
        ("floor_pct", 0 < rules.floor_pct <= 100, "above 0 and at most 100"),
        ("vary_pct", 0 <= rules.vary_pct < 100, "from 0 to below 100"),
        ("fades", len(rules.fades) > 0 and all(0 <= f <= 1 for f in rules.fades), "a list of shares from 0 to 1"),
        ("gaps", all(len(gap) == 2 and min(gap) >= 1 for gap in rules.gaps), "pairs of bars from 1"),
        ("review_days", all(a < b for a, b in zip((0, *days), days, strict=False)), "a rising list of days from 1"),
    ]


def _tuples(value: object) -> object:
    """A list, and what lists it holds, as tuples; anything else as it is."""
    return tuple(map(_tuples, value)) if isinstance(value, list | tuple) else value


def _fits(value: object, like: object) -> bool:
    """Whether a teacher's value is of the kind of the default."""
    if isinstance(like, tuple):
        return isinstance(value, list | tuple) and all(_fits(one, like[0]) for one in value)
    if isinstance(value, bool):
        return False
    if like is None:
        return value is None or isinstance(value, int | float)
    return isinstance(value, int) if isinstance(like, int) else isinstance(value, int | float)


DEFAULT_RULES = Rules()
