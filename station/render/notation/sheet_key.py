"""The key of a sheet: what each note and sign that the score uses means. Units are staff spaces, y down."""

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np
from numpy.typing import NDArray

from station.core.labels import piece_name
from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.music.loudness_marks import FADE, GROW
from station.music.score import Score
from station.render.notation import note_shapes
from station.render.notation.staff import PLACES, NoteHead, head_of, height, ledger_steps
from station.render.palette import INK, INK_SOFT
from station.render.text.draw_list import DrawList, TypeStyle
from station.render.text.fonts import Face

KEY_HEIGHT = 17.6
_STAFF_Y = 3.6
_NAMES_Y, _LINE = 8.4, 1.8
_SIGNS_Y = 13.6
_SLOT = 9.0
_NAME = 1.45
_OPEN_FROM, _WIDE_FROM = 0.25, 0.75

Draw = Callable[[DrawList, tuple[float, float]], None]


def draw_key(draw_list: DrawList, score: Score, width: float, with_sticking: bool) -> None:
    """Draw the key, `width` wide, from y = 0 down to `KEY_HEIGHT`; nothing where nothing is used."""
    used = list(notes_used(score))
    if not used:
        return
    slot = min(_SLOT, width / len(used))
    _staff(draw_list, len(used) * slot)
    for k, (piece, head, name) in enumerate(used):
        x, step = (k + 0.5) * slot, PLACES[piece].step
        y = _STAFF_Y + height(step)
        for line in ledger_steps(step):
            ledger = _STAFF_Y + height(line)
            draw_list.line((x - 1.05, ledger), (x + 1.05, ledger), note_shapes.STAFF_LINE, INK_SOFT)
        note_shapes.draw_head(draw_list, head, (x, y), 1.0)
        style = TypeStyle(_NAME, INK, Face.REGULAR, 0.5)
        for row, words in enumerate(draw_list.broken(name, style, slot - 0.6)):
            draw_list.text(words, (x, _NAMES_Y + _LINE * row), style)
    _signs(draw_list, list(signs_used(score, with_sticking)), width)


def _staff(draw_list: DrawList, width: float) -> None:
    for k in range(-2, 3):
        y = _STAFF_Y + k - note_shapes.STAFF_LINE / 2
        draw_list.box((0.0, y), (width, note_shapes.STAFF_LINE), INK_SOFT)


def notes_used(score: Score) -> Iterator[tuple[Piece, NoteHead, str]]:
    """The pieces and heads of the score, from the lowest on the staff up, with their names."""
    rows = np.unique(score.notes[["piece", "zone", "articulation"]])
    found: dict[tuple[Piece, NoteHead], str] = {}
    for row in rows:
        piece, zone, how = Piece(int(row["piece"])), Zone(int(row["zone"])), Articulation(int(row["articulation"]))
        head = head_of(piece, zone, how)
        plain = head is PLACES[piece].head
        special = "cross-stick" if how is Articulation.CROSS_STICK else "bell"
        found[piece, head] = piece_name(piece) if plain else f"{piece_name(piece)}, {special}"
    for (piece, head), name in sorted(found.items(), key=lambda item: (PLACES[item[0][0]].step, item[0])):
        yield piece, head, name


def signs_used(score: Score, with_sticking: bool) -> Iterator[tuple[Draw, str]]:
    """The other signs of the score, each as what draws it and what it means."""
    notes = score.notes
    graced = notes["ornament"][score.is_grace]
    if (notes["dynamic"] == Dynamic.ACCENT).any():
        yield lambda draw_list, at: draw_list.sign("accent", at, INK, 0.95), "accent: loud"
    if (notes["dynamic"][~score.is_grace] == Dynamic.GHOST).any():
        yield _ghost, "ghost: very soft"
    yield from _hairpins_used(score)
    yield from _hat_signs_used(notes[notes["piece"] == Piece.HIHAT]["openness"])
    if (graced == Ornament.FLAM).any():
        yield lambda draw_list, at: _graces(draw_list, at, 1), "flam"
    if (graced == Ornament.DRAG).any():
        yield lambda draw_list, at: _graces(draw_list, at, 2), "drag"
    if (notes["articulation"] == Articulation.RIM_SHOT).any():
        yield _rim_shot, "rim shot"
    if (notes["articulation"] == Articulation.BUZZ).any():
        yield lambda draw_list, at: draw_list.sign("buzz", at, INK), "buzz roll"
    if (notes["choke_ticks"] > 0).any():
        yield lambda draw_list, at: draw_list.sign("choke", at, INK), "choke: grab it"
    if with_sticking and np.isin(notes["limb"], (Limb.RIGHT_HAND, Limb.LEFT_HAND)).any():
        yield _letters, "right and left hand"


def _hairpins_used(score: Score) -> Iterator[tuple[Draw, str]]:
    for sign, words in ((GROW, "growing louder"), (FADE, "growing softer")):
        if any(mark.sign == sign for mark in score.loudness):
            yield partial(_hairpin, sign=sign), words


def _hat_signs_used(openness: NDArray[np.float32]) -> Iterator[tuple[Draw, str]]:
    is_open = openness >= _OPEN_FROM
    for kind, used, words in (
        ("open", openness >= _WIDE_FROM, "hi-hat open"),
        ("half", is_open & (openness < _WIDE_FROM), "hi-hat half open"),
        ("closed", is_open[:-1] & ~is_open[1:], "closed again"),
    ):
        if used.any():
            yield partial(_hat_sign, kind=kind), words


def _hat_sign(draw_list: DrawList, at: tuple[float, float], kind: str) -> None:
    note_shapes.draw_hat_sign(draw_list, kind, at)


def _signs(draw_list: DrawList, signs: list[tuple[Draw, str]], width: float) -> None:
    """The signs side by side, in as many lines as they need."""
    x, y = 0.0, _SIGNS_Y
    style = TypeStyle(_NAME, INK)
    for draw, words in signs:
        wide = 3.6 + draw_list.width(words, style) + 2.0
        if x + wide > width:
            x, y = 0.0, y + 2.8
        draw(draw_list, (x + 1.4, y))
        draw_list.text(words, (x + 3.6, y + 0.5), style)
        x += wide


def _ghost(draw_list: DrawList, at: tuple[float, float]) -> None:
    note_shapes.draw_head(draw_list, NoteHead.ROUND, at, 0.9)
    for name, side in (("bracket_left", -0.95), ("bracket_right", 0.95)):
        draw_list.sign(name, (at[0] + side, at[1]), INK, 0.95)


def _hairpin(draw_list: DrawList, at: tuple[float, float], sign: str) -> None:
    (x, y), half = at, 1.4 if sign == GROW else -1.4
    for opening in (-0.5, 0.5):
        draw_list.line((x - half, y), (x + half, y + opening), 0.13, INK)


def _graces(draw_list: DrawList, at: tuple[float, float], count: int) -> None:
    note_shapes.draw_head(draw_list, NoteHead.ROUND, (at[0] + 0.9, at[1]), 0.9)
    for k in range(count):
        x = at[0] - 0.5 - 0.9 * k
        note_shapes.draw_head(draw_list, NoteHead.ROUND, (x, at[1]), 0.55)
        draw_list.line((x + 0.3, at[1]), (x + 0.3, at[1] - 1.6), 0.1, INK)


def _rim_shot(draw_list: DrawList, at: tuple[float, float]) -> None:
    note_shapes.draw_head(draw_list, NoteHead.ROUND, at, 0.9)
    draw_list.sign("slash", at, INK, 0.9)


def _letters(draw_list: DrawList, at: tuple[float, float]) -> None:
    draw_list.text("R L", (at[0], at[1] + 0.5), TypeStyle(1.3, INK_SOFT, Face.BOLD, 0.5))
