"""Work for the benchmarks of scoring: grooves with fills, and hits on them with a truth that is known.

The workload is the one that the station's figures are stated for: 16th-note grooves with fills at 120 bpm, played
with a tempo of 1 + depth·sin(2πt/60 s), normal noise on every stroke, notes left out, strokes added anywhere and
strokes on another piece. Seeded, so that every run does the same.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.core.units import NS_PER_S, PPQ
from station.music.performance import HIT_DTYPE, Performance
from station.music.score import NOTE_DTYPE, Score
from station.music.tempo import TempoMap

BAR_TICKS = 4 * PPQ
_STEPS = 16
_FILL_EVERY = 8
_DRIFT_PERIOD_S = 60.0
_KIT = (Piece.KICK, Piece.SNARE, Piece.HIHAT, Piece.RIDE, Piece.CRASH_1, Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1)
_FILL = (Piece.SNARE, Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1)


def grooves(notes: int, seed: int = 0, tempo_bpm: float = 120.0) -> Score:
    """At least `notes` strokes of eight-bar phrases: one groove of 16ths a phrase, a fill, a crash on the one after."""
    rng = np.random.default_rng(seed)
    rows: list[tuple[int, Piece]] = []
    bar = 0
    while len(rows) < notes:
        kicks = {0, *rng.choice(np.arange(1, _STEPS), 3, replace=False).tolist()}
        snares = {4, 12, *(rng.choice(np.arange(_STEPS), 2, replace=False).tolist() if rng.random() < 0.5 else ())}
        hats = range(0, _STEPS, 1 if rng.random() < 0.5 else 2)
        cymbal = Piece.HIHAT if rng.random() < 0.75 else Piece.RIDE
        for phrase_bar in range(_FILL_EVERY):
            start = bar * BAR_TICKS
            steps = [(k, Piece.KICK) for k in kicks] + [(s, Piece.SNARE) for s in snares] + [(h, cymbal) for h in hats]
            if phrase_bar == _FILL_EVERY - 1:
                steps = [s for s in steps if s[0] < _STEPS // 2]
                steps += [(k, _FILL[int(rng.integers(len(_FILL)))]) for k in range(_STEPS // 2, _STEPS)]
            if phrase_bar == 0 and bar:
                steps.append((0, Piece.CRASH_1))
            rows += [(start + step * PPQ // 4, piece) for step, piece in steps]
            bar += 1
    table = np.zeros(len(rows), NOTE_DTYPE)
    table["tick"], table["piece"] = [tick for tick, _ in rows], [piece for _, piece in rows]
    table["velocity"], table["dynamic"], table["limb"], table["openness"] = 80, 1, -1, np.nan
    return Score.from_array(table, TempoMap.constant(tempo_bpm))


def flams(notes: int, with_grace: bool = True, tempo_bpm: float = 120.0) -> Score:
    """`notes` strokes of flams on the snare, a quarter apart, each a grace stroke 30 ms before its main stroke.

    Not `with_grace`: the main strokes alone.
    """
    table = np.zeros(notes, NOTE_DTYPE)
    table["tick"], table["piece"] = np.arange(notes) // 2 * PPQ, Piece.SNARE
    table["lead_ms"] = np.where(np.arange(notes) % 2, 0.0, _FLAM_MS)
    table["velocity"], table["dynamic"], table["limb"], table["openness"] = 80, 1, -1, np.nan
    return Score.from_array(table if with_grace else table[1::2], TempoMap.constant(tempo_bpm))


_FLAM_MS = 30.0
"""HUMANS, Timing: 15–40 ms."""


@dataclass(frozen=True, slots=True)
class WorkPlayer:
    """How the hits differ from the notes: SD in ms, depth of the tempo's drift, shares of what goes wrong."""

    sd_ms: float = 15.0
    drift: float = 0.03
    missing: float = 0.03
    extra: float = 0.03
    wrong_piece: float = 0.02
    tempo: float = 1.0
    start_s: float = 0.0


@dataclass(frozen=True, eq=False)
class PlayedWork:
    """What was played, and the truth about it.

    `note_of_hit` (m,) the note that each hit was meant for, −1 for an extra; `is_wrong` (m,) on another piece;
    `hit_score_ns` (m,) the hits brought to score time by the true tempo.
    """

    performance: Performance
    note_of_hit: NDArray[np.int64]
    is_wrong: NDArray[np.bool_]
    hit_score_ns: NDArray[np.int64]


def play(score: Score, player: WorkPlayer, seed: int = 0) -> PlayedWork:
    """Play `score`; the true warp is known to the caller through `hit_score_ns`."""
    rng = np.random.default_rng(seed)
    kept = np.flatnonzero(rng.random(len(score)) >= player.missing)
    added = round(player.extra * len(score))
    piece = np.concatenate((score.notes["piece"][kept], rng.choice(_KIT, added)))
    is_wrong = np.concatenate((rng.random(len(kept)) < player.wrong_piece, np.zeros(added, bool)))
    others = {own: [p for p in _KIT if p != own] for own in Piece}
    piece[is_wrong] = [rng.choice(others[Piece(p)]) for p in piece[is_wrong]]
    exact = np.concatenate((score.onset_s[kept], rng.random(added) * (score.length_ns / NS_PER_S)))
    played_s = _warped(exact, player) + np.concatenate((rng.normal(0, player.sd_ms / 1e3, len(kept)), np.zeros(added)))
    order = np.argsort(played_s, kind="stable")
    hits = np.zeros(len(order), HIT_DTYPE)
    hits["at_ns"], hits["piece"], hits["velocity"] = np.rint(played_s[order] * NS_PER_S), piece[order], 80
    hits["openness"] = hits["position"] = np.nan
    hits["limb"] = -1
    meant = np.concatenate((kept, np.full(added, -1)))[order]
    back_ns = np.rint(_unwarped(played_s[order], score, player) * NS_PER_S).astype(np.int64)
    return PlayedWork(Performance.from_array(hits), meant, is_wrong[order], back_ns)


def _warped(score_s: NDArray[np.float64], player: WorkPlayer) -> NDArray[np.float64]:
    """When the player plays what stands at `score_s`: their tempo is tempo·(1 + drift·sin(2πs/60 s))."""
    grid = np.arange(min(score_s.min(initial=0.0), 0.0) - 1, score_s.max(initial=0.0) + 1.01, 0.01)
    rate = player.tempo * (1 + player.drift * np.sin(2 * np.pi * grid / _DRIFT_PERIOD_S))
    at = np.concatenate(([0.0], np.cumsum(0.01 / rate[:-1])))
    at += player.start_s - np.interp(0.0, grid, at)
    return np.asarray(np.interp(score_s, grid, at))


def _unwarped(played_s: NDArray[np.float64], score: Score, player: WorkPlayer) -> NDArray[np.float64]:
    grid = np.arange(-2.0, score.length_ns / NS_PER_S + 2.0, 0.01)
    return np.asarray(np.interp(played_s, _warped(grid, player), grid))


def f1(note_of_hit: NDArray[np.int64], played: PlayedWork) -> float:
    """F1 of the matched pairs (m,) (−1 unmatched) against the truth: right piece, the note that was meant."""
    truth = np.where(played.is_wrong, -1, played.note_of_hit)
    right = int(((note_of_hit == truth) & (truth >= 0)).sum())
    claimed, real = int((note_of_hit >= 0).sum()), int((truth >= 0).sum())
    return 2 * right / (claimed + real) if claimed + real else 1.0
