"""The battle behind the window: chosen by pads, played beside nothing else, kept however it ends."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from station.app.actions.action import Show
from station.app.actions.battle_actions import (
    BeginBattle,
    ChooseBattle,
    CloseBattle,
    JudgeBattle,
    OpenBattle,
    PractiseFailed,
    ReplayBest,
    TurnLeaf,
)
from station.app.actions.editor_actions import NewLesson
from station.app.actions.exam_actions import BeginExam
from station.app.actions.practice_actions import Begin, Dismiss, EndSession, Leave, Pause
from station.app.actions.settings_actions import PlayAs
from station.app.battle.battle_shown import BattleShown, BattleStage
from station.app.controller import Controller
from station.app.room_state import Stage
from station.app.sessions.launch import Launch
from station.app.settings.chosen_battle import ChosenBattle, People, chosen_rules
from station.cli.battling.battle_options import BattleOptions, battle_rules
from station.cli.battling.battle_video import FilmOptions
from station.cli.battling.network_options import NetworkOptions
from station.cli.options.sound_options import SoundOptions
from station.core.events import DeviceFound, Hit
from station.core.pieces import Piece, Zone
from station.core.settings import Settings
from station.core.units import NS_PER_S
from station.drills.library import find_lesson
from station.engine.messages import AddCues, Play, RecordCapture, Started
from station.practice.battle.battle_rules import BattleMode
from station.practice.battle.records.earlier_rounds import after_earlier
from station.practice.battle.turn_plan import TurnKind
from station.practice.records.memory import LevelMemory
from station.practice.session.cues.click_pattern import PLAIN
from station.practice.session.plan import PlanOptions, plan_practice
from station.scoring.matching.hit_windows import Level
from tests.fakes.known_students import one_student
from tests.fakes.stations import Line, station_on, store_with

PLAN = plan_practice(find_lesson("rock-1"), PlanOptions(loops=1, demonstrations=0))
SHORT = ChosenBattle(rounds=1, lives=1, seed=1)
FRAME_NS = NS_PER_S // 10


@pytest.fixture
def line() -> Line:
    return Line()


@pytest.fixture
def station(line: Line, tmp_path: Path) -> Controller:
    station = station_on([line], store_with(tmp_path), Launch(PLAN))
    station.dispatch(Show(picture=False))
    station.update(1)
    station.dispatch(OpenBattle())
    return station


def shown(station: Controller) -> BattleShown:
    return station.view().battle


def kept(sessions: Path) -> list[Path]:
    return list(sessions.rglob("battle.json"))


def begun(line: Line, station: Controller, chosen: ChosenBattle = SHORT) -> None:
    """The battle's count-in begins to sound at one second."""
    station.dispatch(ChooseBattle(chosen))
    station.dispatch(BeginBattle())
    starts(line, station)


def starts(line: Line, station: Controller) -> None:
    """The stage is drawn, then the transport starts."""
    for frame in range(2):
        assert not [one for one in line.heard if isinstance(one, Play)], "no count-in goes by unseen"
        station.update(2 + frame)
    line.says.append(Started(NS_PER_S))
    station.update(NS_PER_S + 1)


def strikes(line: Line, station: Controller, piece: Piece = Piece.CRASH_1) -> None:
    """Somebody strikes once, in the first bars."""
    line.says.append(Hit(6 * NS_PER_S, piece, Zone.EDGE, 100))
    station.update(6 * NS_PER_S)


def over(line: Line, station: Controller, plays: bool) -> None:
    """Frame by frame to the result; whoever `plays` strikes every note of a phrase at its time."""
    at_ns, answered = NS_PER_S + 1, -1
    while station.view().room.stage is Stage.PLAYING:
        battle = station.parts.sessions.practice.battle
        assert battle is not None
        view, rules = battle.view(), battle.rules
        for turn in view.turns:
            if plays and turn.kind is TurnKind.ANSWER and turn.index > answered:
                answered = turn.index
                assert turn.phrase is not None
                zero_ns = NS_PER_S + rules.ground.ns_of_bars(rules.count_in_bars) + turn.start_ns
                score = turn.phrase.score
                line.says += [
                    Hit(zero_ns + onset_ns, Piece(note["piece"]), Zone(note["zone"]), int(note["velocity"]))
                    for note, onset_ns in zip(score.notes, score.onset_ns.tolist(), strict=True)
                ]
        at_ns += FRAME_NS
        station.update(at_ns)
        assert at_ns < 300 * NS_PER_S, "it ends"


def test_the_first_leaf_begins_and_turns_mode_and_drummer(station: Controller) -> None:
    choice = station.view().choice
    assert choice is not None
    assert [option.label for option in choice.options] == [
        "Begin",
        "What: Repeat",
        "Against: The steady one",
        "More",
    ]
    assert len({option.pads for option in choice.options}) == 4, "a pad each"
    station.dispatch(choice.options[1].action)
    assert shown(station).setup.mode is BattleMode.IMPROVISE


def test_pads_reach_every_line_of_the_setup(station: Controller) -> None:
    seen: set[str] = set()
    for _ in range(12):
        choice = station.view().choice
        assert choice is not None
        seen |= {option.label.partition(":")[0] for option in choice.options}
        station.dispatch(TurnLeaf())
    assert {"What", "Against", "Tempo", "Rounds", "To win a round", "Who", "Meter", "Feel", "Style", "Click"} <= seen


def test_another_drummer_brings_their_own_ground(station: Controller) -> None:
    station.dispatch(ChooseBattle(shown(station).setup.against("jazz")))
    assert shown(station).setup.ground.tempo_bpm == 132
    assert shown(station).setup.ground.style == "jazz"


def test_two_kits_need_two(line: Line, station: Controller) -> None:
    station.dispatch(ChooseBattle(replace(SHORT, people=People.TWO_KITS, friend="Bo")))
    assert "none is here" in shown(station).fault
    line.says += [DeviceFound(1, "one kit"), DeviceFound(2, "another kit")]
    station.update(2)
    assert shown(station).fault == ""
    begun(line, station, shown(station).setup)
    battle = station.parts.sessions.practice.battle
    assert battle is not None
    assert [player.device for player in battle.rules.players] == ["one kit", "another kit"]


def test_a_battle_is_judged_by_the_level_of_the_students_lessons_and_begins_low_for_it(
    line: Line, station: Controller, tmp_path: Path
) -> None:
    assert shown(station).setup.level is Level.BEGINNER, "of whom no lesson is known"
    levels = LevelMemory(one_student(tmp_path, "Cleo"))
    for lesson, level in (("rock-1", Level.ADVANCED), ("rock-2", Level.STUDIO), ("rock-3", Level.ELEMENTARY)):
        levels.keep(lesson, level)
    station.dispatch(PlayAs("Cleo"))
    station.update(2)
    station.dispatch(OpenBattle())
    setup = shown(station).setup
    assert setup.level is Level.ADVANCED, "the middle one of three"
    begun(line, station, setup)
    battle = station.parts.sessions.practice.battle
    assert battle is not None
    assert battle.rules.first_step == 10


def test_what_nobody_chose_is_the_same_in_the_window_and_in_a_terminal(tmp_path: Path) -> None:
    settings = Settings(student="Ann", sessions=str(tmp_path))
    options = BattleOptions(network=NetworkOptions(), video=FilmOptions(), sound=SoundOptions())
    typed = battle_rules(options, settings)
    chosen = after_earlier(chosen_rules(ChosenBattle(seed=1), "Ann", (), PLAIN), settings, has_handicap=False)
    for rules in (typed, chosen):
        assert (rules.rounds, rules.bars, rules.lives, rules.target) == (6, 2, 3, 0.9)
        assert (rules.level, rules.first_step) == (Level.BEGINNER, 1)


def test_fair_play_measures_two_against_themselves(line: Line, station: Controller) -> None:
    begun(line, station, replace(SHORT, people=People.HOT_SEAT, friend="Bo", is_fair=True))
    battle = station.parts.sessions.practice.battle
    assert battle is not None
    assert battle.rules.has_handicap
    assert [side.lives for side in battle.view().sides] == [None, None, None], "nobody loses a life then"
    over(line, station, plays=False)
    result = shown(station).result
    assert result is not None
    assert result.names == ("student", "Bo")
    assert "of 100 by their own measure" in result.rows[0].given[1]


def test_whoever_plays_all_back_wins_and_it_is_kept(line: Line, station: Controller, tmp_path: Path) -> None:
    begun(line, station)
    over(line, station, plays=True)
    result = shown(station).result
    assert result is not None
    assert result.headline == "You win against the steady one"
    assert result.failed == ""
    assert result.best == "student, bar 1 of round 2", "the final was the hardest"
    station.dispatch(ReplayBest())
    assert shown(station).replays
    assert not shown(station).covers_picture, "the stage is seen"
    station.dispatch(ReplayBest())
    assert not shown(station).replays
    assert [row.given[1] for row in result.rows[1:]] == ["100 % right, won"] * 2, "a round and the final"
    (document,) = kept(tmp_path)
    assert json.loads(document.read_text())["schema"] == "drum-station/battle/1"
    assert sum(isinstance(command, Play) for command in line.heard) == 2, "the battle, and once the best of it"
    assert any(isinstance(command, AddCues) for command in line.heard)


def test_a_battle_that_nobody_played_is_not_kept(line: Line, station: Controller, tmp_path: Path) -> None:
    begun(line, station)
    over(line, station, plays=False)
    result = shown(station).result
    assert result is not None
    assert result.told == "Nobody has played a stroke: the battle is not kept"
    assert (result.folder, result.judged_as) == ("", None), "nothing is left to film or to judge again"
    assert not list(tmp_path.rglob("battle.*"))
    station.dispatch(JudgeBattle(Level.STUDIO))
    assert shown(station).result == result


def test_whoever_plays_something_else_loses_and_may_practise_it(
    line: Line, station: Controller, tmp_path: Path
) -> None:
    begun(line, station)
    line.says.append(Hit(6 * NS_PER_S, Piece.COWBELL, Zone.HEAD, 100))
    over(line, station, plays=False)
    result = shown(station).result
    assert result is not None
    assert result.headline == "The steady one wins this time"
    assert result.failed == "The phrase of round 1: 0 % right"
    (folder,) = (path.parent for path in kept(tmp_path))
    assert len(result.advice) == 1
    assert result.advice[0] in (folder / "battle.txt").read_text(), "what is kept says the same"
    station.dispatch(PractiseFailed())
    assert shown(station).stage is BattleStage.CLOSED
    (lesson,) = (tmp_path / "lessons").glob("*.toml")
    assert "return match" in lesson.read_text()


def test_a_battle_that_is_stopped_has_no_winner_and_is_kept(line: Line, station: Controller, tmp_path: Path) -> None:
    begun(line, station)
    strikes(line, station)
    station.dispatch(EndSession())
    assert shown(station).stage is BattleStage.OVER
    result = shown(station).result
    assert result is not None
    assert result.headline == "Stopped: nobody has won"
    assert len(kept(tmp_path)) == 1


def test_closing_the_window_keeps_the_battle(line: Line, station: Controller, tmp_path: Path) -> None:
    begun(line, station)
    strikes(line, station)
    assert kept(tmp_path) == []
    station.close()
    assert len(kept(tmp_path)) == 1


def test_an_engine_that_dies_ends_it_with_what_was_played(line: Line, station: Controller, tmp_path: Path) -> None:
    begun(line, station)
    strikes(line, station)
    line.dead = True
    station.update(7 * NS_PER_S)
    assert station.view().toast
    assert shown(station).stage is BattleStage.OVER
    assert len(kept(tmp_path)) == 1


def test_escape_goes_from_the_battle_to_its_result_to_the_choice_to_the_lessons(
    line: Line, station: Controller
) -> None:
    begun(line, station)
    stages = []
    for _ in range(3):
        station.dispatch(Leave())
        stages.append(shown(station).stage)
    assert stages == [BattleStage.OVER, BattleStage.CHOOSING, BattleStage.CLOSED]
    assert not station.view().room.battle


def test_back_to_the_lessons_from_a_result(line: Line, station: Controller) -> None:
    begun(line, station)
    station.dispatch(EndSession())
    station.dispatch(Dismiss())
    assert shown(station).stage is BattleStage.CLOSED
    station.update(2 * NS_PER_S)
    assert station.view().room.stage is Stage.IDLE


def test_two_kicks_or_enter_begin_it_and_no_pad_pauses_it(line: Line, station: Controller) -> None:
    station.dispatch(Begin())
    assert shown(station).stage is BattleStage.PLAYING
    starts(line, station)
    for piece in (Piece.CRASH_1, Piece.CRASH_2):
        line.says.append(Hit(6 * NS_PER_S, piece, Zone.EDGE, 100))
    station.update(6 * NS_PER_S)
    station.update(7 * NS_PER_S)
    assert not station.view().room.paused, "two crashes are music in a battle"


def test_a_pause_counts_in_again(line: Line, station: Controller) -> None:
    begun(line, station)
    station.dispatch(Pause())
    assert station.view().room.paused
    station.dispatch(Pause())
    assert not station.view().room.paused
    assert sum(isinstance(command, Play) for command in line.heard) == 2


def test_what_else_is_begun_takes_its_place(line: Line, station: Controller, tmp_path: Path) -> None:
    station.dispatch(NewLesson())
    assert station.view().editor is not None
    assert shown(station).stage is BattleStage.CLOSED


def test_no_exam_begins_in_a_battle(line: Line, station: Controller) -> None:
    begun(line, station)
    station.dispatch(BeginExam())
    assert not station.view().room.exam
    assert shown(station).stage is BattleStage.PLAYING


def test_another_student_finds_no_battle_of_the_one_before(line: Line, station: Controller) -> None:
    begun(line, station)
    station.dispatch(PlayAs("Bea"))
    assert shown(station).stage is BattleStage.PLAYING, "nobody comes in the middle of it"
    station.dispatch(EndSession())
    station.dispatch(PlayAs("Bea"))
    assert shown(station).stage is BattleStage.CLOSED


def test_a_battle_takes_no_session_s_place_that_runs(line: Line, station: Controller) -> None:
    station.dispatch(CloseBattle())
    station.dispatch(Begin())
    assert station.view().room.stage is Stage.PLAYING
    station.dispatch(OpenBattle())
    assert shown(station).stage is BattleStage.CLOSED
    station.update(2)
    assert "end the session first" in station.view().toast
    assert sum(isinstance(command, RecordCapture) for command in line.heard) == 1
