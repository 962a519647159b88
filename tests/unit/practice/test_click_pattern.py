import numpy as np
import pytest

from station.core.units import NS_PER_S, PPQ
from station.engine.messages import Bus, ClickVoice
from station.music.swing import Swing
from station.music.tempo import MeterChange, TempoChange, TempoMap
from station.practice.session.cues.click_pattern import (
    SPOKEN_LEAD_NS,
    ClickBeats,
    ClickLevels,
    ClickPattern,
    Displacement,
    bar_clicks,
    click_cues,
    count_in,
)
from station.practice.session.cues.quiet_bars import Gap

FOUR = MeterChange(0, 4, 4)
SLOW = TempoMap.constant(60.0)  # a beat a second


def beats_of(pattern: ClickPattern, meter: MeterChange = FOUR) -> list[float]:
    """Where the clicks of a bar fall, in beats from its start."""
    return [click.tick / meter.beat_ticks for click in bar_clicks(meter, pattern)]


def voices_of(pattern: ClickPattern, meter: MeterChange = FOUR) -> list[str]:
    return [click.voice.name for click in bar_clicks(meter, pattern)]


def test_the_plain_click() -> None:
    cues = click_cues(SLOW, 8 * PPQ)
    assert cues["at_ns"].tolist() == [beat * NS_PER_S for beat in range(8)]
    assert set(cues["bus"].tolist()) == {Bus.CLICK}
    assert np.flatnonzero(cues["piece"] == ClickVoice.ACCENT).tolist() == [0, 4]
    assert cues["velocity"].tolist() == [110, 90, 90, 90] * 2


@pytest.mark.parametrize(
    ("pattern", "meter", "beats"),
    [
        (ClickPattern(beats=ClickBeats.BACKBEAT), FOUR, [1.0, 3.0]),
        (ClickPattern(beats=ClickBeats.BAR), FOUR, [0.0]),
        (ClickPattern(beats=ClickBeats.BACKBEAT), MeterChange(0, 6, 8), [3.0]),  # the second dotted quarter
        (ClickPattern(beats=ClickBeats.BACKBEAT), MeterChange(0, 12, 8), [3.0, 9.0]),
        (ClickPattern(beats=ClickBeats.BAR), MeterChange(0, 7, 8), [0.0]),
        (ClickPattern(beats=ClickBeats.BACKBEAT), MeterChange(0, 7, 8, (3, 2, 2)), [3.0]),  # the second group
        (ClickPattern(beats=ClickBeats.BACKBEAT), MeterChange(0, 5, 4, (3, 2)), [1.0, 3.0]),  # beats of quarters
        (ClickPattern(), MeterChange(0, 6, 8), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]),
        (ClickPattern(displacement=Displacement.E), FOUR, [0.25, 1.25, 2.25, 3.25]),
        (ClickPattern(displacement=Displacement.AND), FOUR, [0.5, 1.5, 2.5, 3.5]),
        (ClickPattern(displacement=Displacement.A), FOUR, [0.75, 1.75, 2.75, 3.75]),
        (ClickPattern(displacement=Displacement.AND, beats=ClickBeats.BACKBEAT), FOUR, [1.5, 3.5]),
        (ClickPattern(subdivisions=2), MeterChange(0, 2, 4), [0.0, 0.5, 1.0, 1.5]),
        (ClickPattern(subdivisions=3), MeterChange(0, 1, 4), [0.0, 1 / 3, 2 / 3]),
        (ClickPattern(subdivisions=5), MeterChange(0, 1, 4), [0.0, 0.2, 0.4, 0.6, 0.8]),
        (ClickPattern(subdivisions=7), MeterChange(0, 1, 4), [part / 7 for part in range(7)]),
    ],
)
def test_where_clicks_fall(pattern: ClickPattern, meter: MeterChange, beats: list[float]) -> None:
    assert beats_of(pattern, meter) == pytest.approx(beats, abs=1e-9)


@pytest.mark.parametrize(("ratio", "offbeat"), [(1.0, 1 / 2), (2.0, 2 / 3), (3.0, 3 / 4)])
def test_offbeats_swing(ratio: float, offbeat: float) -> None:
    beats = beats_of(ClickPattern(subdivisions=2, swing=Swing(ratio)), MeterChange(0, 2, 4))
    assert beats == pytest.approx([0.0, offbeat, 1.0, 1.0 + offbeat], abs=1e-5)


def test_sixteenths_swing_within_the_eighth() -> None:
    sixteenths = Swing(2.0, PPQ // 4)
    beats = beats_of(ClickPattern(subdivisions=4, swing=sixteenths), MeterChange(0, 1, 4))
    assert beats == pytest.approx([0.0, 1 / 3, 1 / 2, 5 / 6], abs=1e-5)


def test_accents_and_subdivisions_have_their_voices_and_levels() -> None:
    pattern = ClickPattern(subdivisions=2, accents=(0, 2), levels=ClickLevels(120, 80, 40))
    clicks = bar_clicks(FOUR, pattern)
    assert [click.voice.name[0] for click in clicks] == ["A", "S", "B", "S", "A", "S", "B", "S"]
    assert [click.velocity for click in clicks] == [120, 40, 80, 40] * 2


def test_what_is_silent_is_left_out() -> None:
    assert beats_of(ClickPattern(levels=ClickLevels(beat=0))) == [0.0]


def test_the_gap_is_quiet_for_whole_bars() -> None:
    cues = click_cues(SLOW, 6 * 4 * PPQ, ClickPattern(gap=Gap(sounding=2, quiet=1)))
    bars = sorted({int(at_ns // (4 * NS_PER_S)) for at_ns in cues["at_ns"]})
    assert bars == [0, 1, 3, 4]
    assert len(cues) == 4 * 4


def test_counting_says_the_numbers_and_what_is_between() -> None:
    meter = MeterChange(0, 2, 4)
    assert voices_of(ClickPattern(counts=True, subdivisions=4), meter) == [
        "ONE",
        "E",
        "AND",
        "A",
        "TWO",
        "E",
        "AND",
        "A",
    ]
    assert voices_of(ClickPattern(counts=True, subdivisions=2), meter) == ["ONE", "AND", "TWO", "AND"]
    assert voices_of(ClickPattern(counts=True, displacement=Displacement.A), meter) == ["A", "A"]
    assert voices_of(ClickPattern(counts=True, subdivisions=5), meter)[:3] == ["ONE", "SUBDIVISION", "SUBDIVISION"]
    assert voices_of(ClickPattern(counts=True), MeterChange(0, 13, 8))[-2:] == ["TWELVE", "BEAT"]


def test_words_come_before_their_beat_by_the_lead() -> None:
    cues = click_cues(SLOW, 4 * PPQ, ClickPattern(counts=True))
    assert cues["at_ns"].tolist() == [beat * NS_PER_S - SPOKEN_LEAD_NS for beat in range(4)]


def test_meters_and_tempos_may_change_under_way() -> None:
    tempos = [TempoChange.from_bpm(0, 60.0), TempoChange.from_bpm(4 * PPQ, 120.0)]
    changing = TempoMap.build(tempos, [MeterChange(0, 4, 4), MeterChange(4 * PPQ, 3, 4)])
    cues = click_cues(changing, 7 * PPQ)
    assert cues["at_ns"].tolist() == [round(s * NS_PER_S) for s in (0, 1, 2, 3, 4, 4.5, 5)]
    assert np.flatnonzero(cues["piece"] == ClickVoice.ACCENT).tolist() == [0, 4]


def test_a_bar_that_is_cut_short_keeps_to_its_end() -> None:
    cues = click_cues(SLOW, 5 * PPQ // 2, ClickPattern(subdivisions=2))
    assert [at_ns / NS_PER_S for at_ns in cues["at_ns"]] == [0, 0.5, 1, 1.5, 2]


def test_a_pickup_takes_its_beats_from_the_count_in() -> None:
    with_pickup = TempoMap.build([TempoChange.from_bpm(0, 60.0)], [MeterChange(0, 1, 4), MeterChange(PPQ, 4, 4)])
    pickup = with_pickup.pickup_ticks(9 * PPQ)
    before, end_tick = count_in(with_pickup, 1, pickup)
    assert pickup == PPQ
    assert end_tick == 3 * PPQ
    assert len(click_cues(before, end_tick)) == 3  # one two three, and the pickup falls on four


def test_no_pickup_no_change() -> None:
    before, end_tick = count_in(SLOW, 2, SLOW.pickup_ticks(8 * PPQ))
    assert end_tick == 8 * PPQ
    assert before.bpm_at(0) == pytest.approx(60.0)
    assert SLOW.pickup_ticks(4 * PPQ) == 0  # a single bar is no pickup


@pytest.mark.parametrize(
    ("meter", "velocities"),
    [
        (MeterChange(0, 7, 8, (3, 2, 2)), [110, 90, 90, 100, 90, 100, 90]),
        (MeterChange(0, 5, 4, (3, 2)), [110, 90, 90, 100, 90]),
        (MeterChange(0, 6, 8), [110, 90, 90, 100, 90, 90]),
        (MeterChange(0, 7, 8), [110, 90, 90, 90, 90, 90, 90]),
    ],
)
def test_the_first_beats_of_groups_have_a_middle_accent(meter: MeterChange, velocities: list[int]) -> None:
    assert [click.velocity for click in bar_clicks(meter, ClickPattern())] == velocities


def test_who_asks_for_no_accents_gets_none_in_groups_either() -> None:
    clicks = bar_clicks(MeterChange(0, 7, 8, (3, 2, 2)), ClickPattern(accents=()))
    assert {click.velocity for click in clicks} == {90}


def test_the_count_in_of_a_grouped_meter_accents_its_groups() -> None:
    section = TempoMap.build([TempoChange.from_bpm(0, 60.0)], [MeterChange(0, 7, 8, (2, 2, 3))])
    before, end_tick = count_in(section, 1)
    assert click_cues(before, end_tick)["velocity"].tolist() == [110, 90, 100, 90, 100, 90, 90]


def test_the_count_in_of_meters_in_turn_is_a_bar_of_the_first() -> None:
    section = TempoMap.build([TempoChange.from_bpm(0, 60.0)], [MeterChange(0, 4, 4), MeterChange(4 * PPQ, 3, 4)])
    before, end_tick = count_in(section, 2)
    assert click_cues(before, end_tick)["at_ns"].tolist() == [beat * NS_PER_S for beat in range(8)]
