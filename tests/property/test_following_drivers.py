"""Live and final following are one model: hit by hit the beats gain and cost what they do over the whole take."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from station.core.units import NS_PER_S
from station.scoring.following.anchors import Hits
from station.scoring.following.beat_blocks import Blocks
from station.scoring.following.beat_offsets import forward, offsets_of
from station.scoring.following.online import Online
from station.scoring.following.written import written_of
from station.scoring.matching.match_classes import match_classes
from tests.fakes.journeys import through_composed
from tests.fakes.scores import beat_and_fill, double_strokes, rock_beat, swing_ride

SCORES = [rock_beat(12), beat_and_fill(4), double_strokes(6, 110.0), swing_ride(12), through_composed(12, 90.0, 1)]
WRITTEN = [written_of(score, match_classes()[score.notes["piece"]]) for score in SCORES]


@given(
    which=st.integers(0, len(SCORES) - 1),
    seed=st.integers(0, 2**31),
    sd_s=st.floats(0.001, 0.04),
    turn=st.floats(0.1, 0.9),
    by_beats=st.sampled_from([-8.0, -4.0, -1.0, -0.5, 0.0, 1.0, 4.0]),
    silent_s=st.sampled_from([0.0, 0.7, 3.0]),
)
def test_hit_by_hit_the_totals_are_those_of_the_whole(
    which: int, seed: int, sd_s: float, turn: float, by_beats: float, silent_s: float
) -> None:
    """A sloppy take that is silent for a while at `turn` of the score and goes on `by_beats` from where it was."""
    written, rng = WRITTEN[which], np.random.default_rng(seed)
    kept = rng.random(len(written.at_s)) > 0.1
    at_s, classes = written.at_s[kept] + rng.normal(0, sd_s, int(kept.sum())), written.classes[kept]
    turn_s = turn * written.at_s[-1]
    at_s = at_s + np.where(at_s > turn_s, max(silent_s - by_beats * float(written.beat_s[1]), 0.0), 0.0)
    order = np.argsort(at_s, kind="stable")
    at_ns = np.rint(at_s[order] * NS_PER_S).astype(np.int64)
    hits = Hits(at_ns / NS_PER_S, classes[order])

    live, stepwise = Online(written, clocked=True), []
    for i, (at, match_class) in enumerate(zip(at_ns.tolist(), hits.classes.tolist(), strict=True)):
        if live.hit(at, match_class).first < i:
            break  # from here on the offsets count from another place
        stepwise.append(live.totals)

    offsets, end = offsets_of(written, slips=False), len(stepwise)
    blocks = Blocks.of(written, hits, written.beats.beat(hits.at_s), 0, end, offsets)
    total = -offsets.price
    for block in range(len(blocks.starts)):
        np.testing.assert_allclose(stepwise[int(blocks.starts[block])], total - total.max(), atol=1e-3)
        total, _, _ = forward(total, blocks.gains[block], offsets, written, blocks.pauses.get(block))
