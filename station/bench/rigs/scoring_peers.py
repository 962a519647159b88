"""Other programs' ways from hits to notes, for the benchmarks to run beside ours on the same work.

Each peer is a function from a score and what was played to the note of each hit (m,), −1 for none. They come with
`pip install .[peers]`; where a peer is not installed, it raises `ImportError` and has no figures.

* mir_eval 0.8: `match_events` piece by piece, a window of 35 ms to each side, in the file's own time.
* synctoolbox 1.4: MrMsDTW over a row of impulses a piece (50 a second), then piece by piece the notes and hits that are
  each other's nearest in warped time, the running median of what is left taken out, and again.
* parangonar 3.4: `DualDTWNoteMatcher` on note arrays whose pitch is the piece.
"""

import importlib
from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType, ModuleType

import numpy as np
from numpy.typing import NDArray

from station.bench.rigs.scoring_work import PlayedWork
from station.core.units import NS_PER_S, PPQ
from station.music.score import Score

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]
Peer = Callable[[Score, PlayedWork], Indices]

_WINDOW_S, _WARPED_WINDOW_S = 0.035, 0.07
_FRAMES_PER_S, _ROWS = 50, 12
_FADE = np.sqrt(np.linspace(1.0, 0.1, 10))
"""An onset fades over ten frames, as in synctoolbox's own features of onsets (DLNCO)."""

_MEDIAN_HALF_WIDTH = 15
_STRETCH_S = 1.0


def _module(name: str) -> ModuleType:
    return importlib.import_module(name)


# --- mir_eval ---------------------------------------------------------------------------------------------------------


def _mir_eval(score: Score, played: PlayedWork) -> Indices:
    match_events = _module("mir_eval").util.match_events
    at_s = played.performance.hits["at_ns"] / NS_PER_S
    return _by_piece(score, played, at_s, lambda notes, hits: match_events(notes, hits, _WINDOW_S))


def _by_piece(score: Score, played: PlayedWork, at_s: Floats, match: "_Match") -> Indices:
    """The note of each hit at `at_s` (m,), the pieces matched one by one."""
    said = np.full(len(at_s), -1, np.int64)
    pieces = played.performance.hits["piece"]
    for piece in np.intersect1d(score.notes["piece"], pieces):
        own, struck = np.flatnonzero(score.notes["piece"] == piece), np.flatnonzero(pieces == piece)
        for note, hit in match(score.onset_s[own], at_s[struck]):
            said[struck[hit]] = own[note]
    return said


_Match = Callable[[Floats, Floats], Iterable[tuple[int, int]]]


# --- synctoolbox ------------------------------------------------------------------------------------------------------


def _synctoolbox(score: Score, played: PlayedWork) -> Indices:
    at_s = played.performance.hits["at_ns"] / NS_PER_S
    start_s = min(float(at_s.min()), 0.0)
    warped = _warped(score, played, start_s)
    said = _by_piece(score, played, warped, _mutually_nearest)
    known = np.flatnonzero(said >= 0)
    left_over = _running_median(warped[known] - score.onset_s[said[known]])
    refined = warped - np.interp(at_s, at_s[known], left_over)
    return _by_piece(score, played, refined, _mutually_nearest)


def _mutually_nearest(notes: Floats, hits: Floats) -> list[tuple[int, int]]:
    """Pairs within the window that are each other's nearest; hits, in warped time, need not be in order."""
    order = np.argsort(hits, kind="stable")
    note_of, hit_of = _nearest(notes, hits), order[_nearest(hits[order], notes)]
    mutual = note_of[hit_of] == np.arange(len(notes))
    close = np.abs(hits[hit_of] - notes) <= _WARPED_WINDOW_S
    return [(int(note), int(hit_of[note])) for note in np.flatnonzero(mutual & close)]


def _nearest(among: Floats, of: Floats) -> Indices:
    """Index into `among`, sorted, of the nearest to each of `of`."""
    right = np.clip(np.searchsorted(among, of), 1, max(len(among) - 1, 1))
    left_is_nearer = of - among[right - 1] <= among[np.minimum(right, len(among) - 1)] - of
    return np.minimum(np.where(left_is_nearer, right - 1, right), len(among) - 1)


def _warped(score: Score, played: PlayedWork, start_s: float) -> Floats:
    """Score time of each hit by MrMsDTW."""
    sync = _module("synctoolbox.dtw.mrmsdtw").sync_via_mrmsdtw
    monotonic = _module("synctoolbox.dtw.utils").make_path_strictly_monotonic
    hits = played.performance.hits
    rows = {piece: k % _ROWS for k, piece in enumerate(np.union1d(score.notes["piece"], hits["piece"]).tolist())}
    written = _features(score.onset_s - start_s, score.notes["piece"], rows)
    heard = _features(hits["at_ns"] / NS_PER_S - start_s, hits["piece"], rows)
    path = monotonic(
        sync(
            f_chroma1=written,
            f_onset1=written,
            f_chroma2=heard,
            f_onset2=heard,
            input_feature_rate=_FRAMES_PER_S,
            verbose=False,
        )
    )
    frames = (hits["at_ns"] / NS_PER_S - start_s) * _FRAMES_PER_S
    return np.asarray(np.interp(frames, path[1], path[0])) / _FRAMES_PER_S + start_s


def _features(at_s: Floats, pieces: NDArray[np.uint8], rows: Mapping[int, int]) -> Floats:
    frames = np.rint(at_s * _FRAMES_PER_S).astype(np.int64)
    table = np.full((_ROWS, int(frames.max()) + len(_FADE) + round(_STRETCH_S * _FRAMES_PER_S)), 1e-4)
    for row, frame in zip([rows[int(p)] for p in pieces], frames.tolist(), strict=True):
        part = table[row, frame : frame + len(_FADE)]
        np.maximum(part, _FADE, out=part)
    return table


def _running_median(values: Floats) -> Floats:
    padded = np.pad(values, _MEDIAN_HALF_WIDTH, mode="edge")
    return np.asarray(np.median(np.lib.stride_tricks.sliding_window_view(padded, 2 * _MEDIAN_HALF_WIDTH + 1), axis=1))


# --- parangonar -------------------------------------------------------------------------------------------------------

_SCORE_FIELDS = [("onset_beat", "f4"), ("duration_beat", "f4"), ("onset_quarter", "f4"), ("duration_quarter", "f4")]
_HIT_FIELDS = [("onset_sec", "f4"), ("duration_sec", "f4"), ("velocity", "i4")]
_SHARED_FIELDS = [("pitch", "i4"), ("id", "U16"), ("is_grace", "?")]


def _parangonar(score: Score, played: PlayedWork) -> Indices:
    match = _module("parangonar").DualDTWNoteMatcher()
    hits = played.performance.hits
    written = np.zeros(len(score), _SCORE_FIELDS + _SHARED_FIELDS)
    written["onset_beat"] = written["onset_quarter"] = score.notes["tick"] / PPQ
    written["duration_beat"] = written["duration_quarter"] = 0.25
    written["pitch"], written["id"] = 36 + score.notes["piece"], [f"n{k}" for k in range(len(score))]
    heard = np.zeros(len(hits), _HIT_FIELDS + _SHARED_FIELDS)
    heard["onset_sec"], heard["duration_sec"], heard["velocity"] = hits["at_ns"] / NS_PER_S, 0.1, hits["velocity"]
    heard["pitch"], heard["id"] = 36 + hits["piece"], [f"p{k}" for k in range(len(hits))]
    said = np.full(len(hits), -1, np.int64)
    for pair in match(written, heard):
        if pair["label"] == "match":
            said[int(pair["performance_id"][1:])] = int(pair["score_id"][1:])
    return said


PEERS: Mapping[str, Peer] = MappingProxyType(
    {"mir_eval": _mir_eval, "synctoolbox": _synctoolbox, "parangonar": _parangonar}
)
"""Every peer by the name that it is installed under."""
