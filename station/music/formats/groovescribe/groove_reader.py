"""A groove's letters as a part: every stroke where GrooveScribe plays it, and as loud.

A buzz lasts until the hands strike again, at most to the end of its beat, as GrooveScribe prints it. A sticking
letter says the hand of a cell's stroke where the hands strike once there; B and c, and a letter over two strokes, do
not say which hand plays what.
"""

from collections.abc import Iterator
from dataclasses import replace

from station.core.pieces import Articulation, Limb
from station.music.drum_part import DrumPart
from station.music.formats.groovescribe.groove_letters import (
    HANDS,
    LETTERS,
    UNHEARD,
    VELOCITIES,
    GrooveStroke,
)
from station.music.formats.groovescribe.groove_query import WEB_PAGE, Groove, parse_groove
from station.music.grace_strokes import with_graces
from station.music.score import Note, Score
from station.music.swing import Swing
from station.music.tempo import TempoChange, TempoMap

_REST = "-"
_LIMBS = {"R": Limb.RIGHT_HAND, "r": Limb.RIGHT_HAND, "L": Limb.LEFT_HAND, "l": Limb.LEFT_HAND}
_OTHER_STICKINGS = "Bbc"
_HOSTS = (WEB_PAGE.split("/")[2], "mikeslessons.com", "montulli.github.io")
"""Where GrooveScribe itself is at home; its offspring elsewhere play all four toms."""


def read_groove(text: str, source: str) -> DrumPart:
    """The part in a GrooveScribe link or query; raises `BadInput` of `source`."""
    return part_of_groove(parse_groove(text, source), _plays_all_toms(text))


def _plays_all_toms(text: str) -> bool:
    address = text.strip().partition("?")[0].lower()
    return "//" in address and address.split("/")[2] not in _HOSTS


def part_of_groove(groove: Groove, all_toms: bool = False) -> DrumPart:
    """The part that `groove` plays; without `all_toms` its T2 and T3 are silent."""
    silent = () if all_toms else UNHEARD
    lines = {name: letters for name, letters in groove.lines.items() if name not in silent}
    swing = swing_of(groove.swing, groove.cell_ticks) if groove.swings else Swing()
    notes = [note for cell in range(groove.cells_per_bar * groove.bars) for note in _cell(groove, lines, cell, swing)]
    tempo_map = TempoMap.build([TempoChange.from_bpm(0, groove.tempo)], [groove.meter])
    end = groove.bars * groove.meter.bar_ticks
    score = Score.from_notes(notes, tempo_map, end, groove.title)
    lost = (*groove.lost, *_unread(groove, silent))
    return DrumPart(score, groove.author, groove.comments, None, swing, lost=lost)


def swing_of(percent: int, unit_ticks: int) -> Swing:
    """GrooveScribe's swing: the long cell is `percent` longer than straight, the short one as much shorter."""
    return Swing((100 + percent) / (100 - percent), unit_ticks)


# --- a cell -----------------------------------------------------------------------------------------------------------


def _cell(groove: Groove, lines: dict[str, str], cell: int, swing: Swing) -> Iterator[Note]:
    """The strokes of all lines in a cell, grace strokes before theirs."""
    tick, swing_ticks = _place(groove, cell, swing)
    struck = [(name, stroke) for name, letters in lines.items() for stroke in LETTERS[name].get(letters[cell], ())]
    hands = [stroke for name, stroke in struck if name in HANDS]
    letter = groove.stickings[cell] if groove.stickings else _REST
    limb = _LIMBS.get(letter, Limb.UNKNOWN) if len(hands) == 1 else Limb.UNKNOWN
    for name, stroke in struck:
        note = replace(note_of(stroke, tick), swing_ticks=swing_ticks, limb=limb if name in HANDS else Limb.UNKNOWN)
        if stroke.articulation is Articulation.BUZZ:
            note = replace(note, duration_ticks=_place(groove, _buzz_end(groove, lines, cell), swing)[0] - tick)
        yield from with_graces(note)


def note_of(stroke: GrooveStroke, tick: int) -> Note:
    """The main note of `stroke` at `tick`."""
    return Note(
        tick,
        stroke.piece,
        stroke.zone,
        VELOCITIES[stroke.dynamic],
        stroke.articulation,
        stroke.dynamic,
        openness=stroke.openness,
        ornament=stroke.ornament,
    )


def _place(groove: Groove, cell: int, swing: Swing) -> tuple[int, int]:
    """The tick where a cell is played, and how much later that is than notation writes it."""
    bar, inside = divmod(cell, groove.cells_per_bar)
    start, straight = bar * groove.meter.bar_ticks, inside * groove.cell_ticks
    played = swing.swung(straight, groove.meter)
    return start + played, played - straight if swing.stands_in_words else 0


def _buzz_end(groove: Groove, lines: dict[str, str], cell: int) -> int:
    """The cell where a buzz that begins in `cell` ends."""
    beat = max(groove.meter.usual_beat_ticks // groove.cell_ticks, 1)
    bar = cell // groove.cells_per_bar * groove.cells_per_bar
    last = min(bar + ((cell - bar) // beat + 1) * beat, bar + groove.cells_per_bar)
    taken = (i for i in range(cell + 1, last) if any(lines[n][i] in LETTERS[n] for n in HANDS if n in lines))
    return next(taken, last)


# --- what is not read -------------------------------------------------------------------------------------------------


def _unread(groove: Groove, silent: tuple[str, ...]) -> Iterator[str]:
    for name, letters in groove.lines.items():
        known = LETTERS[name]
        if name in silent:
            if count := sum(letter in known for letter in letters):
                yield f"{name}: GrooveScribe plays only the toms T1 and T4; strokes left out: {count}"
            continue
        unknown = sorted(set(letters) - {*known, _REST})
        if unknown:
            first = min(letters.index(letter) for letter in unknown)
            bar, cell = divmod(first, groove.cells_per_bar)
            shown = " ".join(repr(letter) for letter in unknown[:8])
            yield f"{name}, bar {bar + 1}, cell {cell + 1}: read as rests, for GrooveScribe knows no {shown} there"
    if odd := set(groove.stickings) - {*_LIMBS, *_OTHER_STICKINGS, _REST}:
        yield f"Stickings: no letters of GrooveScribe's are {' '.join(map(repr, sorted(odd)[:8]))}"
