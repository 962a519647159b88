"""Human performances against quantised copies of themselves: the truth is where each copy's note came from.

Each hit goes to its nearest 1/16 or 1/24 of a whole note on the file's own grid; hits of one number on one slot are one
note, which any of them may answer.
"""

from pathlib import Path

import numpy as np
import pytest

from station.core.units import NS_PER_MS, PPQ
from station.music.formats.smf.standard_midi import performance_from_midi, read_midi, score_from_midi
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Note, Score
from station.scoring.align import align
from tests.real_data import real_files

FILES = real_files("gmd/*/eval_session/*.mid")
Origins = list[set[int]]


def quantised(path: Path) -> tuple[Score, Performance, Origins]:
    midi = read_midi(path)
    tempo_map, performance = score_from_midi(midi).tempo_map, performance_from_midi(midi)
    ticks = tempo_map.ticks_at_ns(performance.hits["at_ns"])
    nearest = [np.rint(ticks / step).astype(np.int64) * step for step in (PPQ // 4, PPQ // 6)]
    slot = np.where(np.abs(ticks - nearest[0]) <= np.abs(ticks - nearest[1]), nearest[0], nearest[1])
    origins: dict[tuple[int, int], set[int]] = {}
    for i, (tick, number) in enumerate(zip(slot.tolist(), performance.hits["midi_note"].tolist(), strict=True)):
        origins.setdefault((tick, number), set()).add(i)
    first = {key: performance[min(of)] for key, of in origins.items()}
    notes = [
        Note(tick, hit.piece, hit.zone, hit.velocity, hit.articulation, midi_note=number)
        for (tick, number), hit in first.items()
    ]
    score = Score.from_notes(notes, tempo_map)
    return score, performance, [origins[int(row["tick"]), int(row["midi_note"])] for row in score.notes]


def f1(score: Score, performance: Performance, origins: Origins, clocked: bool) -> float:
    result = align(score, performance, clocked)
    pairs = [(n, h) for n, h in enumerate(result.hit_of_note.tolist()) if result.note_label[n] == Label.MATCH]
    right = sum(hit in origins[note] for note, hit in pairs)
    return 2 * right / (len(pairs) + len(score))


@pytest.mark.parametrize("path", FILES)
@pytest.mark.parametrize("start_ms", [0, 3_700, -700])
def test_a_performance_finds_itself(path: Path, start_ms: int) -> None:
    score, performance, origins = quantised(path)
    assert f1(score, performance.shifted(start_ms * NS_PER_MS), origins, clocked=False) >= 0.94


@pytest.mark.parametrize("path", FILES)
def test_a_performance_finds_itself_with_the_click(path: Path) -> None:
    score, performance, origins = quantised(path)
    assert f1(score, performance, origins, clocked=True) >= 0.97


@pytest.mark.parametrize("path", FILES)
def test_a_performance_finds_itself_at_another_tempo(path: Path) -> None:
    score, performance, origins = quantised(path)
    # the first bar may be taken for another
    assert f1(score.at_speed(0.8), performance.shifted(1_000 * NS_PER_MS), origins, clocked=False) >= 0.94
