"""What comes after a result begins with one press, one pad, or two kicks. On an engine by hand."""

from pathlib import Path

from station.app.actions.practice_actions import Begin, Dismiss, TakeStep
from station.app.controller import Controller
from station.app.room_state import Stage
from station.app.sessions.launch import Launch
from station.core.events import Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS, NS_PER_S
from station.drills.library import find_lesson
from station.engine.messages import Play, Started
from station.practice.records.report.next_steps import block_step
from station.practice.session.plan import PlanOptions, plan_practice
from tests.fakes.stations import Line, room, station_on, store_with

PLAN = plan_practice(find_lesson("rock-1"), PlanOptions(tempo_bpm=80.0, loops=4, demonstrations=0))
OVER_NS = NS_PER_S + PLAN.end_ns + 2 * NS_PER_S


def finished(sessions: Path, early_ms: int = 0, **chosen: object) -> tuple[Controller, Line]:
    """A station beside the result of rock 1 at 80, every stroke so much early; its question was not asked."""
    line = Line()
    station = station_on([line], store_with(sessions, ask_first=False, **chosen), Launch(PLAN))
    station.dispatch(Begin())
    line.says.append(Started(NS_PER_S))
    station.update(NS_PER_S + 1)
    zero_ns = NS_PER_S + PLAN.passes_start_ns - early_ms * NS_PER_MS
    for at_ns, piece in zip(PLAN.score.onset_ns.tolist(), PLAN.score.notes["piece"].tolist(), strict=True):
        line.says.append(Hit(zero_ns + at_ns, Piece(piece), Zone.HEAD, 90))
    station.update(OVER_NS)
    assert room(station).stage is Stage.RESULT
    return station, line


def labels(station: Controller) -> list[str]:
    choice = station.view().choice
    return [] if choice is None else [option.label for option in choice.options]


def strike(station: Controller, line: Line, at_ns: int, piece: Piece) -> None:
    line.says.append(Hit(at_ns, piece, Zone.HEAD, 90))
    station.update(at_ns + 1)


def tempo(station: Controller) -> float:
    return station.parts.sessions.practice.session.plan.tempo_bpm


def test_one_press_raises_the_tempo_as_the_page_says(tmp_path: Path) -> None:
    """A rung of rock 1 is 5 % of 110."""
    station, line = finished(tmp_path)
    report = station.view().report
    assert report is not None
    assert labels(station)[:2] == ["Raise the tempo: 86 bpm", "Once more"]
    assert "raise the tempo to 86 bpm" in report.facts.words.advice[0]
    station.dispatch(TakeStep(0))
    assert room(station).stage is Stage.PLAYING
    assert tempo(station) == 86.0
    assert [type(command) for command in line.heard].count(Play) == 2
    assert station.view().selection.tempo_bpm == 86.0, "it stays when the result is left"


def test_bars_that_were_advised_are_played_alone(tmp_path: Path) -> None:
    station, _ = finished(tmp_path, early_ms=45)
    choice = station.view().choice
    assert choice is not None
    assert choice.options[0].why
    again = labels(station).index("Once more")
    station.dispatch(TakeStep(again))
    assert tempo(station) == 80.0


def test_a_pad_chooses_after_silence(tmp_path: Path) -> None:
    """The snare the first, the high tom the second; not before two seconds, nor in a phrase."""
    station, line = finished(tmp_path)
    strike(station, line, OVER_NS + NS_PER_S, Piece.SNARE)
    station.update(OVER_NS + 5 * NS_PER_S)
    assert room(station).stage is Stage.RESULT
    for eighth in range(4):
        strike(station, line, OVER_NS + 8 * NS_PER_S + eighth * NS_PER_S // 4, Piece.SNARE)
    station.update(OVER_NS + 11 * NS_PER_S)
    assert room(station).stage is Stage.RESULT
    strike(station, line, OVER_NS + 12 * NS_PER_S, Piece.TOM_1)
    choice = station.view().choice
    assert choice is not None
    assert choice.meant == 1
    station.update(OVER_NS + 13 * NS_PER_S + 1)
    assert room(station).stage is Stage.PLAYING
    assert tempo(station) == 80.0


def test_two_kicks_take_the_first(tmp_path: Path) -> None:
    station, line = finished(tmp_path)
    for later in (3, 3.5):
        strike(station, line, OVER_NS + round(later * NS_PER_S), Piece.KICK)
    station.update(OVER_NS + 5 * NS_PER_S)
    assert (room(station).stage, tempo(station)) == (Stage.PLAYING, 86.0)


def test_where_the_kit_starts_nothing_no_pad_chooses(tmp_path: Path) -> None:
    station, line = finished(tmp_path, kicks_start=False)
    strike(station, line, OVER_NS + 5 * NS_PER_S, Piece.SNARE)
    station.update(OVER_NS + 9 * NS_PER_S)
    assert room(station).stage is Stage.RESULT
    choice = station.view().choice
    assert choice is not None
    assert not any(option.pads for option in choice.options)


def test_a_block_of_the_day_leads_to_the_next(tmp_path: Path) -> None:
    line = Line()
    station = station_on([line], store_with(tmp_path, ask_first=False), Launch(PLAN))
    station.dispatch(Begin())
    station.parts.sessions.practice.next_block = block_step(3, "Rock 5: sixteenths", "it is new")
    line.says.append(Started(NS_PER_S))
    station.update(NS_PER_S + 1)
    strike(station, line, NS_PER_S + PLAN.passes_start_ns, Piece.KICK)
    station.update(OVER_NS + 60 * NS_PER_S)
    report = station.view().report
    assert report is not None
    assert report.facts.words.advice[0] == "Next block: Rock 5."
    assert labels(station)[0] == "Next block: Rock 5"


def test_there_is_nothing_to_choose_where_no_result_is(tmp_path: Path) -> None:
    station, _ = finished(tmp_path)
    station.dispatch(Dismiss())
    assert labels(station) == []
    station.dispatch(TakeStep(0))
    assert room(station).stage is Stage.IDLE
