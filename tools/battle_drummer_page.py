"""The tables of docs/battle-drummer.md that follow from the code: what each step asks, who the opponents are.

    python -m tools.battle_drummer_page

Writes them between their markers; what was measured stays as `benchmarks/battle_drummer.py` printed it.
"""

from pathlib import Path

import numpy as np

from station.practice.battle.improvising.human_phrases import human_phrases
from station.practice.battle.improvising.human_playing import human_playing
from station.practice.battle.opponents.opponent import OPPONENTS
from station.practice.battle.repeating.demands import MOST_STEP, demand_at

PAGE = Path(__file__).parents[1] / "docs" / "battle-drummer.md"


def steps() -> list[str]:
    """A line for every third step."""
    rows = [
        "| step | bars | strokes/s | who plays | dynamics | off the beat | difficulty |",
        "|---|---|---|---|---|---|---|",
    ]
    for step in range(0, MOST_STEP + 1, 3):
        one = demand_at(step)
        who, how = (word.name.lower().replace("_", " ") for word in (one.coordination, one.dynamics))
        figures = f"{one.strokes_per_s:.1f} | {who} | {how} | {one.off_beat:.2f} | {one.difficulty:.0f}"
        rows.append(f"| {step} | {one.bars} | {figures} |")
    return rows


def opponents() -> list[str]:
    """A line for each opponent."""
    rows = [
        "| name | boldness | takes up | memory | quotes | density | air | clock | lean ms | wrong |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for one in OPPONENTS.values():
        m, wrong = one.manner, one.mistakes
        slips = f"{wrong.spread_ms:g} ms, {wrong.dropped:.0%} dropped" if wrong.dropped else "nothing"
        figures = (m.boldness, m.takes_up, m.memory, m.quotes, m.density, m.air, m.clock, m.lean_ms)
        rows.append(f"| {one.name} | {' | '.join(f'{value:g}' for value in figures)} | {slips} |")
    return rows


def touch() -> list[str]:
    """The figures of the phrases whose touch is borrowed."""
    phrases = human_phrases()
    late = np.split(phrases.late_ms.astype(np.float64), phrases.first[1:-1])
    lean, spread = (np.array([figure(one) for one in late]) for figure in (np.median, np.std))
    return [
        "| figure | measured |",
        "|---|---|",
        f"| phrases, strokes | {len(phrases)}, {len(phrases.at)} |",
        f"| lean of a phrase, mean and spread | {lean.mean():.0f} ± {lean.std():.0f} ms |",
        f"| spread of a phrase's strokes, middle | {np.median(spread):.0f} ms |",
        f"| strokes a beat | {human_playing().strokes_a_beat:g} |",
    ]


TABLES = {"steps": steps, "opponents": opponents, "touch": touch}


def with_tables(text: str) -> str:
    """The page with every table made anew."""
    for name, made in TABLES.items():
        start, end = f"<!-- {name} -->", f"<!-- end of {name} -->"
        before, _, rest = text.partition(start)
        text = "\n".join([before + start, *made(), end]) + rest.partition(end)[2]
    return text


if __name__ == "__main__":
    PAGE.write_text(with_tables(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
