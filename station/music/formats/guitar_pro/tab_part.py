"""From a Guitar Pro song's drum track to a drum part: repeats written out, notes made strokes.

Our choices: one grace note of the same drum is a flam, two a drag; a grace note of another drum is a ghost stroke a
32nd earlier. Tremolo of eighths and sixteenths is written out; of 32nds it is a diddle or an open roll on a drum. An
accent or ghost shades the velocity of its beat as the station's usual velocities do. Triplet and dotted feel move the
offbeats that last at least their half of the pair and stand in no tuplet, as Guitar Pro plays them; the tempo of a
bar is the written one, whichever time it is played.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import groupby

from station.core.errors import BadInput
from station.core.note_map import strike_of
from station.core.pieces import CHOKEABLE, DRUMS, Dynamic, Ornament, Piece
from station.core.units import PPQ
from station.music.drum_part import DrumPart, PartSection
from station.music.formats.guitar_pro.tab_kit import CHOKED, TAB_KIT
from station.music.formats.guitar_pro.tab_song import MOST_TAB_STROKES, TabBar, TabBeat, TabNote, TabSong
from station.music.formats.playing_order import BarSigns, playing_order
from station.music.grace_strokes import with_graces
from station.music.score import Note, Score
from station.music.stroke_velocities import shaded
from station.music.swing import MIN_RATIO, STRAIGHT, Swing
from station.music.tempo import MeterChange, TempoChange, TempoMap

_GRACE_TICKS = PPQ // 8
_DIDDLE_TICKS = PPQ // 8
"""Tremolo strokes of 32nds: two to a sixteenth, as diddles are."""
_ORNAMENTS = {0: Ornament.NONE, 1: Ornament.FLAM, 2: Ornament.DRAG}


def part_of_song(song: TabSong, source: str) -> DrumPart:
    """The part that `song` says; raises `BadInput` where repeats make more than music has."""
    order = playing_order(list(_signs(song.bars)), source)
    if sum(_stroke_count(song.bars[i]) for i in order) > MOST_TAB_STROKES:
        raise BadInput(source, "", f"more than {MOST_TAB_STROKES} strokes as it is played")
    swing, lost = _swing(song.bars)
    strokes = [_bar_strokes(bar, swing) for bar in song.bars]
    starts = _starts(song.bars, order)
    notes = [replace(n, tick=max(n.tick + at, 0)) for i, at in zip(order, starts, strict=False) for n in strokes[i]]
    score = Score.from_notes(notes, _tempo_map(song.bars, order, starts), starts[-1], song.title)
    return DrumPart(
        score,
        song.author,
        song.about,
        None,
        swing,
        _sections(song.bars, order),
        lost=(*song.lost, *_lost_graces(song.bars), *lost),
    )


def _signs(bars: Sequence[TabBar]) -> Iterator[BarSigns]:
    """The signs of the bars, each ending on all that it is over: to its repeat's end, or to the next ending.

    The last ending is over its first bar alone: nothing in the file says where it ends, and it is played but once.
    """
    closes = [False] * (len(bars) + 1)  # whether a repeat ends here or later, before another ending or repeat begins
    for i in range(len(bars) - 1, -1, -1):
        begins = i + 1 < len(bars) and (bars[i + 1].signs.endings or bars[i + 1].signs.repeat_from)
        closes[i] = bool(bars[i].signs.repeat_times) or (closes[i + 1] and not begins)
    inside: frozenset[int] = frozenset()
    for bar, is_closed in zip(bars, closes, strict=False):
        inside = bar.signs.endings or (inside if is_closed and not bar.signs.repeat_from else frozenset())
        yield replace(bar.signs, endings=inside)
        inside = frozenset() if bar.signs.repeat_times else inside


# --- where bars stand ------------------------------------------------------------------------------------------------


def _starts(bars: Sequence[TabBar], order: Sequence[int]) -> list[int]:
    """The tick of every played bar, and of the end."""
    starts = [0]
    for i in order:
        starts.append(starts[-1] + bars[i].meter.bar_ticks)
    return starts


def _tempo_map(bars: Sequence[TabBar], order: Sequence[int], starts: Sequence[int]) -> TempoMap:
    tempos: list[TempoChange] = []
    meters: list[MeterChange] = []
    for i, start in zip(order, starts, strict=False):
        tempos += [TempoChange(start + tick, us) for tick, us in bars[i].tempos]
        meters.append(replace(bars[i].meter, tick=start))
    return TempoMap.build(tempos, meters)


def _sections(bars: Sequence[TabBar], order: Sequence[int]) -> tuple[PartSection, ...]:
    """Each run of played bars under one marker; what stands before the first has no name."""
    marker, of_bar = -1, []
    for i, bar in enumerate(bars):
        marker = i if bar.section else marker
        of_bar.append(marker)
    found = []
    for of, run in groupby(enumerate(order), key=lambda played: of_bar[played[1]]):
        places = [at for at, _ in run]
        if of >= 0:
            found.append(PartSection(bars[of].section, places[0], places[-1]))
    return tuple(found)


# --- swing -----------------------------------------------------------------------------------------------------------


def _swing(bars: Sequence[TabBar]) -> tuple[Swing, tuple[str, ...]]:
    """How the whole part swings, or straight with a line that says where it does."""
    feels = {bar.feel for bar in bars if bar.beats}
    if len(feels) == 1 and (only := feels.pop()).ratio >= MIN_RATIO:
        return only, ()
    swung = [i + 1 for i, bar in enumerate(bars) if bar.feel.ratio != STRAIGHT]
    if not swung or not feels:
        return Swing(), () if not swung else (_partly(swung),)
    return Swing(), (_partly(swung),)


def _partly(swung: Sequence[int]) -> str:
    return f"the swing of some bars only (from bar {swung[0]}): their strokes stand where they sound"


def _swung(bar: TabBar, beat: TabBeat, swing: Swing) -> tuple[int, int]:
    """Where the beat is played, in ticks of the bar, and how much of that notation leaves to the part's `swing`."""
    feel = bar.feel
    is_offbeat = beat.tick % (2 * feel.unit_ticks) == feel.unit_ticks
    if feel.ratio == STRAIGHT or beat.is_tuplet or not is_offbeat or beat.length_ticks < feel.unit_ticks:
        return beat.tick, 0
    tick = feel.swung(beat.tick, bar.meter)
    return tick, tick - beat.tick if feel == swing and feel.stands_in_words else 0


# --- strokes ---------------------------------------------------------------------------------------------------------


def _stroke_count(bar: TabBar) -> int:
    return sum(
        len(note.graces) + (beat.length_ticks // note.tremolo_ticks if note.tremolo_ticks else 1)
        for beat in bar.beats
        for note in beat.notes
    )


def _bar_strokes(bar: TabBar, swing: Swing) -> list[Note]:
    """The strokes of a bar; what two voices write alike is one, the louder."""
    loudest: dict[tuple[int, int], tuple[TabBeat, TabNote]] = {}
    for beat in bar.beats:
        for note in beat.notes:
            known = loudest.get((beat.tick, note.number))
            if known is None or (note.dynamic, note.velocity) > (known[1].dynamic, known[1].velocity):
                loudest[beat.tick, note.number] = (beat, note)
    return [stroke for beat, note in loudest.values() for stroke in _strokes(note, beat, *_swung(bar, beat, swing))]


def _strokes(note: TabNote, beat: TabBeat, tick: int, swing_ticks: int) -> Iterator[Note]:
    if note.is_tied and not note.tremolo_ticks:
        return
    main = _stroke(note.number, tick, note)
    if main.piece in CHOKEABLE and note.number in CHOKED:
        main = replace(main, choke_ticks=beat.length_ticks)
    if note.tremolo_ticks and beat.length_ticks >= 2 * note.tremolo_ticks:
        yield from _roll(main, beat.length_ticks // note.tremolo_ticks, note)
        return
    for number in note.graces:
        if not _is_of(number, main.piece):
            grace = _stroke(number, tick - _GRACE_TICKS, replace(note, dynamic=Dynamic.GHOST))
            yield grace
    own = min(sum(_is_of(number, main.piece) for number in note.graces), 2)
    yield from with_graces(replace(main, ornament=_ORNAMENTS[own], swing_ticks=swing_ticks))


def _is_of(number: int, piece: Piece) -> bool:
    return strike_of(number, TAB_KIT).piece is piece


def _stroke(number: int, tick: int, note: TabNote) -> Note:
    strike = strike_of(number, TAB_KIT)
    return Note(
        tick,
        strike.piece,
        strike.zone,
        shaded(note.velocity, note.dynamic),
        strike.articulation,
        note.dynamic,
        openness=strike.openness,
        midi_note=number if 0 < number < 128 else 0,
    )


def _roll(main: Note, count: int, note: TabNote) -> Iterator[Note]:
    """Strokes one after the other, an accent on the first alone; 32nds on a drum in pairs as diddles are."""
    step_ticks, unmarked = note.tremolo_ticks, min(note.dynamic, Dynamic.NORMAL)
    paired = count - count % 2 if step_ticks == _DIDDLE_TICKS and main.piece in DRUMS else 0
    ornament = Ornament.ROLL if paired > 2 else Ornament.DIDDLE
    later = replace(main, dynamic=unmarked, velocity=shaded(note.velocity, unmarked))
    for i in range(count):
        of = main if i == 0 else later
        yield replace(of, tick=main.tick + i * step_ticks, ornament=ornament if i < paired else Ornament.NONE)


def _lost_graces(bars: Sequence[TabBar]) -> tuple[str, ...]:
    long = next((i for i, bar in enumerate(bars) for b in bar.beats for n in b.notes if len(n.graces) > 2), None)
    return () if long is None else (f"more than two grace notes before a stroke, from bar {long + 1}: two were kept",)
