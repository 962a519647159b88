"""Where the heads of a chord stand beside its stems, so that none lies on another.

Units are staff spaces, x right from the middle of a plain round head, whose edge the stems touch. Heads a second apart
or on one step stand on either side of the stem (Gould, "Behind Bars", 2011, "Chords"). The feet's head that would lie
on a hand's goes to the far side of its own stem.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Piece, Zone
from station.music.score import Score
from station.render.notation.staff import FOOT_PIECES, NoteHead, head_of, step_of
from station.render.notation.staff_strokes import StaffStroke, staff_strokes
from station.render.text.sign_outlines import sign_box

HEAD_SIGNS = {
    NoteHead.ROUND: "head_round",
    NoteHead.CROSS: "head_cross",
    NoteHead.DIAMOND: "head_diamond",
    NoteHead.TRIANGLE: "head_triangle",
    NoteHead.RINGED_CROSS: "head_ringed_cross",
    NoteHead.HEAVY_CROSS: "head_heavy_cross",
    NoteHead.ORNATE_CROSS: "head_ornate_cross",
    NoteHead.HOLLOW_DIAMOND: "head_hollow_diamond",
    NoteHead.SLASHED: "head_slashed",
}
EDGE_X = sign_box("head_round").right
"""Where a stem's outer edge stands, right of a head when up, left of it when down."""
SMALL = 0.7
"""How large the head of a stroke is that is beyond the player: a cue note (Gould: three quarters to two thirds)."""
_SECOND = 1
"""Heads so many steps apart or nearer cover one another."""
_BRACKET_GAP = 0.03
"""Between a head or a stem and the bracket beside it (our choice)."""
_BRACKET_REACH = 2
"""Brackets are half as high again as heads: they must clear those so many steps away."""


@dataclass(frozen=True, slots=True)
class Brackets:
    """A pair of brackets: their middles `left` and `right`, on which `step` they are centred, and their size."""

    left: float
    right: float
    step: float
    scale: float

    @property
    def half_width(self) -> float:
        """Half of what each takes across."""
        return sign_box("bracket_left").width / 2 * self.scale


@dataclass(frozen=True, slots=True)
class PlacedHead:
    """One head: its `step`, its shape, its middle `x`, and the brackets where it is a ghost stroke.

    The lowest of several ghost strokes that lie close bears the brackets round them all.
    """

    step: int
    head: NoteHead
    x: float
    is_foot: bool
    brackets: "Brackets | None" = None
    scale: float = 1.0

    @property
    def left(self) -> float:
        """Its left edge."""
        return self.x - half_width(self.head) * self.scale

    @property
    def right(self) -> float:
        """Its right edge."""
        return self.x + half_width(self.head) * self.scale


def half_width(head: NoteHead) -> float:
    """Half of what a head of that shape takes across."""
    return sign_box(HEAD_SIGNS[head]).width / 2


def _stem_half(head: NoteHead) -> float:
    """How far from its middle a stem touches it: what slashes a head goes beyond that."""
    return sign_box(HEAD_SIGNS[head]).advance / 2


def placed_heads(mains: Sequence[StaffStroke]) -> list[PlacedHead]:
    """The heads of the strokes `mains` (of one tick, both voices, without grace strokes), in their order."""
    kinds = tuple((s.piece, s.zone, s.articulation, s.is_small) for s in mains)
    return list(_placed(kinds, tuple(s.is_ghost for s in mains)))


def heads_x(score: Score) -> NDArray[np.float64]:
    """Where the head of each of the player's strokes stands beside its time, shape (n,); grace strokes at 0."""
    whole, is_small = score.whole
    found, strokes = np.zeros(len(whole)), staff_strokes(whole, is_small=is_small)
    mains = np.flatnonzero(~whole.is_grace)
    _, firsts = np.unique(whole.notes["tick"][mains], return_index=True)
    for rows in np.split(mains, firsts[1:]):
        found[rows] = [head.x for head in placed_heads([strokes[i] for i in rows.tolist()])]
    return found[~is_small]


@lru_cache(maxsize=4096)
def _placed(kinds: tuple[tuple[int, int, int, bool], ...], ghosts: tuple[bool, ...]) -> tuple[PlacedHead, ...]:
    found = [_head_alone(*kind) for kind in kinds]
    placed: list[PlacedHead] = []
    for i in sorted(range(len(found)), key=lambda i: _order(found[i])):
        near = [o for o in placed if _cover(o, found[i])]
        if not all(map(_is_displaced, near)):
            found[i] = replace(found[i], x=_displaced_x(found[i], near))
        placed.append(found[i])
    for cluster in _ghost_clusters(found, ghosts):
        found[cluster[0]] = replace(found[cluster[0]], brackets=_brackets([found[k] for k in cluster], found))
    return tuple(found)


def _cover(a: PlacedHead, b: PlacedHead) -> bool:
    """Whether two heads would lie on one another: those a second apart, and a slash that ends in a wide cross."""
    apart = abs(a.step - b.step)
    return apart <= _SECOND or (apart == _SECOND + 1 and {a.head, b.head} == {NoteHead.SLASHED, NoteHead.HEAVY_CROSS})


def _head_alone(of: int, where: int, how: int, is_small: bool) -> PlacedHead:
    """The head of a piece, a zone and an articulation where it stands alone."""
    scale = SMALL if is_small else 1.0
    piece = Piece(of)
    head = head_of(piece, Zone(where), Articulation(how))
    is_foot = piece in FOOT_PIECES
    beside = EDGE_X - _stem_half(head) * scale
    return PlacedHead(step_of(piece), head, -beside if is_foot else beside, is_foot, scale=scale)


def _order(head: PlacedHead) -> tuple[bool, int, int]:
    """Which heads are placed first: the hands' from the lowest up, then the feet's from the highest down."""
    return head.is_foot, -head.step if head.is_foot else head.step, int(head.head)


def _is_displaced(head: PlacedHead) -> bool:
    return abs(head.x) > EDGE_X  # heads wider or narrower than round ones leave the middle by less


def _displaced_x(head: PlacedHead, near: Sequence[PlacedHead]) -> float:
    """On the far side of the stem, and of what reaches beyond it."""
    edges = [-other.left if head.is_foot else other.right for other in near]
    beyond = max(EDGE_X, *edges) + half_width(head.head) * head.scale
    return -beyond if head.is_foot else beyond


def _ghost_clusters(heads: Sequence[PlacedHead], ghosts: Sequence[bool]) -> list[list[int]]:
    """The ghost strokes from the lowest up, those together whose brackets would meet."""
    clusters: list[list[int]] = []
    for i in sorted(range(len(heads)), key=lambda i: heads[i].step):
        if not ghosts[i]:
            continue
        if clusters and heads[i].step - heads[clusters[-1][-1]].step <= _BRACKET_REACH:
            clusters[-1].append(i)
        else:
            clusters.append([i])
    return clusters


def _brackets(cluster: Sequence[PlacedHead], heads: Sequence[PlacedHead]) -> Brackets:
    """Brackets round `cluster`, outside of any other head that is as high as they are."""
    low, high = cluster[0].step, cluster[-1].step
    scale = 1 + (high - low) / 2 / sign_box("bracket_left").height
    half = sign_box("bracket_left").width / 2 * scale
    near = [other for other in heads if low - _BRACKET_REACH <= other.step <= high + _BRACKET_REACH]
    stems = [-EDGE_X if head.is_foot else EDGE_X for head in cluster]
    left, right = min(*stems, *(o.left for o in near)), max(*stems, *(o.right for o in near))
    return Brackets(left - _BRACKET_GAP - half, right + _BRACKET_GAP + half, (low + high) / 2, scale)
