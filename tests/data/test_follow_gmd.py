"""Human performances followed live, without a click, through quantised copies of themselves.

The truth is where each copy's note came from (`quantised`).
"""

from pathlib import Path

import numpy as np
import pytest

from station.music.judgement import Label
from station.scoring.follower import Follower
from tests.data.test_assess_gmd import quantised
from tests.real_data import real_files


@pytest.mark.parametrize("path", real_files("gmd/*/eval_session/*.mid"))
@pytest.mark.parametrize("rate", [1.0, 0.85, 1.15])
def test_people_are_followed_without_a_click(path: Path, rate: float) -> None:
    """As they played and at another tempo than counted in; the beginning, before the tempo is known, included."""
    score, performance, origins = quantised(path)
    follower = Follower(score, clocked=False)
    note_of_hit: dict[int, int | None] = {}
    for hit in performance:
        for verdict in follower.hit(hit, int(np.rint(hit.at_ns / rate))):
            if verdict.hit_index is not None:
                note_of_hit[verdict.hit_index] = verdict.note_index if verdict.label is Label.MATCH else None
    pairs = [(note, hit) for hit, note in note_of_hit.items() if note is not None]
    right = sum(hit in origins[note] for note, hit in pairs)
    assert 2 * right / (len(pairs) + len(score)) >= 0.96
