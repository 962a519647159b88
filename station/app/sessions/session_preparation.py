"""What is made ready before a session: its lesson, the plan as the settings ask for it, what is remembered, the track.

What is laid out goes by the settings as they are then.
"""

from dataclasses import dataclass, replace
from datetime import date
from typing import TYPE_CHECKING

from station.app.room_state import SessionRequest
from station.app.sessions.demo_drummer import DemonstratedLesson
from station.app.settings.settings_store import SettingsStore
from station.core.errors import BadInput
from station.core.settings import setting_source
from station.drills.lesson import Lesson
from station.motion.kit.kit import DEFAULT_KIT, Kit, load_kit
from station.motion.sticking.hand_notes import Hands
from station.practice.exam.exam_sitting import Sitting
from station.practice.history.student_history import StudentHistory
from station.practice.records.lesson_order import followed_course
from station.practice.records.memory import Memory, Remembered
from station.practice.records.teachers_wishes import wishes_of
from station.practice.session.cues.click_options import parse_click
from station.practice.session.cues.click_pattern import ClickPattern
from station.practice.session.cues.quiet_bars import drawn
from station.practice.session.leading_hand import drummers_kit, hands_of
from station.practice.session.plan import Plan, PlanOptions, plan_practice
from station.scoring.matching.hit_windows import Level
from station.sound.track import PreparedTrack

if TYPE_CHECKING:
    from station.practice.session.backing_track import Backing, BackingRequest


@dataclass(frozen=True, eq=False)
class PreparedSession:
    """A session that can begin; where the tempo follows the student, `followed` lays out what comes after `plan`.

    `sitting` is the exam that it is the take of.
    """

    plan: Plan
    followed: Remembered | None = None
    sitting: Sitting | None = None


class SessionPreparation:
    """Lays out what is asked for by the settings of `store`; sessions whose tempo stays play along to `backing`.

    The tempo of a song stays: its track has one.
    """

    def __init__(self, store: SettingsStore, backing: "BackingRequest | None") -> None:
        self._store = store
        self._request = backing
        self._backing: Backing | None = None

    @property
    def has_tracks(self) -> bool:
        """Whether a session may have played along to a track."""
        return self._request is not None or self._backing is not None

    def laid_out(self, lesson: Lesson, request: SessionRequest, level: Level) -> PreparedSession:
        """What is asked for of a lesson, judged at `level`, from what is remembered where the tempo follows.

        Raises `StationError`.
        """
        settings = self._store.now
        adapts = request.adapt and lesson.band is None
        tempo_bpm = None if adapts else request.tempo_bpm
        click = self._click_of(request, lesson)
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
            request.rise,
        )
        plan = plan_practice(lesson, options)
        if not adapts:
            return PreparedSession(plan)
        memory = Memory(StudentHistory.of(settings), lesson.name, plan.bars)
        today = date.today()
        followed = Remembered.of(lesson, options, today, memory, followed_course(settings), wishes_of(settings, today))
        return PreparedSession(followed.adaptation.plan, followed)

    def _click_of(self, request: SessionRequest, lesson: Lesson) -> ClickPattern | None:
        """What clicks; raises `BadInput` for a tempo that cannot rise with a track."""
        if request.rise is not None and (self._request is not None or lesson.band is not None or self._has_own_track):
            raise BadInput("the tempo", "", "cannot rise with a track, which has one tempo")
        if not request.click:
            return None
        click = self.click()
        return click if request.gap is None else replace(click, gap=drawn(request.gap))

    def watched(self, lesson: Lesson, kit: Kit) -> DemonstratedLesson:
        """The lesson as its demonstration is played; raises `BadInput` for a click that is none."""
        return DemonstratedLesson(lesson, kit, hands_of(self._store.now), replace(self.click(), gap=None))

    def rehearsed(self, lesson: Lesson) -> DemonstratedLesson:
        """The same of a lesson that is being written, on the kit that the settings ask for; raises `BadInput`."""
        settings = self._store.now
        return self.watched(lesson, drummers_kit(lesson, hands_of(settings), settings.stands))

    def own_kit(self) -> Kit:
        """The kit that stands where no lesson says which: the settings', for the hand that leads; raises `BadInput`."""
        hands, kit = hands_of(self._store.now), load_kit(self._store.now.stands or DEFAULT_KIT)
        return kit if hands is None or kit.left_handed == (hands is Hands.LEFT) else kit.mirrored

    def needs_track(self, plan: Plan) -> bool:
        """Whether it is played along to a track."""
        return self._request is not None or plan.lesson.band is not None or self._has_own_track

    def can_do_without(self, plan: Plan) -> bool:
        """Whether its track is the settings' alone, which no lesson depends on."""
        return self._request is None and plan.lesson.band is None

    @property
    def _has_own_track(self) -> bool:
        """Whether the settings have a track for sessions that bring none."""
        return bool(self._store.now.track) and self._store.now.with_track

    def track(self, plan: Plan, rate_hz: int) -> PreparedTrack | None:
        """The track to play along to, None while it is being made ready; raises `BadInput`, `DeviceError`."""
        assert self.needs_track(plan), "it is asked for where there is one"
        if self._backing is None:  # with libraries of sound: the window opens sooner without
            from station.practice.session.backing_track import Backing

            self._backing = Backing(self._request)
        from station.practice.session.backing_track import track_request

        settings = self._store.now
        self._backing.ask(plan, rate_hz, settings.band_drums, track_request(settings))
        return self._backing.ready()

    def click(self) -> ClickPattern:
        """What clicks; raises `BadInput` for settings that say what is none."""
        pattern = parse_click(self._store.now.click_pattern, setting_source("click_pattern"))
        return replace(pattern, gap=drawn(pattern.gap))
