"""Bringing any score onto the grid: what an import does before it writes a lesson.

Times move to the nearest cell of the simplest division that suits their beat, velocities to the ghost, normal or accent
of their piece, every stroke to the letter nearest to it, and what three hands would be needed for is left out. Music
that the grid can write already stays as it is.
"""

from collections import Counter
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import groupby
from statistics import median_low
from types import MappingProxyType

from station.core.errors import BadInput
from station.core.pieces import HALF_OPEN, Articulation, Dynamic, Limb, Ornament, Piece
from station.core.units import NS_PER_MS, PPQ
from station.drills.grid.stroke_settings import Velocities
from station.drills.grid.tab_symbols import FOOT_OF, SYMBOLS, TabFamily, TabSymbol, family_of
from station.drills.lesson import Lesson, Section
from station.drills.quantise_time import on_cells
from station.drills.transcription.whole_bars import at_bar_starts
from station.drills.writing.lesson_writer import write_lesson
from station.motion.feasibility.playable import MAX_HANDS, unplayable_rows
from station.music.grace_strokes import Graces, with_graces
from station.music.score import Note, Score
from station.music.tempo import TempoMap

GHOST_BELOW, ACCENT_FROM = 50, 100
"""Velocities between HUMANS' ranges: ghost 20–45, normal 60–95, accent 105–127."""
BARS_A_SECTION = 4
SHORTEST_BUZZ_TICKS = PPQ // 4
"""A sixteenth, for a buzz of which the file does not say how long it lasts."""


@dataclass(frozen=True, slots=True)
class Quantised:
    """A score on the grid; how many strokes moved, the furthest of them (ms), and how many were left out."""

    score: Score
    velocities: Velocities
    moved: int
    furthest_ms: float
    left_out: int


def quantise_score(score: Score) -> Quantised:
    """`score` with every stroke on a cell of the grid, and the velocities that it is written with.

    Raises `BadInput` where a meter change cuts a bar at a place that no meter can name.
    """
    already = _velocities([n for n in score if not n.lead_ms])
    with suppress(BadInput):
        write_lesson(lesson_of(score, "score", "score", already))
        return Quantised(score, already, 0, 0.0, 0)
    tempo_map = at_bar_starts(score)
    mains = [n for n in score if not n.lead_ms]
    moved = on_cells(mains, tempo_map, score.end_tick)
    graces = Counter((n.tick, n.piece) for n in score if n.lead_ms)
    quantised_mains = [_as_symbol(n, graces[old.tick, old.piece]) for old, n in zip(mains, moved, strict=True)]
    kept = _trimmed(_unhurried(_playable(_single(quantised_mains)), tempo_map, score.end_tick), score.end_tick)
    velocities = _velocities(kept)
    rows = [row for n in kept for row in _with_graces(n, velocities)]
    shifts = [_shift_ns(a.tick, b.tick, score) for a, b in zip(mains, moved, strict=True)]
    quantised = Score.from_notes(rows, tempo_map, score.end_tick, score.title)
    furthest_ms = max(shifts, default=0) / NS_PER_MS
    return Quantised(quantised, velocities, sum(s > 0 for s in shifts), furthest_ms, len(mains) - len(kept))


def lesson_of(score: Score, name: str, title: str, velocities: Velocities | None = None) -> Lesson:
    """A lesson around `score`: sections of four bars, cut where tempo or meter change, all of it looped.

    Of the title, which another program may have written, what can be printed counts, else the name.
    """
    title = " ".join("".join(c if c.isprintable() else " " for c in title).split()) or name
    changes = {t.tick for t in score.tempo_map.tempos} | {m.tick for m in score.tempo_map.meters}
    starts = [0]
    for bar in range(1, score.bar_count):
        if bar - starts[-1] == BARS_A_SECTION or score.tempo_map.bar_start(bar) in changes:
            starts.append(bar)
    ends = [*(s - 1 for s in starts[1:]), score.bar_count - 1]
    return Lesson(
        name,
        title,
        replace(score, title=title),
        loop=(0, score.bar_count - 1),
        sections=tuple(Section("", a, b) for a, b in zip(starts, ends, strict=True)),
        velocities=velocities or Velocities(),
    )


def _shift_ns(before: int, after: int, score: Score) -> int:
    """How far a stroke moved; from the end to the start of the music is no way."""
    by = abs(int(score.tempo_map.ns_at(before)) - int(score.tempo_map.ns_at(after)))
    return min(by, abs(score.length_ns - by))


# --- strokes ----------------------------------------------------------------------------------------------------------


def _as_symbol(note: Note, graces: int) -> Note:
    """The note as the letter nearest to it plays it, with a limb that can."""
    ornament = (Ornament.NONE, Ornament.FLAM, Ornament.DRAG)[min(graces, 2)]
    is_buzz = note.articulation is Articulation.BUZZ
    dynamic = note.dynamic
    if dynamic is Dynamic.NORMAL:
        dynamic = _class(note.velocity)
    letter = nearest_letter(replace(note, dynamic=dynamic, ornament=Ornament.ROLL if is_buzz else ornament))
    return replace(
        note,
        zone=letter.zone,
        articulation=letter.articulation,
        dynamic=letter.dynamic,
        openness=letter.openness,
        ornament=letter.ornament,
        limb=_able(note),
        duration_ticks=note.duration_ticks if letter.articulation is Articulation.BUZZ else 0,
        choke_ticks=note.choke_ticks if family_of(note.piece) in (TabFamily.RIDE, TabFamily.CRASH) else 0,
    )


def _class(velocity: int) -> Dynamic:
    if velocity < GHOST_BELOW:
        return Dynamic.GHOST
    return Dynamic.ACCENT if velocity >= ACCENT_FROM else Dynamic.NORMAL


def nearest_letter(note: Note) -> TabSymbol:
    """The letter of the note's piece that differs least: articulation first, then zone, ornament, openness, dynamic."""
    openness = note.openness or 0.0

    def distance(letter: TabSymbol) -> tuple[bool, bool, bool, float, int]:
        return (
            letter.articulation is not note.articulation,
            letter.zone is not note.zone,
            letter.ornament is not note.ornament,
            abs((letter.openness or 0.0) - openness),
            abs(letter.dynamic - note.dynamic),
        )

    return min(SYMBOLS[family_of(note.piece)].values(), key=distance)


def _able(note: Note) -> Limb:
    """The note's limb if it can play that piece, else who does by custom."""
    if note.piece in FOOT_OF:
        return FOOT_OF[note.piece] if note.limb is Limb.UNKNOWN or note.limb.is_hand else note.limb
    return note.limb if note.limb.is_hand else Limb.UNKNOWN


_SET_FIRST = (Piece.PERCUSSION, Piece.CLAP, Piece.TAMBOURINE, Piece.COWBELL)
"""What is left out before anything of the drum set."""


def _single(notes: Sequence[Note]) -> list[Note]:
    """Of strokes on one piece at one moment, the loudest; both where two hands are named."""
    kept: dict[tuple[int, Piece, Limb], Note] = {}
    for note in sorted(notes, key=lambda n: -n.velocity):
        twins = [k for k in kept if k[:2] == (note.tick, note.piece)]
        if all(Limb.UNKNOWN not in (t[2], note.limb) and t[2] is not note.limb for t in twins):
            kept[(note.tick, note.piece, note.limb)] = note
    return sorted(kept.values(), key=lambda n: (n.tick, n.piece))


def _playable(notes: Sequence[Note]) -> list[Note]:
    """What two hands and two feet can strike at once; the sticking goes where it asks for one hand twice."""
    kept: list[Note] = []
    for _, group in groupby(notes, key=lambda n: n.tick):
        together = list(group)
        feet = [n for n in together if n.piece in FOOT_OF]
        hands = sorted((n for n in together if n.piece not in FOOT_OF), key=_importance)[:MAX_HANDS]
        if len(hands) == MAX_HANDS:
            hands = [replace(n, ornament=_alone(n)) for n in hands]
            if hands[0].limb is hands[1].limb:
                hands = [replace(n, limb=Limb.UNKNOWN) for n in hands]
        if any(n.piece is Piece.HIHAT and (n.openness or 0) >= HALF_OPEN for n in hands):
            feet = [n for n in feet if n.articulation is not Articulation.CHICK]
        by_limb = {n.limb: n for n in reversed(feet)}
        kept += [*hands, *by_limb.values()]
    return kept


def _importance(note: Note) -> tuple[int, int]:
    return _SET_FIRST.index(note.piece) + 1 if note.piece in _SET_FIRST else 0, -note.velocity


def _alone(note: Note) -> Ornament:
    """The ornament without grace strokes, for which no hand is left."""
    return Ornament.NONE if Graces().leads_ms(note.ornament) else note.ornament


def _unhurried(notes: Sequence[Note], tempo_map: TempoMap, end_tick: int) -> list[Note]:
    """The notes without those that nobody can play, once or again and again."""
    for times in (1, 2):
        notes = _possible(notes, tempo_map, end_tick, times)
    return list(notes)


def _possible(notes: Sequence[Note], tempo_map: TempoMap, end_tick: int, times: int) -> list[Note]:
    """The notes that can be played so many times on end; ornaments lose grace strokes that come too soon."""
    rows = [(i, row) for i, note in enumerate(notes) for row in _with_graces(note, Velocities())]
    rows.sort(key=lambda pair: (pair[1].tick, -pair[1].lead_ms, pair[1].piece))
    score = Score.from_notes([row for _, row in rows], tempo_map, end_tick).repeated(times)
    kept = dict(enumerate(notes))
    for index, row in (rows[i % len(rows)] for i in unplayable_rows(score).tolist()):
        if not row.lead_ms:
            kept.pop(index, None)
        elif index in kept:
            kept[index] = replace(kept[index], ornament=_alone(kept[index]))
    return list(kept.values())


def _trimmed(notes: Sequence[Note], end_tick: int) -> list[Note]:
    """Buzz rolls end, at the latest, where their piece is struck next; a cymbal that rings until then is not choked."""
    next_tick: dict[Piece, int] = {}
    kept: list[Note] = []
    for note in reversed(notes):
        room = next_tick.get(note.piece, end_tick) - note.tick
        is_buzz = note.articulation is Articulation.BUZZ
        duration = min(note.duration_ticks or SHORTEST_BUZZ_TICKS, room) if is_buzz else 0
        choke = note.choke_ticks if note.choke_ticks < room else 0
        kept.append(replace(note, duration_ticks=duration, choke_ticks=choke))
        next_tick[note.piece] = note.tick
    return kept[::-1]


# --- dynamics ---------------------------------------------------------------------------------------------------------


def _velocities(notes: Sequence[Note]) -> Velocities:
    """The median velocity of each dynamic on each piece; the usual one where a piece has no such stroke."""
    usual = Velocities().usual
    of_piece: dict[Piece, tuple[int, int, int]] = {}
    for piece in sorted({n.piece for n in notes}):
        heard = [[n.velocity for n in notes if n.piece is piece and n.dynamic is d] for d in Dynamic]
        own = [median_low(v) if v else u for v, u in zip(heard, usual, strict=True)]
        ghost, accent = min(own[0], own[1]), max(own[1], own[2])
        if (ghost, own[1], accent) != usual:
            of_piece[piece] = (ghost, own[1], accent)
    return Velocities(usual, MappingProxyType(of_piece))


def _with_graces(note: Note, velocities: Velocities) -> list[Note]:
    """The note at the velocity of its dynamic, its grace strokes before it."""
    return with_graces(replace(note, velocity=velocities.of(note.piece, note.dynamic), midi_note=0))
