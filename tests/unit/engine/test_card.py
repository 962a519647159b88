"""The sound card's comings and goings, with a fake device that is asked by hand."""

from dataclasses import dataclass, field

import pytest

from station.core.errors import DeviceError
from station.core.units import NS_PER_MS, NS_PER_S
from station.engine.card import RETRY_NS, STALLED_NS, Card
from station.engine.engine import Engine
from station.engine.hotplug import Hotplug
from station.engine.messages import Notice, Play, Sounding, Started, Status, Stop
from station.sound.mixer import Mixer
from station.sound.output.card_stream import SoundDevice
from station.sound.output.portaudio import SoundServerGone
from tests.fakes.cues import clicks
from tests.fakes.impulse_kit import impulse_mixer
from tests.fakes.output import FakeOutput


@dataclass
class Shop:
    """Hands out the outputs in turn; one that is None cannot be opened."""

    outputs: list[FakeOutput | None]
    built_hz: list[int] = field(default_factory=list)

    is_gone: bool = False

    def open(self) -> FakeOutput:
        if self.is_gone:
            raise SoundServerGone("the server has ended")
        output = self.outputs.pop(0) if self.outputs else None
        if output is None:
            raise DeviceError("no sound device is there")
        return output

    def build(self, rate_hz: int) -> Mixer:
        self.built_hz.append(rate_hz)
        return impulse_mixer(rate_hz)


def card_of(engine: Engine, *outputs: FakeOutput | None) -> tuple[Card, Shop]:
    shop = Shop(list(outputs))
    return Card(engine, shop.open, shop.build), shop


def notices(engine: Engine, now_ns: int = 0) -> list[str]:
    return [event.text for event in engine.advance(now_ns) if isinstance(event, Notice)]


def test_a_card_sounds() -> None:
    engine, output = Engine(), FakeOutput()
    card, _ = card_of(engine, output)
    card.start(0)
    engine.handle(Play(clicks([0]), 0))
    assert output.ask(64, 0).any()
    assert card.name == "fake card"
    assert notices(engine) == []


def test_the_drum_kit_is_made_for_the_cards_rate() -> None:
    card, shop = card_of(Engine(), FakeOutput("card", 44_100))
    card.start(0)
    assert shop.built_hz == [44_100]


@pytest.mark.parametrize("output", [None, FakeOutput("card", 48_000, "start")])
def test_without_a_card_the_engine_says_so_once_and_runs_silent(output: FakeOutput | None) -> None:
    engine = Engine()
    card, _ = card_of(engine, output)
    card.start(0)
    engine.handle(Play(clicks([0]), 0))
    events = engine.advance(0)
    for now_ns in range(0, 60 * NS_PER_S, NS_PER_S):
        card.supervise(now_ns)
    events += engine.advance(60 * NS_PER_S)
    assert len([event for event in events if isinstance(event, Notice)]) == 1
    assert [event for event in events if isinstance(event, Started)] == [Started(0)]
    assert card.name is None


def test_a_card_that_does_not_start_is_given_back() -> None:
    output = FakeOutput("card", 48_000, "start")
    card, _ = card_of(Engine(), output)
    card.start(0)
    assert output.calls == ["start", "close"]


def test_a_card_that_stops_is_told_and_found_again() -> None:
    engine = Engine()
    first, second = FakeOutput("first"), FakeOutput("second")
    card, shop = card_of(engine, first, None, second)
    card.start(0)
    first.fault = DeviceError("it was unplugged")
    first.underflows = 4
    card.supervise(NS_PER_S)
    assert first.calls[-1] == "close"
    assert "it was unplugged" in notices(engine)[0]
    for now_ns in range(NS_PER_S, NS_PER_S + 2 * RETRY_NS + 1, 100 * NS_PER_MS):
        card.supervise(now_ns)
    assert notices(engine) == ["sound is back on second"]
    assert second.calls == ["start"]
    assert shop.built_hz == [48_000]  # the kit is kept
    card.supervise(20 * NS_PER_S)
    assert engine.output.underflows == 4


def test_a_card_that_asks_for_nothing_has_stopped() -> None:
    engine, output = Engine(), FakeOutput()
    card, _ = card_of(engine, output)
    card.start(0)
    for second in range(1, 4):
        output.ask(64, second * NS_PER_S)
        card.supervise(second * NS_PER_S)
    assert output.calls == ["start"]
    card.supervise(3 * NS_PER_S + STALLED_NS + 1)
    assert output.calls[-1] == "close"
    assert "asks for no more sound" in notices(engine)[0]


def test_the_cards_figures_reach_the_status() -> None:
    engine, output = Engine(), FakeOutput()
    card, _ = card_of(engine, output)
    card.start(0)
    output.underflows = 7
    card.supervise(1)
    engine.advance(0)
    (status,) = [event for event in engine.advance(NS_PER_S) if isinstance(event, Status)]
    assert (status.underflows, status.output_latency_ms, status.load) == (7, 3.0, 0.25)


def test_the_sound_is_kept_still_and_goes_on() -> None:
    output = FakeOutput()
    card, _ = card_of(Engine(), output)
    card.start(0)
    with card.paused():
        assert output.calls == ["start", "pause"]
    assert output.calls == ["start", "pause", "resume"]


@pytest.mark.parametrize("fault", ["pause", "resume"])
def test_a_card_that_fails_to_pause_or_resume_is_lost(fault: str) -> None:
    engine, output = Engine(), FakeOutput("card", 48_000, fault)
    card, _ = card_of(engine, output)
    card.start(0)
    with card.paused():
        pass
    assert output.calls[-1] == "close"
    assert card.name is None
    assert f"{fault} failed" in notices(engine)[0]


def test_there_is_nothing_to_keep_still_without_a_card() -> None:
    card, _ = card_of(Engine(), None)
    with card.paused():
        pass


def test_closing_gives_the_card_back_and_leaves_the_engine_silent() -> None:
    engine, output = Engine(), FakeOutput()
    card, _ = card_of(engine, output)
    card.start(0)
    card.close()
    card.close()
    assert output.calls == ["start", "close"]
    engine.handle(Play(clicks([0]), 0))
    assert engine.advance(0) == [Started(0)]


# --- what there is to sound on changes -------------------------------------------------------------------------------


@dataclass
class Street:
    """The sound devices that come and go."""

    devices: list[SoundDevice] = field(default_factory=list)
    looks: int = 0

    def look(self) -> list[SoundDevice]:
        self.looks += 1
        if not self.devices:
            raise DeviceError("there is none")
        return self.devices


def device(name: str, is_default: bool = True) -> SoundDevice:
    return SoundDevice(0, name, "fake host", 2, 48_000, is_default)


def seen(hotplug: Hotplug) -> None:
    """Wait until the look that is on its way is done."""
    if hotplug._looking is not None:
        hotplug._looking.join()


def test_after_a_sound_servers_death_the_engine_wears_out_as_soon_as_there_is_an_output() -> None:
    engine, street, shop = Engine(), Street(), Shop([FakeOutput("jack")])
    hotplug = Hotplug("", street.look)
    card = Card(engine, shop.open, shop.build, hotplug)
    card.start(0)
    shop.outputs[:] = []
    shop.is_gone = True
    card._output.fault = DeviceError("its server ended")  # type: ignore[union-attr, misc]
    told = []
    for step in range(100):
        if step == 60:
            street.devices = [device("jack")]
        card.supervise(step * NS_PER_S // 2)
        seen(hotplug)
        told += engine.advance(step)
        if step < 60:
            assert not card.is_worn_out
    assert card.is_worn_out
    assert len([event for event in told if isinstance(event, Notice)]) == 1  # when it went
    assert [event for event in told if isinstance(event, Sounding)] == [Sounding(None)]


def test_a_card_that_was_missing_from_the_start_sounds_when_it_comes_while_nothing_plays() -> None:
    """The first that comes cannot be opened."""
    engine, street, shop = Engine(), Street(), Shop([None, None, FakeOutput("phones")])
    hotplug = Hotplug("phones", street.look)
    card = Card(engine, shop.open, shop.build, hotplug)
    card.start(0)
    told: list[object] = []

    def go_by(seconds: range) -> None:
        for second in seconds:
            if card.name is None:
                card.supervise(second * NS_PER_S)
                seen(hotplug)
                told.extend(engine.advance(second * NS_PER_S))

    go_by(range(1, 10))
    assert street.looks == 0, "the start has just looked"
    go_by(range(10, 40))
    assert 2 <= street.looks <= 4
    assert len(shop.outputs) == 2, "what is not there is not opened"
    street.devices = [device("phones")]
    engine.handle(Play(clicks([0, 3600 * NS_PER_S]), 0))
    go_by(range(40, 80))
    assert len(shop.outputs) == 2, "not while it plays"
    engine.handle(Stop())
    go_by(range(80, 120))
    assert card.name == "phones"
    texts = [event.text for event in told if isinstance(event, Notice)]
    assert texts[0].startswith("running silent")
    texts += [event.text for event in engine.advance(120 * NS_PER_S) if isinstance(event, Notice)]
    assert texts[1:] == ["sound goes to phones"]


def test_the_sound_follows_the_systems_default_while_nothing_plays() -> None:
    engine, street, shop = Engine(), Street([device("speakers")]), Shop([FakeOutput("speakers"), FakeOutput("phones")])
    hotplug = Hotplug("", street.look)
    card = Card(engine, shop.open, shop.build, hotplug)
    card.start(0)
    first = card._output
    assert isinstance(first, FakeOutput)
    engine.handle(Play(clicks([0, 3600 * NS_PER_S]), 0))

    def go_by(seconds: range) -> list[object]:
        told: list[object] = []
        for second in seconds:
            assert isinstance(card._output, FakeOutput)
            card._output.ask(64, second * NS_PER_S)
            card.supervise(second * NS_PER_S)
            seen(hotplug)
            told += engine.advance(second * NS_PER_S)
        return told

    go_by(range(1, 30))
    assert street.looks == 0  # it plays
    engine.handle(Stop())
    go_by(range(30, 60))
    assert street.looks > 1
    assert card.name == "speakers"
    street.devices = [device("phones"), device("speakers", False)]
    told = go_by(range(60, 72))
    assert card.name == "phones"
    assert first.calls[-1] == "close"
    assert [event for event in told if isinstance(event, Sounding)] == [Sounding("phones", 48_000)]
    assert "sound goes to phones" in " ".join(event.text for event in told if isinstance(event, Notice))


@pytest.mark.parametrize(
    ("wanted", "devices"),
    [
        ("speakers", [device("phones"), device("speakers", False)]),  # the user has chosen
        ("", [device("phones", False), device("speakers", False)]),  # there is no default
        ("", []),
    ],
)
def test_the_sound_stays_where_it_was_chosen(wanted: str, devices: list[SoundDevice]) -> None:
    engine, shop = Engine(), Shop([FakeOutput("speakers"), FakeOutput("phones")])
    hotplug = Hotplug(wanted, Street(devices).look)
    card = Card(engine, shop.open, shop.build, hotplug)
    card.start(0)
    for second in range(1, 40):
        assert isinstance(card._output, FakeOutput)
        card._output.ask(64, second * NS_PER_S)
        card.supervise(second * NS_PER_S)
        seen(hotplug)
    assert card.name == "speakers"


def test_a_mixer_that_takes_seconds_to_make_is_no_stall() -> None:
    """The kit is made once for each rate; the card has had no time yet to ask for a block."""
    engine, output = Engine(), FakeOutput()
    card, _ = card_of(engine, output)
    card.start(0)
    card.supervise(STALLED_NS + 1)
    assert output.calls == ["start"]
    card.supervise(2 * STALLED_NS + 2)
    assert output.calls == ["start", "close"]


def test_a_jack_server_that_has_ended_is_looked_for_twice_a_second() -> None:
    """A look and a new engine come on top: it is heard again within two seconds."""
    engine, street = Engine(), Street()
    jack = FakeOutput("system")
    jack.host = "JACK Audio Connection Kit"
    shop = Shop([jack])
    hotplug = Hotplug("", street.look)
    card = Card(engine, shop.open, shop.build, hotplug)
    card.start(0)
    jack.fault = DeviceError("its server ended")
    back_ns = 20 * NS_PER_S
    now_ns = 0
    while not card.is_worn_out:
        now_ns += 10 * NS_PER_MS
        if now_ns == back_ns:
            street.devices = [device("system")]
        card.supervise(now_ns)
        seen(hotplug)
    assert now_ns - back_ns <= NS_PER_S // 2 + 20 * NS_PER_MS
    assert not shop.outputs, "nothing is opened in this process again"
