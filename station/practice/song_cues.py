"""What the engine sounds of a song that is played from some place on, at some speed, in a loop or not.

Loops are unrolled, as everywhere: so many passes as fill `SOUNDED_NS`; whoever plays on longer asks again.
"""

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_S
from station.engine.messages import CUE_DTYPE
from station.music.score import Score
from station.practice.click import ClickPattern, click_cues
from station.practice.plan import demonstration_cues
from station.practice.song_player import SongPlayer

SOUNDED_NS = 600 * NS_PER_S
"""How long a loop sounds before the engine must be told again; our choice."""


def song_cues(score: Score, player: SongPlayer, click: ClickPattern | None) -> NDArray[np.void]:
    """The cues (n,) of `CUE_DTYPE` of `player` from its `at_ns` on, which is cue time 0; times are at its speed.

    A grace stroke on a loop's first note sounds at the end of the pass before. None for `click`: strokes alone.
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
    cues = cues[cues["at_ns"] >= 0]
    cues["at_ns"] = cues["at_ns"] * 100 // player.speed_percent
    return cues[np.argsort(cues["at_ns"], kind="stable")]
