"""Takes of a lesson as somebody else's pads would write them: the virtual player of `transcription_takes`.

Made here and not by the station's own student, and with none of its constants: every stroke lies so many ms beside its
time (Gaussian), with a lean, a wrong tempo, or errors that wander as 1/f noise as human tapping does (Gilden, Thornton
& Mallon 1995; Hennig et al. 2011). A flam is two strokes, a drag three and a buzz a chain of rebounds, as modules send
them; loudness strays too. Nothing but note numbers, times and velocities, tempo and meter is in the file.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Dynamic, Ornament
from station.core.units import NS_PER_S
from station.music.formats.smf.track_writer import score_bytes
from station.music.score import Note, Score
from station.music.tempo import TempoMap

REBOUND_S, REBOUND_SD_S = 0.028, 0.004
"""How far apart the rebounds of a press are: 25–40 a second (a stick pressed into a head, seen in slow motion)."""
REBOUND_SHARE = 0.7
"""Rebounds are softer than the stroke that they follow, a third of whose height is lost (our choice)."""
FLAM_SD, DRAG_SD = 0.2, 0.12
"""The spread of spacings: flams mostly 15–40 ms, drags 40–70 (HUMANS, Timing)."""


@dataclass(frozen=True, slots=True)
class Playing:
    """How a take is played; `spread_ms` to `wander_ms` are of time, the shares of strokes.

    Gaussian spread, constant lean and 1/f wander in ms; by how much too slow; the spread of velocities; the share of
    strokes that is missed, and of strokes that nobody wrote.
    """

    spread_ms: float = 12.0
    lean_ms: float = 0.0
    slow: float = 1.0
    wander_ms: float = 0.0
    loudness: float = 7.0
    missing: float = 0.0
    extra: float = 0.0


@dataclass(frozen=True, eq=False)
class Take:
    """`data` is the MIDI file; of the main strokes that were `written` (n,), `played` (n,) says which were played."""

    data: bytes
    played: NDArray[np.bool_]


def take_of(score: Score, playing: Playing, rng: np.random.Generator) -> Take:
    """A take of `score`, whose first bar is empty."""
    mains = score.notes[~score.is_grace]
    played = rng.random(len(mains)) >= playing.missing
    late = _errors_s(len(mains), playing, rng)
    times = score.tempo_map.ns_at(mains["tick"]) / NS_PER_S * playing.slow + late
    graces = _leads_s(score)
    strokes: list[tuple[float, Note]] = []
    for i, main in enumerate(Score.from_array(mains, score.tempo_map)):
        if played[i]:
            leads = graces.get((main.tick, int(main.piece)), [])
            strokes += [(float(times[i]) + s, note) for s, note in _sounded(main, leads, score.tempo_map, rng)]
    strokes += _strays(strokes, round(playing.extra * len(mains)), rng)
    return Take(_file(strokes, score.tempo_map, playing, rng), played)


def _errors_s(count: int, playing: Playing, rng: np.random.Generator) -> NDArray[np.float64]:
    errors = rng.normal(playing.lean_ms, playing.spread_ms, count)
    if playing.wander_ms and count > 2:
        errors = errors + playing.wander_ms * wander(count, rng)
    return errors / 1000


def wander(count: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """1/f noise of standard deviation 1, by its spectrum."""
    frequencies = np.fft.rfftfreq(count)[1:]
    phases = rng.uniform(0, 2 * np.pi, len(frequencies))
    noise: NDArray[np.float64] = np.fft.irfft(np.concatenate([[0], np.exp(1j * phases) / np.sqrt(frequencies)]), count)
    noise /= noise.std()
    return noise


def _leads_s(score: Score) -> dict[tuple[int, int], list[tuple[float, int]]]:
    """The grace strokes of each main stroke: how long before it, and how loud."""
    found: dict[tuple[int, int], list[tuple[float, int]]] = {}
    for row in score.notes[score.is_grace]:
        own = found.setdefault((int(row["tick"]), int(row["piece"])), [])
        own.append((float(row["lead_ms"]) / 1000, int(row["velocity"])))
    return found


def _sounded(
    main: Note, leads: list[tuple[float, int]], tempo_map: TempoMap, rng: np.random.Generator
) -> Iterator[tuple[float, Note]]:
    """What a pad sends for one stroke, each with its seconds after it."""
    plain = replace(main, ornament=Ornament.NONE, dynamic=Dynamic.NORMAL, lead_ms=0.0, duration_ticks=0, swing_ticks=0)
    wide = 1 + (FLAM_SD if len(leads) == 1 else DRAG_SD) * float(rng.normal())
    for lead, velocity in leads:
        yield -max(lead * max(wide, 0.5), 0.012), replace(plain, velocity=velocity)
    if main.articulation is not Articulation.BUZZ:
        yield 0.0, plain
        return
    end = float(tempo_map.ns_at(main.tick + main.duration_ticks) - tempo_map.ns_at(main.tick)) / NS_PER_S
    at, plain = 0.0, replace(plain, articulation=Articulation.NORMAL)
    velocity = float(main.velocity)
    while at < max(end - REBOUND_S / 2, 2.5 * REBOUND_S):
        yield at, replace(plain, velocity=round(velocity))
        at += max(float(rng.normal(REBOUND_S, REBOUND_SD_S)), REBOUND_S / 2)
        velocity = main.velocity * REBOUND_SHARE


def _strays(strokes: list[tuple[float, Note]], count: int, rng: np.random.Generator) -> Iterator[tuple[float, Note]]:
    """Strokes at any time, each on a piece that is struck in the take, and rather soft."""
    end = max((s for s, _ in strokes), default=0.0)
    for _ in range(count):
        _, like = strokes[int(rng.integers(len(strokes)))]
        yield float(rng.uniform(0, end)), replace(like, velocity=int(rng.integers(20, 70)))


def _file(strokes: list[tuple[float, Note]], tempo_map: TempoMap, playing: Playing, rng: np.random.Generator) -> bytes:
    """The strokes as a MIDI file, a bar after its start."""
    bar = tempo_map.meters[0].bar_ticks
    later = TempoMap.build(
        [replace(t, tick=t.tick + bar if t.tick else 0) for t in tempo_map.tempos],
        [replace(m, tick=m.tick + bar if m.tick else 0) for m in tempo_map.meters],
    )
    start = float(later.ns_at(bar)) / NS_PER_S
    notes = [
        replace(
            note,
            tick=int(later.ticks_at(max(start + at, 0.0))),
            velocity=int(np.clip(round(rng.normal(note.velocity, playing.loudness)), 1, 127)),
        )
        for at, note in strokes
    ]
    return score_bytes(Score.from_notes(notes, later), "take")
