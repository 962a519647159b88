"""Pauses of a session without a window, asked for by the kit: an engine that moves the clock, strokes on its transport.

Rock at 80 quarters a minute: a bar of four takes three seconds. Bars are counted by hand.
"""

from pathlib import Path

import pytest

from station.core.clock import ManualClock
from station.core.events import DeviceFound, Hit, Switched
from station.core.pieces import Piece, Zone
from station.core.settings import Settings
from station.core.units import NS_PER_S
from station.drills.library import find_lesson
from station.engine.messages import CaptureSaved, Command, EngineEvent, Play, RecordCapture, Started, Stop
from station.practice.control.pad_commands import PadCommands, ways_to_go_on
from station.practice.headless.live import LiveOutcome, LiveSetup, practise_live
from station.practice.session.device_latency import Latency
from station.practice.session.plan import PlanOptions, plan_practice
from station.practice.session.runner import SessionRunner

PLAN = plan_practice(find_lesson("rock-1"), PlanOptions(tempo_bpm=80.0, loops=4, demonstrations=0))
BAR_NS = 3 * NS_PER_S
LOOK_NS = NS_PER_S // 4
LONGEST_NS = 40 * BAR_NS
PAUSE_BAR = 2
KICK, CRASH, OTHER_CRASH = Piece.KICK, Piece.CRASH_1, Piece.CRASH_2

Planned = tuple[float, Piece | str]


class Engine:
    """Each look is a quarter of a second later. `first` is played in bars from the first bar, `later` after a stop."""

    def __init__(self, clock: ManualClock, first: list[Planned], later: list[Planned]) -> None:
        self._clock, self._first, self._later = clock, first, later
        self._coming: list[EngineEvent] = []
        self._said: list[EngineEvent] = [DeviceFound(0, "kit")]
        self.sent: list[type[Command]] = []

    def send(self, command: Command) -> None:
        self.sent.append(type(command))
        if isinstance(command, Play):
            zero_ns = self._clock.now_ns() + command.start_in_ns
            self._said.append(Started(zero_ns))
            self._plan(zero_ns + PLAN.passes_start_ns, self._first)
            self._first = []
        elif isinstance(command, Stop):
            self._plan(self._clock.now_ns(), self._later)
            self._later = []
        elif isinstance(command, RecordCapture):
            self._said.append(CaptureSaved(command.path))

    def _plan(self, from_ns: int, strokes: list[Planned]) -> None:
        for bars, what in strokes:
            at_ns = from_ns + round(bars * BAR_NS)
            hit = Switched(at_ns, what) if isinstance(what, str) else Hit(at_ns, what, Zone.HEAD, 90)
            self._coming.append(hit)

    def events(self, wait_s: float = 0.0) -> list[EngineEvent]:
        del wait_s
        self._clock.advance_to(self._clock.now_ns() + LOOK_NS)
        assert self._clock.now_ns() < LONGEST_NS, "it waits for ever"
        now_ns = self._clock.now_ns()
        come = [event for event in self._coming if event.at_ns <= now_ns]  # type: ignore[union-attr] # hits and switches
        self._coming = [event for event in self._coming if event not in come]
        said, self._said = [*self._said, *come], []
        return said


def played(
    tmp_path: Path, first: list[Planned], later: list[Planned], waits: bool = False, **chosen: object
) -> tuple[LiveOutcome, Engine]:
    clock = ManualClock()
    engine, settings = Engine(clock, first, later), Settings(**chosen)  # type: ignore[arg-type] # what a test chooses
    runner = SessionRunner(PLAN, Latency(), PadCommands(settings, PLAN.score))
    runner.session.waits = waits
    return practise_live(LiveSetup(engine, clock, lambda *_: None), runner, tmp_path / "x"), engine


@pytest.mark.parametrize(
    ("pause", "again"),
    [
        ([(PAUSE_BAR, CRASH), (PAUSE_BAR, OTHER_CRASH)], [(1, KICK), (1.1, KICK)]),
        ([(PAUSE_BAR, "cc=64")], [(1, "cc=64")]),
        ([(PAUSE_BAR, "cc=64")], [(1, CRASH), (1, OTHER_CRASH)]),
    ],
)
def test_the_kit_pauses_and_goes_on_from_the_bar_of_the_last_stroke(
    tmp_path: Path, pause: list[Planned], again: list[Planned]
) -> None:
    outcome, engine = played(tmp_path, [(0, KICK), (1.25, Piece.SNARE), *pause], again)
    assert engine.sent.count(Play) == 2
    assert [(one.bar, one.asked, one.strokes) for one in outcome.result.pauses] == [(1, True, 1)]
    assert outcome.result.complete
    assert len(outcome.result.performance) == 1, "the gesture is no stroke, and what was taken back is played again"


def test_silence_waits_only_for_somebody(tmp_path: Path) -> None:
    """Played until the second bar; after two silent ones, and a look or two, two kicks go on there."""
    strokes: list[Planned] = [(0, KICK), (1.25, Piece.SNARE)]
    again: list[Planned] = [(3, KICK), (3.1, KICK), *((4 + bar, Piece.SNARE) for bar in range(40))]
    outcome, engine = played(tmp_path, strokes, again, waits=True)
    assert [(one.bar, one.asked) for one in outcome.result.pauses] == [(1, False)]
    _, engine = played(tmp_path, strokes, [])
    assert engine.sent.count(Play) == 1


def test_it_is_said_what_goes_on() -> None:
    assert ways_to_go_on(Settings()) == ("two kicks", "crash_1+crash_2", "cc=64")
    assert ways_to_go_on(Settings(kicks_start=False, pause="")) == ()
