"""A page's facts: faults that were planted come back on the notes, and figures are those of report and strokes."""

import csv
import json
import shutil
import statistics
from pathlib import Path

import pytest

from station.cli.command_line import main
from station.core.errors import BadInput
from station.core.pieces import Piece
from station.core.settings import Settings
from station.core.units import NS_PER_MS
from station.drills.library import find_lesson
from station.practice.records.report.session_report import practice_document
from station.practice.session.plan import PlanOptions, plan_practice
from station.render.report.page.session_page import NoteState, SessionPage
from station.scenes.report.kept_session import OTHER_REPORT, KeptSession, kept_session
from station.scenes.report.note_states import note_passes
from station.scenes.report.page_facts import session_page
from station.scenes.report.practised_section import ELSEWHERE, practised_section, section_notes
from station.scenes.report.session_place import session_place
from tests.unit.scenes.test_heat_map import played

LOOPS = 4


@pytest.fixture(scope="module")
def folders(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Sessions of a virtual student, each in a folder: a groove, ornaments, a tempo that follows, nothing played."""
    top = tmp_path_factory.mktemp("sessions")
    asked = {
        "groove": ("rock-1", "--virtual-student", "beginner,seed=5", "--loops", "6"),
        "flams": ("flam-fill-1", "--virtual-student", "intermediate,seed=2", "--loops", "2"),
        "adapted": ("rock-1", "--virtual-student", "intermediate,seed=3", "--adapt", "--loops", "4"),
        "other": ("rock-1", "--virtual-student", "beginner,seed=6", "--loops", "6"),
    }
    for name, words in asked.items():
        assert main(["practice", *words, "--headless", "--no-pictures", "--report", str(top / name)]) == 0
    return {name: top / name for name in asked}


def page_of(folder: Path) -> SessionPage:
    return session_page(kept_session(session_place(str(folder), Settings()), Settings()), str(folder))


def test_a_planted_fault_stands_on_its_note() -> None:
    plan = plan_practice(find_lesson("rock-1"), PlanOptions(loops=LOOPS, demonstrations=0))
    count = len(plan.section)
    snares = [i for i, note in enumerate(plan.section) if note.piece is Piece.SNARE]
    late, seldom, once = snares[0], snares[1], snares[2]
    rows = {late + count * each: 50.0 for each in range(LOOPS)}
    left_out = {seldom + count * each for each in range(LOOPS - 1)} | {once}
    result = played(plan, rows, left_out).result()
    section = practised_section(plan)
    notes = note_passes(result, section, section_notes(result, section))
    assert [len(notes), notes[late].state, notes[seldom].state, notes[once].state] == [
        count,
        NoteState.LATE,
        NoteState.MISS,
        NoteState.MATCH,
    ]
    assert notes[late].mean_ms == pytest.approx(50.0, abs=0.01)
    assert [(notes[i].played, notes[i].passes) for i in (late, seldom, once)] == [(4, 4), (1, 4), (3, 4)]
    assert notes[late].piece == "snare"
    others = {note.state for i, note in enumerate(notes) if i not in (late, seldom)}
    assert others == {NoteState.MATCH}


def test_a_session_of_some_bars_has_those_alone() -> None:
    plan = plan_practice(find_lesson("flam-fill-1"), PlanOptions(loops=2, bars=(4, 4), demonstrations=0))
    result = played(plan, {}, set()).result()
    section = practised_section(plan)
    of_note = section_notes(result, section)
    landing = len(plan.score) - 2 * len(section)
    assert (of_note == ELSEWHERE).sum() == landing > 0
    assert sorted(of_note[of_note >= 0].tolist()) == sorted([*range(len(section))] * 2)


def test_figures_are_those_of_the_report_and_of_the_strokes(folders: dict[str, Path]) -> None:
    page, folder = page_of(folders["groove"]), folders["groove"]
    report = json.loads((folder / "report.json").read_text())
    with (folder / "pairs.csv").open() as lines:
        rows = list(csv.DictReader(lines))
    off_ms = [1000 * (float(r["hit_time_s"]) - float(r["note_time_s"])) for r in rows if r["label"] == "match"]
    figures = page.timing.figures
    assert sorted(page.timing.asynchrony_ms.tolist()) == pytest.approx(sorted(off_ms), abs=0.002)
    assert (figures.mean_ms, figures.sd_ms) == pytest.approx(
        (statistics.mean(off_ms), statistics.stdev(off_ms)), abs=0.01
    )
    assert figures.mean_ms == report["timing"]["mean_signed_asynchrony_ms"]
    assert list(figures.mean_ci or ()) == report["timing"]["mean_ci_ms"]
    assert figures.sd_ci is not None
    assert figures.sd_ci[0] < report["timing"]["sd_asynchrony_ms"] < figures.sd_ci[1]
    labels = [row["label"] for row in rows]
    assert [page.notes, page.misses, page.wrong, page.extras, page.right] == [
        report["counts"]["notes"],
        labels.count("miss"),
        labels.count("wrong_piece"),
        labels.count("extra"),
        report["right"],
    ]
    assert page.score == report["score"]
    assert page.remarks == ()


def test_bars_have_their_misses_and_extras(folders: dict[str, Path]) -> None:
    folder = folders["groove"]
    with (folder / "pairs.csv").open() as lines:
        rows = list(csv.DictReader(lines))
    for bar in page_of(folder).by_bar:
        here = [row["label"] for row in rows if int(row["bar"]) == bar.bar]
        assert (bar.group.misses, bar.extras) == (here.count("miss"), here.count("extra"))


def test_notes_add_up_to_the_counts(folders: dict[str, Path]) -> None:
    for name in ("groove", "adapted"):
        page = page_of(folders[name])
        notes = page.bars.notes
        assert sum(note.passes for note in notes) == page.notes
        assert sum(note.wrong for note in notes) == page.wrong
        assert sum(note.passes - note.played - note.wrong for note in notes) == page.misses


def test_passes_that_follow_are_laid_over_the_lesson_s_bars(folders: dict[str, Path]) -> None:
    page = page_of(folders["adapted"])
    assert page.bars.section.bar_count == 2
    assert len(page.passes) == 4
    assert all("bpm" in row.tempo for row in page.passes)


def test_the_tempo_is_told_in_the_lesson_s_beat() -> None:
    """A dotted quarter at 50 is a quarter at 75; played 2 % slower, it is kept at 50 / 1.02."""
    plan = plan_practice(find_lesson("six-eight-1"), PlanOptions(loops=2, demonstrations=0))
    start_ms = plan.score.onset_ns[0] / NS_PER_MS
    slower = {row: (ns / NS_PER_MS - start_ms) * 0.02 for row, ns in enumerate(plan.score.onset_ns.tolist())}
    result = played(plan, slower, set()).result()
    kept = KeptSession(result, practice_document(result, Settings()), None, None)
    tempo = session_page(kept, "session").tempo
    assert tempo.asked.tolist() == pytest.approx([50.0])
    assert tempo.asked_s.tolist() == [0.0]
    assert tempo.beats_a_minute.tolist() == pytest.approx([50.0 / 1.02] * 4, rel=0.003)
    assert tempo.end_s == pytest.approx(4 * 2 * 60 / 50)


def test_loudness_is_what_was_struck(folders: dict[str, Path]) -> None:
    folder = folders["flams"]
    with (folder / "pairs.csv").open() as lines:
        rows = [row for row in csv.DictReader(lines) if row["label"] == "match" and row["hit_piece"] == "crash_1"]
    struck = sorted(float(row["hit_velocity"]) for row in rows)
    found = next(row for row in page_of(folder).loudness if row.piece == "crash")
    assert sorted(found.played.tolist()) == pytest.approx(struck, abs=0.001)
    assert found.kind == "accent"


def test_without_a_report_the_capture_is_judged(folders: dict[str, Path], tmp_path: Path) -> None:
    alone = tmp_path / "alone.capture"
    shutil.copy(folders["groove"] / "session.capture", alone)
    page, reported = page_of(alone), page_of(folders["groove"])
    assert page.score == pytest.approx(reported.score, abs=0.001)
    assert "no report of its own" in page.remarks[0]
    assert page.student == "", "a capture does not say whose it is"


def test_a_report_of_another_session_is_not_believed(folders: dict[str, Path], tmp_path: Path) -> None:
    mixed = tmp_path / "mixed"
    shutil.copytree(folders["groove"], mixed)
    shutil.copy(folders["other"] / "report.json", mixed)
    page = page_of(mixed)
    assert page.remarks == (OTHER_REPORT,)
    assert page.score == page_of(folders["groove"]).score


@pytest.mark.parametrize(
    "text",
    ["", "[]", "{", '{"schema": "drum-station/assessment/1"}', "\x00", '{"schema": 1e999}', "[" * 100_000, "\ud800"],
)
def test_a_damaged_report_is_refused_in_one_line(folders: dict[str, Path], tmp_path: Path, text: str) -> None:
    damaged = tmp_path / "damaged"
    shutil.copytree(folders["groove"], damaged)
    (damaged / "report.json").write_bytes(text.encode("utf-8", "surrogatepass"))
    with pytest.raises(BadInput, match="damaged"):
        page_of(damaged)


@pytest.mark.parametrize("key", ["session", "advice", "craft", "per_piece", "tempo", "per_bar", "timing"])
def test_a_report_that_lacks_or_mangles_a_part_is_refused_or_not_believed(
    folders: dict[str, Path], tmp_path: Path, key: str
) -> None:
    damaged, report = tmp_path / "damaged", json.loads((folders["groove"] / "report.json").read_text())
    shutil.copytree(folders["groove"], damaged)
    for value in (None, 7, "text", [], [1], {}, {"": 1}):
        report[key] = value
        (damaged / "report.json").write_text(json.dumps(report))
        try:
            remarks = page_of(damaged).remarks
        except BadInput:
            continue
        assert remarks == (OTHER_REPORT,) or not value, "an empty list may be what was found"


def test_letters_that_nobody_sees_are_no_part_of_a_page(folders: dict[str, Path], tmp_path: Path) -> None:
    named, report = tmp_path / "named", json.loads((folders["groove"] / "report.json").read_text())
    shutil.copytree(folders["groove"], named)
    report["session"]["student"] = "a\u202eb\x1b[31mc"
    (named / "report.json").write_text(json.dumps(report))
    assert page_of(named).student == "a b [31mc"


def test_what_sensors_told_is_said_and_drawn(folders: dict[str, Path], tmp_path: Path) -> None:
    """As tests/unit/practice/test_stick_words.py and docs/report.md have the keys."""
    felt, report = tmp_path / "felt", json.loads((folders["groove"] / "report.json").read_text())
    shutil.copytree(folders["groove"], felt)
    figures = {"strokes": 30, "height_cm": 21.6, "speed_m_s": 4.25, "rebound": 0.5, "clipped_share": 0.0}
    remark = {
        "remark": "uneven_heights",
        "text": "Your left stick rises less.",
        "effect": 1,
        "ci": [0, 2],
        "unit": "cm",
    }
    report["sticks"] = {"hands": {"left_hand": figures}, "remarks": [remark]}
    report["sticking"] = {
        "right": 7,
        "wrong": 1,
        "cannot_tell": 0,
        "wrong_bars": [{"bar": 2, "wrong": 1}],
        "played": {},
    }
    lean = {"sure": True, "strokes": 30, "late_ms": 12.0, "ci": [8.0, 16.0], "sd_ms": 9.0, "late_beats": 0.01}
    report["phase"] = {"locked_share": 0.93, "hands": {"left_hand": {"fault": "hand_behind", **lean}}}
    (felt / "report.json").write_text(json.dumps(report))
    page = page_of(felt)
    (hand,) = page.hands
    told = hand.timing
    assert (hand.name, told.mean_ms, told.mean_ci, told.sd_ms) == ("left hand", 12.0, (8.0, 16.0), 9.0)
    said = {words.heading: words.lines for words in page.lists}
    assert "left hand: 30 strokes, 22 cm high, 4.2 m/s fast" in said["Sticks and motion"]
    assert "Your left stick rises less." in said["Sticks and motion"]
    assert said["Sticks and motion"][0].startswith("Sticking: 7 of 8")
    assert "93%" in said["Phase"][0]


def test_advice_has_its_bars_effect_and_drill_in_words(tmp_path: Path) -> None:
    folder = tmp_path / "late"
    words = ("practice", "rock-1", "--headless", "--virtual-student", "sd_ms=6,fault=late_kick:60", "--loops", "6")
    assert main([*words, "--no-pictures", "--report", str(folder)]) == 0
    page, report = page_of(folder), json.loads((folder / "report.json").read_text())
    advice = report["advice"][0]
    assert advice["fault"] == "late_kick"
    (where, measured, drill) = page.next_steps[0].details
    assert page.next_steps[0].text == report["session"]["next"][0]
    assert where.startswith("Heard in bar")
    low, high = advice["ci"]
    assert measured == f"Measured: +{advice['effect']:.0f} ms (95 %: +{low:.0f} to +{high:.0f})"
    assert drill.startswith("Drill: ")
    assert drill.endswith(f"at {advice['drill']['tempo_bpm']:.0f} bpm, kick alone")


def test_what_is_measured_has_a_sign_where_it_has_a_side_and_counts_are_not_measured(
    folders: dict[str, Path], tmp_path: Path
) -> None:
    told, report = tmp_path / "told", json.loads((folders["groove"] / "report.json").read_text())
    shutil.copytree(folders["groove"], told)
    drill: dict[str, object] = {"bars": None, "tempo_bpm": 68.0, "pieces": []}
    rows = [("left_out_bars", 2.0, [2.0, 2.0]), ("unsteady", 47.1, [41.2, 53.0]), ("missed", 12.0, [8.0, 16.4])]
    report["advice"] = [
        {"fault": fault, "text": fault, "hint": None, "bars": [], "effect": effect, "ci": ci, "drill": drill}
        for fault, effect, ci in rows
    ]
    report["session"]["next"] = [fault for fault, _, _ in rows]
    (told / "report.json").write_text(json.dumps(report))
    assert [step.details[:-1] for step in page_of(told).next_steps] == [
        (),
        ("Measured: 47 ms (95 %: 41 to 53)",),
        ("Measured: 12 % (95 %: 8 to 16)",),
    ]


def test_single_bars_have_intervals_from_five_passes_on(folders: dict[str, Path]) -> None:
    """Six passes of the groove, two of the flams."""
    groove, flams = (page_of(folders[name]).by_bar for name in ("groove", "flams"))
    assert all(bar.group.timing.mean_ci is not None for bar in groove)
    assert {(bar.group.timing.mean_ci, bar.group.timing.sd_ci) for bar in flams} == {(None, None)}
    assert all(bar.group.timing.mean_ms is not None for bar in flams)


def test_strokes_that_were_played_again_are_told(folders: dict[str, Path], tmp_path: Path) -> None:
    again, report = tmp_path / "again", json.loads((folders["groove"] / "report.json").read_text())
    shutil.copytree(folders["groove"], again)
    report["counts"]["played_again"] = 173
    (again / "report.json").write_text(json.dumps(report))
    page = page_of(again)
    assert page.played_again == 173
    assert page.played_again_words == "173 strokes of bars that were played again, which do not count"
    assert page_of(folders["groove"]).played_again == 0
