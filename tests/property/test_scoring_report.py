"""Properties of the way from hits to report: what moves only the mean, what changes nothing, what always adds up."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from station.core.units import NS_PER_MS
from station.music.performance import HIT_DTYPE, Performance
from station.scoring.align import align
from station.scoring.analysis.summary import Summary, summarise
from station.scoring.report.pairs_table import pairs_csv
from tests.fakes.played import varied_groove
from tests.fakes.scores import beat_and_fill, flams, rock_beat

SCORES = [rock_beat(4), beat_and_fill(2), flams(6), varied_groove(6)]
WHICH, SEED = st.integers(0, len(SCORES) - 1), st.integers(0, 10_000)


def sloppy(which: int, seed: int, sd_ms: float = 10.0) -> Performance:
    """Strokes missing, added at any time, and on any piece."""
    score, rng = SCORES[which], np.random.default_rng(seed)
    rows = np.flatnonzero(rng.random(len(score)) > 0.05)
    noise = np.rint(rng.normal(0, sd_ms, len(rows)) * NS_PER_MS).astype(np.int64)
    added = int(rng.integers(0, 8))
    hits = np.zeros(len(rows) + added, HIT_DTYPE)
    hits["at_ns"] = np.concatenate((score.onset_ns[rows] + noise, rng.integers(0, score.length_ns, added)))
    hits["piece"] = np.concatenate((score.notes["piece"][rows], rng.choice([0, 1, 2, 3, 5, 9], added)))
    hits["velocity"] = rng.integers(20, 127, len(hits))
    return Performance.from_array(hits)


def report(which: int, performance: Performance, clocked: bool = True) -> Summary:
    return summarise(SCORES[which], performance, align(SCORES[which], performance, clocked))


@given(WHICH, SEED, st.integers(-40, 40))
@settings(max_examples=25, deadline=None)
def test_shifting_all_hits_moves_only_the_mean(which: int, seed: int, by_ms: int) -> None:
    """Without strokes at ghost level or of the foot, whose rules look at the grid."""
    hits = sloppy(which, seed).hits.copy()
    hits = hits[hits["piece"] != 3]
    hits["velocity"] = np.maximum(hits["velocity"], 60)
    performance = Performance.from_array(hits)
    here, there = report(which, performance), report(which, performance.shifted(by_ms * NS_PER_MS))
    assert here.counts == there.counts
    assert here.timing.mean_ms is not None
    assert there.timing.mean_ms == pytest.approx(here.timing.mean_ms + by_ms, abs=1e-6)
    assert there.timing.sd_ms == pytest.approx(here.timing.sd_ms, abs=1e-6)


@given(WHICH, SEED, st.booleans())
@settings(max_examples=25, deadline=None)
def test_permuting_simultaneous_hits_changes_nothing(which: int, seed: int, clocked: bool) -> None:
    """All strokes of a slot at one and the same time, in any order."""
    score = SCORES[which]
    performance = sloppy(which, seed, sd_ms=0.0)
    shuffled = Performance.from_array(performance.hits[np.random.default_rng(seed + 1).permutation(len(performance))])
    here, there = report(which, performance, clocked), report(which, shuffled, clocked)
    assert (here.counts, here.timing) == (there.counts, there.timing)
    assert here.points == pytest.approx(there.points)
    assert len(score) == here.counts.notes


@given(WHICH, SEED, st.booleans(), st.floats(0, 80))
@settings(max_examples=40, deadline=None)
def test_everything_adds_up(which: int, seed: int, clocked: bool, sd_ms: float) -> None:
    performance = sloppy(which, seed, sd_ms)
    summary = report(which, performance, clocked)
    c = summary.counts
    assert c.notes == len(SCORES[which]) == c.matched + c.misses + c.wrong_piece
    assert c.hits == len(performance) == c.matched + c.extras + c.wrong_piece + c.ignored
    assert sum(g.notes for g in summary.by_piece.values()) == sum(g.notes for g in summary.by_bar.values()) == c.notes
    assert summary.points is not None
    assert 0 <= summary.points <= 100
    lines = pairs_csv(SCORES[which], performance, summary.alignment).splitlines()
    assert len(lines) == 1 + c.notes + c.extras + c.ignored
