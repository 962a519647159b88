"""Human performances followed live, without a click, through quantised copies of themselves.

The truth is where each copy's note came from (`quantised`).
"""

from pathlib import Path

import numpy as np
import pytest

from station.music.judgement import Label
from station.scoring.following.follower import Follower
from tests.real_data import real_files
from tests.recordings.test_assess_gmd import quantised

FILES = real_files("gmd/*/eval_session/*.mid")


def live_f1(path: Path, rate: float) -> float:
    """How well a recording, played `rate` times as fast, is followed; the beginning included."""
    score, performance, origins = quantised(path)
    follower = Follower(score, clocked=False)
    note_of_hit: dict[int, int | None] = {}
    for hit in performance:
        for verdict in follower.hit(hit, int(np.rint(hit.at_ns / rate))):
            if verdict.hit_index is not None:
                note_of_hit[verdict.hit_index] = verdict.note_index if verdict.label is Label.MATCH else None
    pairs = [(note, hit) for hit, note in note_of_hit.items() if note is not None]
    right = sum(hit in origins[note] for note, hit in pairs)
    return 2 * right / (len(pairs) + len(score))


@pytest.mark.parametrize("path", FILES)
def test_people_are_followed_without_a_click(path: Path) -> None:
    assert live_f1(path, 1.0) >= 0.96


@pytest.mark.parametrize("path", FILES)
def test_people_are_followed_at_other_tempi_than_counted_in(path: Path) -> None:
    """15 % slower and faster; one groove, which rushes in its first bar, 10 % (docs/gmd-cross.md says why)."""
    rates = (0.9, 1.1) if path.match("drummer7/eval_session/2_*") else (0.85, 1.15)
    for rate in rates:
        assert live_f1(path, rate) >= 0.95
