"""An engine that goes on: what a new process is told after one has ended. The processes are played by hand."""

from dataclasses import dataclass, field
from pathlib import Path

import pytest

from station.core.errors import DeviceError
from station.core.events import DeviceFound, DeviceLost, Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS, NS_PER_S
from station.engine.engine_config import WORN_OUT, EngineConfig, Prepare
from station.engine.messages import (
    AddCues,
    Bus,
    CaptureSaved,
    Command,
    EngineEvent,
    KeyHit,
    Notice,
    Play,
    Ready,
    RecordCapture,
    Resume,
    SetBacking,
    SetLevel,
    SetMaster,
    SetMidiOut,
    SetPiece,
    SetSounds,
    Started,
    Status,
    Stop,
    TrackPhase,
    Unheard,
)
from station.engine.supervisor import MOST_RESTARTS, RESTARTS_WITHIN_NS, EngineSupervisor
from tests.fakes.cues import clicks

KEY = KeyHit(123, Piece.SNARE, Zone.HEAD, 99)
KIT = "TD-17"


@dataclass
class HandPlayed:
    """A process that says what the test has it say."""

    says: list[EngineEvent] = field(default_factory=list)
    told: list[Command] = field(default_factory=list)
    prepared: Prepare | None = None
    config: EngineConfig | None = None
    exit_code: int | None = None
    is_closed: bool = False

    def prepare(self, sounds: Prepare) -> None:
        self.prepared = sounds

    def begin(self, config: EngineConfig) -> None:
        self.config = config

    def end(self, exit_code: int = -9) -> None:
        self.exit_code = exit_code

    def send(self, command: Command) -> None:
        if self.exit_code is not None:
            raise DeviceError("it has ended")
        self.told.append(command)

    def events(self, wait_s: float = 0.0) -> list[EngineEvent]:
        said, self.says = self.says, []
        if self.exit_code is not None and not said:
            raise DeviceError("it has ended")
        return said

    def close(self) -> list[EngineEvent]:
        self.is_closed = True
        return self.says


class House:
    """A lasting engine with all the processes that it has started, and a clock moved by hand."""

    def __init__(self) -> None:
        self.processes: list[HandPlayed] = []
        self.now_ns = 0
        self.engine = EngineSupervisor(EngineConfig(kits=()), self._start, lambda: self.now_ns)

    def _start(self) -> HandPlayed:
        self.processes.append(HandPlayed())
        return self.processes[-1]

    @property
    def working(self) -> HandPlayed:
        return [process for process in self.processes if process.config is not None][-1]

    def hears(self, *said: EngineEvent) -> list[EngineEvent]:
        self.working.says += said
        return self.engine.events()


def test_a_spare_waits_once_the_engine_is_ready() -> None:
    house = House()
    assert len(house.processes) == 1
    assert house.hears(Ready("card")) == [Ready("card")]
    assert [process.config is not None for process in house.processes] == [True, False]
    house.engine.close()
    assert all(process.is_closed for process in house.processes)


def test_a_spare_makes_the_sounds_ready_that_the_card_plays() -> None:
    house = House()
    house.hears(Ready("card", 44_100))
    assert house.processes[1].prepared == Prepare("acoustic", "bar", 44_100)  # the settings' defaults


def test_the_session_goes_on_in_the_spare() -> None:
    house = House()
    house.hears(Ready("card"), DeviceFound(1, KIT))
    first = house.working
    play = Play(clicks([0, 10]), 300 * NS_PER_MS)
    for command in (
        SetLevel(Bus.CLICK, 0.5),
        SetLevel(Bus.CLICK, 0.7),
        SetPiece(Piece.CRASH_1, 0.5),
        SetPiece(Piece.CRASH_1, 0.6),
        SetMidiOut("module"),
        TrackPhase(None, note="from here on"),
        RecordCapture(Path("take")),
        play,
    ):
        house.engine.send(command)
    house.hears(CaptureSaved(Path("take")), Started(500))
    first.end()
    told = house.hears()
    second = house.working
    assert second is not first
    assert second.config == first.config
    *before, resume = second.told
    *held, record, track = before
    assert held == [SetLevel(Bus.CLICK, 0.7), SetPiece(Piece.CRASH_1, 0.6), SetMidiOut("module")]
    assert record == RecordCapture(Path("take"))
    assert track == TrackPhase(None, note="from here on"), "its note belongs into the capture"
    assert isinstance(resume, Resume)
    assert resume.cues is play.cues
    assert resume.zero_ns == 500
    (notice,) = [event for event in [*told, *house.hears()] if isinstance(event, Notice)]
    assert "by signal 9" in notice.text
    assert "goes on" in notice.text


def test_the_sounds_and_the_level_of_all_hold_in_the_next_engine() -> None:
    house = House()
    house.hears(Ready("card"))
    for command in (SetSounds("brushes", "bar"), SetMaster(0.4), SetSounds("electronic", "wood")):
        house.engine.send(command)
    house.working.end()
    house.hears()
    assert house.working.told == [SetMaster(0.4), SetSounds("electronic", "wood")]


def test_what_was_said_before_the_end_is_heard_first() -> None:
    house = House()
    house.hears(Ready("card"))
    house.working.says.append(Started(7))
    house.working.end()
    assert house.engine.events() == [Started(7)]
    assert [type(event) for event in [*house.engine.events(), *house.engine.events()]] == [Notice]


def test_a_command_that_meets_a_dead_engine_reaches_the_next() -> None:
    house = House()
    house.hears(Ready("card"))
    house.working.end()
    house.engine.send(KEY)
    assert house.working.told == [KEY]
    house.working.end()
    house.engine.send(RecordCapture(Path("take")))
    assert house.working.told == [RecordCapture(Path("take"))]


def test_a_transport_that_had_not_started_starts_when_it_was_to() -> None:
    house = House()
    house.hears(Ready("card"))
    house.engine.send(Play(clicks([0]), 300 * NS_PER_MS))
    house.now_ns = 100 * NS_PER_MS
    house.working.end()
    house.hears()
    (play,) = house.working.told
    assert isinstance(play, Play)
    assert play.start_in_ns == 200 * NS_PER_MS


def test_what_is_over_is_not_begun_again() -> None:
    house = House()
    house.hears(Ready("card"))
    for command in (RecordCapture(Path("take")), Play(clicks([0]), 0), SetBacking(None), Stop(), RecordCapture(None)):
        house.engine.send(command)
    house.hears(Started(1), CaptureSaved(None))
    house.working.end()
    house.hears()
    assert house.working.told == [SetBacking(None)]


def test_a_capture_whose_end_was_not_told_is_ended_again() -> None:
    house = House()
    house.hears(Ready("card"))
    house.engine.send(RecordCapture(Path("take")))
    house.hears(CaptureSaved(Path("take")))
    house.engine.send(RecordCapture(None))
    house.working.end()
    house.hears()
    assert house.working.told == [RecordCapture(None)]


def test_a_kit_that_comes_back_is_no_news_and_one_that_does_not_is_lost() -> None:
    house = House()
    house.hears(Ready("card"), DeviceFound(1, KIT), DeviceFound(1, "SPD"))
    house.working.end()
    told = [*house.hears(), *house.hears(Ready("card"), DeviceFound(2, KIT))]
    assert not [event for event in told if isinstance(event, DeviceFound | DeviceLost)]
    status = Status(NS_PER_S, 0, 0, None, 0.0)
    assert [event for event in house.hears(status) if isinstance(event, DeviceLost)] == [DeviceLost(NS_PER_S, "SPD")]
    assert house.hears(status) == [status]


def test_an_engine_that_is_worn_out_says_that_sound_is_back() -> None:
    house = House()
    house.hears(Ready("card"))
    house.working.end(WORN_OUT)
    (notice,) = [event for event in [*house.hears(), *house.hears()] if isinstance(event, Notice)]
    assert "sound can be had again" in notice.text


def test_one_that_ends_again_and_again_ends_for_good() -> None:
    house = House()
    for _ in range(MOST_RESTARTS):
        house.working.end()
        house.hears()
    house.hears()
    house.working.end()
    with pytest.raises(DeviceError, match="has ended"):
        house.engine.events()
    house.now_ns += RESTARTS_WITHIN_NS
    assert [type(event) for event in [*house.hears(), *house.hears()]] == [Notice]
    assert house.working.exit_code is None


def test_what_was_said_before_an_end_that_a_command_finds_is_heard() -> None:
    house = House()
    house.hears(Ready("card"))
    stroke = Hit(5, Piece.SNARE, Zone.HEAD, 90)
    house.working.says.append(stroke)
    house.working.end()
    house.engine.send(SetLevel(Bus.CLICK, 0.5))
    assert house.working.told == [SetLevel(Bus.CLICK, 0.5)]
    assert [event for event in house.engine.events() if not isinstance(event, Notice)] == [stroke]


def unheard(said: list[EngineEvent]) -> list[EngineEvent]:
    return [event for event in said if isinstance(event, Unheard)]


def killed_at(house: House, at_ns: int, kits: int) -> list[EngineEvent]:
    """The engine is asked every 10 ms, and killed; what is said when that is found out."""
    house.hears(Ready("card"), *(DeviceFound(1, f"{KIT} {kit}") for kit in range(kits)))
    for house.now_ns in range(0, at_ns, 10 * NS_PER_MS):
        house.hears()
    house.working.end()
    house.now_ns = at_ns + 5 * NS_PER_MS
    return house.engine.events()


def test_it_says_from_when_until_when_no_stroke_could_be_heard() -> None:
    """From when it surely lived, two looks before its end was found, until both kits are heard again."""
    house = House()
    assert not unheard(killed_at(house, NS_PER_S, kits=2))
    house.now_ns = NS_PER_S + 600 * NS_PER_MS
    assert not unheard(house.hears(Ready("card"), DeviceFound(house.now_ns, f"{KIT} 0")))
    back_ns = house.now_ns + 30 * NS_PER_MS
    assert unheard(house.hears(DeviceFound(back_ns, f"{KIT} 1"))) == [Unheard(980 * NS_PER_MS, back_ns)]
    assert not unheard(house.hears(Status(back_ns + NS_PER_S, 0, 0, None, 0.0)))


def test_a_kit_that_does_not_come_back_is_not_waited_for() -> None:
    house = House()
    killed_at(house, NS_PER_S, kits=1)
    house.hears(Ready("card"))
    said = house.hears(Status(2 * NS_PER_S, 0, 0, None, 0.0))
    assert unheard(said) == [Unheard(980 * NS_PER_MS, 2 * NS_PER_S)]
    assert DeviceLost(2 * NS_PER_S, f"{KIT} 0") in said


def test_without_a_kit_it_hears_again_as_soon_as_it_is_ready() -> None:
    house = House()
    killed_at(house, NS_PER_S, kits=0)
    house.now_ns = NS_PER_S + 300 * NS_PER_MS
    assert unheard(house.hears(Ready("card"))) == [Unheard(980 * NS_PER_MS, house.now_ns)]


def test_an_engine_that_is_killed_twice_was_deaf_from_the_first_time() -> None:
    house = House()
    killed_at(house, NS_PER_S, kits=1)
    house.working.end()
    house.now_ns = NS_PER_S + 200 * NS_PER_MS
    house.engine.events()
    back_ns = 2 * NS_PER_S
    assert unheard(house.hears(Ready("card"), DeviceFound(back_ns, f"{KIT} 0"))) == [Unheard(980 * NS_PER_MS, back_ns)]


def test_a_server_may_end_as_often_as_it_likes() -> None:
    """A new engine for a sound server that is back is nobody's fault; one that fails again and again is."""
    house = House()
    house.hears(Ready("card"))
    for _ in range(10):
        house.working.end(WORN_OUT)
        assert [event.text for event in house.engine.events() if isinstance(event, Notice)]
        house.hears(Ready("card"))
    for _ in range(MOST_RESTARTS):
        house.working.end(-6)
        house.engine.events()
    house.working.end(-6)
    with pytest.raises(DeviceError):
        house.engine.events()


def test_cues_that_were_added_sound_in_the_next_engine_too() -> None:
    house = House()
    house.hears(Ready("card"))
    house.engine.send(Play(clicks([0, 10]), 0))
    house.hears(Started(500))
    house.engine.send(AddCues(clicks([20])))
    house.working.end()
    house.engine.send(AddCues(clicks([30])))  # meets a dead engine: sent once, with all that holds
    (resume,) = house.working.told
    assert isinstance(resume, Resume)
    assert resume.zero_ns == 500
    assert resume.cues["at_ns"].tolist() == [0, 10, 20, 30]


def test_cues_added_after_the_stop_are_forgotten() -> None:
    house = House()
    house.hears(Ready("card"))
    for command in (Play(clicks([0]), 0), Stop(), AddCues(clicks([20]))):
        house.engine.send(command)
    house.working.end()
    house.hears()
    assert house.working.told == []
