"""A bar of singles, one of open doubles, one of press strokes: which of them was played is never in doubt.

A second stroke of a fast double comes as soon after the first as a slow bounce; yet a take that is exactly the score
must not lose against any other explanation of its hits.
"""

from dataclasses import replace
from itertools import permutations

import numpy as np
import pytest

from station.core.events import Hit
from station.core.pieces import Articulation, Ornament, Piece, Zone
from station.core.units import NS_PER_MS, PPQ
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.scoring.align import align
from station.scoring.following.follower import Follower

TEMPO_BPM = 190
"""Of doubles at 190 bpm the strokes are 79 ms apart: as a slow bounce is, `ignored_hits`."""

BAR = 4 * PPQ


def bar(kind: str) -> list[Note]:
    """Eighths as single strokes, as open doubles (16ths) or as press strokes; the foot on 2 and 4."""
    feet = [Note(beat * PPQ, Piece.HIHAT_PEDAL) for beat in (1, 3)]
    if kind == "doubles":
        return [Note(k * PPQ // 4, Piece.SNARE) for k in range(16)] + feet
    if kind == "singles":
        return [Note(k * PPQ // 2, Piece.SNARE) for k in range(8)] + feet
    return [buzz(k * PPQ // 2, PPQ // 2) for k in range(8)] + feet


def buzz(tick: int, duration_ticks: int) -> Note:
    """One press of the snare."""
    return Note(
        tick, Piece.SNARE, articulation=Articulation.BUZZ, ornament=Ornament.ROLL, duration_ticks=duration_ticks
    )


def bars(kinds: tuple[str, ...], loops: int) -> Score:
    """A bar of each kind in turn, so many times."""
    notes = [replace(note, tick=note.tick + k * BAR) for k, kind in enumerate(kinds) for note in bar(kind)]
    return Score.from_notes(notes, TempoMap.constant(TEMPO_BPM)).repeated(loops)


def played(score: Score, sd_ms: float, bounces: int, every_ms: float, softer: float = 0.85) -> Performance:
    """The score with so many bounces after each press, each softer than the one before."""
    rng = np.random.default_rng(7)
    hits = []
    for at, row in zip(score.onset_ns.tolist(), score.notes, strict=True):
        at_ns = at + round(sd_ms * rng.standard_normal() * NS_PER_MS)
        hits.append(Hit(at_ns, Piece(int(row["piece"])), Zone.HEAD, 80))
        if row["articulation"] == Articulation.BUZZ:
            every_ns = round(every_ms * NS_PER_MS)
            hits += [
                Hit(at_ns + k * every_ns, Piece.SNARE, Zone.HEAD, round(80 * softer**k)) for k in range(1, bounces + 1)
            ]
    return Performance.from_hits(sorted(hits, key=lambda hit: hit.at_ns))


def said_live(score: Score, performance: Performance) -> list[Label]:
    """The last word on each note that was spoken of while it was played, with a click."""
    follower = Follower(score)
    said = [
        judgement
        for at_ns, hit in zip(performance.hits["at_ns"].tolist(), performance, strict=True)
        for judgement in (*follower.advance(at_ns), *follower.hit(hit, at_ns))
    ]
    return list({j.note_index: j.label for j in said if j.note_index is not None}.values())


BOUNCES = [(0, 30.0), (1, 60.0), (2, 25.0), (2, 53.0), (4, 30.0), (12, 12.5)]
"""How many are heard of each press and how far apart: none, the few of a slow trigger, all that a stick makes."""


@pytest.mark.parametrize("kinds", list(permutations(("singles", "doubles", "buzz"))))
@pytest.mark.parametrize(("bounces", "every_ms"), BOUNCES)
@pytest.mark.parametrize(("loops", "sds_ms"), [(1, (0.0, 8.0, 15.0)), (8, (0.0, 15.0))])
@pytest.mark.parametrize("clocked", [True, False])
def test_who_plays_what_is_written_is_where_it_is_written(
    kinds: tuple[str, ...], bounces: int, every_ms: float, loops: int, sds_ms: tuple[float, ...], clocked: bool
) -> None:
    """Exactly, and with the scatter of a good and of an average hand: each note has its hit, no hit is over."""
    score = bars(kinds, loops)
    for sd_ms in sds_ms:
        alignment = align(score, played(score, sd_ms, bounces, every_ms), clocked)
        assert (alignment.count(Label.MISS), alignment.count(Label.EXTRA)) == (0, 0)


@pytest.mark.parametrize("every_ms", [30.0, 55.0])
def test_a_roll_whose_presses_may_be_bounces(every_ms: float) -> None:
    """Presses 143 ms apart and hardly louder than what they follow by 33 ms: 64 of them, and 8 of the foot."""
    notes = [buzz(k * PPQ // 4, PPQ // 4) for k in range(64)]
    feet = [Note(beat * PPQ, Piece.HIHAT_PEDAL) for beat in range(1, 16, 2)]
    score = Score.from_notes(notes + feet, TempoMap.constant(105))
    performance = played(score, 0.0, 2, every_ms, softer=0.9)
    alignment = align(score, performance, clocked=True)
    assert [alignment.count(label) for label in Label] == [72, 0, 0, 0, 128, 0, 0, 0]
    assert said_live(score, performance) == [Label.MATCH] * 72


@pytest.mark.parametrize("kinds", list(permutations(("singles", "doubles", "buzz"))))
@pytest.mark.parametrize("bounces", [0, 2])
def test_live_it_is_the_same(kinds: tuple[str, ...], bounces: int) -> None:
    """Every note is matched."""
    score = bars(kinds, 2)
    assert said_live(score, played(score, 0.0, bounces, 25.0)) == [Label.MATCH] * len(score)
