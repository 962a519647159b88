"""A tempo that rises every so many bars: in the plan, the click, the judgement, the log and the report."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from station.cli.command_line import main
from station.core.errors import BadInput
from station.core.pieces import Piece
from station.core.settings import Settings
from station.core.units import NS_PER_S
from station.devices.capture.capture import read_capture
from station.drills.library import find_lesson
from station.engine.messages import Bus
from station.music.performance import Performance
from station.practice.headless.virtual_session import practise_virtually
from station.practice.now.tempo_now import tempi_in_words
from station.practice.records.rejudge import judge_again
from station.practice.records.report.session_report import practice_document, report_text
from station.practice.records.report.tempo_report import reached
from station.practice.session.plan import Plan, PlanOptions, plan_practice
from station.practice.session.rising_tempo import Rise, rise_of
from station.scoring.align import align
from station.simulation.student_spec import parse_spec


def plan(rise: str | None = "10/4:120", lesson: str = "rock-1", tempo_bpm: float = 80.0, loops: int = 6) -> Plan:
    """rock-1 is two bars in 4/4, 80 bpm: six passes are twelve bars."""
    asked = None if rise is None else rise_of(rise)
    return plan_practice(find_lesson(lesson), PlanOptions(tempo_bpm, loops, demonstrations=1, rise=asked))


@pytest.mark.parametrize(
    ("text", "rise"),
    [("5/8", Rise(5, 8)), ("+5/8", Rise(5, 8)), ("2.5/1:140", Rise(2.5, 1, 140.0)), ("5/8:92.5", Rise(5, 8, 92.5))],
)
def test_a_rise_as_people_write_it(text: str, rise: Rise) -> None:
    assert rise_of(text) == rise
    assert rise_of(str(rise)) == rise


@pytest.mark.parametrize("text", ["", "5", "5/", "/8", "0/8", "5/0", "-5/8", "51/8", "5/8:", "5/8:x", "5/1001", "٥/8"])
def test_what_is_no_rise(text: str) -> None:
    with pytest.raises(BadInput, match="expected"):
        rise_of(text)


def test_bars_last_as_long_as_their_tempo_says() -> None:
    """Four bars of 16 beats at 80, 90 and 100 bpm: 12, 10.667 and 9.6 s; the first 960/80 and so on."""
    laid = plan()
    tempo_map = laid.score.tempo_map
    starts = tempo_map.ns_at([tempo_map.bar_start(bar) for bar in (0, 4, 8, 12)]) / NS_PER_S
    assert np.diff(starts) == pytest.approx([960 / 80, 960 / 90, 960 / 100], abs=1e-4)
    assert (laid.end_ns - laid.passes_start_ns) / NS_PER_S == pytest.approx(12 + 960 / 90 + 9.6, abs=1e-3)


def test_it_rises_within_a_pass_and_no_further_than_it_should() -> None:
    """Every three bars of two-bar passes: 80 in bars 0-2, 100 in 3-5, and 110, not 120, from bar 6 on."""
    laid = plan("20/3:110")
    tempo_map = laid.score.tempo_map
    bpm = [tempo_map.bpm_at(tempo_map.bar_start(bar)) for bar in range(12)]
    assert bpm == pytest.approx([80] * 3 + [100] * 3 + [110] * 6, abs=1e-3)


def test_the_click_rises_with_it_and_neither_count_in_nor_demonstration_do() -> None:
    laid = plan()
    clicks = laid.cues["at_ns"][laid.cues["bus"] == Bus.CLICK]
    before, passes = clicks[clicks < laid.passes_start_ns], clicks[clicks >= laid.passes_start_ns]
    assert np.diff(before) / NS_PER_S == pytest.approx([0.75] * (len(before) - 1), abs=1e-6)
    waits = [0.75] * 16 + [60 / 90] * 16 + [0.6] * 15
    assert np.diff(passes) / NS_PER_S == pytest.approx(waits, abs=1e-5)


def test_without_a_top_it_goes_to_the_lessons_target_and_counts_the_lessons_beat() -> None:
    """double-paradiddle: its goal is 75 dotted quarters a minute, 112.5 quarters; 90 quarters are 60 of its beats."""
    laid = plan("5/1", "double-paradiddle", tempo_bpm=90.0, loops=8)
    tempi = [step.tempo_bpm for step in laid.steps]
    assert tempi == pytest.approx([90, 97.5, 105, 112.5])
    assert laid.beats_a_minute == pytest.approx(60)


@pytest.mark.parametrize(
    ("rise", "words"), [("5/8", "the lesson's target is 110"), ("5/8:70", "it should rise to is 70")]
)
def test_nothing_to_reach(rise: str, words: str) -> None:
    with pytest.raises(BadInput, match=words):
        plan(rise, tempo_bpm=110.0)


def test_a_tempo_beyond_all_clicks_is_refused() -> None:
    with pytest.raises(BadInput, match="expected 20 to 400"):
        plan("50/1:999", loops=100)


def test_who_follows_no_click_cannot_be_raised() -> None:
    with pytest.raises(BadInput, match="--no-click"):
        plan_practice(find_lesson("rock-1"), PlanOptions(click=None, rise=Rise(5, 8, 100)))


# --- played -----------------------------------------------------------------------------------------------------------


def document(laid: Plan, spec: str = "seed=2,sd_ms=6") -> dict[str, Any]:
    made: dict[str, Any] = practice_document(practise_virtually(laid, parse_spec(spec)).result, Settings())
    return made


def test_a_steady_student_is_judged_by_the_tempo_that_sounds() -> None:
    """Every stroke of such a student is right at every tempo."""
    laid = plan()
    made = document(laid)
    notes_a_bar = len(laid.section) // 2
    rows = made["session"]["tempi"]
    assert [(row["beats_a_minute"], row["bars"]) for row in rows] == [(80, [1, 4]), (90, [5, 8]), (100, [9, 12])]
    assert [row["notes"] for row in rows] == [4 * notes_a_bar] * 3
    assert [row["right"] for row in rows] == [4 * notes_a_bar] * 3
    assert made["session"]["clean_up_to"] == 100
    assert abs(made["timing"]["mean_signed_asynchrony_ms"]) < 3


def test_clean_up_to_the_tempo_before_the_first_that_was_not() -> None:
    """The student stays at 90 bpm where the click goes on to 100: the strokes of bars 9 on fall behind."""
    laid = plan()
    result = practise_virtually(laid, parse_spec("seed=2,sd_ms=6")).result
    hits = result.performance.hits.copy()
    from_ns = laid.score.tempo_map.ns_at(laid.score.tempo_map.bar_start(8))
    last = hits["at_ns"] >= from_ns
    hits["at_ns"][last] = from_ns + (hits["at_ns"][last] - from_ns) * 10 // 9
    played = Performance.from_array(hits, result.performance.chokes)
    slower = replace(result, performance=played, alignment=align(result.score, played, clocked=True))
    made: dict[str, Any] = practice_document(slower, Settings())
    assert made["session"]["clean_up_to"] == 90
    text = report_text(made)
    assert "at 80 bpm and rising to 100 bpm" in text
    assert "Clean up to 90 bpm." in text


def test_the_next_tempo_lies_above_the_last_that_was_clean() -> None:
    """rock-1 goes for 110: who was clean at 80, 90 and 100 is asked for more than 100, not for more than 80."""
    (step,) = (one for one in document(plan("10/4:100"))["session"]["steps"] if one["kind"] == "tempo")
    assert 100 < step["tempo_bpm"] <= 110


def test_practice_goes_on_from_the_fastest_tempo_that_was_clean() -> None:
    """Four strokes nobody asked for at 90 bpm: 80 and 100 were clean, so that 100 goes up, not 80."""
    laid = plan("10/4:110", loops=6)
    result = practise_virtually(laid, parse_spec("seed=2,sd_ms=6")).result
    hits = result.performance.hits
    within = [laid.score.tempo_map.bar_start(bar) + 60 for bar in (4, 5, 6, 7)]
    more = np.repeat(hits[hits["piece"] == Piece.SNARE][:1], 4)
    more["at_ns"] = laid.score.tempo_map.ns_at(within)
    both = np.concatenate([hits, more])
    played = Performance.from_array(both[np.argsort(both["at_ns"])], result.performance.chokes)
    again = replace(result, performance=played, alignment=align(result.score, played, clocked=True))
    made: dict[str, Any] = practice_document(again, Settings())
    session = made["session"]
    assert [(row["clean"], row["extras"]) for row in session["tempi"]] == [(True, 0), (False, 4), (True, 0)]
    assert session["clean_up_to"] == 80
    text = report_text(made)
    assert "Clean up to 80 bpm, and again at 100 bpm." in text
    assert "4 extra" in text
    assert "not clean: " in text
    assert reached(laid, session["tempi"]).tempo_bpm == 100
    assert tempi_in_words(laid, laid.score) == "80 to 100 bpm"


def test_there_is_no_drift_where_the_tempo_was_meant_to_rise() -> None:
    drift = ("drift_pct_per_minute", "drift_ci")
    assert [document(plan())["tempo"][key] for key in drift] == [None, None]
    assert None not in [document(plan(None))["tempo"][key] for key in drift]


def test_a_steady_tempo_has_no_rows() -> None:
    made = document(plan(None))
    assert made["session"]["tempi"] == []
    assert made["session"]["clean_up_to"] is None


def test_the_capture_alone_knows_the_tempi(tmp_path: Path) -> None:
    laid = plan()
    played = practise_virtually(laid, parse_spec("seed=2"), tmp_path / "a.capture").result
    (again,) = judge_again(read_capture(tmp_path / "a.capture"))
    assert again.result().plan.steps == laid.steps
    assert (again.result().alignment.asynchrony_ns == played.alignment.asynchrony_ns).all()


@pytest.mark.parametrize(
    ("more", "words"),
    [(["--adapt"], "follows either the plan or you"), (["--track", "a.wav"], "a track has one tempo")],
)
def test_whatever_else_has_a_say_in_the_tempo_is_refused(
    more: list[str], words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["practice", "rock-1", "--rise", "5/8:100", "--headless", *more]) == 2
    assert words in capsys.readouterr().err
