"""Live judgement: each hit as it arrives, where the student is in the score, and corrections of both.

With a click the score is where the click is, without one where the student is: their tempo and phase are tracked, and
the score waits when they stop. Either way they are found again after a skip or a restart (`online`), and the hits that
were judged in the wrong place meanwhile are judged anew (`live_judge`); a judgement that takes an older one back says
so.

Everything is a function of the hits and their own times alone; frames decide nothing. With a click, notes that nobody
plays are missed as time passes; without one, as the student passes them, for silence is no mistake of theirs.
"""

from collections.abc import Collection, Sequence

import numpy as np

from station.core.events import Hit
from station.core.pieces import Articulation, Piece
from station.core.units import NS_PER_S
from station.music.judgement import Judgement
from station.music.score import Score
from station.scoring.following.online import Online
from station.scoring.following.written import MAYBE_BOUNCE, written_of
from station.scoring.matching.ignored_hits import BOUNCE_NS, PRESS_LOUDER
from station.scoring.matching.live_judge import Judge, Moved
from station.scoring.matching.match_classes import match_classes


class Follower:
    """The live judge of one run through `score`; `kit` names the student's pieces, None for a complete kit.

    Times are ns from the score's tick 0, `clocked` by the click, else by when the student was counted in.
    """

    def __init__(
        self,
        score: Score,
        kit: Collection[Piece] | None = None,
        clocked: bool = True,
    ) -> None:
        self._judge = Judge(score, kit)
        self._class_of: list[int] = match_classes(kit).tolist()
        self._clocked = clocked
        written = written_of(score, match_classes(kit)[score.notes["piece"]])
        self._where = Online(written, clocked) if len(score) else None
        self._first_bar_ns = max(int(score.tempo_map.ns_at(score.tempo_map.bar_start(1))), _BEGINNING_NS)
        buzzing = score.notes["piece"][score.notes["articulation"] == Articulation.BUZZ]
        self._buzzed = {Piece(piece): (-BOUNCE_NS, 0) for piece in np.unique(buzzing)}  # last hit's time and velocity
        self._hits = 0
        self._begun = False

    def hit(self, hit: Hit, at_ns: int) -> tuple[Judgement, ...]:
        """Judge `hit`, played at `at_ns`: its own verdict and every older one that it changes.

        Hits are numbered from 0 in the order of these calls. A judgement replaces all earlier ones on its note and on
        its hit.
        """
        told = self._class_of[hit.piece]
        if hit.piece in self._buzzed and self._may_bounce(hit, at_ns):
            told += MAYBE_BOUNCE
        moved = Moved(self._hits, [at_ns]) if self._where is None else self._where.hit(at_ns, told)
        self._hits += 1
        begun = self._begin(moved.places_ns[0]) if self._is_beginning(moved) else ()
        said = self._judge.hit(hit, moved)
        return begun + said if self._clocked else begun + said + self._judge.advance(moved.places_ns[-1])

    def advance(self, at_ns: int) -> tuple[Judgement, ...]:
        """The misses that are certain at `at_ns` unless an older hit is still on its way."""
        if not self._clocked:
            return ()
        place_ns = self.place_ns(at_ns)
        begun = () if self._begun else self._begin(place_ns)
        return begun + self._judge.advance(place_ns)

    def place_ns(self, at_ns: int) -> int:
        """Where in the score the student is at `at_ns`, as far as the hits told so far show."""
        return at_ns if self._where is None else self._where.place_ns(at_ns)

    def is_waiting(self, at_ns: int) -> bool:
        """Whether the score waits at `at_ns` for a student who has stopped."""
        return self._where is not None and self._where.is_waiting(at_ns)

    @property
    def beats_behind(self) -> float:
        """Quarters by which the student is behind the click and plays on, as far as the hits show; negative ahead."""
        return 0.0 if self._where is None else self._where.beats_behind

    @property
    def pace(self) -> float:
        """How many times as fast as written the student plays, as far as the hits show; 1 by the click."""
        return 1.0 if self._where is None else self._where.pace

    @property
    def waited(self) -> Sequence[tuple[int, int]]:
        """The first hit after each stop of a student without a click, and for how many ns the score waited for it."""
        return () if self._where is None else self._where.waited

    def _may_bounce(self, hit: Hit, at_ns: int) -> bool:
        """Whether a hit on a piece that buzzes may be but a bounce (`ignored_hits`)."""
        before_ns, before = self._buzzed[hit.piece]
        self._buzzed[hit.piece] = at_ns, hit.velocity
        return at_ns - before_ns < BOUNCE_NS and hit.velocity <= PRESS_LOUDER * before

    def _is_beginning(self, moved: Moved) -> bool:
        """Whether the first hit has found its place, or another one."""
        return moved.first == 0 and (not self._clocked or not self._begun)

    def _begin(self, place_ns: int) -> tuple[Judgement, ...]:
        """What is written before the place of the beginning is nobody's, unless it lies in the first bar."""
        self._begun = True
        return self._judge.begin(0 if place_ns < self._first_bar_ns else place_ns)


_BEGINNING_NS = 2 * NS_PER_S
"""A student who begins so soon began at the beginning, however short the first bar and rare the frames (our choice)."""
