"""The player of a demonstration: every expected time is counted by hand.

The song has four bars of 4/4 at 120 beats a minute: a beat lasts 0.5 s, a bar 2 s, the song 8 s.
"""

from dataclasses import replace

import numpy as np
import pytest

from station.core.pieces import Piece
from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.engine.messages import Bus
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap
from station.practice.demonstration.song_cues import SOUNDED_NS, after, count_in_of, song_cues
from station.practice.demonstration.song_player import Song, SongPlayer, SongStep
from station.practice.session.cues.click_pattern import PLAIN

BEAT_NS, BAR_NS = 500 * NS_PER_MS, 2 * NS_PER_S
SONG = Song(TempoMap.constant(120.0), 16 * PPQ)
PLAYER = SongPlayer(SONG)
T = 7 * NS_PER_S
"""Some session time at which things begin."""


def test_it_stands_until_it_is_played_and_stops_at_the_end() -> None:
    assert PLAYER.position_ns(T) == 0
    playing = PLAYER.played(T)
    assert playing.position_ns(T + 3 * NS_PER_S) == 3 * NS_PER_S
    assert playing.stopped_at_end(T + 8 * NS_PER_S - 1) is playing
    over = playing.stopped_at_end(T + 9 * NS_PER_S)
    assert (over.playing, over.position_ns(T + 60 * NS_PER_S)) == (False, 8 * NS_PER_S)
    assert over.played(T).position_ns(T + 1) == 1, "from the end it plays anew"


def test_it_waits_for_its_sound() -> None:
    playing = PLAYER.played(T).started(T + 50 * NS_PER_MS)
    assert playing.position_ns(T + 20 * NS_PER_MS) == 0
    assert playing.position_ns(T + 60 * NS_PER_MS) == 10 * NS_PER_MS


@pytest.mark.parametrize(("percent", "gone_ns"), [(10, 100_000_000), (33, 330_000_000), (100, 10**9), (200, 2 * 10**9)])
def test_its_speed_is_exact_however_often_it_is_asked(percent: int, gone_ns: int) -> None:
    playing = PLAYER.at_speed(T, percent).played(T)
    for now_ns in range(T, T + NS_PER_S, 7_000_003):
        playing = playing.stopped_at_end(now_ns)
    assert playing.position_ns(T + NS_PER_S) == gone_ns


def test_a_change_of_speed_holds_from_where_it_is() -> None:
    playing = PLAYER.played(T).at_speed(T + NS_PER_S, 50)
    assert playing.position_ns(T + 3 * NS_PER_S) == 2 * NS_PER_S
    assert (PLAYER.at_speed(T, 5).speed_percent, PLAYER.at_speed(T, 500).speed_percent) == (10, 200)


def test_backwards_it_stops_at_the_start() -> None:
    back = PLAYER.sought(T, 3 * NS_PER_S).reversed(T, True).played(T)
    assert back.position_ns(T + NS_PER_S) == 2 * NS_PER_S
    assert not back.is_heard
    over = back.stopped_at_end(T + 4 * NS_PER_S)
    assert (over.playing, over.position_ns(T)) == (False, 0)
    assert over.played(T).position_ns(T) == 8 * NS_PER_S, "from the start it goes back from the end"


def test_a_loop_comes_round_both_ways() -> None:
    """Bars 2 and 3: from 2 s until 6 s."""
    loop = PLAYER.looped(T, (2, 1))
    assert loop.loop == (1, 2)
    forward = loop.played(T)
    assert [forward.position_ns(T + s * NS_PER_S) // NS_PER_S for s in (0, 3, 4, 9)] == [2, 5, 2, 3]
    assert forward.stopped_at_end(T + 100 * NS_PER_S).playing
    back = loop.reversed(T, True).played(T)
    assert [back.position_ns(T + s * NS_PER_S) // NS_PER_S for s in (0, 1, 4, 5)] == [6, 5, 6, 5]


def test_a_loop_that_is_set_or_left_while_it_plays() -> None:
    playing = PLAYER.played(T).looped(T + 7 * NS_PER_S, (0, 0))
    assert playing.position_ns(T + 7 * NS_PER_S) == 0, "it stood outside: it enters at the start"
    free = playing.looped(T + 8 * NS_PER_S, None)
    assert free.position_ns(T + 10 * NS_PER_S) == 3 * NS_PER_S
    assert PLAYER.looped(T, (-3, 90)).loop == (0, 3)
    assert playing.sought(T, 5 * NS_PER_S).position_ns(T) == 0, "within a loop it stays"


def test_winding_runs_at_six_times_and_goes_on_as_before() -> None:
    playing = PLAYER.at_speed(T, 50).played(T).wound(T, 1)
    assert not playing.is_heard
    let_go = playing.wound(T + NS_PER_S, 0)
    assert let_go.position_ns(T + NS_PER_S) == 6 * NS_PER_S
    assert let_go.position_ns(T + 2 * NS_PER_S) == 6500 * NS_PER_MS
    assert PLAYER.sought(T, NS_PER_S).wound(T, -1).position_ns(T + NS_PER_S) == 0
    assert not PLAYER.wound(T, 1).wound(T + 1, 0).playing


@pytest.mark.parametrize(
    ("step", "forward", "back"),
    [
        (SongStep.SIXTEENTH, [125, 250, 375], [7875, 7750, 7625]),
        (SongStep.TRIPLET, [167, 333, 500], [7833, 7667, 7500]),
        (SongStep.EIGHTH, [250, 500, 750], [7750, 7500, 7250]),
        (SongStep.BEAT, [500, 1000, 1500], [7500, 7000, 6500]),
        (SongStep.BAR, [2000, 4000, 6000], [6000, 4000, 2000]),
    ],
)
def test_steps_go_from_line_to_line(step: SongStep, forward: list[int], back: list[int]) -> None:
    for start_ns, way, milliseconds in ((0, 1, forward), (8 * NS_PER_S, -1, back)):
        player, seen = PLAYER.sought(T, start_ns), []
        for _ in range(3):
            player = player.stepped(T, step, way)
            seen.append(round(player.position_ns(T) / NS_PER_MS))
        assert seen == milliseconds


def test_steps_from_between_lines_and_at_the_ends() -> None:
    between = PLAYER.played(T)
    assert between.stepped(T + 600 * NS_PER_MS, SongStep.BEAT, 1).at_ns == 1000 * NS_PER_MS
    back = between.stepped(T + 600 * NS_PER_MS, SongStep.BEAT, -1)
    assert (back.at_ns, back.playing) == (500 * NS_PER_MS, False)
    assert PLAYER.stepped(T, SongStep.BAR, -1).at_ns == 0
    assert PLAYER.sought(T, 8 * NS_PER_S).stepped(T, SongStep.BEAT, 1).at_ns == 8 * NS_PER_S


def test_steps_follow_meter_and_tempo() -> None:
    """A bar of 3/4 at 120, then 6/8 at 60 quarters: its beat, an eighth, lasts 0.5 s, its bar 3 s."""
    changes = [TempoChange.from_bpm(0, 120.0), TempoChange.from_bpm(3 * PPQ, 60.0)]
    song = Song(TempoMap.build(changes, [MeterChange(0, 3, 4), MeterChange(3 * PPQ, 6, 8)]), 6 * PPQ)
    player = SongPlayer(song)
    assert (song.bar_count, song.length_ns) == (2, 4500 * NS_PER_MS)
    bar = player.stepped(T, SongStep.BAR, 1)
    assert bar.at_ns == 1500 * NS_PER_MS
    assert bar.stepped(T, SongStep.BEAT, 1).at_ns == 2000 * NS_PER_MS
    assert (bar.place(T).bar, bar.place(T).beat) == (1, 0)
    assert bar.stepped(T, SongStep.BEAT, 1).stepped(T, SongStep.BAR, -1).at_ns == 1500 * NS_PER_MS


def test_bar_and_beat_to_the_very_end() -> None:
    places = [PLAYER.sought(T, ns).place(T) for ns in (0, 2600 * NS_PER_MS, 8 * NS_PER_S)]
    assert [(place.bar, place.beat) for place in places] == [(0, 0), (1, 1), (3, 3)]


def test_flags_keep_places() -> None:
    flagged = PLAYER.sought(T, 3 * NS_PER_S).flagged(T, 7)
    away = flagged.sought(T, 0).played(T)
    assert away.at_flag(T + NS_PER_S, 7).position_ns(T + 2 * NS_PER_S) == 4 * NS_PER_S
    assert away.at_flag(T, 0) is away


def kicks(*beats: int) -> Score:
    return Score.from_notes([Note(beat * PPQ, Piece.KICK) for beat in beats], SONG.tempo_map, SONG.end_tick)


def test_what_sounds_from_the_middle_at_half_speed() -> None:
    """Kicks on beats 1, 6 and 16 (from 1); from beat 2 on they lie 4 and 14 beats ahead, each 1 s long."""
    player = PLAYER.at_speed(T, 50).sought(T, BEAT_NS)
    cues = song_cues(kicks(0, 5, 15), player, None)
    assert cues["at_ns"].tolist() == [4 * NS_PER_S, 14 * NS_PER_S]
    assert set(cues["bus"].tolist()) == {Bus.DEMONSTRATION}
    clicked = song_cues(kicks(0, 5, 15), player, PLAIN)
    assert np.count_nonzero(clicked["bus"] == Bus.CLICK) == 15, "every beat but the first"


def test_a_loop_sounds_over_and_over() -> None:
    """Bars 2 and 3 from beat 3 of bar 2: the kick of bar 3 after 1 s, then each of both every 4 s."""
    player = PLAYER.looped(T, (1, 2)).sought(T, 3 * NS_PER_S)
    cues = song_cues(kicks(0, 4, 8, 12), player, None)
    assert cues["at_ns"][:5].tolist() == [s * NS_PER_S for s in (1, 3, 5, 7, 9)]
    assert cues["at_ns"][-1] > SOUNDED_NS - 4 * NS_PER_S


def test_a_flam_on_a_loop_s_first_note_keeps_its_grace_stroke() -> None:
    notes = [Note(0, Piece.SNARE, lead_ms=30.0), Note(0, Piece.SNARE)]
    score = Score.from_notes(notes, SONG.tempo_map, SONG.end_tick)
    cues = song_cues(score, PLAYER.looped(T, (0, 0)), None)
    assert cues["at_ns"][:3].tolist() == [0, BAR_NS - 30 * NS_PER_MS, BAR_NS]


@pytest.mark.parametrize("percent", [50, 100, 200])
@pytest.mark.parametrize("loop", [None, (0, 1)])
def test_the_first_beat_after_a_count_is_counted_too(percent: int, loop: tuple[int, int] | None) -> None:
    """A word begins 70 ms before its beat (`SPOKEN_LEAD_S`) at any speed; a bar has "one two three four"."""
    score = Score.from_notes([Note(i * PPQ, Piece.SNARE) for i in range(16)], TempoMap.constant(120.0))
    player = PLAYER.looped(T, loop).at_speed(T, percent)
    counted = replace(PLAIN, counts=True)
    count = count_in_of(player, counted)
    cues = after(count, song_cues(score, player, counted))
    words = cues[cues["bus"] == Bus.CLICK]
    beats_ns = count.lead_ns + np.arange(12) * BEAT_NS * 100 // percent
    assert words["at_ns"][:12].tolist() == (beats_ns - 70 * NS_PER_MS).tolist()
    assert words["piece"][:12].tolist() == words["piece"][:4].tolist() * 3
