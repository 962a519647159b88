"""The practised bars as elements of a page: a line each, whose notes and times a script can find.

Each line is `<svg class="bars" data-line="[[tick, x], …]">`: ticks of the section, x in the line's own units, both
growing. In it `<g class="note STATE" data-note="I">` is note I of the section, and `<line class="play-line">` waits for
somebody to move it. The sign of every state is in each note; the style sheet shows that of the note's class.
"""

import json
from collections.abc import Iterator
from html import escape

from station.render.files.svg_file import SvgPaths, figures
from station.render.palette import INK
from station.render.report.page.engraved_bars import BarsSetter, EngravedLine, EngravedNote
from station.render.report.page.note_signs import STATE_WORDS, note_words, sign_of
from station.render.report.page.session_page import JudgedBars, NoteState
from station.render.report.page.timing_words import side
from station.render.text.draw_list import DrawList

LINE_WIDTH = 46.0
"""Staff spaces of a line: two bars of eighths, which a telephone shows legibly and a screen beside each other (our
choice)."""
_EDGE, _AIR = 0.6, 1.0
_SIGNED = (NoteState.EARLY, NoteState.LATE, NoteState.MISS, NoteState.WRONG_PIECE, NoteState.UNKNOWN)
_LEGEND = (NoteState.MATCH, *_SIGNED[:4])


def bar_lines(bars: JudgedBars, paths: SvgPaths) -> list[str]:
    """The lines in order."""
    return [_line(bars, line, paths) for line in BarsSetter(bars, paths.atlas).lines(LINE_WIDTH)]


def sign_definitions(paths: SvgPaths) -> str:
    """The signs by their names, to stand once in the page."""
    signs = "".join(f'<g id="sign-{state}">{paths.areas(sign_of(state, paths.atlas))}</g>' for state in _SIGNED)
    return f'<svg class="outlines" width="0" height="0" aria-hidden="true"><defs>{signs}</defs></svg>'


def legend(bars: JudgedBars, paths: SvgPaths) -> list[tuple[str, str]]:
    """A head with each sign, and what it means; of states that not every session has, those that occur."""
    there = {note.state for note in bars.notes}
    draw_list = DrawList(paths.atlas)
    draw_list.sign("head_round", (0.0, 0.0), INK)
    head = f'<g class="head">{paths.areas(draw_list.shapes())}</g>'
    rare = [state for state in (NoteState.UNKNOWN, NoteState.UNPLAYED) if state in there]
    return [
        (
            f'<svg class="sample" viewBox="-2 -2.2 4 3.6" aria-hidden="true">'
            f'<g class="note {state}">{head}{_sign(state, 0.0, 0.0)}</g></svg>',
            STATE_WORDS[state],
        )
        for state in (*_LEGEND, *rare)
    ]


def _line(bars: JudgedBars, line: EngravedLine, paths: SvgPaths) -> str:
    top, bottom = line.top - _AIR, line.bottom + _AIR
    box = " ".join(map(figures, (-_EDGE, top, line.width + 2 * _EDGE, bottom - top)))
    places = escape(json.dumps([list(place) for place in line.places], separators=(",", ":")))
    play = f'<line class="play-line" x1="0" x2="0" y1="{figures(top + 0.3)}" y2="{figures(bottom - 0.3)}"/>'
    notes = "".join(_notes(bars, line, paths))
    return (
        f'<svg class="bars" viewBox="{box}" data-line="{places}" role="group" aria-label="Engraved bars">'
        f"{paths.areas(line.ground)}{notes}{play}</svg>"
    )


def _notes(bars: JudgedBars, line: EngravedLine, paths: SvgPaths) -> Iterator[str]:
    for note in line.notes:
        facts = bars.notes[note.index]
        head = f'<g class="head">{paths.areas(note.head)}</g>'
        signs = "".join(_sign(state, note.x, note.y, note.scale) for state in _SIGNED)
        at = f'cx="{figures(note.x)}" cy="{figures(note.y)}"'
        yield (
            f'<g class="note {facts.state}" data-note="{note.index}"><title>{escape(_words(bars, note))}</title>'
            f'{head}{signs}<circle class="reach" {at} r="{figures(1.1 * note.scale)}"/></g>'
        )


def _sign(state: NoteState, x: float, y: float, scale: float = 1.0) -> str:
    """The sign of a state that has one, at a head."""
    if state not in _SIGNED:
        return ""
    size = "" if scale == 1.0 else f" scale({figures(scale)})"
    return f'<use class="sign {state}" href="#sign-{state}" transform="translate({figures(x)} {figures(y)}){size}"/>'


def _words(bars: JudgedBars, note: EngravedNote) -> str:
    """Where the note stands, and what became of it."""
    facts, tempo = bars.notes[note.index], bars.section.tempo_map
    tick = int(bars.section.notes["tick"][note.index])
    bar = int(tempo.bars_at(tick))
    start, end = tempo.bar_start(bar), tempo.bar_start(bar + 1)
    beat = (tick - start) / (end - start) * tempo.meter_at(start).beats + 1
    mean = "" if facts.mean_ms is None else f", {side(facts.mean_ms, '.0f')}{' on average' * (facts.passes > 1)}"
    became = note_words(facts.state, facts.played, facts.passes)
    return f"Bar {bar + bars.first_bar}, beat {round(beat, 2):g}, {facts.piece}: {became}{mean}"
