"""The lag in a session's report, and the runs that a report holds; docs/documents.md has the keys."""

from types import MappingProxyType
from typing import Any

from station.core.pieces import Piece, word
from station.practice.lag.lag_words import lag_text
from station.practice.lag.session_lag import SessionLag
from station.scoring.analysis.device_lag import LagMean, LagRun
from station.scoring.report.assessment_document import Json

_PIECES = {word(piece): piece for piece in Piece}
_MOST_BPM, _MOST_MOMENTS, _MOST_MS = 1_000.0, 1_000_000, 60_000.0
"""No session of ours has more (our choice: hours of strokes, a beat at a tempo of 1): what says so was edited."""


def lag_document(lag: SessionLag | None) -> Json:
    """The value of `lag` in a report."""
    if lag is None:
        return None
    found, target = lag.found, lag.target
    rise: Json = None if found.rise_ms is None else [_ms(value) for value in found.rise_ms]
    apart: Json = None
    if found.apart is not None:
        apart = {
            "piece": word(found.apart[0]),
            "ms": _ms(found.apart[1]),
            "ci": [_ms(each) for each in found.apart[2:]],
        }
    return {
        "found_ms": _ms(found.lag_ms),
        "ci": [_ms(found.low_ms), _ms(found.high_ms)],
        "cause": found.cause.value,
        "answer": lag.answer.value,
        "left_out_ms": _ms(lag.out_ms),
        "of": None if target is None else target.what,
        "device": None if target is None else target.name,
        "rise": rise,
        "apart": apart,
        "text": lag_text(lag),
        "runs": [_run_document(run) for run in lag.runs],
    }


def _ms(value: float) -> float:
    return round(value, 1)


def _run_document(run: LagRun) -> Json:
    return {
        "tempo_bpm": round(run.tempo_bpm, 3),
        **_mean_document(run.whole),
        "pads": {word(pad): _mean_document(mean) for pad, mean in run.pads.items()},
    }


def _mean_document(mean: LagMean) -> dict[str, Json]:
    return {"moments": mean.moments, "mean_ms": round(mean.mean_ms, 2), "error_ms": round(mean.error_ms, 2)}


# --- reading ---------------------------------------------------------------------------------------------------------


def runs_in(lag: Any, take: str) -> tuple[LagRun, ...]:  # noqa: ANN401 - of a JSON document
    """The runs of the `lag` in the report of `take`; raises `KeyError`, `TypeError` or `ValueError` of what is none."""
    return () if lag is None else tuple(_run(row, take) for row in lag["runs"])


def _run(row: Any, take: str) -> LagRun:  # noqa: ANN401 - of a JSON document
    pads = {_PIECES[name]: _mean(mean) for name, mean in row["pads"].items()}
    return LagRun(_within(row["tempo_bpm"], 1.0, _MOST_BPM), _mean(row), MappingProxyType(pads), take)


def _mean(row: Any) -> LagMean:  # noqa: ANN401 - of a JSON document
    moments = int(_within(row["moments"], 1, _MOST_MOMENTS))
    return LagMean(moments, _within(row["mean_ms"], -_MOST_MS, _MOST_MS), _within(row["error_ms"], 0.0, _MOST_MS))


def _within(raw: Any, least: float, most: float) -> float:  # noqa: ANN401 - of a JSON document
    """A number of a file that anybody may have edited: JSON writes numbers that no float holds, and 1e400."""
    if isinstance(raw, bool) or not isinstance(raw, int | float) or not least <= raw <= most:
        raise ValueError("beyond every session")
    return float(raw)
