"""Hits of attempts that do not count: a student who stops and begins again, or plays a bar twice, loses nothing."""

import numpy as np
import pytest

from station.drills.library import find_lesson
from station.music.judgement import OF_LONE_HITS, Label
from station.music.performance import Performance
from station.music.score import Score
from station.practice.records import rejudge
from station.scoring.align import align
from station.scoring.analysis.summary import Summary, summarise
from station.scoring.following.follower import Follower
from station.scoring.matching.attempts import owners, played_again
from tests.fakes.played import played, varied_groove, with_noise


def bars(score: Score, first: int, end: int) -> np.ndarray:
    return np.flatnonzero((score.bar >= first) & (score.bar < end))


def begun_again(score: Score) -> Performance:
    """Six and a half bars, then from the second bar to the end, a bar's rest later and on the click."""
    bar_s = score.onset_s[bars(score, 1, 2)[0]] - score.onset_s[bars(score, 0, 1)[0]]
    first, again = bars(score, 0, 7)[:-6], bars(score, 1, score.bar_count)
    rows = np.concatenate((first, again))
    at_s = np.concatenate((score.onset_s[first], score.onset_s[again] + 7 * bar_s))
    return played(score, *with_noise(at_s, rows, 8.0))


def summed(score: Score, performance: Performance, clocked: bool) -> Summary:
    return summarise(score, performance, align(score, performance, clocked))


@pytest.mark.parametrize("clocked", [True, False])
@pytest.mark.parametrize("lesson", ["rock-fill-1", "funk-1"])
def test_who_stops_and_begins_again_loses_no_point(lesson: str, clocked: bool) -> None:
    score = find_lesson(lesson).score.repeated(12 // find_lesson(lesson).score.bar_count)
    clean = played(score, *with_noise(score.onset_s, np.arange(len(score)), 8.0))
    once, twice = summed(score, clean, clocked), summed(score, begun_again(score), clocked)
    counts = twice.counts
    assert counts.played_again >= 0.8 * len(bars(score, 1, 6))
    assert counts.extras <= 1
    assert counts.hits == counts.matched + counts.extras + counts.wrong_piece + counts.ignored
    assert counts.played_again <= counts.ignored
    assert once.points is not None
    assert twice.points == pytest.approx(once.points, abs=2.0)


def test_an_attempt_that_was_given_up_is_not_counted() -> None:
    """Notes a second apart. Four are played, then from the second on all: the later attempt counts, by hand."""
    note_ns = np.arange(6) * 10**9
    hit_ns = np.array([0, 1, 2, 3, 1, 2, 3, 4, 5]) * 10**9
    attempt = np.array([0, 0, 0, 0, 1, 1, 1, 1, 1])
    owner = owners(note_ns, np.zeros(6, np.int64), hit_ns, np.zeros(9, np.int64), attempt)
    assert owner.tolist() == [0, 1, 1, 1, 1, 1]
    assert np.flatnonzero(played_again(note_ns, owner, hit_ns, attempt)).tolist() == [1, 2, 3]


def test_every_label_has_its_word() -> None:
    assert set(rejudge._WORDS) == set(Label) - {Label.PENDING}
    assert {Label.MATCH, Label.MISS, Label.WRONG_PIECE, Label.PENDING, Label.UNKNOWN} | OF_LONE_HITS == set(Label)


def test_live_the_first_attempt_is_played_again_too() -> None:
    """What was heard before the student went back turns into `PLAYED_AGAIN` as the notes are played anew."""
    score = varied_groove(12)
    performance, said = begun_again(score), {}
    follower = Follower(score)
    for hit in performance:
        for verdict in (*follower.advance(hit.at_ns), *follower.hit(hit, hit.at_ns)):
            if verdict.hit_index is not None:
                said[verdict.hit_index] = verdict.label
    labels = list(said.values())
    final = align(score, performance, clocked=True)
    assert labels.count(Label.EXTRA) <= 3
    assert abs(labels.count(Label.PLAYED_AGAIN) - final.count(Label.PLAYED_AGAIN)) <= 3
