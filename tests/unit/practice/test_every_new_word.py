"""A lesson with every word of the format, played by a virtual student and demonstrated: all numbers counted by hand.

Bars as the form plays them: intro twice in 3+2+2/8 (4 hats, snare, 2 kicks: 7 each), A (8 hats, accent, two strokes of
a soft diddle, accent, 3 kicks: 15), A2 with a kick more (16), B in 4/4 (9, 10 and 14 to a beat, a soft flam of 2, and a
kick on every eighth: 43) and in 3/4 (4 soft buzzes, a stroke, a soft drag of 3, 6 kicks: 14). That makes 102.
"""

from datetime import date
from pathlib import Path

import numpy as np
import pytest

from station.cli.command_line import main
from station.core.named_view import NamedView
from station.core.pieces import Limb, Piece
from station.core.settings import Settings
from station.core.units import NS_PER_S
from station.drills.directions import direction_at
from station.drills.library import find_lesson
from station.engine.messages import Bus
from station.motion.drummer import Drummer
from station.motion.style.style import Style
from station.music.judgement import Label
from station.music.tempo_words import tempo_words
from station.practice.headless.virtual_session import practise_adaptively, practise_virtually
from station.practice.records.report.session_report import practice_document
from station.practice.records.virtual_practice import VirtualSession
from station.practice.session.adaptation import Adaptation
from station.practice.session.cues.click_pattern import PLAIN, ClickPattern
from station.practice.session.plan import PlanOptions, plan_practice
from station.scenes.demonstrator import as_taught
from station.simulation.student_spec import parse_spec

FILE = Path(__file__).parents[2] / "fakes" / "every-new-word.toml"
LESSON = find_lesson(str(FILE))
NOTES = [7, 7, 15, 16, 43, 14]
PRO = "pro,seed=3"


@pytest.fixture(scope="module")
def session() -> VirtualSession:
    return practise_virtually(plan_practice(LESSON, PlanOptions()), parse_spec(PRO))


def test_nothing_of_the_lesson_is_a_fault(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["lesson", "check", str(FILE)]) == 0
    assert "no fault" in "".join(capsys.readouterr())


def test_the_form_plays_its_sections_in_their_meters_and_feels() -> None:
    assert [(s.name, s.first_bar, s.last_bar, s.swing.ratio) for s in LESSON.sections] == [
        ("intro", 0, 1, 1.0),
        ("A", 2, 2, 2.0),
        ("A2", 3, 3, 2.0),
        ("B", 4, 5, 1.0),
    ]
    tempo_map = LESSON.score.tempo_map
    meters = [str(tempo_map.meter_at(tempo_map.bar_start(bar))) for bar in range(6)]
    assert meters == ["3+2+2/8", "3+2+2/8", "4/4", "4/4", "4/4", "3/4"]
    assert np.bincount(LESSON.score.bar).tolist() == NOTES


def test_the_count_in_and_the_click_are_felt_in_the_first_meter_s_groups() -> None:
    cues = plan_practice(LESSON, PlanOptions(demonstrations=0)).cues
    clicks = cues[cues["bus"] == Bus.CLICK]
    assert clicks["velocity"][:7].tolist() == [110, 90, 90, 100, 90, 100, 90]
    assert np.diff(clicks["at_ns"][:8]).tolist() == [NS_PER_S // 2] * 7, "eighths at 60 quarters a minute"


def test_the_ritardando_is_one_word() -> None:
    (word,) = tempo_words(LESSON.played_once.tempo_map)
    bar = LESSON.score.tempo_map.bar_start
    assert (word.tick, word.until, word.way) == (bar(4), bar(6), -1)
    assert word.tempo_bpm == pytest.approx(48, abs=0.1)


def test_words_and_views_come_at_their_bars() -> None:
    said = [direction_at(LESSON.cues, bar) for bar in range(6)]
    assert [one.say for one in said] == ["Feel three, two, two"] * 2 + ["Ghosts low"] * 3 + [""]
    assert [one.view for one in said] == [NamedView.HANDS] * 2 + [NamedView.FRONT] * 4
    assert [one.style for one in said] == [None, None, "funk", "funk", "funk", "funk"]


def test_crescendo_and_soft_strokes_are_in_the_velocities() -> None:
    """√(h/6) of p (3 inches) to f (9 inches): 0.71 to 1.22 of the strokes' own 80."""
    hats = LESSON.score.bars(2, 2).notes
    velocity = hats["velocity"][hats["piece"] == Piece.HIHAT].tolist()
    assert velocity[:2] == [57, 57]
    assert velocity[-2:] == [98, 98]
    assert velocity == sorted(velocity)


def test_a_student_who_plays_all_of_it_is_told_so(session: VirtualSession) -> None:
    result = session.result
    assert result.alignment.note_label.tolist() == [Label.MATCH] * (2 * sum(NOTES) + 2)
    assert int((result.score.notes["piece"] == Piece.CRASH_1).sum()) == 1
    document = practice_document(result, Settings())
    bars = document["per_bar"]
    assert isinstance(bars, list)
    told = {one["bar"]: one["notes"] for one in bars if isinstance(one, dict)}
    assert told == {bar: 2 * notes + (2 if bar == 6 else 0) for bar, notes in enumerate(NOTES, 1)}


@pytest.mark.parametrize("click", [PLAIN, None])
def test_without_a_click_it_is_followed_to_its_landing_too(click: ClickPattern | None) -> None:
    result = practise_virtually(plan_practice(LESSON, PlanOptions(click=click, loops=1)), parse_spec(PRO)).result
    assert result.complete
    assert result.alignment.count(Label.MATCH) == sum(NOTES) + 2


def test_practice_that_follows_the_student_lands_in_every_pass() -> None:
    adaptation = Adaptation(LESSON, PlanOptions(loops=2), date(2026, 11, 2))
    result = practise_adaptively(adaptation, parse_spec(PRO)).result
    whole = [one for one in adaptation.rounds if one.result.plan.bars == (0, 5)]
    assert len(whole) == 2
    repeats = sum(one.result.plan.passes for one in whole)
    assert len(result.score) == repeats * sum(NOTES) + 2 * 2
    assert result.alignment.count(Label.MATCH) == len(result.score)


def test_it_is_demonstrated_by_hands_that_can() -> None:
    score = LESSON.played_once
    drummer = Drummer(score, style=as_taught(Style(), LESSON.cues))
    assert drummer.assignment.warnings == ()
    crash = int(np.flatnonzero(score.notes["piece"] == Piece.CRASH_1)[0])
    assert drummer.assignment.limbs[crash] == Limb.RIGHT_HAND
    at_s, tip = score.onset_s[crash], drummer.pose(float(score.onset_s[crash])).tip_m[0]
    assert np.linalg.norm(tip - drummer.pose(float(at_s) - 0.15).tip_m[0]) > 0.05, "it strikes"
