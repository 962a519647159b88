"""Music that is brought in: one file after the other, chosen when it is there, told when it is not."""

import time
from pathlib import Path

from station.app.actions.action import Show
from station.app.actions.file_actions import CancelImport, Import
from station.app.actions.practice_actions import Begin
from station.app.child_programs import ChildPrograms
from station.app.controller import Controller
from station.app.importer import Importer
from station.app.music_files.lesson_import import KeptLesson
from station.app.room_state import Stage
from station.app.sessions.launch import Launch
from station.core.units import NS_PER_S
from station.drills.library import find_lesson
from station.practice.session.plan import PlanOptions, plan_practice
from tests.fakes.stations import Line, room, store_with
from tests.fakes.work_at_once import WorkAtOnce

PLAN = plan_practice(find_lesson("rock-1"), PlanOptions(loops=1, demonstrations=0))
TAB = "Title: {title}\nHH|x-x-x-x-|\nSD|----o---|\n"
READ_WITHIN_S = 60.0


def tab(path: Path, title: str) -> str:
    path.write_text(TAB.format(title=title))
    return str(path)


def station_in(folder: Path) -> Controller:
    """A station with all lessons listed, whose work is done at once."""
    line = Line()
    station = Controller(ChildPrograms(lambda: line, work=WorkAtOnce), store_with(folder), Launch(PLAN))
    station.dispatch(Show(catalog=True))
    until = time.monotonic() + READ_WITHIN_S
    while len(station.view().selection.lessons) < 2 and time.monotonic() < until:
        station.update(1)
    return station


def test_an_import_is_listed_among_ones_own_and_chosen(tmp_path: Path) -> None:
    station = station_in(tmp_path)
    station.dispatch(Import(tab(tmp_path / "beat.tab", "My beat")))
    station.update(2)
    station.update(3)
    view = station.view()
    assert view.selection.card is not None
    assert (view.selection.card.name, view.player.lesson.title) == ("beat", "My beat")
    assert [(group.title, [card.title for card in group.cards]) for group in view.selection.groups()[:1]] == [
        ("Your own", ["My beat"])
    ]
    assert isinstance(view.imports.kept, KeptLesson)
    assert view.imports.kept.path == tmp_path / "lessons" / "beat.toml"
    assert "My beat: 1 bar" in view.toast


def test_it_is_there_when_the_station_is_opened_again(tmp_path: Path) -> None:
    first = station_in(tmp_path)
    first.dispatch(Import(tab(tmp_path / "beat.tab", "My beat")))
    first.update(2)
    first.close()
    assert [card.title for card in station_in(tmp_path).view().selection.lessons if not card.kind] == ["My beat"]


def test_a_session_is_not_disturbed_by_what_comes_in(tmp_path: Path) -> None:
    station = station_in(tmp_path)
    station.dispatch(Begin())
    station.dispatch(Import(tab(tmp_path / "beat.tab", "My beat")))
    station.update(NS_PER_S)
    station.update(2 * NS_PER_S)
    assert room(station).stage is Stage.PLAYING
    card = station.view().selection.card
    assert card is not None
    assert card.name == "rock-1"


def test_what_cannot_be_read_is_named_and_the_next_one_comes(tmp_path: Path) -> None:
    station = station_in(tmp_path)
    (tmp_path / "bad.mid").write_bytes(b"no music")
    station.dispatch(Import(str(tmp_path / "bad.mid")))
    station.dispatch(Import(tab(tmp_path / "good.tab", "Good")))
    station.update(2)
    assert "bad.mid" in station.view().imports.fault
    assert "bad.mid" in station.view().toast
    station.update(3)
    assert station.view().imports.fault == ""
    assert station.view().imports.kept is not None


class _Never:
    """Work that nobody sees the end of."""

    begun = 0

    def __init__(self, *_: object) -> None:
        type(self).begun += 1

    def result(self) -> None:
        return None

    def end(self) -> None:
        type(self).begun -= 1


def test_cancelled_nothing_goes_on(tmp_path: Path) -> None:
    imports = Importer(store_with(tmp_path), _Never)  # type: ignore[arg-type] # of any result
    for name in ("a.mid", "b.mid"):
        imports.act(Import(name))
    imports.advance()
    assert (imports.view().source, imports.view().waiting, _Never.begun) == ("a.mid", 1, 1)
    imports.act(CancelImport())
    assert (imports.view().source, imports.view().waiting, _Never.begun) == ("", 0, 0)
    assert imports.advance() is None
    assert _Never.begun == 0


def test_more_files_than_anybody_means_are_not_taken(tmp_path: Path) -> None:
    imports = Importer(store_with(tmp_path), WorkAtOnce)
    said = [imports.act(Import(f"{number}.mid")) for number in range(60)]
    assert said[49] == "reading 49.mid…"
    assert "at once" in said[50]
