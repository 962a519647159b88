"""What the window shows of the station's parts: pages that nobody looks at are empty, and cost nothing."""

from dataclasses import replace

from station.app.equipment.calibration import CalibrationView
from station.app.equipment.mapping_view import MappingView
from station.app.equipment.sticks_view import SticksView
from station.app.exam_page import ExamView
from station.app.history.history_shown import HistoryView
from station.app.phase_page import PhaseView
from station.app.sound.sound_page import SoundView
from station.app.station_parts import StationParts
from station.app.teacher_desk.assigned_page import AssignedView
from station.app.teacher_desk.teacher_page import TeacherView
from station.app.today_page import TodayView
from station.app.window_state import State
from station.core.measured_latency import StoredCalibration
from station.core.settings import NOTHING
from station.practice.session.cues.click_flash import DARK

_NO_CALIBRATION = CalibrationView(StoredCalibration())


def state_of(parts: StationParts, now_ns: int) -> State:
    """The parts as they are at `now_ns`, as far as they are `shown`."""
    sessions, shown = parts.sessions, parts.shown
    snapshot = sessions.snapshot(now_ns) if shown.picture else None
    choice = parts.choice()
    choice = None if choice is None else parts.pads.heard(choice, now_ns)
    return State(
        choice=None if parts.who.is_open else choice,
        room=replace(sessions.room(), exam=parts.exam.is_on, battle=parts.battle.is_open),
        selection=parts.chooser.selection,
        player=sessions.player.view(),
        settings=parts.store.now,
        view_settings=parts.view_settings,
        style=parts.style.view(),
        hands=sessions.hands,
        score=sessions.practice.session.plan.lesson.score,
        preferences=parts.preferences.now,
        students=parts.who.view(choice),
        mapping=parts.mapping.view() if shown.devices else MappingView(),
        calibration=parts.calibration.view() if shown.devices else _NO_CALIBRATION,
        sticks=parts.sticks.view() if shown.sticks else SticksView(),
        snapshot=snapshot if snapshot is None else parts.exam.named(snapshot),
        report=None if parts.battle.is_open else sessions.practice.last_result.report,
        curves=sessions.curves() if shown.curves else None,
        phase=parts.phase.view() if shown.phase else PhaseView(),
        learns_pause=parts.preferences.learns,
        export_bars=parts.chooser.bars,
        export=parts.export.view(),
        played=sessions.played,
        imports=parts.imports.view(),
        editor=parts.editor.view(),
        drafts=parts.drafts.left if shown.catalog and not parts.editor.is_open else (),
        today=parts.today.view() if shown.today else TodayView(),
        song=parts.song.view(),
        exam=parts.exam.view() if shown.exam or parts.exam.is_on else ExamView(),
        battle=parts.battle.view(),
        teacher=parts.teacher.view() if shown.teacher else TeacherView(),
        assigned=parts.assigned.view() if shown.assigned else AssignedView(),
        history=parts.history.view() if shown.history else HistoryView(),
        sound=parts.sound.view() if shown.sound else SoundView(),
        flash=parts.engine.flash.at(now_ns) if parts.store.now.heard == NOTHING else DARK,
        toast=parts.toasts.text,
        is_lively=sessions.is_lively(now_ns) or parts.battle.is_lively or (shown.sticks and parts.sticks.is_lively),
    )
