"""One step after another, with a fake driver and a fake card."""

from collections.abc import Callable
from pathlib import Path

from station.core.events import DeviceFound, DeviceLost, Hit
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.capture.capture import read_capture
from station.devices.capture.replay import replay
from station.devices.port_watch import PortWatch
from station.engine.card import Card
from station.engine.engine import Engine
from station.engine.engine_step import LET_IN_S, Runner
from station.engine.messages import EngineEvent, RecordCapture
from tests.fakes.impulse_kit import impulse_mixer
from tests.fakes.output import FakeOutput
from tests.fakes.ports import FakeDriver

SNARE = bytes.fromhex("99 26 64")
PORT, DEVICE = "TD-17 20:0", "TD-17"


def no_pause(_: float) -> None:
    pass


def runner_of(
    driver: FakeDriver,
    *parts: str,
    output: FakeOutput | None = None,
    pause: Callable[[float], None] = no_pause,
) -> Runner:
    engine = Engine()
    card = Card(engine, lambda: output, impulse_mixer) if output is not None else None
    return Runner(engine, [PortWatch(driver, part) for part in parts], card, pause)


def run(runner: Runner, from_ms: int, to_ms: int) -> list[EngineEvent]:
    return [event for at_ms in range(from_ms, to_ms) for event in runner.step(at_ms * NS_PER_MS)]


def test_a_kit_is_there_from_the_first_step_and_heard() -> None:
    driver = FakeDriver(PORT)
    runner = runner_of(driver, "td")
    runner.start(0)
    driver.play(PORT, SNARE, 77)
    events = runner.step(NS_PER_MS)
    assert events[0] == DeviceFound(0, DEVICE)
    assert isinstance(events[1], Hit)
    assert (events[1].at_ns, events[1].device) == (77, DEVICE)


def test_several_kits_are_heard_at_once() -> None:
    driver = FakeDriver(PORT, "Nitro 21:0")
    runner = runner_of(driver, "td", "nitro")
    runner.start(0)
    driver.play(PORT, SNARE, 1)
    driver.play("Nitro 21:0", SNARE, 2)
    hits = [event.device for event in run(runner, 1, 3) if isinstance(event, Hit)]
    assert hits == [DEVICE, "Nitro"]


def test_a_port_that_vanishes_in_mid_bar_costs_no_earlier_hit(tmp_path: Path) -> None:
    driver = FakeDriver(PORT)
    runner = runner_of(driver, "td")
    runner.start(0)
    run(runner, 1, 2)
    runner.engine.handle(RecordCapture(tmp_path / "take.cap"))
    driver.play(PORT, SNARE, 1)
    driver.unplug(PORT)
    events = run(runner, 1, 1_000)
    driver.plug("TD-17 28:0")
    events += run(runner, 1_000, 2_000)
    driver.play("TD-17 28:0", SNARE, 2 * NS_PER_S)
    events += run(runner, 2_000, 2_010)
    runner.close()
    kinds = [type(event) for event in events if isinstance(event, Hit | DeviceLost | DeviceFound)]
    assert kinds == [Hit, DeviceLost, DeviceFound, Hit]
    assert [type(event) for event in replay(read_capture(tmp_path / "take.cap"))] == kinds


def test_a_stroke_that_comes_just_after_its_block_was_asked_for_sounds_in_it() -> None:
    """JACK hands out MIDI and asks for sound at one moment, in either order."""
    driver, output, pauses_s = FakeDriver(PORT), FakeOutput(), []

    def other_thread(pause_s: float) -> None:
        pauses_s.append(pause_s)
        driver.play(PORT, SNARE, 1)

    runner = runner_of(driver, "td", output=output, pause=other_thread)
    runner.start(0)
    assert not output.ask(32, 0).any()  # two thirds of a millisecond: no time to wait
    assert output.ask(128, 1).any()
    assert pauses_s == [LET_IN_S]


def test_the_kits_are_opened_before_the_card_and_left_after_it() -> None:
    driver, output = FakeDriver(PORT), FakeOutput()
    runner = runner_of(driver, "td", output=output)
    runner.start(0)
    assert (driver.open_connections, output.calls) == (1, ["start"])
    runner.close()
    assert (driver.open_connections, output.calls) == (0, ["start", "close"])


def test_a_stroke_that_has_just_come_sounds_in_the_block_that_is_being_mixed() -> None:
    driver, output = FakeDriver(PORT), FakeOutput()
    runner = runner_of(driver, "td", output=output)
    runner.start(0)
    runner.step(NS_PER_MS)
    assert not output.ask(64, 0).any()
    driver.play(PORT, SNARE, 77)
    block = output.ask(64, NS_PER_MS)
    assert block[0].any()
    (hit,) = [event for event in run(runner, 2, 4) if isinstance(event, Hit)]
    assert hit.at_ns == 77
    assert not output.ask(64, 2 * NS_PER_MS).any()  # once


def test_a_block_waits_for_nobody_who_holds_the_engine_long() -> None:
    """As where a port is being opened; a kit that is pulled out meanwhile is found out by the next step."""
    driver, output = FakeDriver(PORT), FakeOutput()
    runner = runner_of(driver, "td", output=output)
    runner.start(0)
    driver.play(PORT, SNARE, 77)
    with runner._engine_lock:
        assert not output.ask(64, 0).any()  # a block that waited for the lock would never be mixed
    driver.unplug(PORT)
    output.ask(64, NS_PER_MS)
    events = run(runner, 1, 1000)
    assert [type(event) for event in events if isinstance(event, Hit | DeviceLost)] == [Hit, DeviceLost]
