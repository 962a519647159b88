import numpy as np
import pytest

from station.core.units import NS_PER_MS
from station.engine.cue_queue import LATE_NS, CueQueue, CueRun
from station.engine.messages import CUE_DTYPE, Bus
from tests.fakes.cues import clicks


def times(playback: CueQueue, from_ns: int, until_ns: int) -> list[int]:
    return [cue.at_ns for cue in playback.pop_due(from_ns, until_ns)]


def test_each_cue_is_taken_once_in_its_own_stretch() -> None:
    playback = CueQueue()
    playback.start(CueRun(clicks([30, 10, 20])), 1000)
    assert times(playback, 1000, 1010) == []
    assert times(playback, 1010, 1030) == [1010, 1020]
    assert times(playback, 1030, 1100) == [1030]
    assert times(playback, 1100, 9999) == []


def test_a_transport_that_goes_on_leaves_out_what_is_over_and_calls_nothing_late() -> None:
    playback = CueQueue()
    playback.resume(CueRun(clicks([0, 40, 50, 60])), 1000, 1050)
    assert times(playback, 1050, 1100) == [1050, 1060]
    assert playback.late == 0
    assert playback.zero_ns == 1000


def test_a_stretch_that_was_skipped_drops_its_cues_but_for_the_last_moment() -> None:
    playback = CueQueue()
    begin_ns = 100 * NS_PER_MS
    playback.start(CueRun(clicks([0, begin_ns - LATE_NS - 1, begin_ns - LATE_NS, begin_ns])), 0)
    assert times(playback, begin_ns, begin_ns + 1) == [begin_ns - LATE_NS, begin_ns]
    assert playback.late == 2


def test_a_transport_that_stands_has_nothing_to_sound() -> None:
    playback = CueQueue()
    assert times(playback, 0, 100) == []
    playback.start(CueRun(clicks([0, 50])), 0)
    playback.stop()
    assert times(playback, 0, 100) == []
    assert playback.zero_ns is None


def test_no_cues_are_no_trouble() -> None:
    playback = CueQueue()
    playback.start(CueRun(clicks([])), 0)
    assert times(playback, 0, 100) == []


@pytest.mark.parametrize(("name", "value"), [("bus", 3), ("piece", 200), ("zone", 99), ("velocity", 128)])
def test_a_cue_that_no_sound_has_is_our_own_mistake(name: str, value: int) -> None:
    cues = clicks([0])
    cues[name] = value
    with pytest.raises(AssertionError, match=name):
        CueRun(cues)


def test_a_table_of_something_else_is_our_own_mistake() -> None:
    with pytest.raises(AssertionError, match="CUE_DTYPE"):
        CueRun(np.zeros(3, np.dtype([("at_ns", np.int64)])))


def test_a_cue_bears_what_the_table_says() -> None:
    row = (5, Bus.DEMONSTRATION, 2, 2, 0, 99, 0.5)
    playback = CueQueue()
    playback.start(CueRun(np.array([row], CUE_DTYPE)), 0)
    (cue,) = playback.pop_due(0, 10)
    assert tuple(cue) == row


class StoppedMeanwhile(CueQueue):
    """Another thread stops it as soon as somebody has looked at what it plays."""

    def __getattribute__(self, name: str) -> object:
        seen: object = super().__getattribute__(name)
        if name == "_runs":
            self.stop()
        return seen


def test_it_may_be_stopped_while_another_thread_asks_for_its_cues() -> None:
    playback = StoppedMeanwhile()
    playback.start(CueRun(clicks([10])), 0)
    assert playback.has_cues
    assert not playback.has_cues


def test_added_cues_sound_among_those_that_are_left() -> None:
    playback = CueQueue()
    playback.start(CueRun(clicks([0, 20, 40])), 1000)
    assert times(playback, 1000, 1010) == [1000]
    playback.add(CueRun(clicks([30, 10, 50])))
    assert times(playback, 1010, 1041) == [1010, 1020, 1030, 1040]
    assert playback.has_cues
    assert times(playback, 1041, 2000) == [1050]
    assert not playback.has_cues


def test_an_added_cue_whose_time_has_passed_is_late() -> None:
    playback = CueQueue()
    playback.start(CueRun(clicks([0])), 0)
    now_ns = 50 * NS_PER_MS
    playback.pop_due(0, now_ns)
    playback.add(CueRun(clicks([now_ns - LATE_NS - 1, now_ns])))
    assert times(playback, now_ns, now_ns + 1) == [now_ns]
    assert playback.late == 1


def test_nothing_is_added_to_a_transport_that_stands() -> None:
    playback = CueQueue()
    playback.add(CueRun(clicks([0])))
    playback.start(CueRun(clicks([5])), 0)
    assert times(playback, 0, 100) == [5]
    playback.stop()
    playback.add(CueRun(clicks([200])))
    assert not playback.has_cues
    assert times(playback, 100, 300) == []
