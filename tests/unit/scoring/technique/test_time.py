"""Limbs together, leans and swing described, the way out of a silent click: planted values, counted by hand."""

import numpy as np
import pytest

from station.core.pieces import Limb, Piece
from station.core.units import NS_PER_S, PPQ
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.practice.session.cues.click_pattern import silences
from station.practice.session.cues.quiet_bars import Gap
from station.scoring.analysis.points import ALL_FREE, Feel
from station.scoring.analysis.summary import SummaryView, summarise
from station.scoring.analysis.technique.click_gaps import gaps
from station.scoring.analysis.technique.feel import leans, swing
from station.scoring.analysis.technique.synchrony import synchrony
from tests.fakes.answers import Played, Take, take
from tests.fakes.scores import even_snare, rock_beat, swing_ride


def kick_and_ride(beats: int) -> Score:
    notes = [Note(i * PPQ, piece) for i in range(beats) for piece in (Piece.KICK, Piece.RIDE)]
    return Score.from_notes(notes, TempoMap.constant(120))


def test_simultaneity_by_hand() -> None:
    """The kick 10 and 14 ms after the ride in turn: apart by 12, SD √(8·4/7)."""
    score = kick_and_ride(8)
    off = np.zeros(16)
    off[score.notes["piece"] == Piece.KICK] = np.tile([10.0, 14.0], 4)
    played = take(score, Played(off_ms=off + 30.0))  # where both stand falls out
    found = synchrony(score, played.alignment)
    assert found is not None
    (pair,) = found.pieces
    assert (pair.first, pair.second, pair.apart_ms.count) == (Piece.KICK, Piece.RIDE, 8)
    assert pair.apart_ms.mean == pytest.approx(12.0)
    assert pair.apart_ms.sd == pytest.approx((32 / 7) ** 0.5)
    assert found.sd_ms.sd == pytest.approx((32 / 7) ** 0.5)
    assert found.limbs == ()


def test_limbs_are_told_where_they_are_known() -> None:
    score = kick_and_ride(8)
    limbs = np.where(score.notes["piece"] == Piece.KICK, Limb.RIGHT_FOOT, Limb.RIGHT_HAND).astype(np.int8)
    score = score.with_limbs(limbs)
    found = synchrony(score, take(score).alignment)
    assert found is not None
    assert [(pair.first, pair.second) for pair in found.limbs] == [(Limb.RIGHT_HAND, Limb.RIGHT_FOOT)]


def test_nothing_is_written_together() -> None:
    score = even_snare(8, 500)
    assert synchrony(score, take(score).alignment) is None


def test_too_few_slots_have_no_interval() -> None:
    score = kick_and_ride(3)
    found = synchrony(score, take(score).alignment)
    assert found is not None
    assert (found.sd_ms.ci, found.pieces[0].apart_ms.ci) == (None, None)


# --- feel -------------------------------------------------------------------------------------------------------------


def laid_back(late_ms: float, bars: int = 16, sd_ms: float = 4.0) -> Take:
    """A rock beat whose snare lies back."""
    score = rock_beat(bars)
    off = np.random.default_rng(3).normal(0, sd_ms, len(score))
    return take(score, Played(off_ms=off + np.where(score.notes["piece"] == Piece.SNARE, late_ms, 0.0)))


def points_of(played: Take, feel: Feel = ALL_FREE) -> float:
    found = summarise(played.score, played.performance, played.alignment, SummaryView(feel=feel)).points
    assert found is not None
    return found


def test_a_laid_back_snare_is_free_up_to_25_ms_and_described() -> None:
    """The same strokes with the snare 20 ms back score alike; 60 ms back, 35 more than free, they do not."""
    straight, back, far = (laid_back(late) for late in (0.0, 20.0, 60.0))
    assert points_of(back) == pytest.approx(points_of(straight), abs=0.2)
    assert points_of(far) < points_of(straight) - 3
    summary = summarise(back.score, back.performance, back.alignment)
    snare = next(lean for lean in leans(summary.habits, ALL_FREE) if lean.piece is Piece.SNARE)
    assert snare.lean_ms == pytest.approx(20.0, abs=4.0)
    assert snare.ci[0] <= 20.0 <= snare.ci[1] + 1.0
    assert snare.free
    assert not any("snare" in advice["text"] for advice in _advice(back))


def _advice(played: Take) -> list[dict[str, str]]:
    from station.scoring.report.advice import advise

    found = advise(summarise(played.score, played.performance, played.alignment))
    return [{"fault": one.fault, "text": one.text} for one in found]


def test_a_lesson_may_ask_for_less() -> None:
    """With 5 ms allowed, 20 ms back stand 15 outside: on the edge of the intermediate window; 40 back cost more."""
    assert points_of(laid_back(24.0), Feel(lean_ms=0.0)) < points_of(laid_back(24.0)) - 2


def swung_at(held: float, bars: int = 16) -> Take:
    """Written 2:1 at 120 bpm, played at `held`:1: the offbeat at held/(1 + held) of 500 ms."""
    score = swing_ride(bars)
    off = np.where(score.notes["tick"] % PPQ > 0, 500.0 * (held / (1 + held) - 2 / 3), 0.0)
    return take(score, Played(off_ms=off + np.random.default_rng(1).normal(0, 3, len(score))))


@pytest.mark.parametrize("held", [1.4, 2.0, 2.6, 3.3])
def test_the_held_swing_is_told_and_free(held: float) -> None:
    played = swung_at(held)
    summary = summarise(played.score, played.performance, played.alignment)
    found = swing(played.score, played.alignment, summary.habits, ALL_FREE)
    assert found is not None
    assert found.written == pytest.approx(2.0, abs=1e-3)
    assert found.held == pytest.approx(held, rel=0.06)
    assert found.ci[0] <= held * 1.03
    assert found.ci[1] >= held * 0.97
    assert found.free
    assert found.sd_ms == pytest.approx(3.0, abs=1.2)
    assert summary.points is not None
    assert summary.points > 99


def test_straight_swing_costs_and_a_goal_may_ask_for_the_written_one() -> None:
    assert points_of(swung_at(1.1)) < points_of(swung_at(2.0)) - 3
    assert points_of(swung_at(3.0), Feel(swing_error=0.4)) < points_of(swung_at(3.0)) - 3
    assert points_of(swung_at(2.3), Feel(swing_error=0.4)) > 99


# --- the silent click -------------------------------------------------------------------------------------------------

BAR_MS = 2000.0


def test_silences_by_hand() -> None:
    """Two bars on, one off, at 120 bpm: silent from 4 to 6 s and from 10 to 12 s; the last one never comes back."""
    tempo_map, s = TempoMap.constant(120), NS_PER_S
    assert silences(tempo_map, 9 * 4 * PPQ, Gap(2, 1)) == ((4 * s, 6 * s), (10 * s, 12 * s))
    assert silences(tempo_map, 9 * 4 * PPQ, None) == ()


def rushing_in_the_dark(bars: int, per_bar_ms: float) -> tuple[Take, tuple[tuple[int, int], ...]]:
    """Quarters; 3 ms late with the click, ahead by `per_bar_ms` more a bar without it, at once home on return + 1."""
    score = even_snare(4 * bars, 500)
    spans = silences(score.tempo_map, score.end_tick, Gap(2, 2))
    off = np.full(4 * bars, 3.0)
    for start, end in spans:
        at = score.onset_ns
        dark = (at > start) & (at <= end)
        off[dark] -= per_bar_ms * (at[dark] - start) / 2e9
    return take(score, Played(off_ms=off)), spans


def test_drift_on_return_by_hand() -> None:
    """9 ms a bar over two bars: 18 ms early on return, 18/4000 = 0.45 % fast; nine returns in 38 bars."""
    played, spans = rushing_in_the_dark(38, 9.0)
    found = gaps(played.score, played.alignment, spans)
    assert found is not None
    assert [r.bar for r in found.returns] == [4, 8, 12, 16, 20, 24, 28, 32, 36]
    assert found.drift_ms.mean == pytest.approx(-18.0)
    assert found.size_ms.mean == pytest.approx(18.0)
    assert found.tempo_pct.mean == pytest.approx(0.45)
    assert found.drift_ms.ci is not None


def test_few_gaps_have_no_interval_and_no_stroke_on_return_no_drift() -> None:
    played, spans = rushing_in_the_dark(10, 9.0)
    found = gaps(played.score, played.alignment, spans)
    assert found is not None
    assert (found.drift_ms.count, found.drift_ms.ci) == (2, None)
    score = played.score
    silent = tuple(
        np.flatnonzero((score.onset_ns >= spans[0][1]) & (score.onset_ns < spans[0][1] + 2 * 10**9)).tolist()
    )
    lost = take(score, Played(left_out=silent))
    found = gaps(score, lost.alignment, spans)
    assert found is not None
    assert (found.returns[0].drift_ms, found.drift_ms.count) == (None, 1)


def test_a_recording_to_the_click_has_its_gaps_and_one_without_has_none() -> None:
    """The same on the file's own time base; at another tempo there was no such click."""
    played, spans = rushing_in_the_dark(22, 9.0)
    recorded = take(played.score, Played(off_ms=(played.alignment.asynchrony_ns / 1e6)), clocked=False)
    found = gaps(played.score, recorded.alignment, spans)
    assert found is not None
    assert found.drift_ms.mean == pytest.approx(-18.0)
    slower = take(played.score, Played(off_ms=0.1 * played.score.onset_ns / 1e6), clocked=False)
    assert gaps(played.score, slower.alignment, spans) is None


@pytest.mark.parametrize("per_bar_ms", [20.0, 50.0])
def test_drifting_far_in_the_dark_loses_no_stroke(per_bar_ms: float) -> None:
    """Three bars of silence: 60 and 150 ms early on return, and back at once, in a groove with 8 ms of noise."""
    score = rock_beat(24)
    spans = silences(score.tempo_map, score.end_tick, Gap(1, 3))
    off, at = np.random.default_rng(1).normal(0, 8, len(score)), score.onset_ns
    for start, end in spans:
        dark = (at > start) & (at <= end)
        off[dark] -= per_bar_ms * (at[dark] - start) / 2e9
    found = gaps(score, take(score, Played(off_ms=off)).alignment, spans)
    assert found is not None
    assert found.drift_ms.count == 5
    assert found.drift_ms.mean == pytest.approx(-3 * per_bar_ms, abs=5.0)


def test_without_a_silent_click_there_is_nothing_to_tell() -> None:
    score = even_snare(16, 500)
    assert gaps(score, take(score).alignment, ()) is None
