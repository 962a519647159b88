"""Repeats, endings and jumps, against orders counted by hand (bars from 1 here)."""

import pytest

from station.core.errors import BadInput
from station.music.formats.playing_order import AL_FINE, MOST_BARS, TO_THE_END, BarSigns, playing_order


def _order(*bars: BarSigns) -> list[int]:
    return [bar + 1 for bar in playing_order(bars, "file")]


def _plain() -> BarSigns:
    return BarSigns()


def _ending(*numbers: int, times: int = 0) -> BarSigns:
    return BarSigns(endings=frozenset(numbers), repeat_times=times)


def test_repeats() -> None:
    back, both = BarSigns(repeat_times=2), BarSigns(repeat_from=True, repeat_times=3)
    assert _order(_plain(), back, _plain()) == [1, 2, 1, 2, 3]
    assert _order(_plain(), both, both, _plain()) == [1, 2, 2, 2, 3, 3, 3, 4]
    assert _order(back, back) == [1, 1, 2, 2]


def test_endings() -> None:
    first = BarSigns(repeat_from=True)
    assert _order(_plain(), first, _ending(1, times=2), _ending(2), _plain()) == [1, 2, 3, 2, 4, 5]
    assert _order(first, _ending(1, 2, times=2), _ending(3), _plain()) == [1, 2, 1, 2, 1, 3, 4]
    assert _order(first, _ending(1, times=2), _ending(2, times=2), _plain()) == [1, 2, 1, 3, 4]
    assert _order(first, _ending(1), _ending(1, times=2), _ending(2), _ending(2)) == [1, 2, 3, 1, 4, 5]
    assert _order(first, _ending(1, times=2), _ending(2), BarSigns(repeat_times=2)) == [1, 2, 1, 3, 4, 4]


def test_jumps() -> None:
    fine = BarSigns(fine=True)
    assert _order(_plain(), fine, BarSigns(da_capo=True)) == [1, 2, 3, 1, 2]
    segno, d_s = BarSigns(segno=""), BarSigns(dal_segno="")
    to_coda, coda = BarSigns(to_coda=""), BarSigns(coda="")
    assert _order(_plain(), segno, to_coda, d_s, coda) == [1, 2, 3, 4, 2, 3, 5]
    named = BarSigns(to_coda="coda"), BarSigns(da_capo=True), BarSigns(coda="")
    assert _order(_plain(), *named) == [1, 2, 3, 1, 2, 4]
    repeated = BarSigns(repeat_times=2)
    assert _order(repeated, BarSigns(da_capo=True)) == [1, 1, 2, 1, 2]
    assert _order(_plain(), _ending(1, times=2), _ending(2), BarSigns(da_capo=True)) == [1, 2, 1, 3, 4, 1, 3, 4]


def test_a_jump_that_says_what_follows_heeds_only_that() -> None:
    fine, to_coda, coda = BarSigns(fine=True), BarSigns(to_coda=""), BarSigns(coda="")
    al_fine = BarSigns(da_capo=True, until=AL_FINE)
    assert _order(to_coda, fine, al_fine, coda) == [1, 2, 3, 1, 2]
    assert _order(to_coda, fine, BarSigns(da_capo=True, until=TO_THE_END), coda) == [1, 2, 3, 1, 2, 3, 4]
    al_coda = BarSigns(da_capo=True, until="2")
    to_second, second = BarSigns(to_coda="2"), BarSigns(coda="2")
    assert _order(to_coda, fine, to_second, al_coda, coda, second) == [1, 2, 3, 4, 1, 2, 3, 6]


def test_what_leads_nowhere_is_read_on() -> None:
    assert _order(BarSigns(dal_segno="x"), _plain()) == [1, 2]
    assert _order(BarSigns(da_capo=True, to_coda=""), _plain()) == [1, 1, 2]


def test_endless_repeats_are_refused() -> None:
    with pytest.raises(BadInput, match=f"{MOST_BARS:,} bars"):
        playing_order([BarSigns(repeat_times=10**9)], "file")


def test_bars_that_are_all_of_a_later_pass_are_refused() -> None:
    with pytest.raises(BadInput, match=r"^a\.xml: bar 1: its endings leave no bar to play the first time$"):
        playing_order([BarSigns(endings=frozenset({2}), repeat_times=2)], "a.xml")
