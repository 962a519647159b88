"""What is examined: which score, style, kit, body and hands; lists of such cases, and one case's report."""

import traceback
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations, product
from pathlib import Path
from time import perf_counter

import numpy as np

from benchmarks.examiner import checks_contact, checks_joints, checks_strikes
from benchmarks.examiner.findings import Finding, Findings
from benchmarks.examiner.scores import random_score
from benchmarks.examiner.take import Take, sampled
from station.cli.input.read_scores import load_led_score
from station.core.errors import BadInput
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import figure_names
from station.motion.kit.kit import kit_names, load_kit
from station.motion.motion_plan import MotionPlan
from station.motion.sticking.hand_notes import Hands
from station.motion.sticking.limbs import assign_limbs
from station.motion.style.style_file import load_style, style_names
from station.music.score import Score
from station.scenes.demonstrator import figure_for

RANDOM = "random:"
CHECKS = (
    checks_joints.numbers,
    checks_joints.ranges_and_speeds,
    checks_joints.kinks,
    checks_contact.contacts,
    checks_strikes.strikes_land,
    checks_strikes.feet,
    checks_strikes.waiting,
    checks_strikes.grip,
    checks_strikes.fast_taps,
)


@dataclass(frozen=True, slots=True)
class Case:
    """One performance to look at; `score` is what `station animate` takes, or `random:SEED`."""

    score: str
    style: str = "natural"
    kit: str = "four_piece"
    figure: str = ""
    hands: str = ""

    @property
    def name(self) -> str:
        """In one line."""
        stem = Path(self.score).stem if "/" in self.score else self.score
        if "gmd" in self.score:
            stem = "/".join(Path(self.score).parts[-3:])
        return " ".join(x for x in (stem, self.style, self.kit, self.figure, self.hands) if x)


@dataclass(frozen=True, slots=True)
class Report:
    """What a case shows; `refused` is the station's own no, `crash` is a fault."""

    case: Case
    findings: list[Finding] = field(default_factory=list)
    asked: frozenset[int] = frozenset()
    strikes: int = 0
    length_s: float = 0.0
    variation_mm: float | None = None
    seeds_mm: float | None = None
    refused: str = ""
    crash: str = ""
    took_s: float = 0.0

    @property
    def own(self) -> list[Finding]:
        """The findings outside bars that ask beyond a human."""
        return [f for f in self.findings if f.bar not in self.asked]


def score_of(case: Case) -> Score:
    """The score that a case names."""
    if case.score.startswith(RANDOM):
        return random_score(int(case.score.removeprefix(RANDOM)))
    return load_led_score(case.score, load_kit(case.kit), _hands(case))


def _hands(case: Case) -> Hands | None:
    return Hands(case.hands) if case.hands else None


def drummer_of(case: Case) -> Drummer:
    """The drummer of a case, as `station animate` makes it."""
    score, kit = score_of(case), load_kit(case.kit)
    style = load_style(case.style)
    limbs = assign_limbs(score, kit, hands=_hands(case))
    plan = MotionPlan.of(score, kit, figure_for(style, case.figure), limbs)
    return Drummer(score, plan.kit, plan.figure, style, plan)


def examine(case: Case, most_s: float) -> Report:
    """All checks of the first `most_s` seconds of `case`; of a longer score a segment that its name chooses."""
    began = perf_counter()
    try:
        drummer = drummer_of(case)
        length_s = drummer.score.length_ns / 1e9 + 0.5
        free_s = max(0.0, length_s - most_s)
        start_s = free_s * (sum(map(ord, case.name)) % 97) / 97
        take = Take(drummer, start_s, min(length_s, most_s))
        found = Findings(take.bar_at)
        for check in CHECKS:
            check(take, found)
        asked = frozenset(1 + int(b.bar) for b in drummer.assignment.infeasible)
        varies, seeds = checks_strikes.variation_mm(take), _seeds_mm(take)
        checks_strikes.alike(take, varies, seeds, found)
        played = len(take.strikes.time_s)
        return Report(case, list(found), asked, played, take.length_s, varies, seeds, took_s=perf_counter() - began)
    except BadInput as no:
        return Report(case, refused=str(no), took_s=perf_counter() - began)
    except Exception as crash:  # an examiner reports what it meets
        last = traceback.extract_tb(crash.__traceback__)[-1]
        return Report(case, crash=f"{type(crash).__name__}: {crash} ({last.name}:{last.lineno})")


def _seeds_mm(take: Take) -> float:
    """How far a tip strays at most between two seeds, in mm."""
    style = take.drummer.style
    other = take.drummer.with_style(replace(style, seed=style.seed + 1))
    times = take.poses.time_s[::20]
    return float(1000 * np.abs(sampled(other, times).tip_m - take.poses.tip_m[::20]).max())


# --- lists ------------------------------------------------------------------------------------------------------------


def lesson_names(root: Path = Path("lessons")) -> list[str]:
    """Every shipped lesson."""
    return sorted(p.stem for p in root.rglob("*.toml") if "course" not in p.name)


def gmd(data: Path, count: int) -> Iterator[Case]:
    """`count` files of the Groove MIDI Dataset, evenly from all, in the natural style."""
    files = sorted(data.rglob("*.mid"))
    for k in np.unique(np.linspace(0, len(files) - 1, min(count, len(files))).astype(int)) if files else ():
        yield Case(str(files[k]))


def pairwise(columns: Sequence[Sequence[str]], count: int, seed: int = 1) -> list[tuple[str, ...]]:
    """At most `count` rows in which, greedily, as many pairs of values of two columns as can be meet."""
    random = np.random.default_rng(seed)
    left = {
        (a, x, b, y)
        for a, b in combinations(range(len(columns)), 2)
        for x, y in product(range(len(columns[a])), range(len(columns[b])))
    }
    rows: list[tuple[str, ...]] = []
    while left and len(rows) < count:
        best: tuple[int, list[int]] = (-1, [])
        pool = list(left)
        for _ in range(12):
            a, x, b, y = pool[int(random.integers(len(pool)))]
            row = [int(random.integers(len(c))) for c in columns]
            row[a], row[b] = x, y
            best = max(best, (len(_pairs(row) & left), row))
        left -= _pairs(best[1])
        rows.append(tuple(c[i] for c, i in zip(columns, best[1], strict=True)))
    return rows


def _pairs(row: list[int]) -> set[tuple[int, int, int, int]]:
    return {(a, row[a], b, row[b]) for a, b in combinations(range(len(row)), 2)}


def pairwise_cases(count: int) -> list[Case]:
    """Lessons × styles × kits × figures × hands."""
    columns = (lesson_names(), style_names(), kit_names(), figure_names(), ["", "right", "left", "open"])
    return [Case(*row) for row in pairwise(columns, count)]


def random_cases(count: int, first: int = 0) -> list[Case]:
    """Random scores in all styles and on all kits in turn."""
    styles, kits, figures = style_names(), kit_names(), figure_names()
    return [
        Case(f"{RANDOM}{k}", styles[k % len(styles)], kits[k % len(kits)], figures[k // 2 % len(figures)])
        for k in range(first, first + count)
    ]
