"""The player under any controls in any order: it stays in the song and its loop, and never jumps by itself."""

from collections.abc import Callable

from hypothesis import given
from hypothesis import strategies as st

from station.core.units import NS_PER_S, PPQ
from station.music.tempo import MeterChange, TempoChange, TempoMap
from station.practice.demonstration.song_player import MAX_SPEED_PERCENT, WIND_PERCENT, Song, SongPlayer, SongStep

CHANGES = [TempoChange.from_bpm(0, 97.0), TempoChange.from_bpm(7 * PPQ, 161.0)]
METERS = [MeterChange(0, 4, 4), MeterChange(8 * PPQ, 7, 8)]
SONG = Song(TempoMap.build(CHANGES, METERS), 8 * PPQ + 2 * 7 * PPQ // 2)


CONTROLS: dict[str, Callable[[SongPlayer, int, int, int], SongPlayer]] = {
    "play": lambda p, now, a, b: p.played(now) if a % 2 else p.stopped(now),
    "seek": lambda p, now, a, b: p.sought(now, a * NS_PER_S // 3),
    "step": lambda p, now, a, b: p.stepped(now, list(SongStep)[a % 5], 1 if b % 2 else -1),
    "wind": lambda p, now, a, b: p.wound(now, a % 3 - 1),
    "speed": lambda p, now, a, b: p.at_speed(now, 10 * a),
    "reverse": lambda p, now, a, b: p.reversed(now, bool(a % 2)),
    "loop": lambda p, now, a, b: p.looped(now, (a % 7 - 1, b % 7 - 1) if a else None),
    "flag": lambda p, now, a, b: p.flagged(now, b % 8).at_flag(now, a % 8),
}
"""Each with two numbers to choose what it does."""
NUMBERS = st.integers(0, 40)
USES = st.lists(st.tuples(st.sampled_from(list(CONTROLS)), NUMBERS, NUMBERS, st.integers(0, NS_PER_S)))


@given(USES)
def test_it_stays_in_the_song_and_in_its_loop(uses: list[tuple[str, int, int, int]]) -> None:
    player, now_ns = SongPlayer(SONG), 0
    for name, a, b, later_ns in uses:
        player = CONTROLS[name](player.stopped_at_end(now_ns), now_ns, a, b)
        before_ns = player.position_ns(now_ns)
        now_ns += later_ns
        at_ns = player.position_ns(now_ns)
        low, high = player.span_ns if player.playing and not player.wind else (0, SONG.length_ns)
        assert low <= at_ns <= high
        far_ns = later_ns * max(MAX_SPEED_PERCENT, WIND_PERCENT) // 100 + 1
        wraps = player.loop is not None and player.playing
        assert wraps or abs(at_ns - before_ns) <= far_ns
        assert 0 <= player.place(now_ns).bar < SONG.bar_count


@given(st.integers(0, SONG.length_ns), st.sampled_from(list(SongStep)))
def test_a_step_on_and_one_back_surround_the_place(at_ns: int, step: SongStep) -> None:
    on, back = SONG.stepped_ns(at_ns, step, 1), SONG.stepped_ns(at_ns, step, -1)
    assert back <= at_ns <= on
    assert back < on
    assert SONG.stepped_ns(on, step, -1) <= at_ns
    assert SONG.stepped_ns(back, step, 1) >= at_ns or back == 0
