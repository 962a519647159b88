"""What a page lights while a take plays: the notes of the section pass by pass, and the strokes on the kit."""

from collections import Counter
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from station.core.labels import piece_name
from station.core.pieces import Piece, word
from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.music.judgement import Label
from station.practice.session.session import SessionResult
from station.render.report.page.session_page import NoteState
from station.render.report.take.shown_take import ShownPass, ShownStroke
from station.scenes.report.note_states import state_of
from station.scenes.report.practised_section import ELSEWHERE, practised_section, section_notes, section_ticks
from station.scenes.report.take_clock import TakeClock

_EXTRA, _FREE = "extra", "free"


def note_states(result: SessionResult) -> list[NoteState]:
    """What became of each judged note."""
    alignment, windows = result.alignment, result.plan.level.windows
    off_ms = (alignment.asynchrony_ns / NS_PER_MS).tolist()
    rows = zip(alignment.note_label.tolist(), off_ms, result.score.is_grace.tolist(), strict=True)
    return [state_of(label, off, None if is_grace else windows) for label, off, is_grace in rows]


def shown_passes(result: SessionResult, clock: TakeClock, end_s: float) -> tuple[ShownPass, ...]:
    """The passes over the practised section that begin before `end_s` of the take."""
    section = practised_section(result.plan)
    section_note, states, times_s = section_notes(result, section), note_states(result), _note_times(result, clock)
    ticks = result.score.notes["tick"]
    shown = []
    for bars in _passes(section_ticks(result, section)):
        (first, *_), (last, _, length) = bars[0], bars[-1]
        inside = np.flatnonzero((ticks >= first) & (ticks < last + length) & (section_note != ELSEWHERE)).tolist()
        notes = [(int(section_note[row]), float(times_s[row]), str(states[row])) for row in inside]
        path = _path(bars, clock)
        if notes and path[0][0] < end_s:  # the silence between passes that follow the student has none
            shown.append(ShownPass(path, tuple(sorted(notes, key=lambda note: note[1]))))
    return tuple(shown)


def _passes(bars: list[tuple[int, int, int]]) -> list[list[tuple[int, int, int]]]:
    """The bars of the score that are bars of the section, pass by pass: one begins where the section's tick falls."""
    starts = [k for k, (_, tick, _) in enumerate(bars) if k == 0 or tick <= bars[k - 1][1]]
    return [bars[begin:until] for begin, until in pairwise([*starts, len(bars)])]


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
        state = str(states[note]) if note >= 0 else alone
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
