"""How a motif is taken up, on a bar whose strokes are counted by hand."""

import numpy as np

from station.practice.battle.improvising.motif import Turning, motif_of, turned
from station.practice.battle.improvising.played_beats import Beats, Instrument, joined
from station.practice.battle.improvising.strokes_on_grid import GRID, GridStroke, beats_with, grid_strokes

_RNG = np.random.default_rng
_KICK, _SNARE, _HAT = Instrument.KICK, Instrument.SNARE, Instrument.CLOSED_HIHAT
_BAR = [
    *(GridStroke(beat * GRID, _HAT, 60) for beat in range(4)),
    GridStroke(0, _KICK, 90),
    GridStroke(GRID, _SNARE, 100),
    GridStroke(GRID + 18, _SNARE, 40),
    GridStroke(2 * GRID + 12, _KICK, 90),
]


def _bar() -> Beats:
    return beats_with(_BAR, 4, 4)


def _of(beats: Beats, instrument: Instrument) -> list[int]:
    return [stroke.at for stroke in grid_strokes(beats) if stroke.instrument is instrument]


def test_a_bar_goes_to_beats_and_back() -> None:
    key = lambda s: (s.at, s.instrument)  # noqa: E731
    assert sorted(grid_strokes(_bar()), key=key) == sorted(_BAR, key=key)


def test_triplets_and_sixteenths_have_beats_of_their_own() -> None:
    beats = beats_with([GridStroke(6, _SNARE, 80), GridStroke(GRID + 8, _SNARE, 80)], 2, 2)
    assert beats.division.tolist() == [4, 3]
    assert _of(beats, _SNARE) == [6, GRID + 8]


def test_as_it_was_is_as_it_was() -> None:
    assert grid_strokes(turned(_bar(), Turning.LITERAL, _RNG(1))) == grid_strokes(_bar())


def test_displaced_moves_all_but_the_timekeeping() -> None:
    moved = turned(_bar(), Turning.DISPLACED, _RNG(1))
    assert _of(moved, _HAT) == _of(_bar(), _HAT)
    by = {(b - a) % (4 * GRID) for a, b in zip(_of(_bar(), _SNARE), _of(moved, _SNARE), strict=True)}
    assert by in ({GRID // 2}, {GRID})


def test_augmented_takes_twice_as_long() -> None:
    longer = turned(_bar(), Turning.AUGMENTED, _RNG(1))
    assert _of(longer, _SNARE) == [2 * GRID, 2 * GRID + 36]
    assert _of(longer, _KICK) == [0]


def test_on_other_drums_keeps_the_rhythm() -> None:
    for seed in range(8):
        other = turned(_bar(), Turning.ORCHESTRATED, _RNG(seed))
        assert {s.at for s in grid_strokes(other)} == {s.at for s in _BAR}
        assert {s.instrument for s in grid_strokes(other)} != {s.instrument for s in _BAR}


def test_thinned_is_a_part_of_it() -> None:
    thin = {(s.at, s.instrument) for s in grid_strokes(turned(_bar(), Turning.THINNED, _RNG(3)))}
    assert thin < {(s.at, s.instrument) for s in _BAR}


def test_the_bar_that_says_most_is_the_motif() -> None:
    plain = beats_with([GridStroke(0, _KICK, 90), GridStroke(GRID, _SNARE, 90)], 4, 4)
    heard = joined([plain, plain, _bar(), Beats.silent(4, 4)])
    found = [motif_of(heard, _RNG(seed)) for seed in range(10)]
    assert any(one is not None and grid_strokes(one) == grid_strokes(_bar()) for one in found)
    assert all(one is not None and one.struck.any() for one in found)
    assert motif_of(Beats.silent(8, 4), _RNG(1)) is None
