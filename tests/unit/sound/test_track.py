from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from station.core.errors import DeviceError
from station.core.note_map import NoteMeaning
from station.core.pieces import Piece
from station.sound.buses import Bus
from station.sound.track import EDGE_S, LEAVE_S, SEAM_S, TRACK_JUMP_S, PreparedTrack, Track, TrackVoice, load
from tests.unit.sound.kits import RATE_HZ, impulse, mixer_of

EDGE = round(EDGE_S * RATE_HZ)
SEAM = round(SEAM_S * RATE_HZ)


def ramp_track(frames: int = 9000, start: int = 0, loop: tuple[int, int] | None = None) -> Track:
    """Each frame holds its own number, so that a position can be read off."""
    return Track(np.repeat(np.arange(frames, dtype=np.int16)[:, None], 2, axis=1), RATE_HZ, start, loop)


def tone_track(frames: int, freq_hz: float, loop: tuple[int, int] | None = None, start: int = 0) -> Track:
    tone = np.rint(16_000 * np.sin(2 * np.pi * freq_hz * np.arange(frames) / RATE_HZ)).astype(np.int16)
    return Track(np.repeat(tone[:, None], 2, axis=1), RATE_HZ, start, loop)


def numbers(frames: NDArray[np.float32]) -> NDArray[np.float32]:
    return frames[:, 0] * 32768.0


def test_it_plays_once_and_ends() -> None:
    voice = TrackVoice(ramp_track(1000))
    assert numbers(voice.read(600)).tolist() == list(range(600))
    assert not voice.has_ended
    assert numbers(voice.read(600)).tolist() == [*range(600, 1000), *[0] * 200]
    assert voice.has_ended


def test_a_start_in_mid_music_fades_in() -> None:
    heard = numbers(TrackVoice(ramp_track(start=4000)).read(500))
    assert heard[0] == pytest.approx(4000 / EDGE, rel=1e-3)
    assert heard[EDGE:].tolist() == list(range(4000 + EDGE, 4500))


@given(blocks=st.lists(st.integers(1, 700), min_size=1, max_size=30))
def test_how_it_is_asked_for_changes_nothing(blocks: list[int]) -> None:
    track = tone_track(3000, 300.0, (700, 2500), start=200)
    whole = TrackVoice(track).read(sum(blocks))
    voice = TrackVoice(track)
    assert np.allclose(np.concatenate([voice.read(count) for count in blocks]), whole, atol=1e-7)


def test_a_loop_repeats_exactly_but_for_its_seam() -> None:
    voice = TrackVoice(ramp_track(8000, loop=(1000, 5000)))
    heard = numbers(voice.read(13_000))
    assert heard[: 5000 - SEAM - 1].tolist() == list(range(5000 - SEAM - 1))
    assert heard[5000 : 9000 - SEAM - 1].tolist() == list(range(1000, 5000 - SEAM - 1))
    assert heard[9000:9100].tolist() == list(range(1000, 1100))
    assert not voice.has_ended


@pytest.mark.parametrize("loop", [(0, 10_007), (1234, 9876), (100, 400), (9000, 9100)])
def test_a_loops_seam_does_not_click(loop: tuple[int, int]) -> None:
    """A tone that does not fit the loop: no step is larger than the crossfade of two such tones can make."""
    heard = TrackVoice(tone_track(12_000, 440.0, loop)).read(40_000)[:, 0]
    steepest = 2 * np.pi * 440 / RATE_HZ * (16_000 / 32_768)
    seam = min(SEAM, loop[1] - loop[0])
    assert np.abs(np.diff(heard)).max() < steepest + 2 * (16_000 / 32_768) / seam


def test_a_stop_fades_within_its_edge() -> None:
    voice = TrackVoice(tone_track(12_000, 440.0))
    voice.read(1000)
    voice.stop()
    heard = voice.read(1000)[:, 0]
    assert np.all(heard[EDGE:] == 0.0)
    assert np.abs(np.diff(heard)).max() < 0.05
    assert voice.has_ended


def test_a_move_of_one_frame_is_an_interpolation() -> None:
    voice = TrackVoice(ramp_track())
    voice.read(1000)
    voice.move(1)
    heard = numbers(voice.read(250))
    assert heard[0] == pytest.approx(1000 + 1 / 250, abs=1e-2)
    assert np.diff(heard) == pytest.approx(1 + 1 / 250, abs=1e-2)
    assert numbers(voice.read(1))[0] == 1251
    assert voice.position == 1252


def test_a_jump_crosses_over_without_a_step() -> None:
    voice = TrackVoice(tone_track(48_000, 440.0))
    voice.read(1000)
    voice.move(5003)
    heard = voice.read(250)[:, 0]
    assert np.abs(np.diff(heard)).max() < 0.05
    assert voice.position == 1000 + 5003 + 250


def test_it_never_moves_before_its_start() -> None:
    voice = TrackVoice(ramp_track())
    voice.read(10)
    voice.move(-100)
    voice.read(5)
    assert voice.position == 5


# --- in the mixer ------------------------------------------------------------------------------------------------


def test_a_track_begins_on_its_frame_and_has_its_own_bus() -> None:
    mixer = mixer_of()
    mixer.play_track(ramp_track(), 300)
    heard = numbers(mixer.render(700))
    assert np.all(heard[:300] == 0.0)
    assert heard[300:].tolist() == list(range(400))
    mixer.set_level(Bus.BACKING, 0.0)
    mixer.render(1000)
    assert np.all(mixer.render(500) == 0.0)


def test_strokes_and_track_add_up() -> None:
    mixer = mixer_of(default=impulse(0.5))
    mixer.play_track(ramp_track())
    mixer.trigger(Bus.STUDENT, NoteMeaning(Piece.SNARE), 127, 100)
    assert mixer.render(200)[100, 0] == pytest.approx(0.5 + 100 / 32768, abs=1e-6)


def test_a_second_track_takes_over_without_a_step() -> None:
    mixer = mixer_of()
    mixer.play_track(tone_track(48_000, 220.0))
    mixer.render(5000)
    mixer.play_track(tone_track(48_000, 220.0, start=100))
    heard = mixer.render(2000)[:, 0]
    assert np.abs(np.diff(heard)).max() < 0.06


@pytest.mark.parametrize("drift_ppm", [-200, -50, 50, 200])
def test_a_drifting_card_is_followed(drift_ppm: int) -> None:
    """A minute at 128 frames: each block begins within four frames of where the transport is."""
    mixer = mixer_of()
    mixer.play_track(Track(np.zeros((70 * RATE_HZ, 2), np.int16), RATE_HZ))
    voice = None
    for block in range(60 * RATE_HZ // 128):
        mixer.keep_track_at(round(block * 128 * (1 + drift_ppm * 1e-6)))
        mixer.render(128)
        voice = mixer._tracks._voices[-1]
        assert abs(voice.position - (block + 1) * 128 * (1 + drift_ppm * 1e-6)) <= 4
    assert voice is not None
    assert abs(voice.position - 60 * RATE_HZ) > 60 * RATE_HZ * abs(drift_ppm) * 0.9e-6  # it did drift


def test_a_jump_of_the_stream_is_made_up_at_once() -> None:
    mixer = mixer_of()
    mixer.play_track(ramp_track(30_000))
    mixer.render(1000)
    late = round(2 * TRACK_JUMP_S * RATE_HZ)
    mixer.keep_track_at(1000 + late)
    mixer.render(250)
    assert numbers(mixer.render(1))[0] == 1250 + late


# --- from disk ---------------------------------------------------------------------------------------------------


def test_a_prepared_file_is_loaded(tmp_path: Path) -> None:
    pcm = np.arange(2000, dtype=np.int16).reshape(-1, 2)
    pcm.tofile(tmp_path / "a.track")
    track = load(PreparedTrack(tmp_path / "a.track", RATE_HZ, 10, (5, 900)))
    assert np.array_equal(track.pcm, pcm)
    assert (track.start, track.loop) == (10, (5, 900))


@pytest.mark.parametrize("size", [None, 0, 3, 40])
def test_a_file_that_is_gone_or_cut_short_is_told(tmp_path: Path, size: int | None) -> None:
    path = tmp_path / "a.track"
    if size is not None:
        path.write_bytes(bytes(size))
    with pytest.raises(DeviceError, match="choose its file again"):
        load(PreparedTrack(path, RATE_HZ, 10, None))


def test_a_loop_that_is_left_goes_on_into_what_follows_and_fades() -> None:
    """Frames 1000 to 3000 twice; then 3000, 3001 … by a straight line down to nothing, never the loop's beginning."""
    leave = round(LEAVE_S * RATE_HZ)
    track = replace(ramp_track(32_000, start=1000, loop=(1000, 3000)), turns=2)
    voice = TrackVoice(track)
    heard = numbers(voice.read(4000))
    assert heard[EDGE : 2000 - SEAM - 1].tolist() == list(range(1000 + EDGE, 3000 - SEAM - 1))
    assert heard[2000:].tolist() == list(range(1000, 3000)), "the last turn has no seam"
    assert not voice.has_ended
    left = numbers(voice.read(leave + 100))
    after = np.arange(leave)
    assert left[:leave] == pytest.approx((3000 + after) * (1 - after / leave), abs=0.5)
    assert not left[leave:].any()
    assert voice.has_ended
