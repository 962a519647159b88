"""The page Today behind the window: the book is read beside, changes are shown, a block becomes what is chosen."""

from dataclasses import replace
from datetime import date, timedelta
from pathlib import Path

import pytest

from station.app.actions.today_actions import LeaveOutBlock, LookAtDay, PlanDay, Reflect
from station.app.lesson_cards import card
from station.app.room_state import Stage
from station.app.selection import Selection
from station.app.settings.settings_store import SettingsStore
from station.app.today_page import CalendarDay, TodayPage, calendar_weeks
from station.core.settings import Settings, save_settings
from station.drills.daily.daily_items import DailyItem, ItemKind
from station.drills.library import lesson_rows
from station.practice.session.cues.quiet_bars import Gap
from station.practice.session.rising_tempo import Rise
from tests.fakes.work_later import WorkLater

DAY = date(2026, 11, 23)


@pytest.fixture
def reader() -> WorkLater:
    return WorkLater()


@pytest.fixture
def page(tmp_path: Path, reader: WorkLater) -> TodayPage:
    store = SettingsStore(save_settings(Settings(sessions=str(tmp_path)), tmp_path / "settings.toml"))
    return TodayPage(store, pytest.fail, reader)


def shown(page: TodayPage, reader: WorkLater, stage: Stage = Stage.IDLE, day: date = DAY) -> TodayPage:
    page.advance(day, stage)
    reader.work()
    page.advance(day, stage)
    return page


def test_the_plan_comes_when_it_is_read_and_not_before(page: TodayPage, reader: WorkLater) -> None:
    page.advance(DAY, Stage.IDLE)
    assert (page.view().today, page.view().reads) == (None, True)
    view = shown(page, reader).view()
    assert view.today is not None
    assert view.today.kept.minutes == 20
    assert not view.reads
    assert page.block(0) == view.next_item == view.today.kept.items[0]
    assert page.block(99) is None


def test_nothing_is_read_again_until_something_has_changed(page: TodayPage, reader: WorkLater) -> None:
    shown(page, reader)
    page.advance(DAY, Stage.IDLE)
    page.advance(DAY, Stage.PLAYING)
    assert reader.tasks == []
    page.advance(DAY, Stage.RESULT)
    assert len(reader.tasks) == 1
    reader.work()
    page.advance(DAY + timedelta(days=1), Stage.RESULT)
    assert len(reader.tasks) == 1


def test_what_the_user_does_is_kept_and_shown(page: TodayPage, reader: WorkLater) -> None:
    shown(page, reader)
    for action in (PlanDay(30), LeaveOutBlock(0), Reflect("Good"), LookAtDay(DAY - timedelta(days=1))):
        page.act(action)
    view = shown(page, reader).view()
    assert view.today is not None
    kept = view.today.kept
    assert (kept.minutes, kept.left_out, kept.line) == (30, (0,), "Good")
    assert view.next_item == kept.items[1]
    assert view.looked_at is not None
    assert view.looked_at.kept.day == DAY - timedelta(days=1)


def test_the_calendar_has_four_weeks_in_rows_from_monday() -> None:
    """23 November 2026 is a Monday; four weeks before begin on a Tuesday, 27 October."""
    days = [CalendarDay(DAY - timedelta(days=27 - n)) for n in range(28)]
    rows = calendar_weeks(days)
    assert [len(row) for row in rows] == [7] * 5
    assert rows[0][0] is None
    assert rows[0][1] == CalendarDay(date(2026, 10, 27))
    assert rows[4] == (CalendarDay(DAY), *[None] * 6)
    assert calendar_weeks([]) == []


# --- a block as what is chosen


CARDS = tuple(card(row) for row in lesson_rows())


def block(kind: ItemKind, gap: str = "", rise: str = "") -> DailyItem:
    return DailyItem(kind, "double-paradiddle", "T", (0, 1), 70.0, 50.0, "A.", 4, 12, "B.", gap, rise)


def test_a_block_chooses_lesson_bars_tempo_passes_click_and_rise() -> None:
    """double-paradiddle counts dotted quarters: 50 of them a minute are 75 quarters."""
    request = Selection(CARDS).for_block(block(ItemKind.WARM_UP, "4/1", "4/4:60")).request()
    assert request is not None
    assert (request.lesson, request.bars, request.loops, request.tempo_bpm) == ("double-paradiddle", (1, 2), 12, 75.0)
    assert (request.adapt, request.gap, request.rise) == (False, Gap(4, 1), Rise(4, 4, 60.0))


def test_a_block_that_follows_the_student_leaves_tempo_and_click_to_what_is_remembered() -> None:
    request = Selection(CARDS).for_block(block(ItemKind.GO_ON, "4/1")).request()
    assert request is not None
    assert (request.adapt, request.gap, request.rise) == (True, None, None)


def test_just_playing_and_a_lesson_that_is_gone() -> None:
    assert Selection(CARDS).for_block(replace(block(ItemKind.PLAY), lesson="")).free
    empty = Selection()
    assert empty.for_block(block(ItemKind.PLAY)) is empty


def test_another_lesson_has_its_own_tempo_and_a_click_throughout() -> None:
    chosen = Selection(CARDS).for_block(block(ItemKind.WARM_UP, "4/1", "4/4:60")).choose(CARDS[0])
    assert (chosen.gap, chosen.rise, chosen.bars) == (None, None, None)


def test_a_tempo_that_follows_the_student_does_not_rise() -> None:
    chosen = Selection(CARDS).for_block(block(ItemKind.WARM_UP, rise="4/4:60"))
    request = replace(chosen, adapt=True).request()
    assert request is not None
    assert (request.adapt, request.rise) == (True, None)
