"""What the kit swallowed is "cannot tell" and costs nothing; what was left out is a miss; counted by hand."""

from types import MappingProxyType

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Dynamic, Limb, Ornament, Piece
from station.core.units import PPQ
from station.music.judgement import Label
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.scoring.analysis.summary import SummaryView, summarise
from station.scoring.analysis.technique.observability import KitFacts, Swallowed, swallowed_notes
from station.scoring.report.advice import advise
from station.scoring.report.assessment_document import assessment
from tests.fakes.answers import Played, Take, take
from tests.fakes.scores import flams, rock_beat

GHOSTS = tuple(np.flatnonzero(rock_beat(4).notes["dynamic"] == Dynamic.GHOST).tolist())


def kit(**facts: object) -> KitFacts:
    return KitFacts(**facts)  # type: ignore[arg-type] # the tests' own words


def points(played: Take, facts: KitFacts) -> float | None:
    return summarise(played.score, played.performance, played.alignment, SummaryView(kit=facts)).points


def test_ghosts_below_the_measured_threshold_cannot_be_told() -> None:
    """Ghosts are written at 32, four of 52 notes are missing: with a threshold of 40 nothing is lost."""
    played, deaf = take(rock_beat(4), Played(left_out=GHOSTS)), kit(threshold=MappingProxyType({Piece.SNARE: 40}))
    reason = swallowed_notes(played.score, played.performance, played.alignment, deaf)
    assert np.flatnonzero(reason == Swallowed.THRESHOLD).tolist() == list(GHOSTS)
    assert points(played, deaf) == pytest.approx(100)
    assert points(played, KitFacts()) == pytest.approx(100 * 48 / 52)
    document = assessment(summarise(played.score, played.performance, played.alignment, SummaryView(kit=deaf)))
    assert document["counts"]["misses"] == 4  # type: ignore[index,call-overload] # the document's own shape
    assert document["cannot_tell"][0]["count"] == 4  # type: ignore[index,call-overload] # as above


def test_nobody_is_told_that_he_left_out_what_cannot_be_told() -> None:
    """Eight of the snare's 24 strokes are missing: a sentence, unless they are ghosts that the pad swallowed."""
    played = take(rock_beat(8), Played(left_out=tuple(np.flatnonzero(rock_beat(8).notes["velocity"] == 32).tolist())))
    deaf = kit(threshold=MappingProxyType({Piece.SNARE: 40}))
    for facts, said in ((KitFacts(), ["missed"]), (deaf, [])):
        summary = summarise(played.score, played.performance, played.alignment, SummaryView(kit=facts))
        assert [advice.fault for advice in advise(summary)] == said


def test_a_threshold_below_the_ghosts_or_of_another_pad_excuses_nothing() -> None:
    played = take(rock_beat(4), Played(left_out=GHOSTS))
    for piece, least in ((Piece.SNARE, 32), (Piece.KICK, 60)):
        facts = kit(threshold=MappingProxyType({piece: least}))
        assert not swallowed_notes(played.score, played.performance, played.alignment, facts).any()


def test_backbeats_are_never_excused() -> None:
    loud = tuple(np.flatnonzero(rock_beat(4).notes["dynamic"] == Dynamic.ACCENT).tolist())
    played = take(rock_beat(4), Played(left_out=loud))
    facts = kit(threshold=MappingProxyType({Piece.SNARE: 40}))
    assert not swallowed_notes(played.score, played.performance, played.alignment, facts).any()


def diddles(strokes: int = 64) -> Score:
    limbs = (Limb.RIGHT_HAND, Limb.RIGHT_HAND, Limb.LEFT_HAND, Limb.LEFT_HAND)
    notes = [Note(i * PPQ // 8, Piece.SNARE, ornament=Ornament.ROLL, limb=limbs[i % 4]) for i in range(strokes)]
    return Score.from_notes(notes, TempoMap.constant(100))  # 75 ms apart


def through_mask(score: Score, off_ms: NDArray[np.float64], mask_ms: float) -> tuple[Take, list[int]]:
    """What a module sends that hears nothing for `mask_ms` after a stroke, and the rows that it swallowed."""
    at_ms = score.onset_ns / 1e6 + off_ms
    order = np.argsort(at_ms, kind="stable")
    swallowed = order[1:][np.diff(at_ms[order]) < mask_ms].tolist()
    return take(score, Played(off_ms=off_ms, left_out=tuple(swallowed))), sorted(swallowed)


def close_doubles(gap_ms: float) -> NDArray[np.float64]:
    """Second strokes about `gap_ms` after their first (SD 4)."""
    off = np.zeros(64)
    off[1::2] = gap_ms - 75 + np.random.default_rng(2).normal(0, 4, 32)
    return off


def test_second_bounces_within_the_mask_time_cannot_be_told() -> None:
    """Doubles of about 40 ms through a mask of 36: one in six is swallowed, which is no fault of the student's."""
    played, swallowed = through_mask(diddles(), close_doubles(40.0), 36.0)
    assert len(swallowed) >= 3
    reason = swallowed_notes(played.score, played.performance, played.alignment, kit(mask_ms=36.0))
    assert np.flatnonzero(reason == Swallowed.MASK).tolist() == swallowed
    excused, counted = points(played, kit(mask_ms=36.0)), points(played, KitFacts())
    assert excused is not None
    assert counted is not None
    assert counted == pytest.approx(excused * (64 - len(swallowed)) / 64)


def test_second_strokes_far_beyond_any_mask_were_left_out() -> None:
    played = take(diddles(), Played(off_ms=close_doubles(75.0), left_out=(11, 31)))
    assert not swallowed_notes(played.score, played.performance, played.alignment, KitFacts()).any()
    assert points(played, KitFacts()) == pytest.approx(100 * 62 / 64, abs=2)


def test_what_was_heard_apart_can_be_told_apart() -> None:
    """A pad that sent two strokes 12 ms apart has no mask of 35."""
    score = diddles()
    off = np.zeros(64)
    off[1::2] = -37.0
    off[5] = -63.0
    played = take(score, Played(off_ms=off, left_out=(11, 31)))
    assert not swallowed_notes(score, played.performance, played.alignment, kit(mask_ms=35.0)).any()


def test_a_stroke_that_fell_into_its_grace_stroke_cannot_be_told() -> None:
    """Flams of about 9 ms (SD 2) through a mask of 7: the second of two so close is swallowed."""
    score = flams(12)
    near = 21.0 + np.random.default_rng(1).normal(0, 2, len(score))
    played, swallowed = through_mask(score, np.where(score.is_grace, near, 0.0), 7.0)
    assert len(swallowed) >= 3
    reason = swallowed_notes(score, played.performance, played.alignment, kit(mask_ms=7.0))
    lost = np.flatnonzero(played.alignment.note_label == Label.MISS)
    assert np.flatnonzero(reason).tolist() == lost.tolist()
    assert len(lost) == len(swallowed)


def test_flams_of_which_no_grace_stroke_was_ever_heard_are_missed() -> None:
    score = flams(6)
    played = take(score, Played(left_out=tuple(np.flatnonzero(score.is_grace).tolist())))
    assert not swallowed_notes(score, played.performance, played.alignment, KitFacts()).any()
