"""What the rows of journeys count: turns told and turns invented, live words against final ones, by hand."""

import numpy as np
from numpy.typing import NDArray

from station.bench.rigs.journeys.journey_music import phrase
from station.bench.rigs.journeys.journey_takes import Journey, Player, Take, perform
from station.bench.rigs.journeys.journey_truth import Truth
from station.bench.rigs.journeys.journey_ways import Leg
from station.bench.rows.journey_rows import Live, come_by, equal_hits, turns_told
from station.core.units import PPQ
from station.music.judgement import Label
from station.scoring.matching.alignment import Alignment, Reference

BAR = 4 * PPQ
A_STROKES = 12


def take_of(*legs: Leg) -> Take:
    """A flawless take of two bars of rock at 120 bpm, kick, snare and hi-hat, and a fill."""
    flawless = Player(sd_ms=1e-6, missing=0.0, extra=0.0, wrong_piece=0.0)
    way = Journey("by hand", phrase("rock", "AAB", 120), legs, flawless, clocked=False, start_s=1.0)
    return perform(np.random.default_rng(1), way)


def aligned(take: Take, segment: NDArray[np.int64]) -> Alignment:
    """The true pairs, in segments as told."""
    notes, hits = len(take.score), len(take.meant)
    return Alignment(
        hit_of_note=np.full(notes, -1),
        note_of_hit=take.meant,
        note_label=np.zeros(notes, np.uint8),
        hit_label=np.zeros(hits, np.uint8),
        asynchrony_ns=np.zeros(notes, np.int64),
        hit_score_ns=take.true_ns,
        segment=segment,
        reference=Reference.PLAYER,
        sd_ms=None,
    )


def test_a_turn_is_told_where_a_stretch_begins_near_it() -> None:
    take = take_of(Leg(0, BAR), Leg(0, 3 * BAR, wait_s=3.0))
    truth, hits = Truth(take), np.arange(len(take.meant))
    assert turns_told(truth, aligned(take, take.leg)) == (1, 0, 0)
    assert turns_told(truth, aligned(take, np.zeros_like(hits))) == (1, 1, 0)
    assert turns_told(truth, aligned(take, (hits >= 3 * A_STROKES).astype(np.int64))) == (1, 1, 1)


def test_live_and_final_words_agree_where_notes_are_alike() -> None:
    take = take_of(Leg(0, 3 * BAR))
    final = aligned(take, np.zeros(len(take.meant), np.int64))
    bar_later = np.where(take.meant < A_STROKES, take.meant + A_STROKES, take.meant)
    labels = final.hit_label.copy()
    assert equal_hits(Truth(take), Live(final.note_label, labels, bar_later), final) == 1.0
    labels[:7] = Label.EXTRA
    assert equal_hits(Truth(take), Live(final.note_label, labels, bar_later), final) == 1 - 7 / len(labels)
    labels[:7], bar_later[-1] = Label.MATCH, 0
    assert equal_hits(Truth(take), Live(final.note_label, labels, bar_later), final) == 1 - 1 / len(labels)


def test_the_notes_on_the_way_are_those_of_its_legs() -> None:
    take = take_of(Leg(BAR, 2 * BAR), Leg(2 * BAR, 3 * BAR))
    assert np.flatnonzero(come_by(take)).tolist() == list(range(A_STROKES, len(take.score)))
