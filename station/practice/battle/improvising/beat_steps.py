"""Beats as the steps that are predicted one after the other, and what is known before each of them.

A step is a cell of a beat. All cells of 3, 4, 6 and 8 lie on a grid of 24 to a beat, so that the same place a beat, a
bar or four bars ago is found whatever the beats there are divided into. What is known before a step is a row of
numbers: the last steps, what was struck at this place earlier and what came then, how much of each instrument the last
bars had, where the step stands, and the music's style.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.practice.battle.ground import Feel, Ground
from station.practice.battle.improvising.played_beats import Beats, Instrument
from station.practice.battle.improvising.played_divisions import DIVISIONS

GRID = 24
"""The least common multiple of the divisions."""
INSTRUMENTS = len(Instrument)
RECENT = 12
"""So many steps before a step are seen: three beats of sixteenths."""
PLACES = tuple(sorted({cell * GRID // division for division in DIVISIONS for cell in range(division)}))
"""Where in a beat a cell may lie, on the grid."""
MOST_BEATS_A_BAR, PHRASE_BARS = 4, 4
"""Places in the bar beyond the fourth beat are all one; phrases have four bars."""
LONGEST_LAG = 16
"""In beats: 64 sixteenths."""
STYLES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "rock": ("rock",),
        "funk": ("funk",),
        "jazz": ("jazz", "swing", "bebop"),
        "soul": ("soul", "motown", "gospel"),
        "latin": ("latin", "reggaeton", "samba", "bossa", "baiao"),
        "hiphop": ("hiphop", "breakbeat"),
        "neworleans": ("neworleans", "secondline"),
        "afro": ("afrobeat", "afrocuban", "highlife", "bembe", "rhumba"),
        "reggae": ("reggae",),
        "punk": ("punk", "metal"),
        "pop": ("pop", "country", "ballad"),
        "dance": ("dance", "disco", "house"),
        "shuffle": ("shuffle", "purdieshuffle", "blues"),
    }
)
"""The words of the dataset, and of grounds, that mean each style; metal is none of the dataset's, punk is nearest."""


@dataclass(frozen=True, slots=True)
class Music:
    """What the music is: `styles` are words of `STYLES`; `phrase_bar` is where its first bar is in a phrase."""

    styles: frozenset[str] = frozenset()
    feel: Feel = Feel.STRAIGHT
    beats_a_minute: float = 110.0
    phrase_bar: int = 0

    @classmethod
    def of(cls, ground: Ground, phrase_bar: int = 0) -> "Music":
        """The music of a ground."""
        return cls(styles_of(ground.style), ground.feel, ground.beats_a_minute, phrase_bar)


def styles_of(words: str) -> frozenset[str]:
    """The styles that words such as "latin/brazilian-samba" name; none where none is known."""
    said = set(words.lower().replace("/", " ").replace("-", " ").split())
    return frozenset(style for style, names in STYLES.items() if said & set(names))


def music_row(music: Music) -> NDArray[np.float32]:
    """The numbers of the music that stay for all steps: style, feel, tempo."""
    styles = [style in music.styles for style in STYLES]
    tempo = (music.beats_a_minute - 110.0) / 40.0  # the dataset's mean and spread
    return np.array([*styles, music.feel is Feel.TRIPLET, tempo], np.float32)


@dataclass(frozen=True, eq=False)
class Steps:
    """The steps (s,) of beats: `beat`, `cell` and `at`, on the grid from the first beat on; `division` (n,) of beats.

    `struck` (RECENT + s, 9) are the steps behind so many silent ones, `grid` the same at their places behind
    `LONGEST_LAG` silent beats, `counts` (n + 1, 9) how often each instrument was struck before each beat.
    """

    beats_a_bar: int
    division: NDArray[np.int64]
    beat: NDArray[np.int64]
    cell: NDArray[np.int64]
    at: NDArray[np.int64]
    struck: NDArray[np.float32] = field(repr=False)
    grid: NDArray[np.float32] = field(repr=False)
    counts: NDArray[np.float32] = field(repr=False)

    @property
    def played(self) -> NDArray[np.float32]:
        """What was struck at each step (s, 9), 0 or 1."""
        return self.struck[RECENT:]


def steps_of(beats: Beats) -> Steps:
    """The steps of beats that are known."""
    beat, cell = np.nonzero(np.arange(max(DIVISIONS)) < beats.division[:, None])
    at = beat * GRID + cell * (GRID // beats.division[beat])
    played = beats.struck[beat, cell].astype(np.float32)
    grid = np.zeros(((LONGEST_LAG + len(beats)) * GRID, INSTRUMENTS), np.float32)
    grid[at + LONGEST_LAG * GRID] = played
    counts = np.cumsum(beats.struck.sum(axis=1, dtype=np.float32), axis=0, dtype=np.float32)
    return Steps(
        beats.beats_a_bar,
        beats.division,
        beat.astype(np.int64),
        cell.astype(np.int64),
        at.astype(np.int64),
        np.concatenate([np.zeros((RECENT, INSTRUMENTS), np.float32), played]),
        grid,
        np.concatenate([np.zeros((1, INSTRUMENTS), np.float32), counts]),
    )


# --- what is known before a step --------------------------------------------------------------------------------------

_EARLIER = (
    (0, 1, (0, 1, 2)),
    (0, 2, (0, 1, 2)),
    (1, 0, (-1, 0, 1, 2, 3)),
    (2, 0, (0, 1, 2)),
    (4, 0, (0, 1)),
)
"""Bars ago, beats ago, and which steps about that place are seen, in cells of the beat that is played."""
_SPANS = (4, 16)
"""Over so many beats it is counted how much of each instrument there was."""
AMOUNTS = len(_SPANS) * INSTRUMENTS
"""Columns of `amounts`."""
_HISTORY_BARS = (1, 2, 4)
"""So many bars that have been heard are told apart, for silence is not the same as nothing heard."""


def step_rows(steps: Steps, which: NDArray[np.int64], music: Music) -> NDArray[np.float32]:
    """What is known before each of the steps `which` (m,), shape (m, columns)."""
    beat, at = steps.beat[which], steps.at[which]
    columns = [
        _recent(steps, which),
        _earlier(steps, beat, at),
        amounts(steps, beat),
        place_in_beat(steps.division[beat], at),
        beat_place(beat, steps.beats_a_bar, music),
        np.broadcast_to(music_row(music), (len(which), len(STYLES) + 2)),
    ]
    return np.concatenate(columns, axis=1)


def _recent(steps: Steps, which: NDArray[np.int64]) -> NDArray[np.float32]:
    seen: NDArray[np.float32] = steps.struck[which[:, None] + np.arange(RECENT)]
    return seen.reshape(len(which), -1)


def _earlier(steps: Steps, beat: NDArray[np.int64], at: NDArray[np.int64]) -> NDArray[np.float32]:
    rows = at[:, None] + earlier_offsets(GRID // steps.division[beat], steps.beats_a_bar)
    seen: NDArray[np.float32] = steps.grid[np.maximum(rows, 0)]
    return seen.reshape(len(at), -1)


def earlier_offsets(cell: NDArray[np.int64], beats_a_bar: int) -> NDArray[np.int64]:
    """Which rows of the grid are seen (m, 16), beside each step's place, where a `cell` (m,) has so many of it."""
    lags = [(bars * beats_a_bar + beats, about) for bars, beats, about in _EARLIER]
    offsets = np.array([(LONGEST_LAG - min(lag, LONGEST_LAG)) * GRID for lag, about in lags for _ in about])
    cells = np.array([step for _, about in lags for step in about])
    return np.asarray(offsets + cells * cell[:, None])


def amounts(steps: Steps, beat: NDArray[np.int64] | int) -> NDArray[np.float32]:
    """Strokes a beat of each instrument in the last beats before `beat`, one or (m,)."""
    counts = steps.counts
    past = [(counts[beat] - counts[np.maximum(beat - span, 0)]) / np.float32(span) for span in _SPANS]
    return np.concatenate(past, axis=-1)


def place_in_beat(division: NDArray[np.int64], at: NDArray[np.int64]) -> NDArray[np.float32]:
    """Where in its beat each step (m,) stands, and how that is divided."""
    in_beat = (at % GRID)[:, None] == np.array(PLACES)
    cut = division[:, None] == np.array(DIVISIONS)
    return np.concatenate([in_beat, cut], axis=1).astype(np.float32)


def beat_place(beat: NDArray[np.int64], beats_a_bar: int, music: Music) -> NDArray[np.float32]:
    """Where in bar and phrase each beat (m,) stands, and how much of the music has been heard before it."""
    bar, in_bar = np.divmod(beat, beats_a_bar)
    in_bar = np.minimum(in_bar, MOST_BEATS_A_BAR)[:, None] == np.arange(MOST_BEATS_A_BAR + 1)
    in_phrase = ((bar + music.phrase_bar) % PHRASE_BARS)[:, None] == np.arange(PHRASE_BARS)
    heard = bar[:, None] >= np.array(_HISTORY_BARS)
    is_three = np.full((len(beat), 1), beats_a_bar == 3)
    return np.concatenate([in_bar, in_phrase, heard, is_three], axis=1).astype(np.float32)


def division_rows(steps: Steps, which: NDArray[np.int64], music: Music) -> NDArray[np.float32]:
    """What is known before the beats `which` (m,) of how they are divided, shape (m, columns)."""
    return np.concatenate(
        [
            past_divisions(steps, which),
            amounts(steps, which),
            beat_place(which, steps.beats_a_bar, music),
            np.broadcast_to(music_row(music), (len(which), len(STYLES) + 2)),
        ],
        axis=1,
    )


def past_divisions(steps: Steps, which: NDArray[np.int64]) -> NDArray[np.float32]:
    """How the last beats, and those of the last bars, were divided, seen from beats (m,)."""
    lags = (1, 2, 3, steps.beats_a_bar, 2 * steps.beats_a_bar, 4 * steps.beats_a_bar)
    past = which[:, None] - np.array(lags)
    said: NDArray[np.float32] = _ONE_OF[steps.division[np.maximum(past, 0)]] * (past >= 0)[:, :, None]
    return said.reshape(len(which), -1)


_ONE_OF = (np.arange(max(DIVISIONS) + 1)[:, None] == np.array(DIVISIONS)).astype(np.float32)
"""By number of cells, which of the divisions it is: a one among zeros."""
