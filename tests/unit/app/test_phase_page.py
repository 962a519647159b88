"""The phase page: files that are read beside the window, what is heard, and where it is."""

from collections.abc import Callable
from concurrent.futures import Executor, Future
from pathlib import Path
from typing import Any

import pytest

from station.app.actions.phase_actions import ChooseTriggers, OpenMotion, PlayMotion, SeekMotion
from station.app.phase_page import PhasePage
from station.core.errors import BadInput
from station.core.pieces import Piece
from station.core.units import NS_PER_S
from station.engine.messages import Started
from station.practice.session.cues.listening import Listening
from tests.fakes.walker_files import PERIOD_S, write_walker


class AtOnce(Executor):
    """Runs what it is given, and is done."""

    def submit(self, fn: Callable[..., Any], /, *args: object, **kwargs: object) -> Future[Any]:
        done: Future[Any] = Future()
        try:
            done.set_result(fn(*args, **kwargs))
        except Exception as fault:
            done.set_exception(fault)
        return done


class Room:
    """What the page is heard by: one thing at a time."""

    def __init__(self) -> None:
        self.heard: Listening | None = None
        self.page = PhasePage(self.hear, lambda listening: self.heard is listening, self.quiet, AtOnce())

    def hear(self, listening: Listening) -> None:
        self.heard = listening

    def quiet(self) -> None:
        self.heard = None

    def read(self, model: Path, motion: Path) -> None:
        self.page.act(OpenMotion(model, motion))
        assert self.page.view().is_reading
        self.page.advance(0)


@pytest.fixture
def room() -> Room:
    return Room()


@pytest.fixture(scope="module")
def walker(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_walker(tmp_path_factory.mktemp("walker"))


@pytest.fixture
def opened(room: Room, walker: Path) -> Room:
    room.read(walker, walker)
    return room


def test_nothing_is_there_at_first(room: Room) -> None:
    view = room.page.view()
    assert (view.scene, view.plays, view.is_reading) == (None, False, False)


def test_a_motion_is_read_by_its_own_model(opened: Room) -> None:
    view = opened.page.view()
    assert view.scene is not None
    assert (view.motion, view.model, view.at_s) == ("1_01.amc", "1_01.amc", 0.0)
    assert view.scene.trace.thresholds[0][0] == 0.25


def test_what_cannot_be_read_is_said_once_and_leaves_what_was(opened: Room, tmp_path: Path) -> None:
    before = opened.page.view().scene
    with pytest.raises(BadInput, match="no such file"):
        opened.read(tmp_path / "none.toml", tmp_path / "none.amc")
    assert opened.page.view().scene is before
    opened.page.advance(0)


def test_it_is_heard_and_the_place_follows_the_sound(opened: Room) -> None:
    opened.page.act(PlayMotion(on=True))
    heard = opened.heard
    assert heard is not None
    assert {Piece(piece) for piece in heard.cues["piece"]} == {Piece.KICK, Piece.SNARE}
    heard.handle(Started(7 * NS_PER_S))
    opened.page.advance(9 * NS_PER_S)
    assert opened.page.view().at_s == pytest.approx(2.0)
    assert opened.page.view().plays
    opened.page.advance(100 * NS_PER_S)
    assert not opened.page.view().plays
    assert opened.page.view().at_s == pytest.approx(6 * PERIOD_S, abs=0.02)


def test_it_goes_on_from_where_it_stands(opened: Room) -> None:
    opened.page.act(SeekMotion(3.0))
    opened.page.act(PlayMotion(on=True))
    assert opened.heard is not None
    opened.heard.handle(Started(0))
    opened.page.advance(NS_PER_S)
    assert opened.page.view().at_s == pytest.approx(4.0)


def test_who_drags_the_line_stops_the_sound(opened: Room) -> None:
    opened.page.act(PlayMotion(on=True))
    opened.page.act(SeekMotion(1e9))
    assert opened.heard is None
    assert not opened.page.view().plays
    assert opened.page.view().at_s == pytest.approx(6 * PERIOD_S, abs=0.02)


def test_what_begins_elsewhere_ends_it(opened: Room) -> None:
    opened.page.act(PlayMotion(on=True))
    opened.quiet()
    opened.page.advance(0)
    assert not opened.page.view().plays


@pytest.mark.parametrize("act", [lambda page: page.act(PlayMotion(on=True)), lambda page: page.act(SeekMotion(2.0))])
def test_without_a_motion_there_is_nothing_to_do(room: Room, act: Callable[[PhasePage], None]) -> None:
    act(room.page)
    assert room.heard is None
    assert room.page.view().at_s == 0.0


def test_triggers_are_chosen(opened: Room) -> None:
    opened.page.act(ChooseTriggers("run"))
    scene = opened.page.view().scene
    assert scene is not None
    assert [share for share, _ in scene.trace.thresholds] == [0.44, 0.94]
    with pytest.raises(BadInput, match="skip"):
        opened.page.act(ChooseTriggers("skip"))
