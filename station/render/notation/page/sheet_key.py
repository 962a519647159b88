"""The key of a sheet: what each note and sign that the score uses means. Units are staff spaces, y down."""

from collections.abc import Callable, Collection, Iterator
from functools import partial
from math import ceil

import numpy as np
from numpy.typing import NDArray

from station.core.labels import piece_name
from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.music.loudness_marks import FADE, GROW
from station.music.score import Score
from station.render.notation.head_places import EDGE_X, HEAD_SIGNS, SMALL
from station.render.notation.note_shapes import STEM_FROM, draw_brackets, draw_head, draw_letters
from station.render.notation.staff import NoteHead, head_of, height, ledger_steps, step_of
from station.render.notation.staff_rows import OPEN_FROM, WIDE_FROM, closing_hats, shown_limbs
from station.render.notation.voice.written_strokes import feet_of, written_strokes
from station.render.palette import INK, INK_SOFT
from station.render.text.draw_list import DrawList, TypeStyle
from station.render.text.fonts import Face
from station.render.text.sign_outlines import HAIRPIN_LINE, LEDGER_LINE, LEDGER_OUT, STAFF_LINE, STEM, sign_box

_STAFF_Y, _NAMES_Y, _LINE = 4.6, 9.4, 1.8
"""From the top of a row of notes to its staff's middle line and to the first line of names, and to the next line."""
_AFTER_NAMES, _SIGN_ROW, _BELOW = 1.2, 2.8, 1.0
"""Between the names and what follows, from one row of signs to the next, and below the last one's words."""
_SLOT, _LEAST_SLOT = 9.0, 8.3
"""What a note of the key takes across, and the least of it, which holds the longest word of a name."""
_NAME = 1.45
_BRACKETS_X = EDGE_X + sign_box("bracket_left").width / 2 + 0.03
_GRACE, _GRACE_STEM = 0.62, 1.7

Draw = Callable[[DrawList, tuple[float, float]], None]


def draw_key(draw_list: DrawList, score: Score, bars: Collection[int], width: float, with_sticking: bool) -> float:
    """Draw the key of a score whose `bars`, from 0, are on the sheet, `width` wide, from y = 0 down; returns how far.

    Nothing where nothing is used.
    """
    used = list(notes_used(score.whole[0]))
    if not used:
        return 0.0
    rows = ceil(len(used) / max(int(width / _LEAST_SLOT), 1))
    in_row = ceil(len(used) / rows)
    slot, y = min(_SLOT, width / in_row), 0.0
    for row in range(rows):
        y = _notes_row(draw_list, used[row * in_row : (row + 1) * in_row], slot, y)
    return _signs(draw_list, list(signs_used(score, bars, with_sticking)), width, y + _SIGN_ROW / 2)


def _notes_row(draw_list: DrawList, used: list[tuple[Piece, NoteHead, str]], slot: float, top: float) -> float:
    """Notes on a staff with their names below; returns where the row ends."""
    _staff(draw_list, len(used) * slot, top + _STAFF_Y)
    style, most = TypeStyle(_NAME, INK, Face.REGULAR, 0.5), 1
    for k, (piece, head, name) in enumerate(used):
        x, step = (k + 0.5) * slot, step_of(piece)
        half = sign_box(HEAD_SIGNS[head]).width / 2 + LEDGER_OUT
        for line in ledger_steps(step):
            ledger = top + _STAFF_Y + height(line)
            draw_list.line((x - half, ledger), (x + half, ledger), LEDGER_LINE, INK_SOFT)
        draw_head(draw_list, head, (x, top + _STAFF_Y + height(step)), 1.0)
        lines = draw_list.broken(name, style, slot - 0.6)
        most = max(most, len(lines))
        for row, words in enumerate(lines):
            draw_list.text(words, (x, top + _NAMES_Y + _LINE * row), style)
    return top + _NAMES_Y + _LINE * (most - 1) + _AFTER_NAMES


def _staff(draw_list: DrawList, width: float, middle: float) -> None:
    for k in range(-2, 3):
        y = middle + k - STAFF_LINE / 2
        draw_list.box((0.0, y), (width, STAFF_LINE), INK_SOFT)


def notes_used(score: Score) -> Iterator[tuple[Piece, NoteHead, str]]:
    """The pieces and heads of the score, from the lowest on the staff up, with their names."""
    rows = np.unique(score.notes[["piece", "zone", "articulation"]])
    found: dict[tuple[Piece, NoteHead], str] = {}
    for row in rows:
        piece, zone, how = Piece(int(row["piece"])), Zone(int(row["zone"])), Articulation(int(row["articulation"]))
        head = head_of(piece, zone, how)
        special = _special(piece, zone, how)
        found[piece, head] = f"{piece_name(piece)}, {special}" if special else piece_name(piece)
    for (piece, head), name in sorted(found.items(), key=lambda item: (step_of(item[0][0]), item[0])):
        yield piece, head, name


def _special(piece: Piece, zone: Zone, how: Articulation) -> str:
    """What a head other than the piece's usual one says."""
    if head_of(piece, zone, how) is head_of(piece, Zone.HEAD, Articulation.NORMAL):
        return ""
    ways = {Articulation.CROSS_STICK: "cross-stick", Articulation.RIM_SHOT: "rim shot"}
    zones = {Zone.BELL: "bell", Zone.EDGE: "edge", Zone.BOW: "bow", Zone.RIM: "rim"}
    return ways.get(how) or zones[zone]


def signs_used(score: Score, bars: Collection[int], with_sticking: bool) -> Iterator[tuple[Draw, str]]:
    """The other signs of the score, of which `bars` are written, each as what draws it and what it means."""
    score, is_small = score.whole
    notes = score.notes
    graced = notes["ornament"][score.is_grace]
    if (notes["dynamic"] == Dynamic.ACCENT).any():
        yield partial(_sign, name="accent"), "accent: loud"
    if (notes["dynamic"][~score.is_grace] == Dynamic.GHOST).any():
        yield _ghost, "ghost: very soft"
    yield from _hairpins_used(score)
    closes = closing_hats(score) & np.isin(score.bar, list(bars))
    yield from _hat_signs_used(notes[notes["piece"] == Piece.HIHAT]["openness"], bool(closes.any()))
    if ((notes["piece"] == Piece.HIHAT_PEDAL) & (notes["articulation"] == Articulation.SPLASH)).any():
        yield _splash, "splash with the foot"
    if (graced == Ornament.FLAM).any():
        yield partial(_graces, count=1), "flam"
    if (graced == Ornament.DRAG).any():
        yield partial(_graces, count=2), "drag"
    if written_strokes(score, feet_of(score)).is_hidden.any():
        yield _diddle, "two strokes, one hand"
    if (notes["articulation"] == Articulation.BUZZ).any():
        yield partial(_sign, name="buzz"), "buzz roll"
    if (notes["choke_ticks"] > 0).any():
        yield partial(_sign, name="choke"), "choke: grab it"
    if is_small.any():
        yield _small, "small: beyond two hands and two feet"
    if with_sticking:
        yield from _letters_used(shown_limbs(score, notes["limb"]))


def _letters_used(limbs: NDArray[np.int8]) -> Iterator[tuple[Draw, str]]:
    if np.isin(limbs, (Limb.RIGHT_HAND, Limb.LEFT_HAND)).any():
        yield _letters, "above: right and left hand"
    if np.isin(limbs, (Limb.RIGHT_FOOT, Limb.LEFT_FOOT)).any():
        yield _letters, "below: right and left foot"


def _hairpins_used(score: Score) -> Iterator[tuple[Draw, str]]:
    for sign, words in ((GROW, "growing louder"), (FADE, "growing softer")):
        if any(mark.sign == sign for mark in score.loudness):
            yield partial(_hairpin, sign=sign), words


def _hat_signs_used(openness: NDArray[np.float32], closes: bool) -> Iterator[tuple[Draw, str]]:
    for kind, used, words in (
        ("hat_open", (openness >= WIDE_FROM).any(), "hi-hat open"),
        ("hat_half", ((openness >= OPEN_FROM) & (openness < WIDE_FROM)).any(), "hi-hat half open"),
        ("hat_closed", closes, "closed again"),
    ):
        if used:
            yield partial(_sign, name=kind), words


def _sign(draw_list: DrawList, at: tuple[float, float], name: str) -> None:
    draw_list.sign(name, at, INK)


def _signs(draw_list: DrawList, signs: list[tuple[Draw, str]], width: float, top: float) -> float:
    """The signs side by side from `top` down, in as many lines as they need; returns where they end."""
    x, y = 0.0, top
    style = TypeStyle(_NAME, INK)
    for draw, words in signs:
        wide = 3.6 + draw_list.width(words, style) + 2.0
        if x + wide > width:
            x, y = 0.0, y + _SIGN_ROW
        draw(draw_list, (x + 1.4, y))
        draw_list.text(words, (x + 3.6, y + 0.5), style)
        x += wide
    return y + _BELOW if signs else top - _SIGN_ROW / 2


def _ghost(draw_list: DrawList, at: tuple[float, float]) -> None:
    draw_head(draw_list, NoteHead.ROUND, at, 1.0)
    draw_brackets(draw_list, (at[0] - _BRACKETS_X, at[0] + _BRACKETS_X), at[1])


def _small(draw_list: DrawList, at: tuple[float, float]) -> None:
    draw_head(draw_list, NoteHead.ROUND, at, SMALL)


def _splash(draw_list: DrawList, at: tuple[float, float]) -> None:
    draw_head(draw_list, NoteHead.CROSS, (at[0], at[1] - 0.6), 1.0)
    draw_list.sign("hat_open", (at[0], at[1] + 0.8), INK)


def _diddle(draw_list: DrawList, at: tuple[float, float]) -> None:
    x, y = at[0] - EDGE_X, at[1] + 0.5
    draw_head(draw_list, NoteHead.ROUND, (x, y), 1.0)
    stem = x + EDGE_X - STEM / 2
    draw_list.line((stem, y - STEM_FROM[NoteHead.ROUND][0]), (stem, y - 2.4), STEM, INK)
    draw_list.sign("tremolo_1", (stem, y - 1.5), INK)


def _hairpin(draw_list: DrawList, at: tuple[float, float], sign: str) -> None:
    (x, y), half = at, 1.4 if sign == GROW else -1.4
    for opening in (-0.5, 0.5):
        draw_list.line((x - half, y), (x + half, y + opening), HAIRPIN_LINE, INK)


def _graces(draw_list: DrawList, at: tuple[float, float], count: int) -> None:
    draw_head(draw_list, NoteHead.ROUND, (at[0] + 0.9, at[1]), 1.0)
    for k in range(count):
        x = at[0] - 0.5 - 0.9 * k
        draw_head(draw_list, NoteHead.ROUND, (x, at[1]), _GRACE)
        stem = x + (EDGE_X - STEM / 2) * _GRACE
        draw_list.line((stem, at[1] - 0.1), (stem, at[1] - _GRACE_STEM), STEM, INK)


def _letters(draw_list: DrawList, at: tuple[float, float]) -> None:
    for letter, x in (("R", -0.7), ("L", 0.7)):
        draw_letters(draw_list, letter, (at[0] + x, at[1] + 0.5))
