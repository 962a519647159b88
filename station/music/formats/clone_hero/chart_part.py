"""From a drum chart to a drum part.

Our choices: an accent and a ghost have the station's usual velocities, for charts know no others. In a disco flip red
and yellow change places. A second kick is the left foot's. A roll lane over one note of its lane is a buzz roll as long
as the lane; over several the notes stand as charted. What the game's drummer does beside a note (within a 64th) says
its hand, and which cymbal or tom the lane stands for there.
"""

from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from station.core.pieces import DRUMS, OPEN, Articulation, Limb, Ornament, Piece
from station.core.units import PPQ
from station.music.drum_part import DrumPart
from station.music.formats.clone_hero.drum_chart import (
    ChartNote,
    DrumChart,
    Lane,
    Motion,
    Span,
    check_size,
    held_by,
    merged,
)
from station.music.formats.clone_hero.drum_lanes import MOTIONS_OF, STRIKE_OF, meaning_of
from station.music.formats.section_marks import sections_from_marks
from station.music.grace_strokes import with_graces
from station.music.score import Note, Score
from station.music.stroke_velocities import usual_velocity
from station.music.tempo import MeterChange, TempoChange, TempoMap

_FLIPPED = {Lane.RED: Lane.YELLOW, Lane.YELLOW: Lane.RED}
_SAME_TIME_QUARTERS = 1 / 16
_MOST_MOTIONS = 32
"""Motions that a stroke is compared with (our choice: two hands make no more within a 32nd)."""
_SHORTEST_CHOKE_TICKS = PPQ // 4


def part_of_chart(chart: DrumChart, source: str) -> DrumPart:
    """The part that `chart` says; raises `BadInput` where it is longer than music."""
    check_size(chart, source)
    tempo_map = _tempo_map(chart)
    strokes = _with_chokes(chart, _with_motions(chart, _strokes(chart)))
    notes = [row for stroke in strokes for row in with_graces(stroke)]
    score = Score.from_notes(notes, tempo_map, _end(chart, tempo_map, notes), chart.title)
    return DrumPart(
        score,
        chart.author,
        chart.about,
        sections=sections_from_marks(((_ticks(chart, tick), name) for tick, name in chart.sections), score),
        lost=(*chart.lost, *_lost(chart)),
    )


def _ticks(chart: DrumChart, tick: int) -> int:
    return (2 * tick * PPQ + chart.resolution) // (2 * chart.resolution)


def _tempo_map(chart: DrumChart) -> TempoMap:
    tempos = [TempoChange(_ticks(chart, tick), us) for tick, us in chart.tempos]
    meters = [MeterChange(_ticks(chart, tick), beats, unit) for tick, beats, unit in chart.meters]
    return TempoMap.build(tempos, meters)


def _end(chart: DrumChart, tempo_map: TempoMap, notes: Sequence[Note]) -> int:
    """The end of the bar in which the song ends, or the last note stands."""
    last = max((n.tick for n in notes), default=0)
    end = max(_ticks(chart, chart.end) - 1, last)
    return tempo_map.bar_start(int(tempo_map.bars_at(end)) + 1)


# --- strokes ---------------------------------------------------------------------------------------------------------


def _strokes(chart: DrumChart) -> list[Note]:
    """One stroke a note, in order; of several of one piece on a tick the loudest."""
    buzzes = _buzzes(chart)
    found: dict[tuple[int, Piece], Note] = {}
    for note in sorted(chart.notes, key=lambda n: n.tick):
        stroke = _stroke(chart, _flipped(note, chart.flips), buzzes.get((note.tick, note.lane), note.length))
        known = found.get((stroke.tick, stroke.piece))
        if known is None or stroke.dynamic > known.dynamic:
            found[stroke.tick, stroke.piece] = stroke
    return list(found.values())


def _stroke(chart: DrumChart, note: ChartNote, length: int) -> Note:
    meaning = meaning_of(note, chart.has_five_lanes)
    stroke = Note(
        _ticks(chart, note.tick),
        meaning.piece,
        meaning.zone,
        usual_velocity(note.dynamic),
        meaning.articulation,
        note.dynamic,
        Limb.LEFT_FOOT if note.is_second_kick else Limb.UNKNOWN,
        meaning.openness,
    )
    if length and meaning.piece in DRUMS:
        buzz = _ticks(chart, note.tick + length) - stroke.tick
        return replace(stroke, articulation=Articulation.BUZZ, ornament=Ornament.ROLL, duration_ticks=buzz)
    return replace(stroke, ornament=Ornament.FLAM) if note.is_flam and meaning.piece in DRUMS else stroke


def _flipped(note: ChartNote, flips: Sequence[Span]) -> ChartNote:
    """The note where a disco flip has it: red and yellow, which is the hi-hat there, change places."""
    if note.lane not in _FLIPPED or not held_by(note.tick, flips):
        return note
    return replace(note, lane=_FLIPPED[note.lane], is_cymbal=note.lane is Lane.RED)


def _buzzes(chart: DrumChart) -> dict[tuple[int, Lane], int]:
    """The notes that a roll lane holds alone, (tick, lane) -> length of the roll."""
    hands = sorted((n for n in chart.notes if n.lane is not Lane.KICK), key=lambda n: n.tick)
    found: dict[tuple[int, Lane], int] = {}
    for roll in merged(chart.rolls):
        inside = _between(hands, roll)
        if not inside:
            continue
        first = [n.lane for n in inside if n.tick == inside[0].tick]
        lane = first[0] if len(first) == 1 else None
        if lane is not None and sum(n.lane is lane for n in inside) == 1:
            found[inside[0].tick, lane] = roll.end - inside[0].tick
    return found


def _between(notes: Sequence[ChartNote], span: Span) -> Sequence[ChartNote]:
    first = bisect_left(notes, span.start, key=lambda n: n.tick)
    return notes[first : bisect_left(notes, max(span.end, span.start + 1), key=lambda n: n.tick)]


# --- the game's drummer ----------------------------------------------------------------------------------------------


def _with_motions(chart: DrumChart, strokes: Sequence[Note]) -> list[Note]:
    """The strokes with their hands, and on the cymbals and toms that the game's drummer plays."""
    slack = round(PPQ * _SAME_TIME_QUARTERS)
    motions = sorted(((_ticks(chart, m.tick), m) for m in chart.motions), key=lambda timed: timed[0])
    used: set[int] = set()
    found: dict[tuple[int, Piece], Note] = {}
    for stroke in strokes:
        first = bisect_left(motions, stroke.tick - slack, key=lambda timed: timed[0])
        last = bisect_right(motions, stroke.tick + slack, key=lambda timed: timed[0])
        near = [(i, *motions[i]) for i in range(first, min(last, first + _MOST_MOTIONS)) if i not in used]
        chosen = _best(near, stroke)
        used |= set() if chosen is None else {chosen}
        played = stroke if chosen is None else _moved(stroke, motions[chosen][1])
        found.setdefault((played.tick, played.piece), played)
    return _opened(chart, found.values())


def _best(near: Sequence[tuple[int, int, Motion]], stroke: Note) -> int | None:
    """Index of the motion that plays `stroke`: the likeliest piece first, then the nearest in time."""
    wanted = MOTIONS_OF.get(stroke.piece, ())
    fitting = [(wanted.index(m.piece), abs(tick - stroke.tick), i) for i, tick, m in near if m.piece in wanted]
    return min(fitting)[2] if fitting else None


def _moved(stroke: Note, motion: Motion) -> Note:
    strike = STRIKE_OF[motion.piece]
    return replace(stroke, piece=strike.piece, zone=strike.zone, openness=strike.openness, limb=motion.limb)


def _opened(chart: DrumChart, strokes: Iterable[Note]) -> list[Note]:
    """The strokes, the hi-hat's open where the pedal is up."""
    up = merged(Span(_ticks(chart, s.start), _ticks(chart, s.end)) for s in chart.open_hats)
    return [replace(s, openness=OPEN) if s.piece is Piece.HIHAT and held_by(s.tick, up) else s for s in strokes]


def _with_chokes(chart: DrumChart, strokes: Sequence[Note]) -> list[Note]:
    """The strokes, of which those before a grab are choked; of two grabs of one stroke the first counts."""
    struck: dict[Piece, list[int]] = {}
    for i, stroke in enumerate(strokes):
        struck.setdefault(stroke.piece, []).append(i)
    found = list(strokes)
    for grab in sorted(chart.grabs, key=lambda g: g.tick):
        at, of_piece = _ticks(chart, grab.tick), struck.get(grab.piece, [])
        before = bisect_right(of_piece, at, key=lambda i: strokes[i].tick)
        if before and not found[of_piece[before - 1]].choke_ticks:
            i = of_piece[before - 1]
            held = max(_ticks(chart, grab.length), _SHORTEST_CHOKE_TICKS)
            found[i] = replace(found[i], choke_ticks=at - strokes[i].tick or held)
    return found


def _lost(chart: DrumChart) -> Iterator[str]:
    left = len(merged(chart.rolls)) - len(_buzzes(chart))
    if left:
        yield f"{left} roll lanes over several notes: the notes stand as charted"
    if any(n.length and meaning_of(n, chart.has_five_lanes).piece not in DRUMS for n in chart.notes):
        yield "rolls on cymbals and the kick: one stroke stands for each"
