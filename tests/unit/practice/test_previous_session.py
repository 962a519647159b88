"""An earlier session of a lesson: found by day, read from its judgements, laid over the bars of another one.

The lesson has two bars of four quarters on the snare, the first pass of which is bar 1; times are counted by hand.
"""

import json
from collections.abc import Sequence
from datetime import date, datetime
from pathlib import Path

import numpy as np
import pytest

from station.core.events import Hit
from station.core.pieces import Articulation, Piece, Zone
from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.drills.lesson import Lesson
from station.engine.messages import Started
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.practice.demonstration.compare_by_ear import previous_bar, previous_tempo
from station.practice.records.previous_session import NONE_KEPT, PreviousSession, day_in_words, find_previous
from station.practice.records.report.session_pairs import SESSION_COLUMNS, session_pairs_csv
from station.practice.session.plan import TAIL_NS, PlanOptions, plan_practice
from station.practice.session.session import Session, SessionResult
from station.scoring.report.pairs_table import COLUMNS
from tests.fakes.known_students import one_student, take_all_in

HEAD = ",".join(COLUMNS + SESSION_COLUMNS)
ROWS = (
    "match,0,0.000000,38,0,0.020000,38,1,1,1,snare,head,normal,90,",
    "miss,1,0.500000,38,,,,1,1,2,,,,,",
    "match,8,4.000000,38,1,3.990000,38,2,1,1,snare,rim,cross_stick,70,",
    "match,9,4.500000,38,2,4.530000,38,2,1,2,snare,head,normal,60,",
    "extra,,,,3,4.750000,42,2,1,2.5,hihat,bow,normal,50.5,0.25",
)
"""Bar 1 in two passes at 120: in the second the first beat 10 ms early, the next 30 ms late, a hi-hat between."""


def kept(student: Path, name: str, rows: Sequence[str] = ROWS, head: str = HEAD, lesson: str = "quarters") -> Path:
    folder = student / name
    folder.mkdir(parents=True)
    (folder / "report.json").write_text(json.dumps({"session": {"lesson": lesson}}))
    (folder / "pairs.csv").write_text("\n".join((head, *rows)) + "\n")
    return folder


NOW = "2026-03-05T18-00-00_quarters"


def found(student: Path) -> PreviousSession | str:
    whose = one_student(student.parent, student.name)
    take_all_in(whose)
    return find_previous(whose, student / NOW, "quarters")


def result(tempo_bpm: float, *late_ms: float) -> SessionResult:
    """One pass over both bars; a stroke a beat, so late, none for NaN."""
    score = Score.from_notes([Note(i * PPQ, Piece.SNARE) for i in range(8)], TempoMap.constant(120))
    lesson = Lesson(name="quarters", title="Quarters", score=score, loop=(0, 1))
    session = Session(plan_practice(lesson, PlanOptions(tempo_bpm=tempo_bpm, demonstrations=0, loops=1)))
    session.handle(Started(0))
    start_ns = session.plan.passes_start_ns
    for beat, late in enumerate(late_ms):
        if not np.isnan(late):
            at_ns = start_ns + round(beat * 60 * NS_PER_S / tempo_bpm + late * NS_PER_MS)
            session.handle(Hit(at_ns, Piece.SNARE, Zone.RIM, 90, Articulation.CROSS_STICK))
    session.advance(session.plan.end_ns + TAIL_NS)
    return session.result()


def test_the_last_session_of_an_earlier_day_is_yesterday(tmp_path: Path) -> None:
    for name in ("2026-03-03T10-00-00_quarters", "2026-03-04T09-00-00_quarters", "2026-03-04T21-30-00_quarters_2"):
        kept(tmp_path, name)
    kept(tmp_path, "2026-03-05T17-00-00_quarters")
    kept(tmp_path, "2026-03-04T22-00-00_quarters-two", lesson="quarters-two")
    kept(tmp_path, "2026-03-06T22-00-00_quarters")
    earlier = found(tmp_path)
    assert isinstance(earlier, PreviousSession)
    assert (earlier.when, earlier.day) == (datetime(2026, 3, 4, 21, 30), "yesterday")


def test_where_there_is_no_earlier_day_it_is_the_one_before(tmp_path: Path) -> None:
    kept(tmp_path, "2026-03-05T16-00-00_quarters")
    kept(tmp_path, "2026-03-05T17-00-00_quarters")
    earlier = found(tmp_path)
    assert isinstance(earlier, PreviousSession)
    assert (earlier.when.hour, earlier.day) == (17, "earlier")


def test_an_old_table_is_passed_over_and_told_of_where_there_is_no_other(tmp_path: Path) -> None:
    kept(tmp_path, "2026-03-04T09-00-00_quarters", rows=(), head=",".join(COLUMNS))
    told = found(tmp_path)
    assert told == "the session of 2026-03-04 was kept before its table had bars and beats: it cannot be shown"
    kept(tmp_path, "2026-03-02T09-00-00_quarters")
    assert isinstance(found(tmp_path), PreviousSession)


@pytest.mark.parametrize(
    "rows",
    [
        ("match,0,x,38,0,0.02,38,1,1,1,snare,head,normal,90,",),
        ("match,0,0,38,0,0,38,1,1,1,gong",),
        ("match,0,0,38,0,nan,38,1,1,1,snare,head,normal,90,",),
        ("match,0,0,38,0,0,38,1,1,1e300,snare,head,normal,90,",),
        ("match,0,0,38,0,0,38,1,1,1,snare,head,normal,900,",),
        ("match,0,0,38,0,0,38,1,1,1,snare,head,normal,0,",),
        ("match,0,0,38,0,0,38,1,1,1,snare,head,normal,90,7",),
    ],
)
def test_a_table_that_cannot_be_read_is_none(tmp_path: Path, rows: Sequence[str]) -> None:
    kept(tmp_path, "2026-03-04T09-00-00_quarters", rows)
    assert isinstance(found(tmp_path), str)


def test_nothing_and_other_people_s_folders_are_none(tmp_path: Path) -> None:
    (tmp_path / "2026-03-04T09-00-00_quarters").mkdir()
    (tmp_path / "my_quarters").mkdir()
    assert found(tmp_path) == NONE_KEPT
    assert find_previous(one_student(tmp_path, "Ann"), tmp_path / "somewhere", "quarters") == NONE_KEPT


def test_its_last_pass_is_laid_over_a_bar_at_another_tempo(tmp_path: Path) -> None:
    """At 60 a beat is a second; the strokes stay 10 ms early and 30 ms late, and the hi-hat halfway."""
    kept(tmp_path, "2026-03-04T09-00-00_quarters")
    earlier = found(tmp_path)
    assert isinstance(earlier, PreviousSession)
    laid = previous_bar(result(60, *[0.0] * 8), 0, earlier)
    hits = [(hit.at_ns, hit.piece, hit.zone, hit.fine_velocity) for hit in laid]
    assert hits == [
        (-10 * NS_PER_MS, Piece.SNARE, Zone.RIM, 70),
        (1030 * NS_PER_MS, Piece.SNARE, Zone.HEAD, 60),
        (1500 * NS_PER_MS, Piece.HIHAT, Zone.BOW, 50.5),
    ]
    assert laid.hits["openness"][2] == 0.25
    assert not earlier.has_bar(2)
    assert len(previous_bar(result(60, *[0.0] * 8), 1, earlier)) == 0


def test_a_session_s_own_table_brings_its_strokes_back(tmp_path: Path) -> None:
    """Every beat of bar 2 as late as it was, the second left out."""
    played = result(120, *[0.0] * 4, 12.0, float("nan"), -8.0, 20.0)
    folder = kept(tmp_path, "2026-03-04T09-00-00_quarters")
    (folder / "pairs.csv").write_text(session_pairs_csv(played))
    earlier = found(tmp_path)
    assert isinstance(earlier, PreviousSession)
    laid = previous_bar(result(240, *[0.0] * 8), 1, earlier)
    at_s = laid.hits["at_ns"] / NS_PER_S
    assert at_s.tolist() == pytest.approx([1.0 + 0.012, 1.5 - 0.008, 1.75 + 0.02], abs=1e-6)
    assert {(hit.zone, hit.articulation) for hit in laid} == {(Zone.RIM, Articulation.CROSS_STICK)}


def test_the_tempo_at_which_it_was_played_is_that_of_its_last_pass(tmp_path: Path) -> None:
    """The second pass of bar 1: its first two beats were due half a second apart, at 120; today's are at 90."""
    kept(tmp_path, "2026-03-04T09-00-00_quarters")
    earlier = found(tmp_path)
    assert isinstance(earlier, PreviousSession)
    assert previous_tempo(result(90.0, *[0.0] * 8), 0, earlier) == pytest.approx(120.0)
    assert previous_tempo(result(90.0, *[0.0] * 8), 1, earlier) is None


def test_days_in_words() -> None:
    today = date(2026, 3, 1)
    assert day_in_words(today, today) == "earlier"
    assert day_in_words(date(2026, 2, 28), today) == "yesterday"
    assert day_in_words(date(2026, 2, 20), today) == "20 Feb"
