"""The assessment as one JSON document, `drum-station/assessment/1`, described for readers in docs/report.md.

Every figure is a number or null; null means "no data" and never zero. Percentages are 0–100, times in ms or s as their
names say, bars are counted from 1 as people do.
"""

from collections import Counter
from collections.abc import Mapping

from station.core.pieces import Dynamic, Limb, word
from station.scoring.analysis.habits import Habits
from station.scoring.analysis.loudness import Loudness
from station.scoring.analysis.player_tempo import TempoCurve
from station.scoring.analysis.summary import Summary, SummaryGroup
from station.scoring.analysis.technique.observability import unobservable
from station.scoring.analysis.timing_spread import Spread
from station.scoring.report.advice import advise
from station.scoring.report.assessment_schema import SCHEMA
from station.scoring.report.praise import praise
from station.scoring.report.technique_table import Json, plain

__all__ = ["Json", "assessment"]

_DECIMALS = 3


def assessment(summary: Summary) -> dict[str, Json]:
    """The document of `summary`; callers may add keys of their own."""
    counts, said = summary.counts, advise(summary)
    return {
        "schema": SCHEMA,
        "score": _number(summary.points),
        "level": summary.view.windows.name,
        "reference": summary.alignment.reference.value,
        "counts": {
            "notes": counts.notes,
            "hits": counts.hits,
            "matched": counts.matched,
            "misses": counts.misses,
            "extras": counts.extras,
            "wrong_piece": counts.wrong_piece,
            "ignored": counts.ignored,
            "played_again": counts.played_again,
            "unknown": counts.unknown,
        },
        "right": summary.right,
        "timing": _timing(summary.timing),
        "tempo": _tempo(summary.tempo),
        "habits": _habits(summary.habits),
        "craft": plain(summary.technique),
        "cannot_tell": plain(unobservable(summary.technique, summary.swallowed)),
        "dynamics": None if summary.dynamics is None else _dynamics(summary.dynamics),
        "per_piece": {word(piece): _group(group) for piece, group in summary.by_piece.items()},
        "per_limb": _keyed(summary.by_limb),
        "per_bar": [{"bar": bar + 1, **_group(group)} for bar, group in summary.by_bar.items()],
        "per_subdivision": {name: _group(group) for name, group in summary.by_subdivision.items()},
        "per_dynamic": _keyed(summary.by_dynamic),
        "per_passage": {name: _group(group) for name, group in summary.by_passage.items()},
        "wrong_pieces": [
            {"written": word(wrong.written), "played": word(wrong.played), "count": wrong.count}
            for wrong in summary.wrong_pieces
        ],
        "sticking": _sticking(summary),
        "praise": praise(summary, said),
        "advice": [
            {
                "fault": advice.fault,
                "text": advice.text,
                "hint": advice.hint or None,
                "bars": list(advice.bars),
                "effect": _number(advice.effect),
                "ci": [_number(end) for end in advice.ci],
                "alternatives": list(advice.alternatives),
                "drill": {
                    "bars": None if advice.drill.bars is None else list(advice.drill.bars),
                    "tempo_bpm": _number(advice.drill.tempo_bpm),
                    "pieces": list(advice.drill.pieces),
                },
            }
            for advice in said
        ],
    }


def _sticking(summary: Summary) -> dict[str, Json] | None:
    """The hands beside those that are written, with the lesson's bars in which they were the others."""
    sticking = summary.sticking
    if sticking is None:
        return None
    bars = Counter((summary.view.bars(summary.score)[sticking.wrong] + 1).tolist())
    return {
        "right": int(sticking.right.sum()),
        "wrong": int(sticking.wrong.sum()),
        "cannot_tell": int(sticking.cannot_tell.sum()),
        "wrong_bars": [{"bar": bar, "wrong": bars[bar]} for bar in sorted(bars)],
        "played": {word(limb): count for limb, count in sticking.played.items()},
    }


def _number(value: float | None) -> float | None:
    return None if value is None else round(float(value), _DECIMALS)


def _timing(spread: Spread) -> dict[str, Json]:
    return {
        "mean_signed_asynchrony_ms": _number(spread.mean_ms),
        "sd_asynchrony_ms": _number(spread.sd_ms),
        "mean_ci_ms": None if spread.ci_ms is None else [_number(end) for end in spread.ci_ms],
        "strokes": spread.count,
    }


def _tempo(tempo: TempoCurve) -> dict[str, Json]:
    return {
        "median_bpm": _number(tempo.median_bpm),
        "drift_pct_per_minute": _number(tempo.drift_pct_per_minute),
        "drift_ci": None if tempo.drift_ci is None else [_number(end) for end in tempo.drift_ci],
        "bars": [
            {"bar": bar.bar + 1, "at_s": _number(bar.at_s), "tempo_bpm": _number(bar.tempo_bpm)} for bar in tempo.bars
        ],
    }


def _habits(habits: Habits) -> dict[str, Json]:
    """Every effect with its standard error, named and measured as `station.scoring.analysis.habits` says."""
    return {
        name: {"effect": _number(effect.value), "standard_error": _number(effect.error), "moments": effect.slots}
        for name, effect in habits.effects.items()
    }


def _group(group: SummaryGroup) -> dict[str, Json]:
    return {
        "notes": group.notes,
        "matched": group.matched,
        "misses": group.misses,
        "wrong_piece": group.wrong_piece,
        "extras": group.extras,
        "timing": _timing(group.timing),
        "mean_velocity_error": _number(group.velocity_error),
    }


def _keyed(groups: Mapping[Limb, SummaryGroup] | Mapping[Dynamic, SummaryGroup]) -> dict[str, Json]:
    return {word(key): _group(group) for key, group in groups.items()}


def _dynamics(dynamics: Loudness) -> dict[str, Json]:
    names = [word(dynamic) for dynamic in Dynamic]
    return {
        "mean_velocity_error": _number(dynamics.mean_velocity_error),
        "sd_velocity_error": _number(dynamics.sd_velocity_error),
        "confusion": {
            written: dict(zip(names, row, strict=True))
            for written, row in zip(names, dynamics.confusion.tolist(), strict=True)
        },
    }
