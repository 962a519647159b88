"""Tempo maps by hand calculation."""

import pytest

from station.core.errors import BadInput
from station.core.units import PPQ
from station.music.tempo import BarPosition, MeterChange, TempoChange, TempoMap


def test_unsaid_is_120_bpm_in_four() -> None:
    tempo_map = TempoMap()
    assert tempo_map.bpm_at(0) == 120
    assert int(tempo_map.ns_at(4 * PPQ)) == 2_000_000_000
    assert tempo_map.bar_start(3) == 12 * PPQ


def test_a_tempo_change_is_summed_up() -> None:
    """Four quarters at 120 (2 s), then two at 60 (2 s), then one at 240 (0.25 s)."""
    tempo_map = TempoMap.build(
        [TempoChange.from_bpm(6 * PPQ, 240), TempoChange.from_bpm(0, 120), TempoChange.from_bpm(4 * PPQ, 60)]
    )
    assert tempo_map.seconds_at([0, 4 * PPQ, 5 * PPQ, 6 * PPQ, 7 * PPQ]).tolist() == [0, 2, 3, 4, 4.25]
    assert [tempo_map.bpm_at(q * PPQ) for q in (0, 3, 4, 5, 6, 99)] == [120, 120, 60, 60, 240, 240]


def test_a_tempo_is_rounded_to_whole_microseconds_as_midi_has_it() -> None:
    assert TempoChange.from_bpm(0, 130).us_per_quarter == 461_538  # 60 s / 130 = 461538.46 µs


def test_the_last_change_on_a_tick_counts() -> None:
    tempo_map = TempoMap.build(
        [TempoChange(0, 400_000), TempoChange(0, 300_000)], [MeterChange(0, 3, 4), MeterChange(0, 7, 8)]
    )
    assert tempo_map.tempos == (TempoChange(0, 300_000),)
    assert tempo_map.meters == (MeterChange(0, 7, 8),)


@pytest.mark.parametrize("change", [TempoChange(0, 0), TempoChange(0, -1), TempoChange(-1, 500_000)])
def test_what_is_no_tempo_is_refused(change: TempoChange) -> None:
    with pytest.raises(BadInput, match=f"tick {change.tick}"):
        TempoMap.build([change])


@pytest.mark.parametrize(
    "change", [MeterChange(0, 0, 4), MeterChange(0, 4, 0), MeterChange(0, 4, 8192), MeterChange(-PPQ, 4, 4)]
)
def test_what_is_no_meter_is_refused(change: MeterChange) -> None:
    with pytest.raises(BadInput, match=r"is no meter"):
        TempoMap.build([], [change])


def test_bars_of_changing_meters() -> None:
    """Two bars of 4/4 (8 quarters), two of 7/8 (3.5 each), then 3/4."""
    tempo_map = TempoMap.build([], [MeterChange(8 * PPQ, 7, 8), MeterChange(15 * PPQ, 3, 4)])
    quarters = [tempo_map.bar_start(bar) / PPQ for bar in range(7)]
    assert quarters == [0, 4, 8, 11.5, 15, 18, 21]
    assert tempo_map.bars_at([int(q * PPQ) for q in quarters]).tolist() == list(range(7))
    assert tempo_map.bars_at([int(q * PPQ) - 1 for q in quarters[1:]]).tolist() == list(range(6))


def test_a_change_in_mid_bar_starts_a_new_bar() -> None:
    tempo_map = TempoMap.build([], [MeterChange(5 * PPQ, 3, 4)])
    assert [tempo_map.bar_start(bar) // PPQ for bar in range(4)] == [0, 4, 5, 8]


def test_a_place_as_people_count_it() -> None:
    tempo_map = TempoMap.build([], [MeterChange(4 * PPQ, 6, 8)])
    assert tempo_map.position_at(0) == BarPosition(0, 0, 0)
    assert tempo_map.position_at(3 * PPQ + 7) == BarPosition(0, 3, 7)
    assert tempo_map.position_at(4 * PPQ + 5 * PPQ // 2) == BarPosition(1, 5, 0)


def test_beats_within_a_stretch() -> None:
    tempo_map = TempoMap.build([], [MeterChange(2 * PPQ, 3, 8)])
    eighth = PPQ // 2
    assert tempo_map.beats_between(1, 2 * PPQ + 4 * eighth) == [
        (PPQ, 1),
        (2 * PPQ, 0),
        (2 * PPQ + eighth, 1),
        (2 * PPQ + 2 * eighth, 2),
        (2 * PPQ + 3 * eighth, 0),
    ]


def test_any_shape_comes_back() -> None:
    tempo_map = TempoMap()
    assert tempo_map.ns_at([[0, PPQ], [2 * PPQ, 3 * PPQ]]).shape == (2, 2)
    assert tempo_map.ns_at(PPQ).shape == ()
    assert tempo_map.ns_at([]).shape == (0,)


def test_the_slowest_tempo_that_midi_can_write_lasts_all_day() -> None:
    """16777215 µs a quarter; 5000 quarters are 83886.075 s: no overflow on the way."""
    tempo_map = TempoMap.build([TempoChange(0, (1 << 24) - 1)])
    assert int(tempo_map.ns_at(5000 * PPQ)) == 83_886_075_000_000


def test_scaled_keeps_the_meter() -> None:
    tempo_map = TempoMap.constant(100, 7, 8).scaled(0.5)
    assert tempo_map.bpm_at(0) == 50
    assert tempo_map.meter_at(0) == MeterChange(0, 7, 8)


def test_pulses_are_what_a_foot_taps() -> None:
    eighth = PPQ // 2
    assert MeterChange(0, 7, 8, (3, 2, 2)).pulses == (
        (0, 3 * eighth),
        (3 * eighth, 5 * eighth),
        (5 * eighth, 7 * eighth),
    )
    assert MeterChange(0, 6, 8).pulses == ((0, 3 * eighth), (3 * eighth, 6 * eighth))
    assert MeterChange(0, 3, 4, (2, 1)).pulses == ((0, PPQ), (PPQ, 2 * PPQ), (2 * PPQ, 3 * PPQ))


@pytest.mark.parametrize(
    ("us_per_quarter", "beat_quarters", "bpm"),
    [(833_333, 1.0, 72.0), (500_000, 1.0, 120.0), (327_869, 1.5, 122.0), (662_983, 1.0, 90.5)],
)
def test_a_tempo_has_the_shortest_number_that_means_it(us_per_quarter: int, beat_quarters: float, bpm: float) -> None:
    """60 000 000 µs a minute by hand; 122 dotted quarters are 183 quarters, of 327 868.85 µs."""
    assert TempoChange(0, us_per_quarter).short_bpm(beat_quarters) == bpm


def test_a_tempo_of_no_short_number_keeps_its_microseconds() -> None:
    change = TempoChange(0, 833_331)
    assert TempoChange.from_bpm(0, change.short_bpm()) == change
