"""Who comes in beside the click and plays on steadily is told so, and their strokes are right where they are meant.

Takes are of tests/fakes/journeys.py, which shares nothing with the code: bars that are all different, noise that is
drawn there, then moved against the click by whole and half beats. At 120 a minute a beat lasts half a second.
"""

import numpy as np
import pytest

from station.core.events import Hit
from station.core.units import NS_PER_S, PPQ
from station.music.judgement import Label
from station.music.performance import Performance
from station.practice.session.judging import Judging
from station.scoring.align import align
from station.scoring.analysis.entries import in_words
from station.scoring.analysis.summary import Summary, summarise
from station.scoring.following.follower import Follower
from station.scoring.report.advice import advise
from tests.fakes.journeys import Leg, Slips, through_composed, travel

BARS, BEAT_S = 8, 0.5
SCORE = through_composed(BARS, 120.0, 3)
SLIPS = Slips(sd_s=0.02, missing=0.05, extra=0.03, wrong_piece=0.03)
END_S = BARS * 4 * BEAT_S + 1.0
"""Strokes later than a second after the end are no longer judged (`plan.TAIL_S`)."""


def played(beats: float, seed: int, legs: tuple[Leg, ...] = (Leg(0, BARS),), after_s: float = 0.0) -> list[Hit]:
    """A take; what is played after `after_s` comes so many beats late."""
    hits = [stroke.hit for stroke in travel(SCORE, legs, seed, SLIPS).strokes]
    moved = [
        Hit(
            h.at_ns + (round(beats * BEAT_S * NS_PER_S) if h.at_ns >= after_s * NS_PER_S - 5e7 else 0),
            h.piece,
            h.zone,
            h.velocity,
        )
        for h in hits
    ]
    return [hit for hit in moved if -0.25 <= hit.at_ns / NS_PER_S <= END_S]


def judged(hits: list[Hit]) -> Summary:
    performance = Performance.from_hits(hits)
    return summarise(SCORE, performance, align(SCORE, performance, clocked=True))


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(
    ("beats", "fault", "said"),
    [
        (0.5, "came_in_late", "half a beat late"),
        (1, "came_in_late", "a beat late"),
        (2, "came_in_late", "two beats late"),
        (4, "came_in_late", "a bar late"),
        (-0.5, "came_in_early", "half a beat early"),
        (-1, "came_in_early", "a beat early"),
    ],
)
def test_an_entry_is_the_one_fault_that_is_named(beats: float, fault: str, said: str, seed: int) -> None:
    summary = judged(played(beats, seed))
    first, *others = advise(summary)
    assert (first.fault, said in first.text) == (fault, True)
    assert not {one.fault for one in others} & {"missed", "extra", "wrong_piece", "stopped", "late", "early"}
    assert summary.counts.matched > 0.8 * len(SCORE)


def test_the_strokes_of_a_late_player_are_right_and_only_the_beat_at_the_end_is_missed() -> None:
    """Eight bars, a beat late, without a slip: all notes match but those for which a second after the end is too short.

    The last beat ends a beat late, half a second after the end: even that is heard.
    """
    exact = [
        Hit(int(at) + NS_PER_S // 2, note.piece, note.zone, 80) for at, note in zip(SCORE.onset_ns, SCORE, strict=True)
    ]
    summary = judged([hit for hit in exact if hit.at_ns <= BARS * 4 * BEAT_S * NS_PER_S])
    missed = SCORE.notes["tick"][summary.alignment.note_label == Label.MISS]
    assert missed.min() > SCORE.end_tick - PPQ
    assert summary.alignment.count(Label.MATCH) == int((SCORE.notes["tick"] <= SCORE.end_tick - PPQ).sum())
    assert summary.alignment.count(Label.WRONG_PIECE) == summary.alignment.count(Label.EXTRA) == 0


@pytest.mark.parametrize("seed", range(6))
def test_who_is_in_time_is_not_told_otherwise(seed: int) -> None:
    faults = {one.fault for one in advise(judged(played(0, seed)))}
    assert not faults & {"came_in_late", "came_in_early"}


@pytest.mark.parametrize("seed", range(3))
def test_a_pass_that_is_a_beat_late_is_told_by_its_bar(seed: int) -> None:
    """The second half, from bar 5 on, is a beat late."""
    (first, *_) = advise(judged(played(1, seed, after_s=4 * 4 * BEAT_S)))
    assert (first.fault, first.bars) == ("came_in_late", (5,))


@pytest.mark.parametrize("beats", [-1, 0.5, 1, 2])
def test_it_is_told_while_it_is_played(beats: float) -> None:
    """Within two bars, and then every stroke that is right is judged right: also those of before."""
    hits = played(beats, 1)
    follower, told, right = Follower(SCORE, clocked=True), -1, 0
    last: dict[int, Label] = {}
    for i, hit in enumerate(hits):
        for verdict in follower.hit(hit, hit.at_ns):
            if verdict.hit_index is not None:
                last[verdict.hit_index] = verdict.label
        if told < 0 and follower.beats_behind:
            told = i
    assert follower.beats_behind == pytest.approx(beats)
    assert hits[told].at_ns - hits[0].at_ns < 2 * 4 * BEAT_S * NS_PER_S
    right = sum(label is Label.MATCH for label in last.values())
    assert right > 0.85 * len(hits)


def test_beats_in_words() -> None:
    said = [in_words(quarters, PPQ, 4 * PPQ) for quarters in (0.5, 1, 1.5, 2, 3, 4, 8)]
    assert said == ["half a beat", "a beat", "a beat and a half", "two beats", "three beats", "a bar", "2 bars"]
    dotted = [in_words(quarters, PPQ * 3 // 2, 3 * PPQ) for quarters in (0.5, 1.0, 1.5, 3.0)]
    assert dotted == ["an eighth", "two eighths", "a beat", "a bar"]


def test_a_loose_player_is_late_and_not_in_another_place() -> None:
    """90 ms behind the click throughout, the worst lean of anybody: no entry."""
    hits = [Hit(hit.at_ns + 90_000_000, hit.piece, hit.zone, 80) for hit in played(0, 2)]
    assert np.isin([one.fault for one in advise(judged(hits))], ["came_in_late"]).sum() == 0


def test_a_bar_that_is_left_out_or_played_again_in_the_middle_is_no_entry() -> None:
    skipped = travel(SCORE, [Leg(0, 4), Leg(5, 8)], 1, SLIPS).strokes
    faults = {one.fault for one in advise(judged([stroke.hit for stroke in skipped]))}
    assert "left_out_bars" in faults
    assert "came_in_early" not in faults
    again = travel(SCORE, [Leg(0, 4), Leg(3, 7)], 1, SLIPS).strokes
    faults = {one.fault for one in advise(judged([stroke.hit for stroke in again]))}
    assert "repeated_bars" in faults
    assert "came_in_late" not in faults


def test_who_sits_out_the_first_bar_of_a_loop_and_plays_its_passes_came_in_a_bar_late() -> None:
    """Four times the same bar: what is played a bar late fits the bars after it, but for the first."""
    loop = through_composed(1, 120.0, 5).repeated(4)
    hits = [
        Hit(int(at) + 2 * NS_PER_S, note.piece, note.zone, 80) for at, note in zip(loop.onset_ns, loop, strict=True)
    ]
    performance = Performance.from_hits([hit for hit in hits if hit.at_ns <= loop.length_ns + NS_PER_S])
    (said, *_) = advise(summarise(loop, performance, align(loop, performance, clocked=True)))
    assert said.fault in ("came_in_late", "left_out_bars")


@pytest.mark.parametrize("seed", range(4))
def test_who_plays_something_else_came_in_nowhere(seed: int) -> None:
    """Other bars on the click, of the same pieces: wrong as they are, and no entry."""
    other = through_composed(BARS, 120.0, 40 + seed)
    hits = [stroke.hit for stroke in travel(other, [Leg(0, BARS)], seed, SLIPS).strokes]
    assert not {one.fault for one in advise(judged(hits))} & {"came_in_late", "came_in_early"}
    judging = Judging(SCORE, clocked=True)
    told = [judging.beats_behind for hit in hits if judging.hit(hit) is not None]
    assert not any(told)
