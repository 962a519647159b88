"""The click as light: it falls where the cues lie, by the engine's word when they began."""

import numpy as np
import pytest

from station.core.units import NS_PER_MS, NS_PER_S
from station.engine.messages import AddCues, Play, Started, Stop
from station.music.tempo import MeterChange, TempoChange, TempoMap
from station.practice.session.cues.click_flash import DARK, FLASH_NS, ClickFlash
from station.practice.session.cues.click_pattern import ClickPattern, click_cues

ZERO_NS = 5 * NS_PER_S
AT_120 = TempoMap.build([TempoChange.from_bpm(0, 120.0)], [MeterChange(0, 4, 4)])
BEAT_NS = NS_PER_S // 2


def flashing(pattern: ClickPattern) -> ClickFlash:
    flash = ClickFlash()
    flash.sent(Play(click_cues(AT_120, AT_120.bar_start(2), pattern), 0))
    flash.handle(Started(ZERO_NS))
    return flash


@pytest.mark.parametrize("counts", [False, True])
def test_every_beat_flashes_as_it_is_heard_the_first_as_an_accent(counts: bool) -> None:
    flash = flashing(ClickPattern(counts=counts))
    assert flash.at(ZERO_NS - NS_PER_MS) == DARK
    seen = [flash.at(ZERO_NS + beat * BEAT_NS) for beat in range(8)]
    assert [each.strength for each in seen] == [1.0] * 8, "a counted word flashes on its beat, too"
    assert [each.is_accent for each in seen] == [True, False, False, False] * 2
    assert flash.at(ZERO_NS + FLASH_NS // 2).strength == pytest.approx(0.5)
    assert flash.at(ZERO_NS + FLASH_NS) == DARK


def test_what_is_off_or_between_is_dark_or_dim() -> None:
    flash = flashing(ClickPattern(subdivisions=2, off=(1,)))
    assert flash.at(ZERO_NS + BEAT_NS).strength == 0.0
    assert 0.0 < flash.at(ZERO_NS + BEAT_NS // 2).strength < 0.5


def test_nothing_flashes_before_it_has_begun_or_after_it_was_ended() -> None:
    flash = ClickFlash()
    assert flash.at(ZERO_NS) == DARK
    flash.sent(Play(click_cues(AT_120, AT_120.bar_start(1)), 0))
    assert flash.at(ZERO_NS) == DARK
    flash.handle(Started(ZERO_NS))
    flash.sent(Stop())
    assert flash.at(ZERO_NS) == DARK
    flash.sent(Play(np.zeros(0, click_cues(AT_120, 1).dtype), 0))
    flash.handle(Started(ZERO_NS))
    assert flash.at(ZERO_NS) == DARK


def test_clicks_that_are_added_flash_too() -> None:
    flash = ClickFlash()
    flash.sent(Play(click_cues(AT_120, AT_120.bar_start(1)), 0))
    flash.handle(Started(ZERO_NS))
    more = click_cues(AT_120, AT_120.bar_start(1))
    more["at_ns"] += 4 * BEAT_NS
    flash.sent(AddCues(more))
    assert [flash.at(ZERO_NS + beat * BEAT_NS).is_accent for beat in range(8)] == [True, False, False, False] * 2
