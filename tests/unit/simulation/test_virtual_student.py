"""The virtual student as a whole.

Expected means and SDs are the specification's own. Bounds are four standard errors, which for strokes that correlate by
ρₖ = 0.30·0.62^(k−1) at lag k are SD·√(2.58/n) for a mean and SD·√(1.29/2n) for an SD (1 + 2·Σρₖ and 1 + 2·Σρₖ²), and
with several limbs in a slot n counts the slots.
"""

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.core.units import NS_PER_MS, NS_PER_S
from station.music.judgement import Label
from station.music.score import Score
from station.simulation.student_spec import PLAYERS, parse_spec
from station.simulation.virtual_student import VirtualPerformance, VirtualStudent, play
from tests.fakes import scores

BRIEF = "seed=1,sd_ms=12,bias_ms=-8,miss_pct=3,extra_pct=2"
EVERYTHING = f"{BRIEF},wrong_piece_pct=2,velocity_sd=8,drift_pct=1,fault=late_kick:9"


def _mean_bound(sd_ms: float, slots: int) -> float:
    return 4 * sd_ms * math.sqrt(2.58 / slots)


def _sd_bound(sd_ms: float, slots: int) -> float:
    return 4 * sd_ms * math.sqrt(1.29 / (2 * slots))


def _by_hand(played: VirtualPerformance) -> NDArray[np.float64]:
    """Asynchronies of rightly played main strokes, one by one."""
    found = []
    for hit, note in zip(played.performance.hits, played.truth.note_of_hit, strict=True):
        if note >= 0 and played.truth.note_label[note] == Label.MATCH and played.score.notes["lead_ms"][note] == 0:
            found.append((int(hit["at_ns"]) - int(played.score.onset_ns[note])) / NS_PER_MS)
    return np.array(found)


@pytest.mark.parametrize("seed", range(4))
def test_mean_and_sd_are_as_said(seed: int) -> None:
    score, slots = scores.rock_beat(500), 4500
    asynchrony = play(score, parse_spec(f"seed={seed},sd_ms=12,bias_ms=-8")).asynchrony_ms()
    assert abs(asynchrony.mean() + 8) < _mean_bound(12, slots)
    assert abs(asynchrony.std() - 12) < _sd_bound(12, slots)


def test_the_spread_does_not_depend_on_tempo_or_place() -> None:
    for tempo_bpm in (60.0, 180.0):
        score = scores.rock_beat(400, tempo_bpm)
        asynchrony = play(score, parse_spec("seed=1,sd_ms=20")).asynchrony_ms()
        for part in np.array_split(asynchrony, 3):
            assert abs(part.std() - 20) < 1.6 * _sd_bound(20, 1200)  # sixteenths at 180 correlate more


@pytest.mark.parametrize("name", PLAYERS)
def test_a_named_player_spreads_by_its_share_of_the_interval(name: str) -> None:
    """Strokes 400 ms apart on one drum; the shares are the published ones, see test_student_spec."""
    asynchrony = play(scores.even_snare(4000, 400), parse_spec(f"{name},seed=2,miss_pct=0")).asynchrony_ms()
    expected = PLAYERS[name].sd_interval_pct / 100 * 400
    assert abs(asynchrony.std() - expected) < _sd_bound(expected, 4000)
    assert abs(asynchrony.mean() - PLAYERS[name].bias_ms) < _mean_bound(expected, 4000)


def test_lag_one_is_seen_in_what_is_played() -> None:
    x = play(scores.even_snare(8000, 300), parse_spec("seed=1,sd_ms=15")).asynchrony_ms()
    x = x - x.mean()
    assert abs(float(x[1:] @ x[:-1] / (x @ x)) - 0.30) < 4 * math.sqrt(1.29 / 8000)


def test_limbs_of_a_slot_correlate_and_lean_apart() -> None:
    """Motor noise is 0.32 of the process: apart from leans, kick and hat of a slot correlate by 0.68."""
    score = scores.rock_beat(800)
    spec = parse_spec("seed=6,sd_ms=15")
    played = play(score, spec)
    shift = (played.performance.hits["at_ns"][played.truth.hit_of_note] - score.onset_ns) / NS_PER_MS
    at = {
        p: {int(t): shift[r] for r, t in enumerate(score.notes["tick"]) if score.notes["piece"][r] == p} for p in Piece
    }
    pairs = np.array([(kick, at[Piece.HIHAT][tick]) for tick, kick in at[Piece.KICK].items()])
    assert abs(float(np.corrcoef(pairs.T)[0, 1]) - 0.68) < 4 * (1 - 0.68**2) / math.sqrt(len(pairs)) * 1.3
    assert abs(float((pairs[:, 0] - pairs[:, 1]).mean())) > 4 * 15 * math.sqrt(0.64 / len(pairs))


def test_drift_sways_the_tempo() -> None:
    """After 30 s at 3 % the playing is 0.03·60/π = 0.573 s ahead, and after 60 s on the click again."""
    score = scores.even_snare(241, 250)
    asynchrony = play(score, parse_spec("drift_pct=3")).asynchrony_ms()
    assert asynchrony[120] == pytest.approx(-573.0, abs=0.1)
    assert asynchrony[240] == pytest.approx(0.0, abs=0.1)


def test_drift_goes_on_in_the_next_score() -> None:
    spec, half = parse_spec("drift_pct=3"), scores.even_snare(120, 250)
    student = VirtualStudent(spec)
    student.play(half)
    assert student.play(half).asynchrony_ms()[0] == pytest.approx(-573.0, abs=0.1)


def test_one_seed_is_one_playing() -> None:
    score, spec = scores.beat_and_fill(5), parse_spec(EVERYTHING)
    one, two = play(score, spec), play(score, spec)
    assert one.performance.hits.tobytes() == two.performance.hits.tobytes()
    assert one.midi == two.midi
    assert one.truth_document() == two.truth_document()
    other = play(score, parse_spec(EVERYTHING.replace("seed=1", "seed=2")))
    assert other.performance.hits.tobytes() != one.performance.hits.tobytes()


def test_what_is_missed_does_not_change_the_timing() -> None:
    score = scores.rock_beat(50)
    clean, slipping = (play(score, parse_spec(f"seed=9,sd_ms=5{more}")) for more in ("", ",miss_pct=10,extra_pct=10"))
    rows = slipping.truth.note_label == Label.MATCH
    at = [p.performance.hits["at_ns"][p.truth.hit_of_note[rows]] for p in (clean, slipping)]
    assert (at[0] == at[1]).all()


def test_velocity_scatters_about_what_is_written() -> None:
    velocities = play(scores.even_snare(4000, 300), parse_spec("seed=1,velocity_sd=9")).performance.hits["velocity"]
    assert abs(velocities.mean() - 80) < 4 * 9 / math.sqrt(4000)
    assert abs(velocities.std() - 9) < 4 * 9 / math.sqrt(8000)


def test_a_named_player_scatters_in_proportion() -> None:
    """HUMANS, "Velocity": professionals 6–10 %, amateurs 12–15, novices 20–30."""
    for name, low, high in (("pro", 6, 10), ("intermediate", 12, 15), ("beginner", 20, 30)):
        velocities = play(scores.even_snare(4000, 300), parse_spec(f"{name},miss_pct=0,extra_pct=0")).performance.hits
        variation = 100 * velocities["velocity"].std() / velocities["velocity"].mean()
        assert 0.95 * low < variation < 1.05 * high, name


def test_strokes_of_a_piece_never_overtake_each_other() -> None:
    score = scores.double_strokes(50, tempo_bpm=200)  # 75 ms apart
    played = play(score, parse_spec("seed=1,sd_ms=80"))
    assert (np.diff(played.truth.hit_of_note) > 0).all()


def test_grace_strokes_keep_their_lead_with_a_spread_of_their_own() -> None:
    played = play(scores.flams(500), parse_spec("seed=1,sd_ms=15,bias_ms=20"))
    at_ns = played.performance.hits["at_ns"][played.truth.hit_of_note].reshape(-1, 2)
    leads = (at_ns[:, 1] - at_ns[:, 0]) / NS_PER_MS
    assert abs(leads.mean() - 30) < 4 * 4.5 / math.sqrt(len(leads))
    assert abs(leads.std() - 4.5) < 4 * 4.5 / math.sqrt(2 * len(leads))  # 0.3 · 15
    assert len(played.asynchrony_ms()) == len(leads)


def test_the_truth_is_a_matching() -> None:
    score = scores.beat_and_fill(40)
    played = play(score, parse_spec(EVERYTHING))
    truth, hits = played.truth, played.performance.hits
    for note, hit in enumerate(truth.hit_of_note):
        assert (hit < 0) == (truth.note_label[note] == Label.MISS)
        if hit >= 0:
            assert truth.note_of_hit[hit] == note
            assert truth.hit_label[hit] == truth.note_label[note]
            same = hits["piece"][hit] == score.notes["piece"][note]
            assert same == (truth.note_label[note] == Label.MATCH)
    assert ((truth.note_of_hit < 0) == (truth.hit_label == Label.EXTRA)).all()
    assert (np.diff(hits["at_ns"]) >= 0).all()


def test_the_truth_document_adds_up() -> None:
    played = play(scores.flams(60), parse_spec(EVERYTHING))
    document: Any = played.truth_document()
    counts, timing = document["counts"], document["timing"]
    assert counts["notes"] == counts["matched"] + counts["misses"] + counts["wrong_piece"] == 480
    assert counts["hits"] == counts["matched"] + counts["extras"] + counts["wrong_piece"] + counts["ignored"]
    assert counts["hits"] == sum(data[0] == 0x99 for _, data in played.midi)
    expected = _by_hand(played)
    assert timing["mean_signed_asynchrony_ms"] == pytest.approx(expected.mean())
    assert timing["sd_asynchrony_ms"] == pytest.approx(expected.std(ddof=1))
    assert parse_spec(str(document["spec"])) == parse_spec(EVERYTHING)


def test_no_data_is_none() -> None:
    silent = play(scores.rock_beat(1), parse_spec("miss_pct=100")).truth_document()
    assert silent["timing"] == {"mean_signed_asynchrony_ms": None, "sd_asynchrony_ms": None}


def test_scores_in_a_row_do_not_repeat_the_same_playing() -> None:
    student, score = VirtualStudent(parse_spec(BRIEF)), scores.rock_beat(4)
    first, second = student.play(score), student.play(score)
    assert first.performance.hits.tobytes() != second.performance.hits.tobytes()


def test_early_strokes_may_come_before_the_score() -> None:
    assert play(scores.rock_beat(1), parse_spec("bias_ms=-20")).performance.hits["at_ns"][0] == -20 * NS_PER_MS


def test_long_scores_are_played_in_reasonable_memory_and_order() -> None:
    score: Score = scores.rock_beat(1500)
    played = play(score, parse_spec(BRIEF))
    assert len(score) == 19_500
    assert played.performance.hits["at_ns"][-1] - score.length_ns + NS_PER_S > 0
