"""What the engine sounds of a song that is played from some place on, at some speed, in a loop or not.

Loops are unrolled, as everywhere: so many passes as fill `SOUNDED_NS`; whoever plays on longer asks again.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_S
from station.engine.messages import CUE_DTYPE
from station.music.score import Score
from station.music.tempo import TempoMap
from station.practice.demonstration.song_player import SongPlayer
from station.practice.session.cues.click_pattern import ClickPattern, click_cues, counting, leads_ns
from station.practice.session.cues.stroke_cues import demonstration_cues

SOUNDED_NS = 600 * NS_PER_S
"""How long a loop sounds before the engine must be told again; our choice."""


def song_cues(score: Score, player: SongPlayer, click: ClickPattern | None) -> NDArray[np.void]:
    """The cues (n,) of `CUE_DTYPE` of `player` from its `at_ns` on, which is cue time 0; times are at its speed.

    The word that counts the first beat begins before it, at a negative time. A grace stroke on a loop's first note
    sounds at the end of the pass before. None for `click`: strokes alone.
    """
    low_ns, high_ns = player.span_ns
    length_ns = high_ns - low_ns
    section = score if player.loop is None else score.bars(*player.loop)
    parts = [demonstration_cues(section)]
    if click is not None:
        parts.append(click_cues(section.tempo_map, section.end_tick, click))
    once = np.concatenate(parts)
    passes = 1 if player.loop is None else 2 + SOUNDED_NS * player.speed_percent // 100 // length_ns
    cues = np.tile(once, passes).astype(CUE_DTYPE)
    cues["at_ns"] += np.repeat(np.arange(passes, dtype=np.int64) * length_ns, len(once)) + low_ns - player.at_ns
    leads = leads_ns(cues)  # a counted word begins before its beat, by the clock and at any speed
    beats = cues["at_ns"] + leads
    ahead = beats >= 0
    cues, leads, beats = cues[ahead], leads[ahead], beats[ahead]
    cues["at_ns"] = beats * 100 // player.speed_percent - leads
    return cues[np.argsort(cues["at_ns"], kind="stable")]


@dataclass(frozen=True, eq=False)
class CountIn:
    """What is counted before a song goes on: `cues` from 0, `length_ns` until it does, both at the player's speed.

    `tempo_map` is the count's own, from its first beat, which comes `lead_ns` after 0.
    """

    cues: NDArray[np.void]
    length_ns: int
    lead_ns: int
    tempo_map: TempoMap

    def beat(self, left_ns: int) -> int | None:
        """The beat of the bar, from 1, that is counted when so much is left; None before the first."""
        at_ns = self.length_ns - left_ns - self.lead_ns
        if at_ns < 0 or left_ns <= 0:
            return None
        return self.tempo_map.position_at(int(self.tempo_map.ticks_at_ns(at_ns))).beat + 1


def count_in_of(player: SongPlayer, click: ClickPattern) -> CountIn:
    """A bar of clicks in the meter and at the tempo of where `player` stands, and so much more as lies before it there.

    From the middle of a bar it counts "one two three four, one two" and goes on with three.
    """
    written = player.song.tempo_map
    tick = player.song.tick_at(player.at_ns)
    start = written.bar_start(int(written.bars_at(tick)))
    meter = written.meter_at(tick)
    plain = TempoMap.constant(written.bpm_at(tick) * player.speed_percent / 100)
    tempo_map = TempoMap.build(plain.tempos, [replace(meter, tick=0)])
    end_tick = meter.bar_ticks + tick - start
    cues = click_cues(tempo_map, end_tick, counting(click))
    lead_ns = max(-int(cues["at_ns"].min(initial=0)), 0)  # a word begins before its beat
    cues["at_ns"] += lead_ns
    return CountIn(cues, lead_ns + int(tempo_map.ns_at(end_tick)), lead_ns, tempo_map)


def after(count_in: CountIn, cues: NDArray[np.void]) -> NDArray[np.void]:
    """The count, then `cues`."""
    moved = cues.copy()
    moved["at_ns"] += count_in.length_ns
    return np.concatenate([count_in.cues, moved])
