"""The pages of the history behind the window: read beside, newest first, and a database that is not there is said."""

from dataclasses import replace
from datetime import date, datetime, timedelta
from pathlib import Path

import pytest

from station.app.actions.history_actions import Asked, HistorySection, ReadAgain, ShowPages
from station.app.history.history_page import HistoryPage
from station.app.history.history_shown import HistoryPages
from station.app.room_state import Stage
from station.app.settings.settings_store import SettingsStore
from station.practice.progress.overview import WeekMeasure
from station.practice.progress.trends import Measure
from station.store.database_url import sqlite_url
from station.store.opening import history_of
from station.store.rows import FigureRow, KeptSession, Part, SessionKind, SessionRow
from tests.fakes.stations import store_with
from tests.fakes.work_at_once import WorkAtOnce
from tests.fakes.work_later import WorkLater

DAY = date(2026, 11, 27)  # a Friday


class Room:
    """The page of a student, whose history and reader are the test's own."""

    def __init__(self, folder: Path, **chosen: object) -> None:
        url = sqlite_url(folder / "history.sqlite3")
        self.store: SettingsStore = store_with(folder, **{"history": url, "student": "Ada", **chosen})
        self.reader = WorkLater()
        self.page = HistoryPage(self.store, self.reader, WorkAtOnce)

    def keep(self, *sessions: SessionRow, figures: tuple[FigureRow, ...] = ()) -> None:
        for row in sessions:
            history_of(self.store.now).keep(KeptSession(row, figures))

    def shown(self, stage: Stage = Stage.IDLE) -> HistoryPages:
        self.page.advance(DAY, stage)
        self.reader.work()
        self.page.advance(DAY, stage)
        pages = self.page.view().pages
        assert pages is not None
        return pages

    def asked(self, asked: Asked) -> HistoryPages:
        self.page.act(ShowPages(asked))
        return self.shown()


@pytest.fixture
def room(tmp_path: Path) -> Room:
    return Room(tmp_path)


def session(ago: int, hour: int = 17, **others: object) -> SessionRow:
    started = datetime(2026, 11, 27, hour) - timedelta(days=ago)
    values: dict[str, object] = {"lesson": "rock-1", "title": "Rock", "played_s": 600.0, "score": 80.0, "notes": 64}
    values |= {"beats_a_minute": 80.0, "mean_ms": -4.0, "sd_ms": 15.0, "strokes": 60} | others
    return SessionRow("Ada", f"{started:%Y-%m-%dT%H-%M-%S}", started, "", **values)  # type: ignore[arg-type]


def test_nothing_is_read_in_a_frame_and_what_comes_is_shown(room: Room) -> None:
    room.page.advance(DAY, Stage.IDLE)
    assert (room.page.view().pages, room.page.view().reads) == (None, True)
    pages = room.shown()
    assert (pages.sessions, pages.student, pages.streak.weeks) == ((), "Ada", 0)
    assert not room.page.view().reads


def test_sessions_come_the_newest_first_with_days_streak_and_lessons(room: Room) -> None:
    room.keep(
        session(0), session(2), session(4), session(9, lesson="fill", title="Fill"), session(3, kind=SessionKind.TAKE)
    )
    pages = room.shown()
    assert [row.started.day for row in pages.sessions] == [27, 25, 24, 23, 18]
    assert [(each.name, each.title, each.sessions) for each in pages.lessons] == [
        ("rock-1", "Rock", 3),
        ("fill", "Fill", 1),
    ]
    assert pages.days[DAY].minutes == 10.0
    assert (pages.streak.weeks, pages.streak.days, pages.week_s) == (1, 4, 2400.0)
    assert pages.months[0].days == 5
    assert pages.trends is None


def test_it_is_read_again_after_what_was_played_and_not_while_it_is(room: Room) -> None:
    room.shown()
    room.page.advance(DAY, Stage.PLAYING)
    assert room.reader.tasks == []
    room.keep(session(0))
    assert len(room.shown(Stage.RESULT).sessions) == 1
    room.page.advance(DAY, Stage.IDLE)
    assert room.reader.tasks == []
    room.page.look_again()
    room.page.advance(DAY, Stage.IDLE)
    assert len(room.reader.tasks) == 1


def test_trends_are_of_the_last_lesson_until_another_is_asked_for(room: Room) -> None:
    room.keep(*(session(ago) for ago in range(1, 9)), session(20, lesson="fill", title="Fill"))
    asked = Asked(HistorySection.TRENDS)
    trends = room.asked(asked).trends
    assert trends is not None
    assert (trends.lesson, trends.sessions) == ("rock-1", 8)
    assert [trend.measure for trend in trends.trends] == list(Measure)
    other = room.asked(replace(asked, lesson="fill")).trends
    assert other is not None
    assert other.title == "Fill"
    gone = room.asked(replace(asked, lesson="no such lesson")).trends
    assert gone is not None
    assert gone.lesson == "rock-1"


def test_weeks_are_of_what_is_asked(room: Room) -> None:
    left = FigureRow(Part.LIMB, "left_hand", 10, 9, 1, 0, 9, -20.0, 11.0)
    snare = FigureRow(Part.PIECE, "snare", 10, 5, 5, 0, 5, 3.0, 11.0)
    room.keep(session(1), session(8), figures=(left, snare))
    weeks = room.asked(Asked(HistorySection.WEEKS)).weeks
    assert weeks is not None
    assert [(name, [cell and cell.value for cell in cells[-2:]]) for name, cells in weeks.rows] == [
        ("left_hand", [-20.0, -20.0])
    ]
    pieces = room.asked(Asked(HistorySection.WEEKS, part=Part.PIECE, measure=WeekMeasure.HIT)).weeks
    assert pieces is not None
    assert [(name, cells[-1] and cells[-1].value) for name, cells in pieces.rows] == [("snare", 50.0)]
    other = room.asked(Asked(HistorySection.WEEKS, lesson_of_weeks="fill")).weeks
    assert other is not None
    assert other.rows == ()


def test_what_was_asked_and_is_not_begun_is_not_read_any_more(room: Room) -> None:
    room.page.advance(DAY, Stage.IDLE)
    for section in HistorySection:
        room.page.act(ShowPages(Asked(section)))
    assert [future.cancelled() for future, _ in room.reader.tasks] == [True] * 4 + [False]
    room.shown()
    assert room.page.view().asked.section is HistorySection.WEEKS
    assert not room.page.view().reads


def test_a_database_that_is_not_there_is_said_and_found_again(tmp_path: Path) -> None:
    room = Room(tmp_path, history="postgresql://nobody@127.0.0.1:1/none")
    room.page.advance(DAY, Stage.IDLE)
    room.reader.work()
    room.page.advance(DAY, Stage.IDLE)
    view = room.page.view()
    assert view.pages is None
    assert "postgresql" in view.fault
    assert "127.0.0.1" in view.fault
    room.store.update(lambda settings: replace(settings, history=sqlite_url(tmp_path / "here.sqlite3")))
    room.page.act(ReadAgain())
    room.shown()
    assert room.page.view().fault == ""


def test_another_student_sees_nothing_of_the_one_before(room: Room) -> None:
    room.keep(session(0))
    room.shown()
    room.page.act(ShowPages(Asked(HistorySection.TRENDS, lesson="rock-1")))
    room.store.update(lambda settings: replace(settings, student="Bea"))
    room.page.begin_anew()
    assert room.page.view().pages is None
    room.reader.work()
    assert room.page.view().pages is None
    assert (room.shown().sessions, room.page.view().asked) == ((), Asked())
