"""A whole assessment: counts, timing, dynamics and points, overall and by piece, limb, bar, subdivision and dynamic.

Two identities always hold: notes = matched + misses + wrong_piece, hits = matched + extras + wrong_piece + ignored; of
a piece, notes are the written and hits the played, so that there wrong pieces stand on both sides. Notes of moments in
which nothing could be heard are `unknown`: none of the notes, and nothing else here looks at them.
"""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Dynamic, Limb, Piece
from station.core.units import PPQ
from station.music import passages
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.analysis.fault_table import PIECE_WORDS, Asked, kind_of
from station.scoring.analysis.habits import Habits, habits
from station.scoring.analysis.loudness import Loudness, dynamics
from station.scoring.analysis.player_tempo import TempoCurve, tempo_curve
from station.scoring.analysis.points import ALL_FREE, Feel, Judged, points
from station.scoring.analysis.technique.click_gaps import Silences
from station.scoring.analysis.technique.observability import KitFacts, Swallowed, swallowed_notes
from station.scoring.analysis.technique.openness import choke_faults, hat_faults
from station.scoring.analysis.technique.ornaments import loud_graces
from station.scoring.analysis.technique.played_sticking import PlayedSticking, played_sticking
from station.scoring.analysis.technique.technique import Circumstances, Technique, technique
from station.scoring.analysis.timing_spread import Spread, asynchrony_ms, spread, timed_notes
from station.scoring.matching.alignment import Alignment
from station.scoring.matching.hit_windows import DEFAULT_LEVEL, Windows
from station.scoring.matching.right import right_notes
from station.scoring.matching.unheard import known_part

Flags = NDArray[np.bool_]
Key = TypeVar("Key")

SUBDIVISIONS = (
    ("quarter", PPQ),
    ("eighth", PPQ // 2),
    ("triplet", PPQ // 3),
    ("sixteenth", PPQ // 4),
    ("sixteenth_triplet", PPQ // 6),
    ("thirty_second", PPQ // 8),
)
"""Names of the places in a beat: the first grid that holds a note names it."""


@dataclass(frozen=True, slots=True)
class Counts:
    """What became of the notes and the hits; `played_again` are among the `ignored`, `unknown` none of the `notes`."""

    notes: int
    hits: int
    matched: int
    misses: int
    extras: int
    wrong_piece: int
    ignored: int
    played_again: int
    unknown: int = 0


@dataclass(frozen=True, slots=True)
class SummaryGroup:
    """One piece, limb, bar …: its counts and the timing of its matched main strokes; hits None where they have none."""

    notes: int
    matched: int
    misses: int
    wrong_piece: int
    extras: int | None
    timing: Spread
    velocity_error: float | None


@dataclass(frozen=True, slots=True)
class WrongPiece:
    """`count` times `played` was struck where `written` stood."""

    written: Piece
    played: Piece
    count: int


@dataclass(frozen=True, slots=True)
class SummaryView:
    """How a score is looked at: the level, and how its bars are named.

    `pass_bars` bars make one pass of a loop (None: no loop), so that bar b of the score is the lesson's bar
    `first_bar` + b mod `pass_bars`, from 0; where passes differ `bar_names` says it of each bar. `hears_velocity` False
    where the input cannot tell loud from soft. `feel` is what costs nothing, `silences` where the click was silent,
    `kit` what was measured of the student's. `beat_ticks` is the beat that tempi in sentences count. `faults` are the
    sizes from which the lesson names faults, `hints` what its author says against them, by their words; `parts` are
    the names of the lesson's bars, from 0, such as "fill" or "chorus", where they have any. `asks_hand`
    (n,) says of which notes the lesson writes the hand, None: of all that have one.
    """

    windows: Windows = DEFAULT_LEVEL
    pass_bars: int | None = None
    first_bar: int = 0
    hears_velocity: bool = True
    feel: Feel = ALL_FREE
    silences: Silences = ()
    bar_names: tuple[int, ...] | None = None
    kit: KitFacts = field(default_factory=KitFacts)
    beat_ticks: int = PPQ
    faults: Asked = field(default_factory=Asked)
    asks_hand: NDArray[np.bool_] | None = field(default=None, compare=False)
    hints: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    parts: Mapping[int, str] = field(default_factory=lambda: MappingProxyType({}))

    @property
    def least_lean_ms(self) -> float:
        """The smallest lean of a piece that matters here."""
        asked = (size for word, size in self.faults.sizes.items() if word in PIECE_WORDS and size is not None)
        return max(min(kind_of("late_piece").least, self.feel.lean_ms, *asked), 1.0)

    def bars(self, score: Score) -> NDArray[np.int64]:
        """The lesson's bar of each note, from 0, shape (n,)."""
        return self.bar_names_of(score)[score.bar]

    def bar_names_of(self, score: Score) -> NDArray[np.int64]:
        """The lesson's bar, from 0, of each bar of the score."""
        if self.bar_names is not None:
            return np.asarray(self.bar_names, np.int64)
        own = np.arange(max(score.bar_count, int(score.bar.max(initial=0)) + 1))
        return np.asarray((own if self.pass_bars is None else own % self.pass_bars) + self.first_bar, np.int64)


@dataclass(frozen=True, eq=False)
class Summary:
    """An assessment in figures; `points` 0–100, None for a score without notes; `right` notes by the view's level.

    `swallowed` (n,) says by `Swallowed` of which notes the kit cannot tell whether they were played.

    Tables are keyed by piece, limb, the lesson's bar from 0, the subdivision's name, the dynamic and the passage
    (`groove` or `fill`); keys without notes are absent (of pieces: without notes and hits).
    """

    score: Score
    performance: Performance
    alignment: Alignment
    view: SummaryView
    points: float | None
    counts: Counts
    right: int
    timing: Spread
    dynamics: Loudness | None
    by_piece: Mapping[Piece, SummaryGroup]
    by_limb: Mapping[Limb, SummaryGroup]
    by_bar: Mapping[int, SummaryGroup]
    by_subdivision: Mapping[str, SummaryGroup]
    by_dynamic: Mapping[Dynamic, SummaryGroup]
    by_passage: Mapping[str, SummaryGroup]
    wrong_pieces: tuple[WrongPiece, ...]
    habits: Habits
    tempo: TempoCurve
    swallowed: NDArray[np.uint8]

    @cached_property
    def sticking(self) -> PlayedSticking | None:
        """The hands beside those that are written; None where no hit's hand is known."""
        return played_sticking(self.score, self.performance, self.alignment, self.view.asks_hand)

    @cached_property
    def technique(self) -> Technique:
        """Rolls, ornaments, feel, the inner clock and what else there is beyond the single stroke."""
        view = self.view
        around = Circumstances(view.feel, view.silences, view.kit.tells_chokes, view.hears_velocity)
        return technique(self.score, self.performance, self.alignment, self.habits, around)


def summarise(score: Score, performance: Performance, alignment: Alignment, view: SummaryView | None = None) -> Summary:
    """Sum up how `performance` answered `score`, of which unknown notes are left out."""
    view = view or SummaryView()
    score, alignment, known = known_part(score, alignment)
    if view.asks_hand is not None:
        view = replace(view, asks_hand=view.asks_hand[known])
    loudness = dynamics(score, performance, alignment)
    group = _grouper(score, performance, alignment)
    notes = score.notes
    pieces = np.union1d(notes["piece"], performance.hits["piece"])
    limbs, bars, places = notes["limb"], view.bars(score), subdivisions(score)
    swallowed = swallowed_notes(score, performance, alignment, view.kit)
    judged = Judged(
        loudness.off_db if view.hears_velocity else None,
        _faulty(score, performance, alignment, view),
        swallowed != Swallowed.NO,
    )
    return Summary(
        score=score,
        performance=performance,
        alignment=alignment,
        view=view,
        points=points(score, alignment, judged, view.feel),
        counts=replace(count(alignment), unknown=int((~known).sum())),
        right=int(right_notes(score, alignment, view.windows).sum()),
        timing=group(np.ones(len(score), np.bool_), None).timing,
        dynamics=loudness if view.hears_velocity else None,
        by_piece=_table(
            (Piece(p), group(notes["piece"] == p, performance.hits["piece"] == p)) for p in pieces.tolist()
        ),
        by_limb=_table((Limb(k), group(limbs == k, None)) for k in np.unique(limbs).tolist() if k != Limb.UNKNOWN),
        by_bar=_table((b, group(bars == b, None)) for b in np.unique(bars).tolist()),
        by_subdivision=_table(
            (name, group(places == i, None)) for i, name in enumerate(_PLACES) if (places == i).any()
        ),
        by_dynamic=_table(
            (Dynamic(k), group(notes["dynamic"] == k, None)) for k in np.unique(notes["dynamic"]).tolist()
        ),
        by_passage=_table((name, group(here, None)) for name, here in _passages(score) if here.any()),
        wrong_pieces=_wrong_pieces(score, performance, alignment),
        habits=habits(score, performance, alignment, view.hears_velocity, view.least_lean_ms),
        tempo=tempo_curve(score, performance, alignment),
        swallowed=swallowed,
    )


def _faulty(score: Score, performance: Performance, alignment: Alignment, view: SummaryView) -> Flags:
    """Notes (n,), where told: hats open for closed or closed for open, cymbals not grabbed, grace strokes too loud."""
    faulty = hat_faults(score, performance, alignment)[1]
    faulty = faulty | choke_faults(score, performance, alignment, view.kit.tells_chokes)[1]
    return faulty | loud_graces(score, performance, alignment) if view.hears_velocity else faulty


def count(alignment: Alignment) -> Counts:
    """The counts; both identities hold."""
    again = alignment.count(Label.PLAYED_AGAIN)
    return Counts(
        notes=len(alignment.note_label),
        hits=len(alignment.hit_label),
        matched=alignment.count(Label.MATCH),
        misses=alignment.count(Label.MISS),
        extras=alignment.count(Label.EXTRA),
        wrong_piece=alignment.count(Label.WRONG_PIECE),
        ignored=alignment.count(Label.IGNORED) + again,
        played_again=again,
    )


_Grouper = Callable[[Flags, Flags | None], SummaryGroup]


def _grouper(score: Score, performance: Performance, alignment: Alignment) -> _Grouper:
    """A function that sums up the notes of one mask and counts the extras of another."""
    timed, off_ms = timed_notes(score, alignment), asynchrony_ms(alignment)
    hit = np.maximum(alignment.hit_of_note, 0)
    played = performance.fine_velocity[hit] if len(performance) else np.zeros(len(score))
    error = played - score.notes["velocity"]

    def group(notes: Flags, hits: Flags | None) -> SummaryGroup:
        label = alignment.note_label[notes]
        matched = notes & (alignment.note_label == Label.MATCH)
        own = notes & timed
        return SummaryGroup(
            notes=int(notes.sum()),
            matched=int((label == Label.MATCH).sum()),
            misses=int((label == Label.MISS).sum()),
            wrong_piece=int((label == Label.WRONG_PIECE).sum()),
            extras=None if hits is None else int((alignment.hit_label[hits] == Label.EXTRA).sum()),
            timing=spread(off_ms[own], score.notes["tick"][own]),
            velocity_error=float(error[matched].mean()) if matched.any() else None,
        )

    return group


def _table(rows: Iterable[tuple[Key, SummaryGroup]]) -> Mapping[Key, SummaryGroup]:
    return MappingProxyType(dict(rows))


def _passages(score: Score) -> tuple[tuple[str, Flags], ...]:
    """Fills and what is none, of a score that has both."""
    fills = passages.fills(score)
    return (("groove", ~fills), ("fill", fills)) if fills.any() else ()


_PLACES = (*(name for name, _ in SUBDIVISIONS), "other")


def subdivisions(score: Score) -> NDArray[np.int64]:
    """Index of each note's place in the beat: into `SUBDIVISIONS`, or its length for none of them; shape (n,)."""
    place = np.full(len(score), len(SUBDIVISIONS), np.int64)
    within = score.notes["tick"] % PPQ
    for i in range(len(SUBDIVISIONS) - 1, -1, -1):
        place[within % SUBDIVISIONS[i][1] == 0] = i
    return place


def _wrong_pieces(score: Score, performance: Performance, alignment: Alignment) -> tuple[WrongPiece, ...]:
    """Which piece was struck for which, the commonest first."""
    wrong = np.flatnonzero(alignment.note_label == Label.WRONG_PIECE)
    pairs = zip(
        score.notes["piece"][wrong].tolist(),
        performance.hits["piece"][alignment.hit_of_note[wrong]].tolist(),
        strict=True,
    )
    return tuple(WrongPiece(Piece(w), Piece(p), n) for (w, p), n in Counter(pairs).most_common())
