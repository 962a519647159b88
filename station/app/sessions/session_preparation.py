"""What is made ready before a session: its lesson, the plan as the settings ask for it, what is remembered, the track.

What is laid out goes by the settings as they are then.
"""

from dataclasses import dataclass
from datetime import date
from typing import TYPE_CHECKING

from station.app.room_state import SessionRequest
from station.app.sessions.demo_player import DemonstratedLesson
from station.app.settings.settings_store import SettingsStore
from station.core.errors import DeviceError
from station.core.settings import setting_source
from station.drills.lesson import Lesson
from station.motion.kit.kit import Kit
from station.practice.records.lesson_order import followed_course
from station.practice.records.memory import Memory, Remembered
from station.practice.session.cues.click_options import parse_click
from station.practice.session.cues.click_pattern import ClickPattern
from station.practice.session.leading_hand import hands_of
from station.practice.session.plan import Plan, PlanOptions, plan_practice
from station.scoring.matching.hit_windows import Level
from station.sound.track import PreparedTrack

if TYPE_CHECKING:
    from station.practice.session.backing_track import BackingRequest


@dataclass(frozen=True, eq=False)
class PreparedSession:
    """A session that can begin; where the tempo follows the student, `followed` lays out what comes after `plan`."""

    plan: Plan
    followed: Remembered | None = None


class SessionPreparation:
    """Lays out what is asked for by the settings of `store`; sessions whose tempo stays play along to `backing`."""

    def __init__(self, store: SettingsStore, backing: "BackingRequest | None") -> None:
        self._store = store
        self._backing = None
        if backing is not None:  # with libraries of sound: the window opens sooner without
            from station.practice.session.backing_track import Backing

            self._backing = Backing(backing)

    @property
    def has_tracks(self) -> bool:
        """Whether sessions may play along to a track."""
        return self._backing is not None

    def laid_out(self, lesson: Lesson, request: SessionRequest, level: Level) -> PreparedSession:
        """What is asked for of a lesson, judged at `level`, from what is remembered where the tempo follows.

        Raises `StationError`.
        """
        settings = self._store.now
        tempo_bpm = None if request.adapt else request.tempo_bpm
        click = self._click() if request.click else None
        hands = hands_of(settings)
        options = PlanOptions(
            tempo_bpm,
            request.loops,
            request.bars,
            request.demonstrations,
            click,
            settings.guide,
            hands,
            level,
            settings.stands,
        )
        plan = plan_practice(lesson, options)
        if not request.adapt:
            return PreparedSession(plan)
        memory = Memory.of(settings.sessions_dir, settings.student, lesson.name, plan.bars)
        followed = Remembered.of(lesson, options, date.today(), memory, followed_course(settings))
        return PreparedSession(followed.adaptation.plan, followed)

    def watched(self, lesson: Lesson, kit: Kit) -> DemonstratedLesson:
        """The lesson as its demonstration is played; raises `BadInput` for a click that is none."""
        return DemonstratedLesson(lesson, kit, hands_of(self._store.now), self._click())

    def track(self, plan: Plan, rate_hz: int) -> PreparedTrack | None:
        """The track to play along to; raises `DeviceError` while it is being made ready, `BadInput` if it cannot be."""
        if self._backing is None:
            return None
        self._backing.ask(plan, rate_hz)
        track = self._backing.ready()
        if track is None:
            raise DeviceError("the track is being made ready for this tempo: start again in a moment")
        return track

    def _click(self) -> ClickPattern:
        return parse_click(self._store.now.click_pattern, setting_source("click_pattern"))
