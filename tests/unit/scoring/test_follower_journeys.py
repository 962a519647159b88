"""Students who are not where the score expects them: found again within two bars, with a click and without.

The truth is the journeys' own (tests/fakes/journeys.py): which note each stroke was meant for.
"""

import numpy as np
import pytest

from station.core.units import NS_PER_MS
from station.music.judgement import Judgement, Label
from station.music.performance import Performance
from station.scoring.align import align
from station.scoring.following.follower import Follower
from tests.fakes.journeys import Journey, Leg, Slips, through_composed, travel

BARS = 24
SCORES = {"at 90": through_composed(BARS, 90.0, 1), "at 120": through_composed(BARS, 120.0, 2)}
SEEDS = (0, 1, 2)

FREE = {
    "20 % too slow": [Leg(0, 16, 0.8)],
    "20 % too fast": [Leg(0, 16, 1.2)],
    "begins late": [Leg(0, 16, pause_s=1.3)],
    "begins a minute late": [Leg(0, 16, pause_s=60.0)],
    "begins in mid-score": [Leg(7, 20)],
    "skips a bar": [Leg(0, 6), Leg(7, 20)],
    "skips five bars": [Leg(0, 6.5), Leg(11.5, 22)],
    "skips two and a half beats": [Leg(0, 6), Leg(6.625, 20)],
    "goes back a bar": [Leg(0, 8), Leg(7, 20)],
    "goes back four and a half bars": [Leg(0, 10.5), Leg(6, 20)],
    "begins again at once": [Leg(0, 9.25), Leg(0, 12)],
    "begins again after a while": [Leg(0, 9.25), Leg(0, 12, pause_s=4.4)],
    "hesitates": [Leg(0, 5.5), Leg(5.5, 16, pause_s=0.7)],
    "stops for three seconds": [Leg(0, 5.5), Leg(5.5, 16, pause_s=3.1)],
    "stops for ten minutes": [Leg(0, 5.5), Leg(5.5, 16, pause_s=600.0)],
    "stops and takes the bar again": [Leg(0, 5.5), Leg(5, 16, pause_s=3.1)],
    "stops and goes on elsewhere, slower": [Leg(0, 9.5), Leg(4, 16, 0.85, pause_s=5.3)],
    "is suddenly 10 % faster": [Leg(0, 6), Leg(6, 20, 1.1)],
    "is suddenly 20 % slower": [Leg(0, 6), Leg(6, 20, 0.8)],
}

CLICKED = {
    "skips a bar": [Leg(0, 6), Leg(7, 20)],
    "skips five beats": [Leg(0, 6), Leg(7.25, 20)],
    "goes back a bar": [Leg(0, 8), Leg(7, 20)],
    "begins again": [Leg(0, 9), Leg(0, 12)],
    "begins again after twenty bars": [Leg(0, 20), Leg(0, 6)],
}


def judged_at_once(journey: Journey, clocked: bool) -> tuple[list[Judgement], dict[int, Judgement], int]:
    """What was first said of each hit, the last word on it, and the most judgements that one hit brought."""
    follower = Follower(journey.score, clocked=clocked)
    first: list[Judgement] = []
    last: dict[int, Judgement] = {}
    most = 0
    for i, stroke in enumerate(journey.strokes):
        said = follower.hit(stroke.hit, stroke.hit.at_ns)
        most = max(most, len(said))
        last |= {verdict.hit_index: verdict for verdict in said if verdict.hit_index is not None}
        first.append(last[i])
    return first, last, most


def share_right(journey: Journey, said: list[Judgement], hits: list[int]) -> float:
    """Of the strokes `hits` that were meant for a note, how many were given it."""
    meant = [i for i in hits if journey.strokes[i].note is not None]
    return sum(said[i].note_index == journey.strokes[i].note for i in meant) / len(meant)


@pytest.mark.parametrize("score", SCORES)
@pytest.mark.parametrize("legs", FREE)
def test_without_a_click_the_student_is_found_within_two_bars(score: str, legs: str) -> None:
    for seed in SEEDS:
        journey = travel(SCORES[score], FREE[legs], seed)
        first, last, most = judged_at_once(journey, clocked=False)
        for leg in range(len(FREE[legs])):
            assert share_right(journey, first, journey.after(leg, 2.0)) >= 0.95
        assert share_right(journey, [last[i] for i in range(len(first))], journey.not_played_again()) >= 0.9
        assert most <= 6 * 48  # what one hit may take back: three bars, each with its note's and its old hit's verdict


@pytest.mark.parametrize("score", SCORES)
@pytest.mark.parametrize("legs", CLICKED)
def test_with_a_click_whoever_plays_other_bars_is_found_within_two(score: str, legs: str) -> None:
    for seed in SEEDS:
        journey = travel(SCORES[score], CLICKED[legs], seed)
        first, last, most = judged_at_once(journey, clocked=True)
        for leg in range(len(CLICKED[legs])):
            assert share_right(journey, first, journey.after(leg, 2.0)) >= 0.95
        assert share_right(journey, [last[i] for i in range(len(first))], journey.not_played_again()) >= 0.92
        assert most <= 4 * 48


@pytest.mark.parametrize("score", SCORES)
@pytest.mark.parametrize("legs", CLICKED)
def test_the_report_finds_with_a_click_what_was_found_live(score: str, legs: str) -> None:
    journey = travel(SCORES[score], CLICKED[legs], SEEDS[0])
    performance = Performance.from_hits(stroke.hit for stroke in journey.strokes)
    alignment = align(journey.score, performance, clocked=True)
    own = np.where(alignment.hit_label == Label.MATCH, alignment.note_of_hit, -1)
    counted = journey.not_played_again()
    meant = [i for i in counted if journey.strokes[i].note is not None]
    assert sum(own[i] == journey.strokes[i].note for i in meant) / len(meant) >= 0.9
    assert abs(float(np.mean(alignment.asynchrony_ns[alignment.note_label == Label.MATCH]))) < 5 * NS_PER_MS


def test_with_a_click_a_stop_does_not_move_the_score() -> None:
    """Two bars and a half are left out while the click goes on: four seconds and a half of silence at 120."""
    journey = travel(SCORES["at 120"], [Leg(0, 6), Leg(8.5, 16, pause_s=5.0)], 1)
    follower = Follower(journey.score)
    said = [verdict for stroke in journey.strokes for verdict in follower.hit(stroke.hit, stroke.hit.at_ns)]
    own = {v.hit_index: v.note_index for v in said if v.hit_index is not None}
    meant = [i for i, stroke in enumerate(journey.strokes) if stroke.note is not None]
    assert sum(own[i] == journey.strokes[i].note for i in meant) / len(meant) >= 0.97


@pytest.mark.parametrize("clocked", [True, False])
def test_a_start_in_mid_score_makes_no_false_misses(clocked: bool) -> None:
    journey = travel(SCORES["at 120"], [Leg(7, 12)], 3, Slips(missing=0.0, extra=0.0, wrong_piece=0.0))
    late_ns = round(7 * 2.0e9) if clocked else 0
    follower, missed = Follower(journey.score, clocked=clocked), {}
    for stroke in journey.strokes:
        at_ns = stroke.hit.at_ns + late_ns
        for verdict in (*follower.hit(stroke.hit, at_ns), *follower.advance(at_ns)):
            missed[verdict.note_index] = verdict.label is Label.MISS
    assert not any(missed.values())


def test_without_a_click_silence_is_no_miss_and_the_score_waits() -> None:
    journey = travel(SCORES["at 120"], [Leg(0, 4)], 4, Slips(missing=0.0, extra=0.0, wrong_piece=0.0))
    follower = Follower(journey.score, clocked=False)
    for stroke in journey.strokes:
        follower.hit(stroke.hit, stroke.hit.at_ns)
    end_ns = journey.strokes[-1].hit.at_ns
    assert follower.advance(end_ns + 60 * 10**9) == ()
    waits_ns = follower.place_ns(end_ns + 60 * 10**9)
    assert waits_ns == follower.place_ns(end_ns + 600 * 10**9)
    assert 8.0e9 < waits_ns < 10.1e9  # less than a bar after the end of bar 4


def test_a_correction_says_that_it_is_one() -> None:
    """20 % too slow: the first strokes are judged by the tempo written, then by his own."""
    journey = travel(SCORES["at 120"], [Leg(0, 4, 0.8)], 5, Slips(missing=0.0, extra=0.0, wrong_piece=0.0))
    follower = Follower(journey.score, clocked=False)
    told: set[tuple[str, int | None]] = set()
    corrections = 0
    for stroke in journey.strokes:
        for verdict in follower.hit(stroke.hit, stroke.hit.at_ns):
            of = {("note", verdict.note_index), ("hit", verdict.hit_index)} - {("note", None), ("hit", None)}
            if verdict.label is not Label.PENDING:
                assert verdict.corrects == bool(of & told)
            told = told - of if verdict.label is Label.PENDING else told | of
            corrections += verdict.corrects
    assert corrections > 0


def test_asynchronies_are_real_milliseconds_at_any_tempo_of_the_student() -> None:
    """At 0.8 of the tempo written a stroke comes 40 ms late, which is 32 ms of score time."""
    journey = travel(SCORES["at 120"], [Leg(0, 10, 0.8)], 6, Slips(0.0, 0.0, 0.0, 0.0))
    follower = Follower(journey.score, clocked=False)
    late = len(journey.strokes) - 40
    for i, stroke in enumerate(journey.strokes[: late + 1]):
        at_ns = stroke.hit.at_ns + (40_000_000 if i == late else 0)
        said = follower.hit(stroke.hit, at_ns)
    (verdict,) = [v for v in said if v.hit_index == late]
    assert verdict.asynchrony_ns == pytest.approx(40e6, abs=1e6)
