"""The page for sticks without a window: what the engine says in, what is shown and kept out.

Sticks are `fakes.stick_physics`; the gesture and the zones are made as a player would make them, on a clock by hand.
"""

from collections.abc import Callable
from math import cos, sin
from pathlib import Path

import numpy as np
import pytest

from station.app.actions.equipment_actions import (
    FollowPhase,
    GiveUpSticks,
    LearnAir,
    LearnMounting,
    LookForSticks,
    PlayInAir,
    SetHand,
    SoundPhase,
)
from station.app.equipment.sticks_editor import SticksEditor
from station.app.settings.settings_store import SettingsStore
from station.core.errors import BadInput, DeviceError
from station.core.events import (
    PhaseEstimate,
    SensorLost,
    SensorMounted,
    SensorSamples,
    SensorStatus,
    StickPose,
    StickStroke,
)
from station.core.imu import ImuSample, Mounting, Quaternion
from station.core.pieces import Limb, Piece, Zone
from station.core.settings import load_settings
from station.core.units import ns_from_s
from station.devices.mapping.stick_file import own_stick
from station.engine.messages import Command, ReloadDevice, SetAirDrums, WatchSensors
from station.sync.air.air_file import read_air, save_air
from station.sync.air.air_zones import AirKit, AirZone
from tests.fakes.stations import store_with
from tests.fakes.stick_physics import FINE_HZ, Array, Sensor, Stroke, measured, moved_slowly, strokes_by_angle

RIGHT, LEFT = "stick 1", "stick 2"
STILL = 0.0


class Page:
    """An editor with files of its own, and what it sent."""

    def __init__(self, folder: Path, **chosen: object) -> None:
        self.folder, self.air = folder / "sticks", folder / "air.toml"
        self.sent: list[Command] = []
        self.engines: list[str] = []
        """The sensors for which engines were started."""
        self.plays = False
        self.store: SettingsStore = store_with(folder, **chosen)
        self.editor = SticksEditor(self.sent.append, self.store, self.start_anew, self.folder, self.air)

    def start_anew(self) -> None:
        if self.plays:
            raise DeviceError("end the session first")
        self.engines.append(self.store.now.sticks)

    def here(self, *devices: str, mounting: Mounting | None = None) -> None:
        for device in devices:
            self.editor.handle(SensorMounted(0, device, mounting or Mounting()))

    def complete(self, at_s: float) -> None:
        """The gesture is over, and a thread finds out what it was."""
        while self.editor.learns:
            self.editor.advance(ns_from_s(at_s))

    def status(self, device: str = RIGHT, at_s: float = 1.0, **said: object) -> None:
        said = {"protocol": "x-imu3", "rate_hz": 200.0, "samples": 990} | said
        self.editor.handle(SensorStatus(ns_from_s(at_s), device, **said))  # type: ignore[arg-type] # what a test says
        self.editor.advance(ns_from_s(at_s))

    def measure(self, device: str, samples: list[ImuSample], from_s: float) -> None:
        """The samples come in clumps of a twentieth of a second, from `from_s` on."""
        shift_ns = ns_from_s(from_s)
        for begin in range(0, len(samples), 10):
            clump = tuple(s._replace(at_ns=s.at_ns + shift_ns) for s in samples[begin : begin + 10])
            self.editor.handle(SensorSamples(clump[-1].at_ns, device, clump))


@pytest.fixture
def page(tmp_path: Path) -> Page:
    return Page(tmp_path)


def about_the_vertical(angle_rad: float) -> Quaternion:
    return (cos(angle_rad / 2), 0.0, 0.0, sin(angle_rad / 2))


# --- what is shown ----------------------------------------------------------------------------------------------------


def test_a_sensor_is_shown_with_what_it_says_of_itself(page: Page) -> None:
    page.here(RIGHT, mounting=Mounting(Limb.RIGHT_HAND, learnt=True))
    page.status(samples=990, lost=10, battery=0.83)
    page.editor.handle(StickStroke(0, RIGHT, Limb.RIGHT_HAND, 4.21, 0.31))
    (stick,) = page.editor.view().sticks
    assert (stick.device, stick.limb, stick.is_learnt) == (RIGHT, Limb.RIGHT_HAND, True)
    assert stick.facts == ("x-IMU3, 200 Hz", "battery 83%", "1.0% lost", "last stroke 4.2 m/s from 31 cm")
    assert stick.troubles == ()


@pytest.mark.parametrize(
    ("said", "trouble"),
    [
        ({"protocol": ""}, "nothing readable comes"),
        ({"lost": 11}, "samples are lost"),
        ({"note": "over heat"}, "it says: over heat"),
    ],
)
def test_what_the_player_should_mend_is_said(page: Page, said: dict[str, object], trouble: str) -> None:
    page.here(RIGHT)
    page.status(**said)  # type: ignore[arg-type]
    (stick,) = page.editor.view().sticks
    assert len(stick.troubles) == 1
    assert trouble in stick.troubles[0]


def test_a_sensor_that_says_nothing_any_more_is_told(page: Page) -> None:
    page.here(RIGHT)
    assert "nothing has come" in page.editor.view().sticks[0].troubles[0]
    page.status(at_s=1.0)
    page.editor.advance(ns_from_s(3.0))
    assert page.editor.view().sticks[0].troubles == ()
    page.editor.advance(ns_from_s(3.1))
    assert page.editor.view().sticks[0].troubles == ("it has fallen silent",)
    page.editor.handle(SensorLost(ns_from_s(4.0), RIGHT))
    assert page.editor.view().sticks == ()


def test_whether_a_stick_moves_is_said_while_its_sensor_is_heard(page: Page) -> None:
    page.here(RIGHT)
    page.status(at_s=1.0)
    assert page.editor.view().sticks[0].moves is None
    page.editor.handle(StickPose(ns_from_s(1.0), RIGHT, Limb.RIGHT_HAND, (1.0, 0.0, 0.0, 0.0)))
    assert page.editor.view().sticks[0].moves is True
    page.editor.advance(ns_from_s(3.1))
    assert page.editor.view().sticks[0].moves is None


def test_strokes_beyond_the_gyro_and_what_an_air_drummer_should_know_are_told(page: Page) -> None:
    page.here(RIGHT)
    page.status(air=("Learn the zones again.",))
    for clipped in (True, False, True):
        page.editor.handle(StickStroke(0, RIGHT, Limb.RIGHT_HAND, 9.0, clipped=clipped))
    first, second = page.editor.view().sticks[0].troubles
    assert first.startswith("2 of the last 3 strokes were beyond its gyro")
    assert first.endswith("set it to a wider range, if it has one")
    assert second == "Learn the zones again."


def test_what_points_ahead_for_long_is_ahead_in_the_picture_and_a_swing_is_seen(page: Page) -> None:
    page.here(RIGHT)

    def pose(at_s: float, heading_rad: float) -> float:
        page.editor.handle(StickPose(ns_from_s(at_s), RIGHT, Limb.RIGHT_HAND, about_the_vertical(heading_rad)))
        turn = page.editor.view().sticks[0].turn
        assert turn is not None
        return 2 * turn[3] / turn[0]  # small angles

    assert pose(0.0, 2.0) == pytest.approx(0.0, abs=1e-9)
    assert pose(0.05, 2.4) == pytest.approx(0.4, abs=0.02), "a swing to the left"
    for step in range(1000):
        last = pose(0.05 + step / 50, 2.4)
    assert last == pytest.approx(0.0, abs=0.01), "after twenty seconds it is ahead"


def test_a_phase_is_shown_as_it_was_told_last(page: Page) -> None:
    told = PhaseEstimate(5, 1.0, 0.9, 0.95, 6.0, locked=True)
    page.editor.handle(told)
    assert page.editor.view().phase == told


# --- where they are ---------------------------------------------------------------------------------------------------


def test_another_port_is_kept_and_the_engine_looks_there(page: Page) -> None:
    page.here(RIGHT)
    page.editor.act(LookForSticks(" serial:/dev/ttyUSB0@115200; ble:WT901 "))
    assert page.engines == ["serial:/dev/ttyUSB0@115200; ble:WT901"]
    assert page.editor.view().sticks == ()


def test_what_is_no_port_and_what_comes_while_somebody_plays_changes_nothing(page: Page) -> None:
    with pytest.raises(BadInput):
        page.editor.act(LookForSticks("serial:/dev/ttyUSB0@fast"))
    page.plays = True
    with pytest.raises(DeviceError):
        page.editor.act(LookForSticks("ble:WT901"))
    assert (page.engines, page.store.now.sticks) == ([], "")


# --- which hand -------------------------------------------------------------------------------------------------------


def test_a_chosen_hand_is_kept_and_the_other_stick_changes_over(page: Page) -> None:
    page.here(RIGHT, mounting=Mounting(Limb.RIGHT_HAND, tip_m=0.31, learnt=True))
    page.here(LEFT, mounting=Mounting(Limb.LEFT_HAND))
    page.editor.act(SetHand(RIGHT, Limb.LEFT_HAND))
    assert own_stick(RIGHT, page.folder) == Mounting(Limb.LEFT_HAND, tip_m=0.31, learnt=True)
    assert own_stick(LEFT, page.folder).limb is Limb.RIGHT_HAND
    assert set(page.sent) == {ReloadDevice(RIGHT), ReloadDevice(LEFT)}


# --- the mounting gesture ---------------------------------------------------------------------------------------------


def taps(start_s: float, total_s: float = 10.0) -> Array:
    """The stick lies, is lifted, taps four times from `start_s` on, and lies."""
    angle, _, _ = strokes_by_angle([Stroke(0.3)] * 4, rest_s=0.1)
    lying = [STILL] * round((start_s - 0.5) * FINE_HZ)
    whole = [*lying, *moved_slowly(0.0, 0.3, 0.5), *angle]
    return np.array([*whole, *[whole[-1]] * (round(total_s * FINE_HZ) - len(whole))])


def test_the_gesture_says_what_to_do_and_keeps_what_it_shows(page: Page) -> None:
    page.here(RIGHT, LEFT, mounting=Mounting(tip_m=0.3))
    page.editor.advance(0)
    page.editor.act(LearnMounting())
    assert page.sent == [WatchSensors(on=True)]
    asked = []
    for second in range(0, 14, 2):
        page.editor.advance(ns_from_s(second + 0.1))
        lesson = page.editor.view().lesson
        assert lesson is not None
        asked.append(lesson.asks.split()[0])
    assert asked == ["Lay", "Lay", "Let", "Let", "Take", "Take", "Now"]
    page.measure(RIGHT, measured(taps(3.0), Sensor(200)), 4.0)
    page.measure(LEFT, measured(taps(6.5), Sensor(200)), 4.0)
    page.complete(14.0)
    view = page.editor.view()
    assert view.lesson is None
    assert view.learnt == (f"{RIGHT} is learnt and kept", f"{LEFT} is learnt and kept")
    for device, limb in ((RIGHT, Limb.RIGHT_HAND), (LEFT, Limb.LEFT_HAND)):
        kept = own_stick(device, page.folder)
        assert (kept.limb, kept.learnt, kept.tip_m) == (limb, True, 0.3)
    assert page.sent[1:] == [WatchSensors(on=False), ReloadDevice(RIGHT), ReloadDevice(LEFT)]


def test_what_the_gesture_does_not_show_is_said_and_nothing_is_kept(page: Page) -> None:
    page.here(RIGHT, LEFT)
    page.editor.advance(0)
    page.editor.act(LearnMounting())
    page.measure(RIGHT, measured(np.array([STILL] * (10 * FINE_HZ)), Sensor(100)), 4.0)
    page.complete(14.0)
    learnt = page.editor.view().learnt
    assert any(line.startswith(RIGHT) and "tapped" in line for line in learnt)
    assert f"{LEFT}: nothing came from it" in learnt
    assert not page.folder.exists()


def test_one_stick_alone_keeps_the_hand_that_was_chosen(page: Page) -> None:
    page.here(RIGHT, mounting=Mounting(Limb.LEFT_HAND))
    page.editor.advance(0)
    page.editor.act(LearnMounting())
    page.measure(RIGHT, measured(taps(3.0), Sensor(200)), 4.0)
    page.complete(14.0)
    assert own_stick(RIGHT, page.folder).limb is Limb.LEFT_HAND
    assert any("only one stick" in line for line in page.editor.view().learnt)


@pytest.mark.parametrize(
    "end",
    [
        lambda editor: editor.act(GiveUpSticks()),
        lambda editor: editor.handle(SensorLost(ns_from_s(5), RIGHT)),
    ],
)
def test_a_gesture_that_is_given_up_changes_nothing(page: Page, end: Callable[[SticksEditor], None]) -> None:
    page.here(RIGHT)
    page.editor.act(LearnMounting())
    page.measure(RIGHT, measured(taps(3.0), Sensor(100)), 4.0)
    end(page.editor)
    page.editor.advance(ns_from_s(20.0))
    assert not page.editor.learns
    assert page.sent == [WatchSensors(on=True), WatchSensors(on=False)]
    assert not page.folder.exists()


def test_without_a_sensor_there_is_nothing_to_learn_from(page: Page) -> None:
    with pytest.raises(DeviceError, match="no sensor is here"):
        page.editor.act(LearnMounting())
    with pytest.raises(DeviceError, match="no sensor is here"):
        page.editor.act(LearnAir())
    assert page.sent == []


# --- in the air -------------------------------------------------------------------------------------------------------

KIT = AirKit((AirZone(Limb.RIGHT_HAND, Piece.SNARE, Zone.HEAD, 0.0, 0.0, 0.1, 0.2),))


def test_the_air_kit_is_played_where_it_is_set_and_asked_for(tmp_path: Path) -> None:
    page = Page(tmp_path)
    save_air(KIT, page.air)
    page.editor.begin()
    assert page.sent == []
    page.editor.act(PlayInAir(on=True))
    (asked,) = page.sent
    assert isinstance(asked, SetAirDrums)
    assert asked.kit is not None
    assert [zone.piece for zone in asked.kit.zones] == [Piece.SNARE]
    page.store.write()
    assert load_settings(tmp_path / "settings.toml").air_drums
    again = Page(tmp_path, air_drums=True)
    again.editor.begin()
    assert again.sent == [], "the engine begins with what is set"
    again.editor.act(PlayInAir(on=False))
    assert again.sent == [SetAirDrums(None)]


def test_a_stick_whose_hand_nobody_knows_learns_no_zones(page: Page) -> None:
    page.here(RIGHT)
    with pytest.raises(DeviceError, match="which hand holds which stick"):
        page.editor.act(LearnAir())


def test_zones_are_learnt_by_striking_them(page: Page) -> None:
    """A stick strikes the same place all the time: five pieces in one place, which is said."""
    page.here(RIGHT, mounting=Mounting(Limb.RIGHT_HAND, learnt=True))
    page.editor.act(LearnAir())
    assert page.sent == [WatchSensors(on=True), SetAirDrums(None)]
    lesson = page.editor.view().lesson
    assert lesson is not None
    assert lesson.asks == "right hand: strike where the snare shall be, 8 more"
    angle, _, _ = strokes_by_angle([Stroke(0.7, 0.12, 0.02, 0.5)] * 44, rest_s=1.0)
    samples = measured(angle, Sensor(200))
    page.measure(RIGHT, samples[: len(samples) // 2], 0.0)
    halfway = page.editor.view().lesson
    assert halfway is not None
    assert 0.3 < halfway.done < 0.7
    page.measure(RIGHT, samples[len(samples) // 2 :], 0.0)
    page.editor.advance(samples[-1].at_ns)
    view = page.editor.view()
    assert view.lesson is None
    assert view.learnt[0] == "5 zones are learnt and kept"
    assert "lie close" in view.learnt[1]
    assert [zone.piece for zone in read_air(page.air).zones] == [zone.piece for zone in view.zones]
    assert page.sent[2:] == [WatchSensors(on=False)]


def test_a_switch_lets_the_drummer_follow_the_phase(page: Page) -> None:
    page.editor.act(FollowPhase(on=True))
    assert page.store.now.follow_phase
    assert page.editor.view().follows_phase


def test_a_switch_lets_the_phase_sound_the_drill(page: Page) -> None:
    page.editor.act(SoundPhase(on=True))
    assert page.store.now.sound_phase
    assert page.editor.view().sounds_phase
