"""Live judgement with a click: each hit as it arrives, and corrections when later hits prove one wrong.

Hits come with their time on the score's axis (integer ns); the verdict on every note and hit is a function of the hits
alone, never of when or how often `advance` is called, so that one performance is judged alike at any frame rate.
`advance` only says aloud which notes are too late to be played; a hit that was delivered late takes such a miss back.

A hit and the few hits and notes of its piece around it are paired by least cost, as the final alignment does. What is
older than `_MEMORY` reaches is settled for good, which bounds the cost of a hit whatever the score's length. A hit that
its own piece does not want goes to a waiting note of another piece close by, until that note's own piece claims it.
"""

from bisect import bisect_left, bisect_right
from collections.abc import Collection

from station.core.events import Hit
from station.core.pieces import Piece
from station.core.units import NS_PER_MS
from station.music.judgement import Judgement, Label
from station.music.score import Score
from station.scoring.classes import match_classes
from station.scoring.ignored import Unwritten
from station.scoring.pairing import least_cost
from station.scoring.windows import DEFAULT_LEVEL, Windows

_MEMORY = 2
"""Reaches back in time within which a verdict may still change (our choice; a longer tangle is a roll)."""

_WRONG_REACH_NS = 50 * NS_PER_MS
"""How near another piece's note must be (our choice: less than half a 16th at 140 bpm)."""

_NOBODY = -1


class _Lane:
    """Notes and hits of one match class, each as parallel lists in order of time."""

    __slots__ = ("hit_ns", "hits", "note_ns", "notes")

    def __init__(self, notes: list[int], note_ns: list[int]) -> None:
        self.notes, self.note_ns = notes, note_ns
        self.hits: list[int] = []
        self.hit_ns: list[int] = []

    def put(self, hit: int, at_ns: int) -> None:
        place = bisect_right(self.hit_ns, at_ns)
        self.hit_ns.insert(place, at_ns)
        self.hits.insert(place, hit)

    def hits_between(self, start_ns: int, end_ns: int) -> slice:
        return slice(bisect_left(self.hit_ns, start_ns), bisect_right(self.hit_ns, end_ns))

    def notes_between(self, start_ns: int, end_ns: int) -> slice:
        return slice(bisect_left(self.note_ns, start_ns), bisect_right(self.note_ns, end_ns))


class Follower:
    """The live judge of one run through `score`; `kit` names the student's pieces, None for a complete kit."""

    def __init__(self, score: Score, windows: Windows = DEFAULT_LEVEL, kit: Collection[Piece] | None = None) -> None:
        self._reach_ns = round(windows.reach_ms * NS_PER_MS)
        self._class_of: list[int] = match_classes(kit).tolist()
        self._onset_ns: list[int] = score.onset_ns.tolist()
        self._velocity: list[int] = score.notes["velocity"].tolist()
        self._note_class: list[int] = [self._class_of[piece] for piece in score.notes["piece"].tolist()]
        self._order = sorted(range(len(score)), key=self._onset_ns.__getitem__)
        self._ordered_ns = [self._onset_ns[note] for note in self._order]
        self._lanes = self._split()
        self._unwritten = Unwritten(score)
        self._passed = 0  # how many of `_order` are too late to be played
        self._own_of_note = [_NOBODY] * len(score)
        self._other_of_note = [_NOBODY] * len(score)
        self._hits: list[Hit] = []
        self._hit_ns: list[int] = []
        self._note_of_hit: list[int] = []

    def _split(self) -> dict[int, _Lane]:
        rows: dict[int, list[int]] = {}
        for note in self._order:
            rows.setdefault(self._note_class[note], []).append(note)
        return {c: _Lane(notes, [self._onset_ns[note] for note in notes]) for c, notes in rows.items()}

    def hit(self, hit: Hit, score_ns: int) -> tuple[Judgement, ...]:
        """Judge `hit`, played at `score_ns`: its own verdict and every older one that it changes.

        Hits are numbered from 0 in the order of these calls. A judgement replaces all earlier ones on its note and on
        its hit.
        """
        index = len(self._hits)
        self._hits.append(hit)
        self._hit_ns.append(score_ns)
        self._note_of_hit.append(_NOBODY)
        lane = self._lanes.get(self._class_of[hit.piece])
        if lane is None:
            return (self._left_alone(index),)
        lane.put(index, score_ns)
        return self._pair_around(lane, index)

    def advance(self, score_ns: int) -> tuple[Judgement, ...]:
        """The misses that are certain at `score_ns` unless an older hit is still on its way."""
        until = bisect_left(self._ordered_ns, score_ns - self._reach_ns)
        if until <= self._passed:
            return ()
        due, self._passed = self._order[self._passed : until], until
        return tuple(Judgement(Label.MISS, note, None) for note in due if self._is_waiting(note))

    # --- pairing ----------------------------------------------------------------------------------------------------

    def _pair_around(self, lane: _Lane, index: int) -> tuple[Judgement, ...]:
        """Pair anew what is near the hit `index` in its lane; returns what changed."""
        at_ns, reach = self._hit_ns[index], self._reach_ns
        near = lane.hits_between(at_ns - _MEMORY * reach, at_ns + _MEMORY * reach)
        hits, hit_ns = lane.hits[near], lane.hit_ns[near]
        around = lane.notes_between(hit_ns[0] - reach, hit_ns[-1] + reach)
        among = set(hits)
        notes = [n for n in lane.notes[around] if (own := self._own_of_note[n]) == _NOBODY or own in among]
        pairs = least_cost([self._onset_ns[n] for n in notes], hit_ns, reach)
        now = dict.fromkeys(hits, _NOBODY) | {hits[j]: notes[i] for i, j in pairs}
        changed = [h for h in hits if h == index or now[h] != self._own_note(h)]
        return self._apply(changed, now)

    def _apply(self, changed: list[int], now: dict[int, int]) -> tuple[Judgement, ...]:
        """Give each hit of `changed` the note that `now` names."""
        freed = {self._release(hit) for hit in changed}
        said: list[Judgement] = []
        alone: list[int] = []
        for hit in changed:
            note = now[hit]
            if note == _NOBODY:
                alone.append(hit)
                continue
            self._own_of_note[note], self._note_of_hit[hit] = hit, note
            said.append(self._pair(Label.MATCH, note, hit))
            if (other := self._other_of_note[note]) != _NOBODY:
                self._release(other)
                alone.append(other)
        said += [self._left_alone(hit) for hit in alone]
        said += [Judgement(Label.MISS, n, None) for n in freed if n != _NOBODY and self._is_missed(n)]
        return tuple(said)

    def _release(self, hit: int) -> int:
        """Take the hit from its note; returns the note."""
        note = self._note_of_hit[hit]
        self._note_of_hit[hit] = _NOBODY
        if note != _NOBODY:
            table = self._own_of_note if self._own_of_note[note] == hit else self._other_of_note
            table[note] = _NOBODY
        return note

    def _left_alone(self, hit: int) -> Judgement:
        """The verdict on a hit that no note of its own piece wants: another piece's note, or nobody's."""
        played, at_ns = self._hits[hit], self._hit_ns[hit]
        if not self._unwritten.is_own_only(played.piece, at_ns):
            note = self._waiting_note_near(at_ns, self._class_of[played.piece])
            if note != _NOBODY:
                self._other_of_note[note], self._note_of_hit[hit] = hit, note
                return self._pair(Label.WRONG_PIECE, note, hit)
        quiet = self._unwritten.is_quiet(played.piece, played.velocity, at_ns)
        return Judgement(Label.IGNORED if quiet else Label.EXTRA, None, hit)

    def _waiting_note_near(self, at_ns: int, but_class: int) -> int:
        start = bisect_left(self._ordered_ns, at_ns - _WRONG_REACH_NS)
        end = bisect_right(self._ordered_ns, at_ns + _WRONG_REACH_NS)
        waiting = [n for n in self._order[start:end] if self._note_class[n] != but_class and self._is_waiting(n)]
        return min(waiting, key=lambda n: abs(self._onset_ns[n] - at_ns), default=_NOBODY)

    def _own_note(self, hit: int) -> int:
        note = self._note_of_hit[hit]
        return note if note != _NOBODY and self._own_of_note[note] == hit else _NOBODY

    def _is_missed(self, note: int) -> bool:
        too_late = self._passed and self._onset_ns[note] <= self._ordered_ns[self._passed - 1]
        return bool(too_late) and self._is_waiting(note)

    def _is_waiting(self, note: int) -> bool:
        return self._own_of_note[note] == _NOBODY and self._other_of_note[note] == _NOBODY

    def _pair(self, label: Label, note: int, hit: int) -> Judgement:
        asynchrony_ns = self._hit_ns[hit] - self._onset_ns[note]
        return Judgement(label, note, hit, asynchrony_ns, self._hits[hit].velocity - self._velocity[note])
