"""Properties of live judgement: one performance, one judgement, however often the clock is told."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from station.core.units import NS_PER_MS, NS_PER_S
from station.music.judgement import Judgement, Label
from station.music.performance import Performance
from station.scoring.align import align
from station.scoring.following.follower import Follower
from tests.fakes.scores import beat_and_fill, double_strokes, rock_beat

SCORES = [rock_beat(3), beat_and_fill(1), double_strokes(2, 110.0)]


def performance_of(which: int, seed: int, sd_ms: float) -> Performance:
    """A sloppy run through a score: strokes missing, doubled, and on other pieces."""
    rng = np.random.default_rng(seed)
    score = SCORES[which]
    hits = np.zeros(0, dtype=Performance.from_hits([]).hits.dtype)
    rows = np.flatnonzero(rng.random(len(score)) > 0.05)
    rows = np.concatenate((rows, rng.choice(len(score), len(score) // 20)))
    hits = np.zeros(len(rows), hits.dtype)
    hits["at_ns"] = score.onset_ns[rows] + np.rint(rng.normal(0, sd_ms, len(rows)) * NS_PER_MS).astype(np.int64)
    hits["piece"] = np.where(rng.random(len(rows)) < 0.03, 9, score.notes["piece"][rows])
    hits["velocity"] = rng.integers(20, 127, len(rows))
    return Performance.from_array(hits)


Verdicts = tuple[dict[int, Label], dict[int, tuple[Label, int | None]]]


def judged(which: int, performance: Performance, frames_per_s: float, clocked: bool = True) -> Verdicts:
    """The last word on every note and hit when the clock is told `frames_per_s` times a second."""
    score = SCORES[which]
    follower = Follower(score, clocked=clocked)
    notes: dict[int, Label] = {}
    hits: dict[int, tuple[Label, int | None]] = {}
    frame_ns = round(NS_PER_S / frames_per_s)
    now, played, i = -NS_PER_S, list(performance), 0
    end_ns = max(score.length_ns, int(performance.hits["at_ns"].max(initial=0)))
    while now < end_ns + 2 * NS_PER_S:
        now += frame_ns
        said: list[Judgement] = []
        while i < len(played) and played[i].at_ns <= now:
            said += follower.hit(played[i], played[i].at_ns)
            i += 1
        said += follower.advance(now)
        for judgement in said:
            if judgement.hit_index is not None:
                hits[judgement.hit_index] = (judgement.label, judgement.note_index)
            if judgement.note_index is not None:
                notes[judgement.note_index] = judgement.label
    return notes, hits


@pytest.mark.parametrize("clocked", [True, False])
@pytest.mark.parametrize("frames_per_s", [1, 24, 60, 240])
@given(st.integers(0, len(SCORES) - 1), st.integers(0, 10_000), st.floats(0, 60))
@settings(max_examples=10, deadline=None)
def test_frame_rate_does_not_matter(frames_per_s: float, clocked: bool, which: int, seed: int, sd_ms: float) -> None:
    performance = performance_of(which, seed, sd_ms)
    assert judged(which, performance, frames_per_s, clocked) == judged(which, performance, 1000, clocked)


@given(st.integers(0, len(SCORES) - 1), st.integers(0, 10_000), st.floats(0, 60), st.floats(0.7, 1.4))
@settings(max_examples=20, deadline=None)
def test_verdicts_are_one_to_one_without_a_click(which: int, seed: int, sd_ms: float, rate: float) -> None:
    """Whatever was corrected on the way, no two hits hold one note in the end."""
    performance = performance_of(which, seed, sd_ms)
    hits = performance.hits.copy()
    hits["at_ns"] = np.rint(hits["at_ns"] / rate)
    notes, said = judged(which, Performance.from_array(hits), 60, clocked=False)
    claimed = [note for _, note in said.values() if note is not None]
    assert sorted(said) == list(range(len(performance)))
    assert len(set(claimed)) == len(claimed)
    held = {note for note, label in notes.items() if label in (Label.MATCH, Label.WRONG_PIECE)}
    assert set(claimed) == held


@given(st.integers(0, len(SCORES) - 1), st.integers(0, 10_000), st.floats(0, 60))
@settings(max_examples=40, deadline=None)
def test_verdicts_are_consistent(which: int, seed: int, sd_ms: float) -> None:
    """Every note and every hit has a verdict, and the two sides name each other."""
    performance = performance_of(which, seed, sd_ms)
    notes, hits = judged(which, performance, 60)
    assert sorted(notes) == list(range(len(SCORES[which])))
    assert sorted(hits) == list(range(len(performance)))
    claimed = [note for _, note in hits.values() if note is not None]
    assert len(set(claimed)) == len(claimed)
    for label in (Label.MATCH, Label.WRONG_PIECE):
        assert sorted(n for n, said in notes.items() if said is label) == sorted(
            note for said, note in hits.values() if said is label and note is not None
        )


@given(st.integers(0, len(SCORES) - 1), st.integers(0, 10_000))
@settings(max_examples=20, deadline=None)
def test_a_steady_player_is_judged_as_in_the_end(which: int, seed: int) -> None:
    """With a spread of 8 ms nothing is in doubt: the live counts are those of the final alignment."""
    performance = performance_of(which, seed, 8.0)
    notes, _ = judged(which, performance, 60)
    final = align(SCORES[which], performance, clocked=True)
    assert sum(label is Label.MATCH for label in notes.values()) == final.count(Label.MATCH)
