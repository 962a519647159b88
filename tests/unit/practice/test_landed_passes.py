"""The stroke on which the last loop ends, by hand: a two-bar lesson at 120 bpm, so that a bar lasts two seconds.

A bar of `rock_beat` has 13 strokes; the landing is a crash and a kick.
"""

import csv
import io
from dataclasses import replace
from datetime import date
from pathlib import Path

import pytest

from station.core.pieces import Limb, Piece, Zone
from station.core.settings import Settings
from station.core.units import NS_PER_S
from station.devices.capture.capture import read_capture
from station.drills.lesson import Lesson
from station.engine.messages import Bus
from station.music.judgement import Label
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.practice.headless.virtual_session import practise_adaptively, practise_virtually
from station.practice.records.rejudge import judge_again
from station.practice.records.report.session_pairs import session_pairs_csv
from station.practice.records.report.session_report import practice_document
from station.practice.session.adaptation import Adaptation
from station.practice.session.lesson_places import places_of
from station.practice.session.plan import Phase, PlanOptions, plan_practice
from station.scenes.heat_map import heat_map
from station.scoring.align import align
from station.simulation.student_spec import parse_spec
from station.simulation.virtual_student import play
from tests.fakes.scores import rock_beat

BAR_NS = 2 * NS_PER_S
PER_BAR = 13
STRUCK = [Note(0, Piece.CRASH_1, Zone.EDGE, limb=Limb.RIGHT_HAND), Note(0, Piece.KICK)]
LANDING = Score.from_notes(STRUCK, TempoMap()).notes
LESSON = Lesson(
    name="two-bars",
    title="Two bars",
    score=rock_beat(2),
    loop=(0, 1),
    passes=3,
    count_in_bars=1,
    demonstrations=2,
    landing=LANDING,
)


def test_the_last_pass_and_the_last_demonstration_have_a_bar_more() -> None:
    plan = plan_practice(LESSON, PlanOptions())
    assert [(s.phase, s.index, s.start_ns // BAR_NS, s.end_ns // BAR_NS) for s in plan.segments] == [
        (Phase.COUNT_IN, 0, 0, 1),
        (Phase.DEMONSTRATION, 0, 1, 3),
        (Phase.DEMONSTRATION, 1, 3, 6),
        (Phase.COUNT_IN, 0, 6, 7),
        (Phase.PASS, 0, 7, 9),
        (Phase.PASS, 1, 9, 11),
        (Phase.PASS, 2, 11, 14),
    ]
    assert len(plan.section) == 2 * PER_BAR
    assert len(plan.score) == 3 * 2 * PER_BAR + 2
    assert plan.score.notes["piece"][-2:].tolist() == [Piece.KICK, Piece.CRASH_1]
    assert plan.score.onset_ns[-2:].tolist() == [6 * BAR_NS] * 2
    assert plan.score.notes["limb"][-2:].tolist() == [Limb.RIGHT_FOOT, Limb.RIGHT_HAND]


def test_the_landing_sounds_once_in_the_demonstrations_with_one_click_and_rings() -> None:
    plan = plan_practice(LESSON, PlanOptions())
    sounding = plan.cues[plan.cues["bus"] == Bus.DEMONSTRATION]
    crashes = sounding["at_ns"][sounding["piece"] == Piece.CRASH_1]
    assert crashes.tolist() == [5 * BAR_NS]
    clicks = plan.cues["at_ns"][plan.cues["bus"] == Bus.CLICK]
    assert [at for at in clicks.tolist() if 5 * BAR_NS <= at < 6 * BAR_NS] == [5 * BAR_NS]
    assert [at for at in clicks.tolist() if at >= 13 * BAR_NS] == [13 * BAR_NS]


def test_bars_have_the_lesson_s_numbers_and_the_landing_the_next() -> None:
    plan = plan_practice(LESSON, PlanOptions(loops=2))
    assert plan.bar_names == (0, 1, 0, 1, 2)
    assert plan.practised_bars == (0, 1, 0, 1, 1)
    assert plan.pass_starts == (0, 2)


@pytest.mark.parametrize(("bars", "struck"), [((1, 1), 0), ((2, 2), 2), ((1, 2), 2)])
def test_bars_that_do_not_end_where_the_loop_does_have_no_landing(bars: tuple[int, int], struck: int) -> None:
    plan = plan_practice(LESSON, PlanOptions(bars=bars))
    assert len(plan.score) == 3 * PER_BAR * (bars[1] - bars[0] + 1) + struck


def test_the_landing_is_judged_and_counts_with_the_bar_that_leads_to_it(tmp_path: Path) -> None:
    capture = tmp_path / "take.capture"
    result = practise_virtually(plan_practice(LESSON, PlanOptions()), parse_spec("seed=1"), capture).result
    assert result.complete
    assert result.alignment.note_label.tolist() == [Label.MATCH] * (3 * 2 * PER_BAR + 2)
    document = practice_document(result, Settings())
    bars = document["per_bar"]
    assert isinstance(bars, list)
    counted = [(one["bar"], one["notes"]) for one in bars if isinstance(one, dict)]
    assert counted == [(1, 3 * PER_BAR), (2, 3 * PER_BAR + 2)]
    landed = places_of(result, result.score.notes["tick"][-1:])[["bar", "beat", "place", "pass"]].tolist()
    assert landed == [(2, 5.0, 3.0, 3)]  # as the report counts it: in bar 2, on the beat after its fourth
    rows = list(csv.DictReader(io.StringIO(session_pairs_csv(result))))
    assert [sum(row["bar"] == str(bar) for row in rows) for bar, _ in counted] == [notes for _, notes in counted]
    assert heat_map(result).cells[2, Limb.RIGHT_FOOT].notes == 3 * 2 + 1  # the kick: two strokes a bar
    (again,) = judge_again(read_capture(capture))
    replayed = again.result()
    assert len(replayed.score) == len(result.score)
    assert replayed.alignment.note_label.tolist() == result.alignment.note_label.tolist()
    assert replayed.alignment.asynchrony_ns.tolist() == result.alignment.asynchrony_ns.tolist()
    assert again.plan.bar_names == result.plan.bar_names


def test_who_does_not_land_misses_it() -> None:
    bare = practise_virtually(plan_practice(replace(LESSON, landing=LANDING[:0]), PlanOptions()), parse_spec("seed=1"))
    plan = plan_practice(LESSON, PlanOptions())
    alignment = align(plan.score, bare.result.performance, clocked=True)
    assert alignment.count(Label.MISS) == 2
    assert alignment.count(Label.EXTRA) == 0


def test_practice_that_follows_the_student_lands_at_the_end_of_every_pass() -> None:
    adaptation = Adaptation(LESSON, PlanOptions(loops=3), date(2026, 11, 2))
    result = practise_adaptively(adaptation, parse_spec("seed=1")).result
    crashes = result.score.notes["piece"] == Piece.CRASH_1
    landed = [r for r in adaptation.rounds if r.result.plan.bars[1] == 1]
    assert len(adaptation.rounds) == 3
    assert int(crashes.sum()) == len(landed) > 0
    assert set(result.plan.practised_bars) == {0, 1}


def test_the_lesson_as_written_ends_with_its_landing_where_its_loop_is_the_end() -> None:
    assert LESSON.played_once.bar_count == 3
    assert LESSON.played_once.onset_ns[-1] == 2 * BAR_NS
    assert replace(LESSON, loop=(0, 0)).played_once is LESSON.score


def test_a_virtual_student_slips_nowhere_in_the_bar_that_rings() -> None:
    """The landing's bar has room on every grid line; whoever plays wrong strokes plays them among the written ones."""
    plan = plan_practice(LESSON, PlanOptions())
    student = play(plan.score, parse_spec("seed=3,extra_pct=20"))
    assert student.truth.count(Label.EXTRA) > 5
    beat_ns = BAR_NS // 4
    assert student.performance.hits["at_ns"].max() < plan.score.onset_ns[-1] + beat_ns
