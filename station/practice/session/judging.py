"""The strokes of a session while it runs: kept in score time, judged as they come, and in part taken back.

Score time is ns from tick 0 of the plan's score. The final judgement is the alignment's (`scoring.align`); this is
what the student sees meanwhile.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import TypeVar

import numpy as np

from station.core.events import Choke, Hit
from station.core.pieces import Limb
from station.core.units import PPQ
from station.music.judgement import Judgement, Label
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.analysis.entries import STEADY_HITS, is_right_there
from station.scoring.following.follower import Follower
from station.scoring.matching.unheard import Span, notes_within

_Played = TypeVar("_Played", Hit, Choke)


class Judging:
    """`hits` and `chokes` so far; the newest verdict `of_note` and `of_hit`, by their indices."""

    def __init__(self, score: Score, clocked: bool) -> None:
        self._score, self._clocked = score, clocked
        self.chokes: list[Choke] = []
        self._is_unheard = np.zeros(len(score), np.bool_)
        self._begin()

    def _begin(self) -> None:
        self._follower = Follower(self._score, clocked=self._clocked)
        self.hits: list[Hit] = []
        self.last_ns: int | None = None
        """When the last stroke was played."""
        self.of_note: dict[int, Judgement] = {}
        self.of_hit: dict[int, Judgement] = {}

    def hit(self, hit: Hit) -> tuple[Judgement, ...]:
        """Take a stroke, in score time; returns what was judged because of it."""
        self.hits.append(hit)
        self.last_ns = hit.at_ns if self.last_ns is None else max(hit.at_ns, self.last_ns)
        return self._keep(self._follower.hit(hit, hit.at_ns))

    def advance(self, score_ns: int) -> tuple[Judgement, ...]:
        """The misses that are certain at `score_ns`."""
        return self._keep(self._follower.advance(score_ns))

    def not_heard(self, span: Span) -> tuple[Judgement, ...]:
        """No stroke could be heard within `span`: notes that count as missed there are unknown, now and later."""
        self._is_unheard |= notes_within(self._score, [span])
        missed = [self.of_note[note] for note in np.flatnonzero(self._is_unheard).tolist() if note in self.of_note]
        return self._keep(replace(verdict, corrects=True) for verdict in missed if verdict.label is Label.MISS)

    def place_ns(self, score_ns: int) -> int:
        """Where in the score the student is, when that much of it would have passed."""
        return self._follower.place_ns(score_ns)

    def is_waiting(self, score_ns: int) -> bool:
        """Whether the score waits for the student then."""
        return self._follower.is_waiting(score_ns)

    @property
    def beats_behind(self) -> float:
        """Quarters by which the student came in behind the click and plays on there; negative ahead of it.

        Whole bars are told where nothing was played before: else bars were left out or are played again.
        """
        quarters = self._follower.beats_behind
        if not quarters or not self.hits:
            return 0.0
        last = range(max(len(self.hits) - STEADY_HITS, 0), len(self.hits))
        labels = [self.of_hit[hit].label for hit in last if hit in self.of_hit]
        is_steady = len(labels) >= STEADY_HITS // 2 and is_right_there(labels)
        tempo_map = self._score.tempo_map
        is_whole = quarters * PPQ % tempo_map.meter_at(0).bar_ticks == 0
        due_ns = int(tempo_map.ns_at(max(round(quarters * PPQ) - PPQ // 2, 0)))
        is_late = quarters > 0 and self.hits[0].at_ns >= due_ns
        return quarters if is_steady and (is_late or not is_whole) else 0.0

    @property
    def pace(self) -> float:
        """How many times as fast as written the student plays, as far as the hits show."""
        return self._follower.pace

    def forget_from(self, from_ns: int) -> int:
        """Forget what belongs to the score from `from_ns` on; returns how many strokes that were.

        A stroke belongs to the time of the note that it answers, else to its own.
        """
        kept = [hit for index, hit in enumerate(self.hits) if self._belongs_ns(index) < from_ns]
        forgotten = len(self.hits) - len(kept)
        self.chokes = [choke for choke in self.chokes if choke.at_ns < from_ns]
        self._is_unheard &= self._score.onset_ns < from_ns
        self._judge_anew(kept)
        return forgotten

    def leave_out(self, strokes: Sequence[Hit]) -> None:
        """Let `strokes` never have been played."""
        if strokes:
            self._judge_anew([hit for hit in self.hits if hit not in strokes])

    def performance(self, limbs: Sequence[Limb] | None = None) -> Performance:
        """What was played; where the score waited for the student, so does the time of what came after.

        `limbs` are those of the hits, where more is known than the hits tell themselves.
        """
        hits = self.hits
        if limbs is not None:
            hits = [replace(hit, limb=limb) for hit, limb in zip(hits, limbs, strict=True)]
        waited = [(self.hits[hit].at_ns, by_ns) for hit, by_ns in self._follower.waited]

        def moved(event: _Played) -> _Played:
            return replace(event, at_ns=event.at_ns - sum(by_ns for from_ns, by_ns in waited if event.at_ns >= from_ns))

        if not waited:
            return Performance.from_hits(hits, self.chokes)
        return Performance.from_hits(map(moved, hits), map(moved, self.chokes))

    def extras(self) -> list[int]:
        """Indices of the hits that answer no note, as far as is known."""
        return [hit for hit, verdict in self.of_hit.items() if verdict.label is Label.EXTRA]

    def _judge_anew(self, kept: Iterable[Hit]) -> None:
        self._begin()
        for hit in kept:
            self.hit(hit)

    def _belongs_ns(self, index: int) -> int:
        verdict = self.of_hit.get(index)
        if verdict is None or verdict.note_index is None:
            return self.hits[index].at_ns
        return int(self._score.onset_ns[verdict.note_index])

    def _keep(self, verdicts: Iterable[Judgement]) -> tuple[Judgement, ...]:
        kept = tuple(map(self._or_unknown, verdicts))
        for verdict in kept:
            if verdict.note_index is not None:
                self.of_note[verdict.note_index] = verdict
            if verdict.hit_index is not None:
                self.of_hit[verdict.hit_index] = verdict
        return kept

    def _or_unknown(self, verdict: Judgement) -> Judgement:
        if verdict.label is Label.MISS and verdict.note_index is not None and self._is_unheard[verdict.note_index]:
            return replace(verdict, label=Label.UNKNOWN)
        return verdict
