"""The station behind the window: nothing that was played is lost when the engine fails, and each kind of practice."""

import json
import time
from dataclasses import replace
from datetime import datetime
from pathlib import Path

import pytest

from station.app.actions.action import Show
from station.app.actions.file_actions import Export
from station.app.actions.practice_actions import (
    Begin,
    ChooseBars,
    Dismiss,
    EndSession,
    HearBar,
    JudgeAt,
    Leave,
    Select,
    StrikeKey,
    Veto,
)
from station.app.actions.settings_actions import FinishFirstStart, LearnPause, PutUp, SetPreferences, SetView
from station.app.controller import Controller
from station.app.export import LESSON
from station.app.room_state import Stage
from station.app.sessions.launch import Launch
from station.app.sessions.session_control import LIVELY_NS
from station.app.settings.first_start import FirstAnswers
from station.app.settings.settings_store import SettingsStore
from station.core.events import DeviceFound, Hit, StickPose
from station.core.pieces import Limb, Piece, Zone
from station.core.settings import Settings, load_settings, save_settings
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.capture.replay import LoggedText
from station.drills.library import find_lesson
from station.engine.messages import Bus, KeyHit, Play, RecordCapture, SetBacking, SetLevel, Started, TrackPhase
from station.motion.sticking.hand_notes import Hands
from station.practice.demonstration.compare_by_ear import Whose
from station.practice.headless.virtual_session import practise_virtually
from station.practice.history.session_files import CAPTURE_NAME, session_folder
from station.practice.records.memory import remembered
from station.practice.session.backing_track import BackingRequest
from station.practice.session.event_log import Tracked, said_in
from station.practice.session.plan import PlanOptions, plan_practice
from station.scenes.session_part import AHEAD
from station.scoring.matching.hit_windows import Level
from station.simulation.student_spec import parse_spec
from station.store import memory_rows
from tests.fakes.known_students import one_student
from tests.fakes.stations import Line, choose, just_play, room, shown, station_on, store_with

TARGET_BPM = find_lesson("rock-1").target_tempo_bpm
PLAN = plan_practice(find_lesson("rock-1"), PlanOptions(loops=1, demonstrations=0))
MOST_READING_S = 60.0
"""A slow machine reads all lessons well within this."""


def station_at(lines: list[Line], sessions: Path) -> Controller:
    return station_on(lines, store_with(sessions), Launch(PLAN))


def downbeat(offset_ns: int = 0) -> Hit:
    return Hit(NS_PER_S + PLAN.passes_start_ns + offset_ns, Piece.KICK, Zone.HEAD, 90)


def test_hits_on_their_way_when_the_session_is_stopped_are_judged(tmp_path: Path) -> None:
    line = Line()
    station = station_at([line], tmp_path)
    station.dispatch(Begin())
    line.says.append(Started(NS_PER_S))
    station.update(NS_PER_S + PLAN.passes_start_ns + 10)
    line.says.append(downbeat())
    station.dispatch(EndSession())
    report = station.view().report
    assert report is not None
    counts = report.document["counts"]
    assert isinstance(counts, dict)
    assert counts["hits"] == 1


def test_sticks_that_move_are_tracked_for_the_report_though_nobody_asks_to_be_followed(tmp_path: Path) -> None:
    line = Line()
    station = station_at([line], tmp_path)
    station.dispatch(Begin())
    line.says += [Started(NS_PER_S), StickPose(1, "right", Limb.RIGHT_HAND, (1.0, 0.0, 0.0, 0.0))]
    station.update(NS_PER_S + 1)
    AHEAD.submit(lambda: None).result()
    station.update(NS_PER_S + 2)
    (track,) = [command for command in line.heard if isinstance(command, TrackPhase)]
    assert track.model is not None
    assert not track.triggers
    tracked = said_in(LoggedText(0, track.note))
    assert isinstance(tracked, Tracked)
    assert tracked.section.notes.tobytes() == PLAN.section.notes.tobytes()
    station.dispatch(EndSession())
    assert line.heard[-1] == TrackPhase(None)


def test_a_second_update_in_a_frame_says_whether_there_is_something_new_and_shows_it(tmp_path: Path) -> None:
    line = Line()
    station = station_at([line], tmp_path)
    station.dispatch(Begin())
    line.says += [Started(0)]
    assert station.update(1)
    assert not station.update(2)
    line.says += [downbeat()]
    assert station.update(downbeat().at_ns + 1)
    snapshot = station.view().snapshot
    assert snapshot is not None
    assert [strike.piece for strike in snapshot.strikes] == [downbeat().piece]


def test_to_look_changes_nothing(tmp_path: Path) -> None:
    line = Line()
    station = station_at([line], tmp_path)
    station.update(1)
    line.says += [downbeat()]
    before = station.view()
    assert station.view() is before
    assert line.says == [downbeat()], "what the engine has said is read by an update alone"


def test_a_window_spares_no_frame_while_a_kit_is_played(tmp_path: Path) -> None:
    line = Line()
    station = station_at([line], tmp_path)

    def is_lively(now_ns: int) -> bool:
        station.update(now_ns)
        return station.view().is_lively

    assert not is_lively(0)
    line.says += [downbeat()]
    struck_ns = downbeat().at_ns
    assert [is_lively(struck_ns + later_ns) for later_ns in (100, LIVELY_NS - 1, LIVELY_NS)] == [True, True, False]
    station.dispatch(Begin())
    assert is_lively(struck_ns + LIVELY_NS + 1)


def test_an_engine_that_dies_costs_no_hit_and_the_next_start_wakes_another(tmp_path: Path) -> None:
    first, second = Line(), Line()
    station = station_at([first, second], tmp_path)
    station.dispatch(Begin())
    first.says += [Started(NS_PER_S), downbeat()]
    station.update(NS_PER_S + PLAN.passes_start_ns + 10)
    first.dead = True
    station.update(NS_PER_S + PLAN.passes_start_ns + 20)
    assert room(station).stage is Stage.RESULT
    assert "ended" in station.view().toast
    assert len(list(tmp_path.rglob("report.json"))) == 1
    station.dispatch(Dismiss())
    station.dispatch(Begin())
    assert any(isinstance(command, RecordCapture) for command in second.heard)


def test_a_session_that_cannot_begin_leaves_no_folder(tmp_path: Path) -> None:
    line = Line()
    station = station_at([line], tmp_path)
    line.dead = True
    station.dispatch(Begin())
    line.dead = False
    station.update(1)
    assert "the engine has ended" in station.view().toast
    assert not list(tmp_path.rglob("*_rock-1"))


def test_keys_to_a_dead_engine_are_harmless(tmp_path: Path) -> None:
    line = Line()
    station = station_at([line], tmp_path)
    line.dead = True
    station.dispatch(StrikeKey(KeyHit(0, Piece.SNARE, Zone.HEAD, 90)))
    assert line.heard == []


def test_where_the_tempo_follows_the_student_the_next_pass_begins_by_itself(tmp_path: Path) -> None:
    """Silence on both: the second pass is the first once more, and then nobody is there."""
    line = Line()
    station = station_at([line], tmp_path)
    choose(station, loops=5, adapt=True)
    station.dispatch(Begin())
    now_ns = 0
    for _ in range(2):
        line.says.append(Started(now_ns))
        station.update(now_ns + 1)
        assert room(station).stage is Stage.PLAYING
        now_ns += 60 * NS_PER_S
        station.update(now_ns)
    assert [type(command) for command in line.heard].count(Play) == 2
    assert room(station).stage is Stage.RESULT
    report = station.view().report
    assert report is not None
    mastery = report.document["mastery"]
    assert isinstance(mastery, dict)
    assert [one["tempo_bpm"] for one in mastery["passes"]] == [pytest.approx(0.7 * TARGET_BPM)] * 2
    assert [state.item.name for state in remembered(one_student(tmp_path, "student"))] == ["rock-1"]
    assert report.facts.words.subtitle.endswith(" · Not yet shown in a blind pass.")


def test_a_change_may_be_refused_while_the_next_pass_is_counted_in(tmp_path: Path) -> None:
    line = Line()
    station = station_at([line], tmp_path)
    choose(station, loops=5, adapt=True)
    station.dispatch(Begin())
    line.says.append(Started(0))
    station.update(1)
    assert not room(station).can_veto
    line.says.append(Hit(3 * NS_PER_S, Piece.KICK, Zone.HEAD, 90))
    station.update(60 * NS_PER_S)
    line.says.append(Started(60 * NS_PER_S))
    station.update(60 * NS_PER_S + 1)
    assert room(station).can_veto
    assert "down to" in room(station).why
    station.dispatch(Veto())
    assert room(station).why == "As you wish: all stays as it was."


def test_a_pass_that_was_refused_when_the_engine_had_ended_is_none(tmp_path: Path) -> None:
    line = Line()
    station = station_at([line], tmp_path)
    choose(station, loops=5, adapt=True)
    station.dispatch(Begin())
    line.says += [Started(0), Hit(3 * NS_PER_S, Piece.KICK, Zone.HEAD, 90)]
    station.update(60 * NS_PER_S)
    line.says.append(Started(60 * NS_PER_S))
    station.update(60 * NS_PER_S + 1)
    line.dead = True
    station.dispatch(Veto())
    (kept,) = tmp_path.glob("*/*_rock-1/report.json")
    assert len(json.loads(kept.read_text("utf-8"))["mastery"]["passes"]) == 1


def played_early(station: Controller, line: Line, from_ns: int) -> None:
    """A whole session of rock 1, every stroke 15 ms early."""
    station.dispatch(Begin())
    zero_ns = from_ns + PLAN.passes_start_ns
    line.says.append(Started(from_ns))
    station.update(from_ns + 1)
    for at_ns, piece in zip(PLAN.score.onset_ns.tolist(), PLAN.score.notes["piece"].tolist(), strict=True):
        line.says.append(Hit(zero_ns + at_ns - 15 * NS_PER_MS, Piece(piece), Zone.HEAD, 90))
    station.update(from_ns + PLAN.end_ns + 2 * NS_PER_S)
    assert room(station).stage is Stage.RESULT


def test_the_student_is_asked_before_the_result_and_answers_with_a_pad(tmp_path: Path) -> None:
    """24 strokes to a click: once a lesson."""
    line = Line()
    station = station_at([line], tmp_path)
    played_early(station, line, NS_PER_S)
    assert "rushed, on, or dragged?" in room(station).question
    assert station.view().report is None
    line.says.append(Hit(90 * NS_PER_S, Piece.HIHAT, Zone.BOW, 90))
    station.update(90 * NS_PER_S)
    choice = station.view().choice
    assert choice is not None
    assert choice.meant == 0, "it is shown at once, and counts when nothing follows"
    station.update(91 * NS_PER_S)
    assert room(station).question == ""
    assert station.view().report is not None
    assert station.view().toast == "You said rushed, and you were 15 ms early on average: your ear is right."
    station.dispatch(Dismiss())
    played_early(station, line, 100 * NS_PER_S)
    assert room(station).question == ""
    assert station.view().report is not None


def test_no_stroke_of_the_music_answers(tmp_path: Path) -> None:
    """Whoever plays on after the end: two bars of eighths on the hi-hat with a backbeat, then a flourish."""
    line = Line()
    station = station_at([line], tmp_path)
    played_early(station, line, NS_PER_S)
    for eighth in range(16):
        line.says.append(Hit(90 * NS_PER_S + eighth * NS_PER_S // 4, Piece.HIHAT, Zone.BOW, 90))
        if eighth % 4 == 2:
            line.says.append(Hit(90 * NS_PER_S + eighth * NS_PER_S // 4, Piece.SNARE, Zone.HEAD, 90))
    line.says += [Hit(96 * NS_PER_S + i * NS_PER_S // 8, Piece.FLOOR_TOM_1, Zone.HEAD, 90) for i in range(3)]
    station.update(99 * NS_PER_S)
    assert room(station).question
    assert station.view().report is None


def test_a_question_that_is_skipped_shows_the_result(tmp_path: Path) -> None:
    line = Line()
    station = station_at([line], tmp_path)
    played_early(station, line, NS_PER_S)
    station.dispatch(Leave())
    assert (room(station).stage, room(station).question) == (Stage.RESULT, "")
    assert station.view().report is not None
    station.dispatch(Leave())
    assert room(station).stage is Stage.IDLE


def test_who_does_not_want_to_be_asked_is_not(tmp_path: Path) -> None:
    line = Line()
    station = station_on([line], store_with(tmp_path, ask_first=False), Launch(PLAN))
    played_early(station, line, NS_PER_S)
    assert room(station).question == ""
    assert station.view().report is not None


def test_a_question_may_be_left_open(tmp_path: Path) -> None:
    line = Line()
    station = station_at([line], tmp_path)
    played_early(station, line, NS_PER_S)
    station.dispatch(Dismiss())
    assert (room(station).stage, room(station).question) == (Stage.IDLE, "")


def test_a_free_take_is_kept_with_its_capture_and_judges_nothing(tmp_path: Path) -> None:
    line = Line()
    station = station_at([line], tmp_path)
    choose(station, free=True)
    just_play(station)
    assert room(station).stage is Stage.PLAYING
    line.says.append(Started(NS_PER_S))
    station.update(NS_PER_S + 1)
    line.says.append(Hit(2 * NS_PER_S, Piece.SNARE, Zone.HEAD, 90))
    picture = shown(station, 2 * NS_PER_S + 1)
    assert picture.strip is not None
    assert picture.strip.played.hits["at_ns"].tolist() == [NS_PER_S]
    assert [strike.piece for strike in picture.strikes] == [Piece.SNARE]
    assert picture.hud.judged == 0
    station.dispatch(EndSession())
    assert (room(station).stage, station.view().report) == (Stage.IDLE, None)
    assert room(station).take is not None
    assert len(list(tmp_path.glob("*/*_just-play/take.json"))) == 1
    assert [command.path.name for command in line.heard if isinstance(command, RecordCapture) and command.path] == [
        "session.capture"
    ]


def test_strokes_light_the_kit_before_a_take_and_are_not_kept(tmp_path: Path) -> None:
    line = Line()
    station = station_at([line], tmp_path)
    choose(station, free=True)
    line.says.append(Hit(NS_PER_S, Piece.RIDE, Zone.BOW, 90))
    picture = shown(station, NS_PER_S)
    assert [strike.piece for strike in picture.strikes] == [Piece.RIDE]
    assert picture.strip is not None
    assert len(picture.strip.played) == 0


def test_an_engine_that_dies_in_a_take_loses_none_of_it(tmp_path: Path) -> None:
    line = Line()
    station = station_at([line], tmp_path)
    just_play(station)
    line.says += [Started(NS_PER_S), Hit(2 * NS_PER_S, Piece.SNARE, Zone.HEAD, 90)]
    station.update(2 * NS_PER_S + 1)
    line.dead = True
    station.update(3 * NS_PER_S)
    assert room(station).stage is Stage.IDLE
    assert room(station).take is not None
    assert len(list(tmp_path.glob("*/*_just-play/take.json"))) == 1


def test_the_kit_of_the_student_s_choice_is_put_up(tmp_path: Path) -> None:
    station = station_at([Line()], tmp_path)
    station.dispatch(PutUp("jazz"))
    assert shown(station, 0).kit.finish == "maple"
    station.dispatch(PutUp(""))
    assert shown(station, 0).kit.finish == "teal"
    station.close()


def test_whoever_was_met_is_kept_through_a_new_engine(tmp_path: Path) -> None:
    first, second = Line(), Line()
    station = station_at([first, second], tmp_path)
    station.dispatch(FinishFirstStart(FirstAnswers("Ann", module_sounds=True, hands=Hands.LEFT)))
    assert first.heard == [SetLevel(Bus.STUDENT, 0.0)]
    assert shown(station, 0).kit.left_handed
    first.dead = True
    station.update(1)
    station.dispatch(Begin())
    assert second.heard[0] == SetLevel(Bus.STUDENT, 0.0), "the new engine keeps silent too"
    station.close()
    assert list((tmp_path / "Ann").rglob("*.json")), "her sessions are hers"


def test_a_free_take_has_no_track_of_a_lesson(tmp_path: Path) -> None:
    """A track sounds whenever the transport runs, so it is taken away first."""
    line = Line()
    request = BackingRequest(tmp_path / "song.mp3")
    station = station_on([line], store_with(tmp_path), Launch(PLAN, backing=request))
    just_play(station)
    line.says += [Started(NS_PER_S), Hit(2 * NS_PER_S, Piece.SNARE, Zone.HEAD, 90)]
    station.update(2 * NS_PER_S + 1)
    station.dispatch(EndSession())
    before_play = [
        line.heard[i - 1] for i, command in enumerate(line.heard) if isinstance(command, RecordCapture | Play)
    ]
    assert isinstance(before_play[0], SetBacking)
    assert before_play[0].track is None


def test_a_bar_is_heard_and_ends_by_itself(tmp_path: Path) -> None:
    line = Line()
    station = station_on([line], store_with(tmp_path, ask_first=False), Launch(PLAN))
    played_early(station, line, NS_PER_S)
    for whose in Whose:
        station.dispatch(HearBar(1, whose))
        assert isinstance(line.heard[-1], Play)
        assert room(station).listening
    line.says.append(Started(100 * NS_PER_S))
    station.update(100 * NS_PER_S + 1)
    station.update(160 * NS_PER_S)
    assert not room(station).listening, "it ends by itself"


def test_an_end_that_a_key_finds_is_told_and_the_session_is_kept(tmp_path: Path) -> None:
    line = Line()
    station = station_at([line], tmp_path)
    station.dispatch(Begin())
    line.says += [DeviceFound(0, "TD-17"), Started(NS_PER_S)]
    station.update(NS_PER_S + PLAN.passes_start_ns + 10)
    assert room(station).kit == "TD-17"
    line.dead = True
    station.dispatch(StrikeKey(KeyHit(0, Piece.SNARE, Zone.HEAD, 90)))
    station.update(NS_PER_S + PLAN.passes_start_ns + 20)
    assert room(station).stage is Stage.RESULT
    assert "ended" in station.view().toast
    assert room(station).kit == ""


def test_what_is_played_in_a_session_is_never_learnt_as_a_gesture(tmp_path: Path) -> None:
    line = Line()
    station = station_at([line], tmp_path)
    before = station.view().preferences
    station.dispatch(LearnPause(on=True))
    assert station.view().learns_pause
    station.dispatch(Begin())
    at_ns = NS_PER_S + PLAN.passes_start_ns
    line.says += [Started(NS_PER_S), downbeat(), Hit(at_ns, Piece.CRASH_1, Zone.EDGE, 90)]
    station.update(at_ns + 10)
    assert station.view().preferences == before
    assert not station.view().learns_pause


# --- settings ---------------------------------------------------------------------------------------------------------


def test_who_practises_for_this_call_alone_has_what_is_exported(tmp_path: Path) -> None:
    """`--student Ann` over a file that says Bob."""
    path = save_settings(Settings(sessions=str(tmp_path), student="Bob"), tmp_path / "settings.toml")
    station = station_on([Line()], SettingsStore(path, {"student": "Ann"}), Launch(PLAN))
    station.dispatch(Export(LESSON))
    assert [path.relative_to(tmp_path).parts[0] for path in tmp_path.glob("*/take-along/*")] == ["Ann"]


def test_a_tick_of_the_practice_panel_writes_itself_alone(tmp_path: Path) -> None:
    """`--guide` of this call stays this call's."""
    path = save_settings(Settings(sessions=str(tmp_path), pause="cc=64  crash_1+ride"), tmp_path / "settings.toml")
    before = load_settings(path)
    station = station_on([Line()], SettingsStore(path, {"guide": True}), Launch(PLAN))
    station.dispatch(SetPreferences(replace(station.view().preferences, ask_first=False)))
    assert load_settings(path) == before, "nothing is written before the next frame"
    station.update(1)
    assert load_settings(path) == replace(before, ask_first=False)
    assert station.view().preferences.guide
    station.dispatch(SetPreferences(replace(station.view().preferences, guide=False)))
    station.update(2)
    assert not station.view().preferences.guide


def test_nothing_is_written_while_somebody_plays(tmp_path: Path) -> None:
    store, line = store_with(tmp_path), Line()
    station = station_on([line], store, Launch(PLAN))
    station.dispatch(Begin())
    station.dispatch(SetView(replace(station.view().view_settings, mirrored=True)))
    station.update(1)
    assert not load_settings(tmp_path / "settings.toml").mirrored
    station.dispatch(EndSession())
    station.update(2)
    assert load_settings(tmp_path / "settings.toml").mirrored


def test_a_faulty_file_is_told_and_keeps_nobody_from_practising(tmp_path: Path) -> None:
    (tmp_path / "settings.toml").write_text('kitt = "TD-17"\n')
    store = SettingsStore(tmp_path / "settings.toml", {"sessions": str(tmp_path)})
    station = station_on([Line()], store, Launch(PLAN))
    station.update(1)
    assert "no such setting: kitt" in station.view().toast
    station.dispatch(SetView(replace(station.view().view_settings, mirrored=True)))
    station.update(2)
    assert station.view().view_settings.mirrored
    assert "no such setting: kitt" in station.view().toast
    station.dispatch(Begin())
    assert room(station).stage is Stage.PLAYING


def offer_all(station: Controller, now_ns: int = 1) -> None:
    """Show the list, and go on until all lessons are in it; the window goes on meanwhile."""
    station.dispatch(Show(catalog=True))
    assert [card.name for card in station.view().selection.lessons] == ["rock-1"], "nothing waits for the others"
    deadline = time.monotonic() + MOST_READING_S
    while len(station.view().selection.lessons) == 1 and time.monotonic() < deadline:
        station.update(now_ns)
    assert {"rock-1", "rock-2"} <= {card.name for card in station.view().selection.lessons}


def test_what_is_chosen_is_shown_and_its_bars_are_repeated(tmp_path: Path) -> None:
    station = station_at([Line()], tmp_path)
    offer_all(station)
    cards = {card.name: card for card in station.view().selection.lessons}
    station.dispatch(Select(station.view().selection.choose(cards["rock-2"])))
    station.dispatch(ChooseBars((1, 1)))
    station.update(1)
    assert (station.view().score.bar_count, station.view().player.lesson.name) == (2, "rock-2")
    assert (station.view().player.player.loop, station.view().export_bars) == ((1, 1), (1, 1))


def test_escape_leaves_a_session_then_its_result(tmp_path: Path) -> None:
    station = station_at([Line()], tmp_path)
    station.dispatch(Begin())
    stages = []
    for _ in range(3):
        stages.append(room(station).stage)
        station.dispatch(Leave())
    assert stages == [Stage.PLAYING, Stage.RESULT, Stage.IDLE]


def test_what_cannot_be_written_any_more_is_told_when_the_window_is_closed(tmp_path: Path) -> None:
    station = station_at([Line()], tmp_path)
    station.dispatch(Begin())
    station.dispatch(SetView(replace(station.view().view_settings, mirrored=True)))
    (tmp_path / "settings.toml").write_text('kitt = "TD-17"\n')
    assert "no such setting: kitt" in str(station.close())


def test_a_session_that_was_cut_off_is_told_of_when_the_window_opens(tmp_path: Path) -> None:
    store = store_with(tmp_path)
    folder = session_folder(tmp_path, store.now.student, "rock-1", datetime(2026, 3, 1, 10))
    practise_virtually(PLAN, parse_spec("pro"), folder / CAPTURE_NAME)
    station = station_on([Line()], store, Launch(PLAN))
    deadline = time.monotonic() + MOST_READING_S
    while not station.view().toast and time.monotonic() < deadline:
        station.update(1)
    taken, told = station.view().toast.splitlines()
    assert taken == "1 session taken into the history"
    assert told.startswith("a session was cut off before it was judged: 2026-03-01T10-00-00_rock-1; station practice")


# --- how strictly is judged -------------------------------------------------------------------------------------------


def level_of_a_session(station: Controller, line: Line) -> object:
    """The level by which a session that is begun now is judged."""
    station.dispatch(Begin())
    line.says += [Started(NS_PER_S), downbeat()]
    station.update(NS_PER_S + PLAN.passes_start_ns + 10)
    station.dispatch(EndSession())
    report = station.view().report
    assert report is not None
    station.dispatch(Dismiss())
    return report.document["level"]


def test_a_lesson_is_judged_as_it_suggests_until_the_student_chooses(tmp_path: Path) -> None:
    line = Line()
    station = station_at([line], tmp_path)
    assert level_of_a_session(station, line) == "beginner"
    station.dispatch(JudgeAt("rock-1", Level.ADVANCED))
    assert level_of_a_session(station, line) == "advanced"
    offer_all(station, 2 * NS_PER_S)
    assert station.view().selection.level is Level.ADVANCED


def test_a_choice_of_level_holds_for_that_lesson_and_the_next_time(tmp_path: Path) -> None:
    station_at([Line()], tmp_path).dispatch(JudgeAt("rock-1", Level.ELEMENTARY))
    line = Line()
    again = station_at([line], tmp_path)
    assert level_of_a_session(again, line) == "elementary"
    offer_all(again)
    selection = again.view().selection
    again.dispatch(Select(selection.choose(next(card for card in selection.lessons if card.name == "rock-2"))))
    assert again.view().selection.level is Level.BEGINNER


def test_a_level_that_the_disk_refuses_is_not_shown_as_chosen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    station = station_at([Line()], tmp_path)

    def refused(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(memory_rows, "put_level", refused)
    station.dispatch(JudgeAt("rock-1", Level.STUDIO))
    station.update(1)
    assert "No space left on device" in station.view().toast
    assert station.view().selection.level is Level.BEGINNER
