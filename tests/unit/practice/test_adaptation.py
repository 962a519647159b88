"""Practice that follows the student: passes laid out by the policy, one report over all, determinism.

Expected tempi are the policy's rules counted by hand (docs/mastery.md): 70 %, two clean passes a rung of 5 %, two bad
ones 8 % down; expected counts are the virtual student's own.
"""

from dataclasses import replace
from datetime import date

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.pieces import Piece
from station.core.settings import Settings
from station.drills.library import find_lesson
from station.drills.mastery.feedback_fading import Feedback
from station.drills.mastery.practice_steps import PassKind
from station.music.judgement import Judgement, Label
from station.music.score import NOTE_DTYPE
from station.practice.headless.virtual_session import practise_adaptively
from station.practice.records.report.mastery_report import with_mastery
from station.practice.records.report.session_report import practice_document, report_text, with_truth
from station.practice.records.virtual_practice import VirtualSession
from station.practice.session.adaptation import SILENT_TO_STOP, Adaptation, ScoreRow
from station.practice.session.plan import PlanOptions, plan_practice
from station.practice.session.session import Session
from station.scoring.matching.hit_windows import Level
from station.simulation.student_spec import parse_spec

TODAY = date(2026, 3, 1)
FILL = replace(find_lesson("rock-fill-1"), landing=np.zeros(0, NOTE_DTYPE))
"""Four bars, target 104 bpm; what a landing adds has tests of its own."""


def practised(
    spec: str, options: PlanOptions, adaptation: Adaptation | None = None
) -> tuple[Adaptation, VirtualSession]:
    followed = adaptation or Adaptation(FILL, options, TODAY)
    return followed, practise_adaptively(followed, parse_spec(spec))


def tempi(adaptation: Adaptation) -> list[float]:
    return [round(one.step.tempo_bpm, 1) for one in adaptation.rounds]


def test_clean_passes_climb_as_the_rules_say() -> None:
    adaptation, _ = practised("sd_ms=10,seed=4", PlanOptions(loops=6))
    assert tempi(adaptation) == [72.8, 72.8, 78.0, 78.0, 83.2, 83.2]


def test_bad_passes_come_down_with_a_reason() -> None:
    adaptation, _ = practised("sd_ms=12,miss_pct=40,seed=4", PlanOptions(loops=3))
    played = tempi(adaptation)
    assert played[0] == 72.8
    assert played[-1] < 72.8
    assert "Too much went wrong" in adaptation.rounds[1].step.why


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_the_report_counts_what_the_student_knows_over_all_passes(seed: int) -> None:
    adaptation, virtual = practised(f"sd_ms=12,bias_ms=-8,miss_pct=4,extra_pct=2,seed={seed}", PlanOptions(loops=7))
    told, truth = virtual.result.alignment, virtual.student.truth
    assert len(told.note_label) == len(truth.note_label) == sum(len(one.result.score) for one in adaptation.rounds)
    assert len(told.hit_label) == len(truth.hit_label)
    for label in (Label.MISS, Label.EXTRA, Label.WRONG_PIECE):
        assert abs(told.count(label) - truth.count(label)) <= 2
    document = with_truth(practice_document(virtual.result, Settings()), virtual, Settings())
    known = document["truth"]
    assert isinstance(known, dict)
    for counts in (document["counts"], known["counts"]):
        assert isinstance(counts, dict)
        labelled = [counts[key] for key in ("matched", "misses", "wrong_piece")]
        assert counts["notes"] == sum(one for one in labelled if isinstance(one, int))


def test_the_same_student_has_the_same_session() -> None:
    first, second = (practised("intermediate,seed=5", PlanOptions(loops=5)) for _ in range(2))
    assert [one.step for one in first[0].rounds] == [one.step for one in second[0].rounds]
    assert np.array_equal(first[1].result.performance.hits["at_ns"], second[1].result.performance.hits["at_ns"])


def test_a_tempo_that_was_asked_for_stays() -> None:
    adaptation, _ = practised("sd_ms=10,seed=1", PlanOptions(tempo_bpm=90.0, loops=4))
    assert tempi(adaptation) == [90.0] * 4


def test_bars_that_were_asked_for_are_the_item() -> None:
    adaptation, virtual = practised("sd_ms=10,seed=1", PlanOptions(bars=(3, 4), loops=2))
    assert [one.step.bars for one in adaptation.rounds] == [(2, 3), (2, 3)]
    assert virtual.result.plan.bars == (2, 3)
    assert set(virtual.result.plan.practised_bars) == {2, 3}


def test_wishes_that_cannot_be_are_refused() -> None:
    with pytest.raises(BadInput, match="--loops"):
        Adaptation(FILL, PlanOptions(loops=0), TODAY)


def test_the_demonstration_comes_before_the_first_pass_alone() -> None:
    adaptation = Adaptation(FILL, PlanOptions(loops=3), TODAY)
    assert adaptation.plan.demonstrations_end_ns > 0
    adaptation.record_pass(practised("pro,seed=1", PlanOptions(loops=1))[1].result)
    assert adaptation.plan.demonstrations_end_ns == 0


def test_the_next_session_goes_on_from_what_is_known() -> None:
    first, _ = practised("sd_ms=10,seed=4", PlanOptions(loops=6))
    same_day = Adaptation(FILL, PlanOptions(), TODAY, first.state)
    assert same_day.step.pct == 85.0
    tomorrow = Adaptation(FILL, PlanOptions(), date(2026, 3, 2), first.state)
    assert tomorrow.step.pct == 77.0


def test_a_lesson_that_was_changed_begins_anew() -> None:
    first, _ = practised("sd_ms=10,seed=4", PlanOptions(loops=6))
    other = Adaptation(FILL, PlanOptions(bars=(1, 2)), TODAY, first.state)
    assert other.step.pct == 70.0


def test_silence_ends_it_and_is_not_judged() -> None:
    adaptation, _ = practised("miss_pct=100,seed=1", PlanOptions(loops=8))
    assert len(adaptation.rounds) == SILENT_TO_STOP
    assert adaptation.step.pct == 70.0
    assert adaptation.step.why == "Nothing was played: the same again."


def test_a_pass_that_was_stopped_is_kept_and_not_judged() -> None:
    _, virtual = practised("pro,seed=1", PlanOptions(loops=1))
    stopped = Adaptation(FILL, PlanOptions(loops=4), TODAY)
    step = stopped.step
    stopped.record_pass(replace(virtual.result, complete=False))
    assert stopped.over
    assert stopped.step == step
    assert stopped.rounds[0].measured is None
    assert not stopped.result().complete


def test_a_veto_stays_with_the_last_tempo() -> None:
    adaptation, _ = practised("sd_ms=10,seed=4", PlanOptions(loops=2))
    assert adaptation.step.pct == 75.0
    assert adaptation.veto().pct == 70.0
    assert adaptation.plan.tempo_bpm == pytest.approx(72.8)


def test_passes_in_a_row_lie_apart() -> None:
    """A bar of 4/4 at 84 bpm, as it is written, lasts 2.9 s: one such bar is rest enough. Quarters are whole µs."""
    score = plan_practice(replace(FILL, landing=FILL.landing[:0]), PlanOptions(loops=1)).score
    row = ScoreRow((score, score))
    assert row.start_bars == (0, 5)
    assert row.start_ns[1] == pytest.approx(20 * 60e9 / 84, abs=20 * 500)


def test_bars_of_a_chunk_keep_the_lesson_s_numbers() -> None:
    """A student who breaks one bar gets it alone; its strokes count under the lesson's own bar."""
    adaptation, virtual = practised("sd_ms=30,miss_pct=14,seed=2", PlanOptions(loops=24, level=Level.INTERMEDIATE))
    chunks = [one.step.bars for one in adaptation.rounds if one.step.kind is PassKind.CHUNK]
    assert chunks, "the seed was chosen for its weak bar"
    names = np.array(virtual.result.plan.practised_bars)[virtual.result.score.bar]
    for one, start in zip(adaptation.rounds, adaptation.row().start_bars, strict=True):
        bars = virtual.result.score.bar
        mine = (bars >= start) & (bars < start + one.result.score.bar_count)
        assert set(names[mine]) <= set(range(one.step.bars[0], one.step.bars[1] + 1))


def test_the_report_says_every_pass_and_what_comes_next() -> None:
    adaptation, virtual = practised("sd_ms=10,seed=4", PlanOptions(loops=3))
    document = with_mastery(practice_document(virtual.result, Settings()), adaptation)
    mastery = document["mastery"]
    assert isinstance(mastery, dict)
    passes = mastery["passes"]
    assert isinstance(passes, list)
    assert [one["tempo_bpm"] for one in passes if isinstance(one, dict)] == [72.8, 72.8, 78.0]
    text = report_text(document)
    assert "Clean twice: up to 75 %, 78 bpm." in text
    assert adaptation.step.why in text


@pytest.mark.parametrize(
    ("feedback", "shown"), [(Feedback.TIMING, [9, None]), (Feedback.PADS, [None, None]), (Feedback.NONE, [])]
)
def test_feedback_is_what_the_student_is_shown(feedback: Feedback, shown: list[int | None]) -> None:
    session = Session(plan_practice(FILL, PlanOptions(loops=1)), feedback=feedback)
    verdicts = (Judgement(Label.MATCH, 0, 0, 9), Judgement(Label.MISS, 1, None))
    assert [verdict.asynchrony_ns for verdict in session.shown(verdicts)] == shown


def test_what_is_stable_is_kept_while_the_click_is_silent() -> None:
    """A student without a fault is stable after probes of the target; then passes have gaps, and the report knows."""
    adaptation, virtual = practised("sd_ms=8,seed=4", PlanOptions(loops=20))
    gapped = [one.result.plan.silences for one in adaptation.rounds if one.step.gap is not None]
    assert gapped
    assert all(gapped)
    assert len(virtual.result.plan.silences) == sum(map(len, gapped))
    quiet_ns, _ = virtual.result.plan.silences[0]
    clicks = next(one.result.plan for one in adaptation.rounds if one.step.gap is not None)
    assert clicks.click is not None
    assert clicks.click.gap is not None
    assert clicks.silences[0][0] < quiet_ns


def test_what_is_stable_is_also_played_on_the_other_cymbal() -> None:
    adaptation, virtual = practised("sd_ms=8,seed=4", PlanOptions(loops=24))
    other = [one for one in adaptation.rounds if one.step.reorchestrated]
    assert other
    assert {one.step.pct for one in other} == {100.0}
    assert all((one.result.score.notes["piece"] == Piece.RIDE).any() for one in other)
    assert virtual.result.alignment.count(Label.WRONG_PIECE) == 0
