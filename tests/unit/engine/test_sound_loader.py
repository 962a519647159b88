"""Kits and clicks read beside the sound: the last request counts, a fault leaves what sounds."""

import threading

from station.core.errors import BadInput
from station.engine.messages import SetSounds
from station.engine.sound_loader import ReadSounds, SoundLoader
from station.sound.drum_kit import DrumKit
from tests.fakes.impulse_kit import impulse_mixer

RATE_HZ = 48_000


class Reader:
    """Reads when it is let; remembers what it was asked for."""

    def __init__(self) -> None:
        self.asked: list[str] = []
        self.may = threading.Event()

    def read(self, name: str, rate_hz: int) -> DrumKit:
        self.asked.append(name)
        self.may.wait(10.0)
        if name == "gone":
            raise BadInput(name, "", "no such drum kit")
        return impulse_mixer(rate_hz).kit


def read_by(loader: SoundLoader) -> ReadSounds:
    while (read := loader.advance(RATE_HZ)) is None:
        pass
    return read


def test_of_requests_that_come_meanwhile_the_last_one_is_taken() -> None:
    reader = Reader()
    loader = SoundLoader(SetSounds("acoustic", "bar"), reader.read, lambda *_: {})
    for drums in ("brushes", "shed", "electronic"):
        loader.ask(SetSounds(drums, "bar"))
        assert loader.advance(RATE_HZ) is None
    reader.may.set()
    assert read_by(loader).asked == SetSounds("electronic", "bar")
    assert reader.asked == ["brushes", "electronic"]
    assert loader.now == SetSounds("electronic", "bar")


def test_what_cannot_be_read_leaves_what_sounds() -> None:
    reader = Reader()
    reader.may.set()
    loader = SoundLoader(SetSounds("acoustic", "bar"), reader.read, lambda *_: {})
    loader.ask(SetSounds("gone", "bar"))
    read = read_by(loader)
    assert read.kit is None
    assert "no such drum kit" in str(read.fault)
    assert loader.now == SetSounds("acoustic", "bar")


def test_without_a_card_nothing_is_read_and_the_next_card_sounds_by_it() -> None:
    reader = Reader()
    loader = SoundLoader(SetSounds("acoustic", "bar"), reader.read, lambda *_: {})
    loader.ask(SetSounds("brushes", "wood"))
    told = loader.advance(None)
    assert told is not None
    assert told.fault is None
    assert loader.now == SetSounds("brushes", "wood")
    assert reader.asked == []
