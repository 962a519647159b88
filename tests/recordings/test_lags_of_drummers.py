"""Drummers of the Groove MIDI Dataset against their own click: as they are, and as late equipment would have them."""

from pathlib import Path

import pytest

from benchmarks.device_lags import quantised, runs_of
from station.core.units import NS_PER_MS
from station.music.formats.smf.standard_midi import performance_from_midi, read_midi
from station.scoring.analysis.device_lag import LagCause, LagRun, shared_lag
from tests.real_data import DATA

TAKES = sorted((DATA / "gmd").glob("drummer[1578]/eval_session/*_beat_4-4.mid"))
DRUMMERS = sorted({path.parents[1].name for path in TAKES})


def runs(path: Path, late_ms: float) -> tuple[LagRun, ...]:
    take = performance_from_midi(read_midi(path))
    score = quantised(take, float(path.stem.split("_")[-3]))
    return runs_of(score, take.shifted(round(late_ms * NS_PER_MS)), path.stem)


@pytest.mark.parametrize("drummer", DRUMMERS)
def test_a_lag_is_found_beside_their_own_stand_and_none_where_there_is_none(drummer: str) -> None:
    own = [path for path in TAKES if path.parents[1].name == drummer]
    found = {late: shared_lag(run for path in own for run in runs(path, late)) for late in (0.0, 50.0, 100.0, 150.0)}
    assert found[0.0].cause is LagCause.NONE
    for late, lag in found.items():
        assert lag.lag_ms == pytest.approx(late + found[0.0].lag_ms, abs=10)
        assert lag.cause not in (LagCause.TEMPO, LagCause.PADS) or late <= 50, "equipment is no habit"
    assert found[150.0].may_be_taken_out
