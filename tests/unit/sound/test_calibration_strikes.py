"""Strikes on synthetic recordings: the true lateness is the one that the stamps were made with."""

import numpy as np
import pytest

from station.core.errors import DeviceError
from station.core.pieces import Piece
from station.sound.calibration.strikes import Strikes, strikes
from station.sound.calibration.stroke_onsets import onsets
from tests.fakes.rooms import Room, room_with_strokes, stamps_ns, strokes_at_s

PADS = (Piece.SNARE, Piece.RIDE)
LATER_MS = np.array([0.0, 2.0])  # the ride beside the snare


def measured(room: Room, late_ms: float, jitter_ms: float = 0.5, count: int = 20, seed: int = 3) -> Strikes:
    at_s = strokes_at_s(count, seed)
    which = np.arange(count) % 2
    stamps = stamps_ns(at_s, late_ms + LATER_MS[which], jitter_ms, seed)
    return strikes(stamps, [PADS[each] for each in which], room_with_strokes(room, at_s))


@pytest.mark.parametrize(
    ("room", "late_ms"),
    [
        (Room(), 4.0),
        (Room(), -12.0),  # the input itself is late
        (Room(), 120.0),  # wireless MIDI
        (Room(gain=-0.5), 4.0),
        (Room(noise=0.008), 4.0),
        (Room(hum=0.5), 4.0),
        (Room(gain=2.0, clip=0.2), 4.0),
        (Room(crackles=10), 4.0),
        (Room(echo_ms=12.0, echo_gain=0.9), 4.0),
        (Room(rate_hz=44_100), 4.0),
    ],
)
def test_the_lateness_of_kit_and_pads_is_found(room: Room, late_ms: float) -> None:
    found = measured(room, late_ms)
    assert found.kit.value_ms == pytest.approx(late_ms + 1.0, abs=0.6)  # the mean of both pads
    assert found.pads[Piece.SNARE].value_ms == pytest.approx(late_ms, abs=0.5)
    assert found.pads[Piece.RIDE].value_ms == pytest.approx(late_ms + 2.0, abs=0.5)
    assert found.kit.trusted, found.kit.doubts


@pytest.mark.parametrize("seed", range(4))
def test_the_interval_holds_the_truth_about_as_often_as_it_says(seed: int) -> None:
    pads = measured(Room(seed=seed), 4.0, seed=seed).pads
    off = abs(pads[Piece.SNARE].value_ms - 4.0)
    assert off < 1.6 * pads[Piece.SNARE].half_ms  # 95 % within 1.0, 99.7 % within 1.6 half widths of t(9)


def test_the_microphones_distance_is_taken_out() -> None:
    at_s = strokes_at_s(16, 4)
    pieces = [Piece.SNARE] * 16
    heard = room_with_strokes(Room(), at_s + 0.343 / 343.0)  # a third of a metre: a millisecond
    stamps = stamps_ns(at_s, 5.0, 0.3, 4)
    assert strikes(stamps, pieces, heard).kit.value_ms == pytest.approx(4.0, abs=0.3)
    assert strikes(stamps, pieces, heard, 0.343).kit.value_ms == pytest.approx(5.0, abs=0.3)


def test_silence_is_no_measurement() -> None:
    with pytest.raises(DeviceError, match="of 20 strokes 0 were heard"):
        measured(Room(gain=0.0), 4.0)
    with pytest.raises(DeviceError, match="too few"):
        measured(Room(), 4.0, count=3)


def test_a_microphone_that_hears_half_is_doubted() -> None:
    at_s = strokes_at_s(24, 6)
    found = strikes(stamps_ns(at_s, 4.0, 0.5, 6), [Piece.SNARE] * 24, room_with_strokes(Room(), at_s[::2]))
    assert any("of 24 strokes were heard" in doubt for doubt in found.kit.doubts)


def test_a_metronomic_player_leaves_the_delay_open() -> None:
    at_s = np.linspace(0.5, 6.25, 24)
    found = strikes(stamps_ns(at_s, 4.0, 0.2, 6), [Piece.SNARE] * 24, room_with_strokes(Room(), at_s))
    assert any("less evenly" in doubt for doubt in found.kit.doubts)


def test_a_jittery_kit_and_an_impossible_one_are_doubted() -> None:
    assert any("scatter" in doubt for doubt in measured(Room(), 4.0, jitter_ms=6.0).kit.doubts)
    assert any("beyond" in doubt for doubt in measured(Room(), 200.0).kit.doubts)


def test_few_strokes_are_doubted_and_give_no_pad() -> None:
    found = measured(Room(), 4.0, count=6)
    assert any("only 6 strokes" in doubt for doubt in found.kit.doubts)
    assert not found.pads


def test_an_onset_is_found_to_a_tenth_of_a_millisecond() -> None:
    at_s = strokes_at_s(20, 8)
    found = onsets(room_with_strokes(Room(), at_s).sound[:, 1], 48_000) / 48_000
    assert len(found) == 20
    assert np.abs(found - at_s).max() < 0.0005
    assert np.abs(found - at_s).mean() < 0.0002
    assert len(onsets(np.empty(0, np.float32), 48_000)) == 0
