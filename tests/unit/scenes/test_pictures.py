"""Whom the picture of a session shows."""

from dataclasses import replace
from pathlib import Path

from station.core.named_view import NamedView
from station.core.units import NS_PER_S, PPQ
from station.drills.lesson import BarCue
from station.drills.library import find_lesson
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import load_figure
from station.motion.style.style import Style
from station.music.drum_part import PartSection
from station.practice.headless.virtual_session import practise_virtually
from station.practice.session.plan import PlanOptions, plan_practice
from station.scenes.demonstrator import Demonstrator
from station.scenes.pictures import directed, drummer_of, picture_of
from station.scenes.score_words import ScoreWords
from station.simulation.student_spec import parse_spec


def test_the_picture_shows_who_demonstrated_in_his_own_style(tmp_path: Path) -> None:
    plan = plan_practice(find_lesson("rock-1"), PlanOptions(loops=2))
    result = practise_virtually(plan, parse_spec("pro,seed=3"), tmp_path / "session.capture").result
    demonstrator = Demonstrator(load_figure("headphones"), replace(Style(), amplitude_gain=80.0))
    drummer = drummer_of(result, demonstrator)
    assert drummer.style.amplitude_gain == 80.0
    assert drummer.figure is demonstrator.figure
    assert drummer.score is result.score


def test_a_film_follows_the_words_and_views_of_the_lesson_s_cues() -> None:
    """rock-1 at 80 beats a minute: a bar lasts three seconds."""
    score = find_lesson("rock-1").score
    drummer, end_s = Drummer(score), score.length_ns / NS_PER_S
    cues = (BarCue(0, camera="hands"), BarCue(1, say="Ghosts low", camera="feet"))
    shown = [directed(picture_of(drummer, at_s), cues) for at_s in (-0.5, 1.0, 4.0, end_s + 0.5)]
    assert [one.view for one in shown] == [NamedView.HANDS, NamedView.HANDS, NamedView.FEET, NamedView.FEET]
    assert [one.hud.say for one in shown] == ["", "", "Ghosts low", ""]


def test_a_film_has_the_sections_of_its_score_and_counts_its_beat() -> None:
    """One answer for window and film: what stands by the notes of a demonstration stands by those of its film."""
    lesson = find_lesson("rock-1")
    words = ScoreWords((PartSection("verse", 0, 0), PartSection("", 1, 1)), 3 * PPQ // 2)
    shown = picture_of(Drummer(lesson.score), 1.0, words)
    assert (shown.bar_numbers.section_of(0), shown.bar_numbers.section_of(1)) == ("verse", "")
    assert shown.beat_ticks == 3 * PPQ // 2
    assert [shown.bar_numbers.of(bar) for bar in range(2)] == [1, 2]
