"""Journeys: what is played is what way, player and hand-written bars say, and the truth is what an ear can hear.

Expected values are counted by hand on rock at 120 bpm, where a beat lasts 0.5 s and bar A is kick on 1 and 3, snare on
2 and 4 and eighths on the hi-hat: 12 strokes, two alike halves.
"""

from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from station.bench.rigs.journeys.journey_music import (
    STYLES,
    families,
    gmd_takes,
    music,
    phrase,
    quantised,
    written_ticks,
)
from station.bench.rigs.journeys.journey_takes import Journey, Player, Take, ar_noise, perform
from station.bench.rigs.journeys.journey_truth import Truth, alike, nearest_pairs
from station.bench.rigs.journeys.journey_ways import Leg, Places
from station.bench.rigs.journeys.journeys import CLICK_KINDS, KINDS, journey
from station.core.pieces import Piece
from station.core.units import NS_PER_S, PPQ
from station.drills.library import find_lesson
from station.music.formats.smf.standard_midi import performance_from_midi, read_midi
from station.music.score import Score

BAR = 4 * PPQ
A_STROKES, B_STROKES = 12, 4 + 5 + 2 + 2 + 3
FLAWLESS = Player(sd_ms=1e-6, missing=0.0, extra=0.0, wrong_piece=0.0)
NOBODY = -1


def rock(form: str = "AAAB") -> Score:
    return phrase("rock", form, 120)


def played(*legs: Leg, player: Player = FLAWLESS, score: Score | None = None, seed: int = 1) -> Take:
    way = Journey("by hand", score or rock(), legs, player, clocked=False, start_s=2.0)
    return perform(np.random.default_rng(seed), way)


def onsets_s(take: Take, piece: Piece) -> list[float]:
    hits = take.performance.hits
    return [round(float(at) / NS_PER_S, 3) for at in hits["at_ns"][hits["piece"] == piece]]


# --- the music --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("style", STYLES)
def test_every_bar_of_a_style_fills_its_meter(style: str) -> None:
    meter = STYLES[style]
    for bar in meter.bars.values():
        grids = {len(line) for line in bar.values()}
        assert grids <= {12, 16}
        assert len(grids) == 1
    assert phrase(style, "AAAB", 90).length_beats == pytest.approx(16 * meter.beats / meter.unit)


def test_a_shuffle_is_written_in_triplets() -> None:
    bar = phrase("shuffle", "A", 100)
    hats = bar.notes["tick"][bar.notes["piece"] == Piece.HIHAT] / PPQ
    assert np.allclose(hats, [0, 2 / 3, 1, 5 / 3, 2, 8 / 3, 3, 11 / 3])


def test_a_beat_is_written_on_the_grid_that_its_strokes_are_near() -> None:
    swung = np.array([0.01, 0.65, 0.98, 1.68])
    straight = np.array([2.02, 2.27, 2.49, 2.76])
    ticks = np.rint(np.concatenate([swung, straight]) * PPQ).astype(np.int64)
    assert np.allclose(written_ticks(ticks) / PPQ, [0, 2 / 3, 1, 5 / 3, 2, 2.25, 2.5, 2.75])


@pytest.mark.parametrize("family", families())
def test_music_lasts_long_enough_to_begin_late_and_is_the_same_again(family: str) -> None:
    once, again = music(family, [3]), music(family, [3])
    assert once.score.length_ns >= 45 * NS_PER_S
    assert once.name == again.name
    assert once.score.notes.tobytes() == again.score.notes.tobytes()


# --- playing ----------------------------------------------------------------------------------------------------------


def test_who_plays_flawlessly_at_double_tempo_takes_half_the_time() -> None:
    take = played(Leg(0, BAR), player=Player(2.0, sd_ms=1e-6, missing=0, extra=0, wrong_piece=0))
    assert onsets_s(take, Piece.SNARE) == [2.25, 2.75]
    assert np.allclose(take.true_ns, take.score.onset_ns[take.meant], atol=1e5)


def test_a_skip_goes_straight_on_and_a_stop_is_silence() -> None:
    skips, stops = played(Leg(0, BAR), Leg(3 * BAR, 4 * BAR)), played(Leg(0, BAR), Leg(0, BAR, wait_s=3.1))
    assert onsets_s(skips, Piece.TOM_1) == [5.5, 5.625]
    assert onsets_s(stops, Piece.SNARE) == [2.5, 3.5, 7.6, 8.6]
    assert sorted(stops.meant.tolist()) == sorted(2 * list(range(A_STROKES)))


def test_a_leg_may_be_slower_than_the_one_before() -> None:
    take = played(Leg(0, 2 * BAR), Leg(0, 2 * BAR, wait_s=2.0, speed=0.8))
    assert np.allclose(np.diff(onsets_s(take, Piece.SNARE)), [1, 1, 1, 0.5 + 2 + 0.625, 1.25, 1.25, 1.25], atol=0.02)


def test_a_ramp_goes_from_slow_to_fast_around_its_speed() -> None:
    ramp = Player(1.0, drift=0.12, ramps=True, sd_ms=1e-6, missing=0, extra=0, wrong_piece=0)
    score = rock("A" * 30)
    waits = np.diff(onsets_s(played(Leg(0, score.end_tick), player=ramp, score=score), Piece.SNARE))
    assert waits[0] == pytest.approx(1 / 0.88, rel=0.01)
    assert waits[-1] == pytest.approx(1 / 1.12, rel=0.01)
    assert np.all(np.diff(waits) < 0)


def test_the_noise_has_the_spread_and_memory_that_it_says() -> None:
    noise = ar_noise(np.random.default_rng(2), 100_000, 15.0)
    assert noise.std() == pytest.approx(15.0, rel=0.02)
    assert np.corrcoef(noise[1:], noise[:-1])[0, 1] == pytest.approx(0.3, abs=0.02)


def test_mistakes_are_as_many_as_asked() -> None:
    score = rock("A" * 200)
    notes = len(score)
    take = played(Leg(0, score.end_tick), player=Player(missing=0.1, extra=0.05, wrong_piece=0.04), score=score)
    wrong = take.performance.hits["piece"] != score.notes["piece"][take.meant]
    assert (take.meant >= 0).sum() == pytest.approx(0.9 * notes, rel=0.03)
    assert (take.meant < 0).sum() == pytest.approx(0.05 * 0.9 * notes, rel=0.3)
    assert np.array_equal(wrong[take.meant >= 0], take.is_wrong[take.meant >= 0])
    assert take.is_wrong.sum() == pytest.approx(0.04 * 0.9 * notes, rel=0.3)


def test_grace_strokes_come_before_their_main_strokes() -> None:
    score = find_lesson("flam").score.repeated(20)
    take = played(Leg(0, score.end_tick), player=Player(sd_ms=20, missing=0, extra=0, wrong_piece=0), score=score)
    is_grace = score.is_grace[take.meant]
    assert is_grace.tolist() == [True, False] * (len(score) // 2)


def test_who_stops_with_a_click_comes_in_on_its_beat() -> None:
    for seed in range(6):
        take = journey("stop_bar_back", seed, clocked=True)
        beat = Places.of(take.score).beat_s
        behind = (take.performance.hits["at_ns"] / NS_PER_S - take.true_ns / NS_PER_S) / beat
        assert np.allclose(behind, np.rint(behind), atol=1e-4)
        assert len(np.unique(np.rint(behind))) == len(take.legs) == 2


@pytest.mark.parametrize("kind", KINDS)
def test_a_journey_is_what_its_kind_says(kind: str) -> None:
    for seed in range(3):
        take = journey(kind, seed)
        first, joins = take.legs[0].first, list(pairwise(take.legs))
        assert all(leg.last > leg.first for leg in take.legs)
        assert all(b.first > a.last for a, b in joins) or not kind.startswith("skip")
        assert all(b.first < a.last for a, b in joins) or kind not in {"repeat", "restart"}
        assert all(1.5 <= b.wait_s <= 6.0 for _, b in joins) or not kind.startswith("stop")
        assert len(take.legs) == (2 if kind in {"skip", "skip_beats", "repeat", "restart"} else len(take.legs))
        if kind == "begin":
            assert take.score.tempo_map.seconds_at(first) >= 12.0


@pytest.mark.skipif("gmd" not in families(), reason="no takes of the dataset here")
def test_a_drummer_s_own_timing_is_that_of_the_file() -> None:
    path, (score, late_s) = next((p, quantised(p)) for p in gmd_takes() if quantised(p)[1] is not None)
    way = Journey("", score, (Leg(0, score.end_tick),), FLAWLESS, clocked=True, start_s=0.0, own_s=late_s)
    hits = perform(np.random.default_rng(1), way).performance.hits
    file_ms = performance_from_midi(read_midi(path)).hits["at_ns"] / 1e6
    off_ms = [float(abs(file_ms - at_ns / 1e6).min()) for at_ns in hits["at_ns"][hits["piece"] == Piece.SNARE]]
    assert np.mean(np.array(off_ms) < 0.01) >= 0.9


# --- the truth --------------------------------------------------------------------------------------------------------


def test_notes_of_bars_and_half_bars_that_are_alike_are_one() -> None:
    score, classes = rock("AAB"), alike(rock("AAB"))
    halves = [classes[(score.notes["tick"] // (BAR // 2)) == half].tolist() for half in range(6)]
    assert halves[0] == halves[1] == halves[2] == halves[3]
    assert len(set(halves[0])) == A_STROKES // 2
    assert not set(halves[0]) & set(halves[4] + halves[5])
    assert len(set(halves[4] + halves[5])) == B_STROKES


def test_f1_is_one_for_the_truth_and_for_bars_that_are_alike() -> None:
    take = played(Leg(0, 4 * BAR))
    truth = Truth(take)
    swapped = np.where(take.meant < A_STROKES, take.meant + A_STROKES, take.meant)
    swapped = np.where((take.meant >= A_STROKES) & (take.meant < 2 * A_STROKES), take.meant - A_STROKES, swapped)
    assert truth.f1(take.meant) == truth.f1(swapped) == 1.0
    assert truth.f1(np.full(len(take.meant), NOBODY)) == 0.0


def test_f1_counts_what_is_lost_and_what_is_false() -> None:
    take = played(Leg(0, 4 * BAR))
    notes = 3 * A_STROKES + B_STROKES
    lost = np.where(take.meant < A_STROKES, NOBODY, take.meant)
    false = take.meant.copy()
    false[-1] = 0
    assert Truth(take).f1(lost) == pytest.approx(2 * (notes - 12) / (2 * (notes - 12) + 12))
    assert Truth(take).f1(false) == pytest.approx(2 * (notes - 1) / (2 * (notes - 1) + 2))


def test_a_note_that_was_played_twice_may_go_to_either_play() -> None:
    take = played(Leg(0, 4 * BAR), Leg(3 * BAR, 4 * BAR, wait_s=2.0))
    first, second = (np.where((take.leg == 1 - leg) & (take.meant >= 3 * A_STROKES), -1, take.meant) for leg in (0, 1))
    assert Truth(take).f1(first) == Truth(take).f1(second) == 1.0


def test_either_reading_of_a_stretch_finds_its_notes() -> None:
    """A C C A B of A C A B: until the kick on step 10 the second C may as well be the A that follows the first."""
    take = played(Leg(0, 2 * BAR), Leg(BAR, 4 * BAR), score=rock("ACAB"))
    ticks = take.score.notes["tick"]
    step = (ticks[take.meant] % BAR) * 16 // BAR
    bar, early = ticks[take.meant] // BAR, step < 10
    again = (take.leg == 1) & (bar == 1)
    at = {(int(n["tick"]), int(n["piece"])): i for i, n in enumerate(take.score.notes)}
    next_bar = [at.get((int(n["tick"]) + BAR, int(n["piece"])), NOBODY) for n in take.score.notes[take.meant]]
    said = np.where(again & early, next_bar, take.meant)
    place = take.true_ns + np.where(again & early, 2 * NS_PER_S, 0)
    said[(again & ~early) | ((bar == 2) & early)] = NOBODY
    assert Truth(take).f1(said, place) == 1.0
    assert Truth(take).f1(take.meant, take.true_ns) == 1.0


def test_who_stops_in_bars_that_are_alike_may_go_on_or_begin_again() -> None:
    """Two bars of A, a stop, two bars of A: the second two are bars 3 and 4, or 1 and 2 once more."""
    take = played(Leg(0, 2 * BAR), Leg(2 * BAR, 4 * BAR, wait_s=2.0), score=rock("AAAA"))
    again = np.where(take.leg == 1, NOBODY, take.meant)
    place = take.true_ns - np.where(take.leg == 1, 4 * NS_PER_S, 0)
    assert Truth(take).f1(again, place) == 1.0
    assert Truth(take).f1(again, take.true_ns) == pytest.approx(2 * 24 / (2 * 24 + 24))


def test_where_the_music_goes_on_alike_nobody_hears_a_turn() -> None:
    unheard = Truth(played(Leg(0, BAR), Leg(2 * BAR, 4 * BAR), score=rock("AAAB")))
    heard = Truth(played(Leg(0, 2 * BAR), Leg(4 * BAR, 8 * BAR), score=rock("ACABACAB")))
    stopped = Truth(played(Leg(0, BAR), Leg(2 * BAR, 4 * BAR, wait_s=2.0), score=rock("AAAB")))
    assert [turn.is_heard for turn in unheard.turns] == [False]
    assert [turn.is_heard for turn in heard.turns] == [True]
    assert [turn.is_heard for turn in stopped.turns] == [True]


def test_a_turn_lies_between_the_last_stroke_and_the_first_that_tell_it() -> None:
    """A A B, then from the first A again: until the kick of C that fails to come, step 10 of 16, it could be C."""
    turn = Truth(played(Leg(0, 3 * BAR), Leg(0, 4 * BAR), score=rock("AABC"))).turns[0]
    assert turn.is_heard
    assert turn.since_ns == pytest.approx((2.0 + 4.0 + 2.0 * 15 / 16) * NS_PER_S, abs=1e3)
    assert turn.until_ns == pytest.approx((2.0 + 6.0 + 2.0 * 10 / 16) * NS_PER_S, abs=1e3)


def test_pairs_are_the_cheapest() -> None:
    """Against the Hungarian method, leaving alone included."""
    rng = np.random.default_rng(4)
    for _ in range(30):
        notes, hits = (np.sort(rng.integers(0, 1_000, rng.integers(1, 8))) for _ in range(2))
        reach = float(rng.integers(20, 300))
        off = (np.subtract.outer(notes, hits) / reach) ** 2
        alone = [np.full((len(side), len(side)), 0.5) for side in (notes, hits)]
        full = np.block([[off, alone[0]], [alone[1], np.zeros((len(hits), len(notes)))]])
        least = full[linear_sum_assignment(full)].sum()
        pairs = nearest_pairs(notes, hits, reach)
        ours = sum(off[pair] for pair in pairs) + 0.5 * (len(notes) + len(hits) - 2 * len(pairs))
        assert ours == pytest.approx(least)


@pytest.mark.parametrize("kind", KINDS)
def test_the_oracle_finds_nearly_all(kind: str) -> None:
    for seed in range(2):
        truth = Truth(journey(kind, seed))
        assert truth.f1(truth.oracle()) > 0.95


def heard_way(take: Take) -> NDArray[np.int64]:
    """A plain listener's way: the bar that each leg's bar was heard as, by its strokes alone and the fewest turns.

    They hear each played bar as the set of its strokes; a fault costs 1, a turn 3; the cheapest way by Viterbi.
    """
    key = take.score.notes["tick"].astype(np.int64) * 32 + take.score.notes["piece"]
    bars = [set((key[take.score.bar == b] % (BAR * 32)).tolist()) for b in range(take.score.bar_count)]
    heard = []
    for i, leg in enumerate(take.legs):
        for start in range(leg.first, leg.last, BAR):
            mine = (take.leg == i) & (take.meant >= 0) & (take.score.bar[take.meant] == start // BAR)
            tick = take.score.notes["tick"][take.meant[mine]].astype(np.int64)
            heard.append(set((tick % BAR * 32 + take.performance.hits["piece"][mine]).tolist()))
    cost = np.array([[len(mine ^ bar) for bar in bars] for mine in heard], float)
    total, back = cost[0].copy(), []
    for row in cost[1:]:
        stay, turn = np.concatenate([[np.inf], total[:-1]]), total.min() + 3
        back.append(np.where(stay <= turn, np.arange(len(bars)) - 1, total.argmin()))
        total = np.minimum(stay, turn) + row
    way = [int(total.argmin())]
    for step in reversed(back):
        way.append(int(step[way[-1]]))
    return np.array(way[::-1])


def test_a_plain_listener_hears_the_way() -> None:
    """What is held to be true can be known: a listener who counts strokes alone pairs nearly all notes rightly."""
    right = []
    for seed in range(40):
        rng = np.random.default_rng(seed)
        score = rock("AACBACAB" * 2)
        legs = [Leg(int(a) * BAR, int(b) * BAR) for a, b in ((rng.integers(0, 4), 8), (rng.integers(0, 12), 16))]
        take = played(*legs, player=Player(), score=score, seed=seed)
        way = iter(heard_way(take))
        said = np.full(len(take.meant), NOBODY)
        key = {(int(n["tick"]), int(n["piece"])): i for i, n in enumerate(score.notes)}
        for i, leg in enumerate(take.legs):
            for bar in range(leg.first // BAR, leg.last // BAR):
                to = next(way)
                for hit in np.flatnonzero((take.leg == i) & (take.right_note >= 0)):
                    note = score.notes[take.meant[hit]]
                    if int(note["tick"]) // BAR == bar:
                        said[hit] = key.get((int(note["tick"]) + (to - bar) * BAR, int(note["piece"])), NOBODY)
        ok = take.right_note >= 0
        right.append(Truth(take).right(said)[ok].mean())
    assert np.mean(np.array(right) > 0.98) >= 0.95


def test_kinds_with_a_click_are_played_at_its_tempo() -> None:
    for kind in CLICK_KINDS:
        take = journey(kind, 1, clocked=True)
        assert take.player.speed == 1.0
        assert take.player.drift == 0.0
