"""Silent bars at random: the shares that were asked for, the same from a seed, and none that nobody could keep."""

from dataclasses import replace
from itertools import groupby
from pathlib import Path
from typing import Any

import pytest

from station.core.errors import BadInput
from station.core.settings import Settings
from station.devices.capture.capture import read_capture
from station.drills.library import find_lesson
from station.practice.headless.virtual_session import practise_virtually
from station.practice.records.rejudge import judge_again
from station.practice.records.report.session_report import practice_document, report_text
from station.practice.session.cues.click_options import parse_click
from station.practice.session.cues.click_pattern import PLAIN, ClickPattern
from station.practice.session.cues.quiet_bars import Gap, RandomGap, drawn, gap_of, gap_words
from station.practice.session.plan import Plan, PlanOptions, plan_practice
from station.simulation.student_spec import parse_spec


def quiet(gap: RandomGap, bars: int = 400) -> list[bool]:
    return [gap.is_quiet(bar) for bar in range(bars)]


def runs(bars: list[bool]) -> list[int]:
    return [len(list(run)) for is_quiet, run in groupby(bars) if is_quiet]


@pytest.mark.parametrize(("percent", "of_eight"), [(10, 1), (25, 2), (30, 2), (50, 4), (60, 5)])
def test_every_block_of_eight_has_its_share(percent: int, of_eight: int) -> None:
    bars = quiet(RandomGap(percent, percent, seed=3))
    assert {sum(bars[at : at + 8]) for at in range(0, 400, 8)} == {of_eight}


@pytest.mark.parametrize("seed", range(20))
def test_the_first_bar_sounds_and_no_silence_is_longer_than_three_bars(seed: int) -> None:
    bars = quiet(RandomGap(20, 60, seed))
    assert not bars[0]
    assert max(runs(bars)) <= 3


def test_silences_are_no_pattern() -> None:
    """Half of the bars: were they in turn, every silence would be as long as every other."""
    bars = quiet(RandomGap(50, 50, seed=1))
    assert set(runs(bars)) == {1, 2, 3}
    assert len({tuple(bars[at : at + 8]) for at in range(0, 400, 8)}) > 20


def test_the_share_rises_over_32_bars_and_then_stays() -> None:
    """20, 30, 40, 50 and 60 % of 8 bars are 1.6, 2.4, 3.2, 4 and 4.8 of them."""
    bars = quiet(RandomGap(20, 60, seed=5))
    assert [sum(bars[at : at + 8]) for at in range(0, 56, 8)] == [2, 2, 3, 4, 5, 5, 5]


def test_equal_words_give_equal_silences_and_other_seeds_others() -> None:
    assert quiet(RandomGap(seed=7)) == quiet(gap_of("random:20-60%:7"))  # type: ignore[arg-type]
    assert quiet(RandomGap(seed=7)) != quiet(RandomGap(seed=8))
    assert RandomGap(seed=7).is_quiet(333) == quiet(RandomGap(seed=7))[333]


def test_a_session_goes_on_with_other_silences_and_the_share_it_had_reached() -> None:
    later = RandomGap(20, 60, seed=7).going_on(bars=32, turn=1)
    assert [sum(quiet(later)[at : at + 8]) for at in range(0, 24, 8)] == [5, 5, 5]
    assert quiet(later) != quiet(RandomGap(60, 60, seed=7))


def test_a_seed_is_drawn_where_none_was_said() -> None:
    gap = drawn(RandomGap(30, 30))
    assert isinstance(gap, RandomGap)
    assert gap.seed is not None
    assert drawn(RandomGap(seed=4)) == RandomGap(seed=4)
    assert drawn(Gap(4, 1)) == Gap(4, 1)
    assert drawn(None) is None


@pytest.mark.parametrize("text", ["4/1", "1/3", "random:20-60%", "random:30%:12", "random:10-60%:0"])
def test_a_gap_is_written_as_it_is_read(text: str) -> None:
    assert str(gap_of(text)) == text


@pytest.mark.parametrize(
    "text",
    [
        *("", "4", "0/1", "4/0", "4/1/1", "1001/1", "randomly", "random:", "random:5%", "random:61%", "x" * 10**6),
        *("random:30%:", "random:30%:-1", "random:20-", "random:20-30-40", "random:²0%", "random:30%:9999999999999"),
    ],
)
def test_what_is_no_gap(text: str) -> None:
    with pytest.raises(BadInput, match="expected bars with and without a click such as 4/1, or random") as fault:
        gap_of(text, "--gap")
    assert fault.value.source == "--gap"


def test_the_settings_say_a_gap_too() -> None:
    assert parse_click("parts=2,gap=4/1").gap == Gap(4, 1)
    assert parse_click("gap=random:30%").gap == RandomGap(30, 30)
    with pytest.raises(BadInput, match="gap=9%: expected bars with and without"):
        parse_click("gap=9%")


def test_in_words() -> None:
    assert gap_words(Gap(4, 1)) == "4 bars of click, 1 without, in turn"
    assert gap_words(RandomGap(20, 60)) == "the click drops out at random, 20 to 60 % of the bars"


# --- in a session -----------------------------------------------------------------------------------------------------


def plan(click: ClickPattern) -> Plan:
    """rock-1 is two bars of 3 s each at 80 bpm, played eight times: 16 bars."""
    return plan_practice(find_lesson("rock-1"), PlanOptions(demonstrations=0, click=click))


def test_the_click_is_silent_where_the_plan_says_and_the_report_tells_every_return(tmp_path: Path) -> None:
    laid = plan(replace(PLAIN, gap=RandomGap(50, 50, seed=3)))
    sounding = {int((at - laid.passes_start_ns) // 3_000_000_000) for at in laid.cues["at_ns"].tolist()} - {-1}
    quiet_bars = {bar for bar in range(16) if RandomGap(50, 50, seed=3).is_quiet(bar)}
    assert sounding == set(range(16)) - quiet_bars
    played = practise_virtually(laid, parse_spec("seed=2,sd_ms=8"), tmp_path / "a.capture")
    document: dict[str, Any] = practice_document(played.result, Settings())
    backs = sorted(bar + 1 for bar in range(1, 16) if bar not in quiet_bars and bar - 1 in quiet_bars)
    gaps = document["craft"]["gaps"]
    assert [one["bar"] for one in gaps["returns"]] == backs
    assert document["session"]["gap"] == "random:50%:3"
    assert "again with --gap random:50%:3" in report_text(document)


def test_the_capture_alone_knows_the_silences(tmp_path: Path) -> None:
    laid = plan(replace(PLAIN, gap=RandomGap(50, 50, seed=3)))
    practise_virtually(laid, parse_spec("seed=2"), tmp_path / "a.capture")
    (again,) = judge_again(read_capture(tmp_path / "a.capture"))
    assert again.result().plan.silences == laid.silences
