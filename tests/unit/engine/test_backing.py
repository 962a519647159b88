from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.units import NS_PER_MS, NS_PER_S
from station.engine.engine import Engine
from station.engine.messages import CUE_DTYPE, Notice, Play, SetBacking, Stop
from station.engine.pipes import with_track
from station.sound.track import PreparedTrack, Track
from tests.fakes.impulse_kit import impulse_mixer

RATE_HZ = 48_000
BLOCK = 480
BLOCK_NS = 10 * NS_PER_MS
NO_CUES = np.zeros(0, CUE_DTYPE)


def prepared(folder: Path, rate_hz: int = RATE_HZ) -> PreparedTrack:
    """Each frame of the file holds its own number."""
    pcm = np.repeat(np.arange(30_000, dtype=np.int16)[:, None], 2, axis=1)
    pcm.tofile(folder / "a.track")
    return PreparedTrack(folder / "a.track", rate_hz, 0, None)


def heard(engine: Engine, from_block: int, blocks: int, block_ns: int = BLOCK_NS) -> NDArray[np.float32]:
    """The numbers of the frames that sound, block after block."""
    parts = [engine.render(BLOCK, index * block_ns) for index in range(from_block, from_block + blocks)]
    return np.concatenate(parts)[:, 0] * 32768.0


def test_the_track_starts_on_its_frame_after_the_transport(tmp_path: Path) -> None:
    engine = Engine(impulse_mixer(RATE_HZ))
    engine.handle(SetBacking(prepared(tmp_path), at_ns=25 * NS_PER_MS))
    engine.handle(Play(NO_CUES, start_in_ns=0))
    sound = heard(engine, 0, 6)
    start = 25 * RATE_HZ // 1000
    assert np.all(sound[:start] == 0.0)
    assert sound[start:].tolist() == list(range(len(sound) - start))


def test_no_transport_no_track(tmp_path: Path) -> None:
    engine = Engine(impulse_mixer(RATE_HZ))
    engine.handle(SetBacking(prepared(tmp_path)))
    assert np.all(heard(engine, 0, 4) == 0.0)


def test_it_stops_with_the_transport_and_starts_again_from_its_start(tmp_path: Path) -> None:
    engine = Engine(impulse_mixer(RATE_HZ))
    engine.handle(SetBacking(prepared(tmp_path)))
    engine.handle(Play(NO_CUES, start_in_ns=0))
    heard(engine, 0, 10)
    engine.handle(Stop())
    assert np.all(heard(engine, 10, 3)[BLOCK:] == 0.0)
    engine.advance(13 * BLOCK_NS)
    engine.handle(Play(NO_CUES, start_in_ns=0))
    assert heard(engine, 13, 2).tolist() == list(range(2 * BLOCK))


def test_it_keeps_to_the_transport_whatever_the_cards_clock(tmp_path: Path) -> None:
    """A card 200 ppm slow: after 50 blocks the frames lag by 4.8; the track makes up for all but the slack of 2."""
    engine = Engine(impulse_mixer(RATE_HZ))
    engine.handle(SetBacking(prepared(tmp_path)))
    engine.handle(Play(NO_CUES, start_in_ns=0))
    slow_ns = round(BLOCK_NS * 1.0002)
    last = heard(engine, 0, 50, slow_ns)[-1]
    true = (49 * slow_ns) * RATE_HZ / NS_PER_S + BLOCK - 1
    assert abs(last - true) <= 3.0
    assert true - (50 * BLOCK - 1) > 4.0


def test_a_card_that_comes_back_finds_the_track_where_it_should_be(tmp_path: Path) -> None:
    engine = Engine(impulse_mixer(RATE_HZ))
    engine.handle(SetBacking(prepared(tmp_path)))
    engine.handle(Play(NO_CUES, start_in_ns=0))
    heard(engine, 0, 5)
    engine.attach(None)
    engine.attach(impulse_mixer(RATE_HZ))
    assert heard(engine, 20, 3)[-1] == pytest.approx(23 * BLOCK - 1)


def test_no_track_is_silence(tmp_path: Path) -> None:
    engine = Engine(impulse_mixer(RATE_HZ))
    engine.handle(SetBacking(prepared(tmp_path)))
    engine.handle(Play(NO_CUES, start_in_ns=0))
    heard(engine, 0, 5)
    engine.handle(SetBacking(None))
    assert np.all(heard(engine, 5, 3)[BLOCK:] == 0.0)


def test_another_rate_is_told_and_mute(tmp_path: Path) -> None:
    engine = Engine(impulse_mixer(RATE_HZ))
    engine.handle(SetBacking(prepared(tmp_path, 44_100)))
    engine.handle(Play(NO_CUES, start_in_ns=0))
    assert np.all(heard(engine, 0, 5) == 0.0)
    assert any(isinstance(event, Notice) and "44100 Hz" in event.text for event in engine.advance(0))


def test_a_file_that_is_gone_is_told(tmp_path: Path) -> None:
    engine = Engine(impulse_mixer(RATE_HZ))
    engine.handle(with_track(SetBacking(PreparedTrack(tmp_path / "gone.track", RATE_HZ, 0, None))))
    assert any(isinstance(event, Notice) and "choose its file again" in event.text for event in engine.advance(0))


def test_the_file_is_read_where_nobody_waits(tmp_path: Path) -> None:
    command = with_track(SetBacking(prepared(tmp_path)))
    assert isinstance(command, SetBacking)
    assert isinstance(command.loaded, Track)
    (tmp_path / "a.track").unlink()
    engine = Engine(impulse_mixer(RATE_HZ))
    engine.handle(command)
    engine.handle(Play(NO_CUES, start_in_ns=0))
    assert heard(engine, 0, 1).tolist() == list(range(BLOCK))
