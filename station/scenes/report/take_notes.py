"""What a page lights while a take plays: the notes of the section pass by pass, and the strokes on the kit."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from station.core.labels import piece_name
from station.core.pieces import Piece, word
from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.music.judgement import Label
from station.practice.session.session import SessionResult
from station.render.report.take.shown_take import ShownPass, ShownStroke
from station.scenes.report.take_clock import TakeClock

_EXTRA, _FREE = "extra", "free"


@dataclass(frozen=True, eq=False)
class SectionPlace:
    """Where the judged score lies on the section that the page engraves.

    `notes` (n,) are the section's rows of the judged notes, −1 for none. `bars` are the bars of the score that are bars
    of the section, in order of time: (the score's tick, the section's tick, the length); a pass begins where the
    section's tick does not rise.
    """

    notes: NDArray[np.int64]
    bars: Sequence[tuple[int, int, int]]


def note_states(result: SessionResult) -> list[str | None]:
    """What became of each judged note; None where nobody can tell."""
    alignment, windows = result.alignment, result.plan.level.windows
    states: list[str | None] = []
    rows = zip(alignment.note_label.tolist(), alignment.asynchrony_ns.tolist(), result.score.is_grace, strict=True)
    for label, late_ns, is_grace in rows:
        if label == Label.MATCH:
            lean = 0 if is_grace else windows.lean(late_ns / NS_PER_MS)
            states.append(("early", "match", "late")[lean + 1])
        else:
            states.append({Label.MISS: "miss", Label.WRONG_PIECE: "wrong_piece"}.get(Label(label)))
    return states


def shown_passes(result: SessionResult, place: SectionPlace, clock: TakeClock, end_s: float) -> tuple[ShownPass, ...]:
    """The passes that begin before `end_s` of the take."""
    starts = [k for k, (_, tick, _) in enumerate(place.bars) if k == 0 or tick <= place.bars[k - 1][1]]
    passes = [place.bars[begin:until] for begin, until in pairwise([*starts, len(place.bars)])]
    times_s = _note_times(result, clock)
    states = note_states(result)
    ticks = result.score.notes["tick"]
    shown = []
    for bars in passes:
        (first, *_), (last, _, length) = bars[0], bars[-1]
        inside = np.flatnonzero((ticks >= first) & (ticks < last + length) & (place.notes >= 0)).tolist()
        notes = [(int(place.notes[row]), float(times_s[row]), state) for row in inside if (state := states[row])]
        path = _path(bars, clock)
        if path[0][0] < end_s:
            shown.append(ShownPass(path, tuple(sorted(notes, key=lambda note: note[1]))))
    return tuple(shown)


def _note_times(result: SessionResult, clock: TakeClock) -> NDArray[np.float64]:
    """When each judged note is lit: at its hit, or when it was due."""
    hit = result.alignment.hit_of_note
    due_s = clock.seconds_at(result.score.notes["tick"])
    if not len(result.performance):
        return due_s
    hit_s = (result.performance.hits["at_ns"][np.maximum(hit, 0)] + clock.lead_ns) / NS_PER_S
    return np.asarray(np.where(hit >= 0, hit_s, due_s))


def _path(bars: Sequence[tuple[int, int, int]], clock: TakeClock) -> tuple[tuple[float, float], ...]:
    """Times and ticks of the section at every quarter of the bars, and at their end."""
    path = []
    for score_tick, section_tick, length in bars:
        steps = np.arange(0, length, PPQ)
        times = clock.seconds_at(score_tick + steps).tolist()
        path += list(zip(times, (section_tick + steps).astype(float).tolist(), strict=True))
    score_tick, section_tick, length = bars[-1]
    path.append((float(clock.seconds_at(score_tick + length)), float(section_tick + length)))
    return tuple(path)


def shown_strokes(result: SessionResult, clock: TakeClock) -> tuple[ShownStroke, ...]:
    """All strokes of the student, in order of time."""
    states, note_of_hit = note_states(result), result.alignment.note_of_hit.tolist()
    kit, hits = result.plan.kit, result.performance.hits
    rows = zip(hits["at_ns"].tolist(), hits["piece"].tolist(), hits["velocity"].tolist(), strict=True)
    strokes = []
    for hit, (at_ns, piece, velocity) in enumerate(rows):
        note = note_of_hit[hit]
        alone = _EXTRA if result.alignment.hit_label[hit] == Label.EXTRA else _FREE
        state = (states[note] if note >= 0 else None) or alone
        time_s = (at_ns + clock.lead_ns) / NS_PER_S
        strokes.append(ShownStroke(time_s, word(kit.stand_in(Piece(piece))), velocity, state))
    return tuple(strokes)


def extras_in_words(result: SessionResult) -> str:
    """How many strokes answer no note, and on what; empty where there are none."""
    extra = result.performance.hits["piece"][result.alignment.hit_label == Label.EXTRA].tolist()
    if not extra:
        return ""
    counted = [f"{count} {piece_name(Piece(piece))}" for piece, count in Counter(extra).most_common()]
    return f"Strokes that no note answers, heard and seen here too: {', '.join(counted)}."
