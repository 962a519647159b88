"""Live verdicts on hits whose place in the score is known: each as it comes, corrected when later ones prove it wrong.

The verdict on every note and hit is a function of the hits and their places alone, never of when or how often `advance`
is called, so that one performance is judged alike at any frame rate. `advance` only says aloud which notes are too late
to be played; a hit that was delivered late takes such a miss back.

A hit and the few hits and notes of its piece around it are paired by least cost, as the final alignment does; where a
note and a hit surely belong together (`pairing`) nothing else needs to be looked at. What is older than `_MEMORY`
reaches is final, which bounds the cost of a hit whatever the score's length. A hit that its own piece does
not want goes to a waiting note of another piece close by, until that note's own piece claims it.

Where the student turns out to be elsewhere, `move` judges the last hits anew. When they go back, what they played
before counts until they pass it again; then the new hit does, and the old one was played again, as in the end.

How far a hit may lie from where its note is due is the final alignment's rule (`note_reach`, `assignment`), told by the
matches so far (`running_lean`). Times are ns on the score's axis; asynchronies are real time, by the pace.
"""

from bisect import bisect_left, bisect_right
from collections import deque
from collections.abc import Collection
from dataclasses import replace
from itertools import accumulate
from typing import NamedTuple

import numpy as np

from station.core.events import Hit
from station.core.pieces import Piece
from station.core.units import NS_PER_MS
from station.music.judgement import Judgement, Label
from station.music.score import Score
from station.scoring.matching.assignment import Leaning, leaning_places
from station.scoring.matching.click_offset import common_bias_ns
from station.scoring.matching.ignored_hits import Unwritten
from station.scoring.matching.match_classes import match_classes
from station.scoring.matching.note_lane import Lane
from station.scoring.matching.note_reach import LEAST_REACH_NS, reach_of
from station.scoring.matching.pairing import least_cost
from station.scoring.matching.running_lean import RunningLean

_MEMORY = 2
"""Reaches back in time within which a verdict may still change (our choice; a longer tangle is a roll)."""

_BESIDE_NS = 120 * NS_PER_MS
"""Who begins, or goes back, so little before a note is at that note (our choice: as far as a lone note's reach)."""

_LOOK_AFTER = (12, 48)
"""After so many hits it is asked whether all lie beside the click by the same (our choice: a bar, and a few)."""

_ELSEWHERE_NS = 50 * NS_PER_MS
"""Leans that differ by less do not part sixteenths at 160 bpm, 94 ms (our choice: half of it)."""

_LONE_HITS = 8
"""So many hits that answer nothing may still answer a note that another hit gives up (our choice: a beat's)."""


class Moved(NamedTuple):
    """Hits `first` … to the newest are at `places_ns` of the score, of which `pace` s pass in a real second."""

    first: int
    places_ns: list[int]
    pace: float = 1.0


_NOBODY = -1
_FAR = 2**62


class Judge:
    """Judges one run through `score`; `kit` names the student's pieces, None for a complete kit."""

    def __init__(self, score: Score, kit: Collection[Piece] | None = None) -> None:
        self._pace = 1.0
        self._class_of: list[int] = match_classes(kit).tolist()
        self._onset_ns: list[int] = score.onset_ns.tolist()
        self._velocity: list[int] = score.notes["velocity"].tolist()
        self._note_class: list[int] = [self._class_of[piece] for piece in score.notes["piece"].tolist()]
        self._order = sorted(range(len(score)), key=self._onset_ns.__getitem__)
        self._ordered_ns = [self._onset_ns[note] for note in self._order]
        self._lanes = self._split()
        classes = np.array(self._note_class, np.int64)
        room = reach_of(score, classes)
        self._lean = RunningLean(Leaning(leaning_places(score), room), classes)
        self._widest_ns = int(np.maximum(room.early, room.late).max(initial=0))
        self._unwritten = Unwritten(score)
        self._own_of_note = [_NOBODY] * len(score)
        self._other_of_note = [_NOBODY] * len(score)
        self._note_is_said = bytearray(len(score))
        self._hits: list[Hit] = []
        self._hit_ns: list[int] = []
        self._note_of_hit: list[int] = []
        self._hit_is_said = bytearray()
        self._segment_start = 0  # the first hit since the student last went back
        self._begin = self._passed = 0
        self._again = self._again_end = 0  # of `_order`: what the student went back over and has not passed again
        self._again_ns = 0
        self._lone: deque[int] = deque(maxlen=_LONE_HITS)

    def _split(self) -> dict[int, Lane]:
        rows: dict[int, list[int]] = {}
        for note in self._order:
            rows.setdefault(self._note_class[note], []).append(note)
        return {c: Lane(notes, [self._onset_ns[note] for note in notes]) for c, notes in rows.items()}

    def hit(self, hit: Hit, moved: Moved) -> tuple[Judgement, ...]:
        """Judge `hit`, the last of `moved`: its own verdict and every older one that it changes.

        Hits are numbered from 0 in the order of these calls. A judgement replaces all earlier ones on its note and on
        its hit.
        """
        index = len(self._hits)
        self._hits.append(hit)
        self._hit_ns.append(moved.places_ns[-1])
        self._note_of_hit.append(_NOBODY)
        self._hit_is_said.append(False)
        self._pace = moved.pace
        said = self._judged(index) if moved.first == index else self._judged_anew(moved)
        if index + 1 in _LOOK_AFTER and not self._segment_start:
            said = _last_words(said + self._led_by_all())
        if self._again < self._again_end:
            said += self._passed_again(moved.places_ns[-1])
        return self._with_corrections(said)

    def advance(self, score_ns: int) -> tuple[Judgement, ...]:
        """The misses that are certain at `score_ns` unless an older hit is still on its way."""
        until = self._passed
        while until < len(self._order) and self._last_ns(self._order[until]) < score_ns:
            until += 1
        if until == self._passed:
            return ()
        due, self._passed = self._order[self._passed : until], until
        return self._with_corrections([Judgement(Label.MISS, note, None) for note in due if self._is_waiting(note)])

    def begin(self, score_ns: int) -> tuple[Judgement, ...]:
        """The student turns out to have begun at `score_ns`: what is written before is nobody's. Takes misses back."""
        before, self._begin = self._begin, self._before(score_ns - _BESIDE_NS) if score_ns else 0
        self._passed = self._begin if self._begin < before else max(self._passed, self._begin)
        early = [n for n in self._order[before : self._begin] if self._note_is_said[n] and self._is_waiting(n)]
        return self._with_corrections([Judgement(Label.PENDING, note, None) for note in early])

    def _led_by_all(self) -> list[Judgement]:
        """Judge all anew if the hits as a whole lie elsewhere beside the click than their matches say."""
        near = self._before(max(self._hit_ns) + self._widest_ns)
        notes = np.array(self._order[:near], np.int64)
        hit_class = np.array([self._class_of[hit.piece] for hit in self._hits], np.int64)
        onset, classes = np.array(self._ordered_ns[:near], np.int64), np.array(self._note_class, np.int64)[notes]
        bias_ns = common_bias_ns(onset, classes, np.array(self._hit_ns, np.int64), hit_class)
        if abs(bias_ns - self._lean.common_ns) < _ELSEWHERE_NS:
            return []
        return self._judged_anew(Moved(0, list(self._hit_ns)), bias_ns)

    # --- pairing ----------------------------------------------------------------------------------------------------

    def _judged(self, index: int) -> list[Judgement]:
        """Put a hit in its place; returns what changes."""
        lane = self._lanes.get(self._class_of[self._hits[index].piece])
        if lane is None:
            return [self._left_alone(index)]
        lane.put(index, self._hit_ns[index])
        note = self._sure_note(lane, index)
        if note == _NOBODY:
            return self._pair_around(lane, index)
        said: list[Judgement] = []
        self._give(index, note, said)
        return said

    def _sure_note(self, lane: Lane, index: int) -> int:
        """The free note that surely belongs to the hit `index`, by the rules of `pairing`; −1 if none does."""
        at_ns, hit_ns, lean = self._hit_ns[index], lane.hit_ns, self._lean
        right = bisect_left(lane.note_ns, at_ns)
        low = right - 2 if right > 2 else 0
        near = second = _FAR
        note, due = _NOBODY, 0
        for candidate, other in lean.due_at(lane.notes[low : right + 2], lane.note_ns[low : right + 2]):
            away = abs(other - at_ns)
            if away < near:
                note, due, near, second = candidate, other, away, near
            elif away < second:
                second = away
        if note == _NOBODY or self._own_of_note[note] != _NOBODY:
            return _NOBODY
        early, late = lean.reach_ns(note)
        if not -early <= at_ns - due <= late:
            return _NOBODY
        reach = max(early, late)
        place, rival = bisect_left(hit_ns, at_ns), _FAR
        if place:
            rival = abs(hit_ns[place - 1] - due)
        if place + 1 < len(hit_ns):
            rival = min(rival, abs(hit_ns[place + 1] - due))
        surely = near < rival and rival * rival + second * second >= (reach + 1) * (reach + 1) + near * near
        return note if surely else _NOBODY

    def _pair_around(self, lane: Lane, index: int) -> list[Judgement]:
        """Pair anew what is near the hit `index` in its lane; returns what changed."""
        at_ns, lean = self._hit_ns[index], self._lean
        reach = self._reach_near(lane, at_ns)
        near = lane.hits_between(at_ns - _MEMORY * reach, at_ns + _MEMORY * reach)
        hits, hit_ns = lane.hits[near], lane.hit_ns[near]
        around = lane.notes_between(hit_ns[0] - 2 * reach, hit_ns[-1] + 2 * reach)
        among = set(hits)
        notes = [n for n in lane.notes[around] if (own := self._own_of_note[n]) < self._segment_start or own in among]
        notes.sort(key=self._due_ns)
        due = [self._due_ns(n) for n in notes]
        rooms = [lean.reach_ns(n) for n in notes]
        first = list(accumulate((at - early for at, (early, _) in zip(due, rooms, strict=True)), max))
        last = list(accumulate((at + late for at, (_, late) in zip(due[::-1], rooms[::-1], strict=True)), min))[::-1]
        pairs = least_cost(due, hit_ns, list(zip(first, last, strict=True)), reach)
        now = dict.fromkeys(hits, _NOBODY) | {hits[j]: notes[i] for i, j in pairs}
        changed = [h for h in hits if h == index or now[h] != self._own_note(h)]
        return self._apply(changed, now)

    def _reach_near(self, lane: Lane, at_ns: int) -> int:
        """The widest reach of the notes around `at_ns`."""
        here = lane.notes[lane.notes_between(at_ns - self._widest_ns, at_ns + self._widest_ns)]
        return max((max(self._lean.reach_ns(n)) for n in here), default=LEAST_REACH_NS)

    def _due_ns(self, note: int) -> int:
        """When the note is due, where this player stands."""
        return self._onset_ns[note] + self._lean.due_ns(note)

    def _last_ns(self, note: int) -> int:
        """Until when the note may be played."""
        return self._due_ns(note) + self._lean.reach_ns(note)[1]

    def _apply(self, changed: list[int], now: dict[int, int]) -> list[Judgement]:
        """Give each hit of `changed` the note that `now` names."""
        freed = {self._release(hit) for hit in changed}
        said: list[Judgement] = []
        for hit in changed:
            if now[hit] != _NOBODY:
                self._give(hit, now[hit], said)
        said += [self._left_alone(hit) for hit in changed if now[hit] == _NOBODY]
        for note in freed:
            if note != _NOBODY and self._is_waiting(note):
                said += self._given_up(note)
        return said

    def _given_up(self, note: int) -> list[Judgement]:
        """What becomes of a note that its hit leaves: a lone hit's on another piece, or nobody's."""
        for hit in self._lone:
            if self._note_of_hit[hit] == _NOBODY and self._is_wrong_piece(hit, note):
                self._other_of_note[note], self._note_of_hit[hit] = hit, note
                return [self._pair(Label.WRONG_PIECE, note, hit)]
        return [Judgement(Label.MISS, note, None)] if self._is_missed(note) else []

    def _is_wrong_piece(self, hit: int, note: int) -> bool:
        played = self._hits[hit]
        return (
            hit >= self._segment_start
            and self._class_of[played.piece] != self._note_class[note]
            and abs(self._due_ns(note) - self._hit_ns[hit]) <= self._lean.wrong_reach_ns
            and not self._unwritten.is_own_only(played.piece, self._hit_ns[hit])
        )

    def _give(self, hit: int, note: int, said: list[Judgement]) -> None:
        """Pair them; whoever had the note before is left alone."""
        rivals = self._own_of_note[note], self._other_of_note[note]
        for rival in rivals:
            if rival != _NOBODY:
                self._release(rival)
        self._own_of_note[note], self._note_of_hit[hit] = hit, note
        self._lean.learn(note, self._hit_ns[hit] - self._onset_ns[note])
        said.append(self._pair(Label.MATCH, note, hit))
        said += [self._left_alone(rival) for rival in rivals if rival != _NOBODY]

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
        if hit >= self._segment_start and not self._unwritten.is_own_only(played.piece, at_ns):
            note = self._waiting_note_near(at_ns, self._class_of[played.piece])
            if note != _NOBODY:
                self._other_of_note[note], self._note_of_hit[hit] = hit, note
                return self._pair(Label.WRONG_PIECE, note, hit)
        if hit < self._segment_start and at_ns >= self._again_ns:
            return Judgement(Label.PLAYED_AGAIN, None, hit)
        self._lone.append(hit)
        quiet = self._unwritten.is_quiet(played.piece, played.velocity, at_ns)
        return Judgement(Label.IGNORED if quiet else Label.EXTRA, None, hit)

    def _waiting_note_near(self, at_ns: int, but_class: int) -> int:
        reach = self._lean.wrong_reach_ns
        start = bisect_left(self._ordered_ns, at_ns - self._widest_ns)
        end = bisect_right(self._ordered_ns, at_ns + self._widest_ns)
        best, nearest = _NOBODY, reach
        for note in self._order[start:end]:
            if self._note_class[note] != but_class and self._is_waiting(note):
                away = abs(self._due_ns(note) - at_ns)
                if away < nearest or (away == nearest and best == _NOBODY):
                    best, nearest = note, away
        return best

    # --- moving -----------------------------------------------------------------------------------------------------

    def _judged_anew(self, moved: Moved, lean_ns: int = 0) -> list[Judgement]:
        """Put the hits of `moved` in their new places; returns what changes. `lean_ns` is what all share, if known."""
        first, places_ns = moved.first, moved.places_ns
        if first < len(self._hits) // 2:  # most that is known of the leans was told by hits in the wrong place
            self._lean.begin_at(lean_ns)
        freed = {self._remove(hit) for hit in range(first, len(self._hits))} - {_NOBODY}
        if first and places_ns[0] < self._hit_ns[first - 1] - _BESIDE_NS:
            self._go_back(first, places_ns[0])
        said: list[Judgement] = []
        for hit, place_ns in enumerate(places_ns, first):
            self._hit_ns[hit] = place_ns
            said += self._judged(hit)
        said += [Judgement(self._unplayed(note), note, None) for note in freed if self._is_waiting(note)]
        return _last_words(said)

    def _remove(self, hit: int) -> int:
        """Remove a hit from its lane and its note; returns the note."""
        lane = self._lanes.get(self._class_of[self._hits[hit].piece])
        if lane is not None:
            lane.remove(hit, self._hit_ns[hit])
        return self._release(hit)

    def _go_back(self, first: int, to_ns: int) -> None:
        """From hit `first` on the score is played again from `to_ns`: the hits of the time before stay out of it."""
        self._segment_start = first
        self._again_end = max(self._passed, self._before(max(self._hit_ns[:first], default=0)))
        self._again_ns = to_ns - _BESIDE_NS
        self._passed = self._again = max(self._before(self._again_ns), self._begin)
        for lane in self._lanes.values():
            lane.forget_from(self._again_ns)

    def _passed_again(self, place_ns: int) -> list[Judgement]:
        """Notes that the student played the first time and has now passed without: what counts is the second time."""
        said: list[Judgement] = []
        while self._again < self._again_end and self._last_ns(self._order[self._again]) < place_ns:
            note, self._again = self._order[self._again], self._again + 1
            hit = max(self._own_of_note[note], self._other_of_note[note])
            if _NOBODY < hit < self._segment_start:
                self._release(hit)
                said += [Judgement(Label.MISS, note, None), Judgement(Label.PLAYED_AGAIN, None, hit)]
        return said

    # --- what is so -------------------------------------------------------------------------------------------------

    def _before(self, score_ns: int) -> int:
        """How many notes are written before `score_ns`."""
        return bisect_left(self._ordered_ns, score_ns)

    def _own_note(self, hit: int) -> int:
        note = self._note_of_hit[hit]
        return note if note != _NOBODY and self._own_of_note[note] == hit else _NOBODY

    def _is_missed(self, note: int) -> bool:
        return self._is_waiting(note) and self._unplayed(note) is Label.MISS

    def _unplayed(self, note: int) -> Label:
        """What a note is that nobody plays: missed, or still to come."""
        at_ns, passed, begin = self._onset_ns[note], self._passed, self._begin
        is_past = passed > 0 and at_ns <= self._ordered_ns[passed - 1]
        return Label.MISS if is_past and (begin == 0 or at_ns > self._ordered_ns[begin - 1]) else Label.PENDING

    def _is_waiting(self, note: int) -> bool:
        return self._own_of_note[note] == _NOBODY and self._other_of_note[note] == _NOBODY

    def _pair(self, label: Label, note: int, hit: int) -> Judgement:
        off_ns = self._hit_ns[hit] - self._onset_ns[note]
        asynchrony_ns = off_ns if self._pace == 1.0 else round(off_ns / self._pace)
        return Judgement(label, note, hit, asynchrony_ns, self._hits[hit].fine_velocity - self._velocity[note])

    def _with_corrections(self, said: list[Judgement]) -> tuple[Judgement, ...]:
        """`said`, each marked if it corrects what was said before of its note or hit."""
        for i, verdict in enumerate(said):
            note, hit = verdict.note_index, verdict.hit_index
            before = False
            if note is not None:
                before, self._note_is_said[note] = bool(self._note_is_said[note]), verdict.label is not Label.PENDING
            if hit is not None:
                before, self._hit_is_said[hit] = before or bool(self._hit_is_said[hit]), True
            if before:
                said[i] = replace(verdict, corrects=True)
        return tuple(said)


def _last_words(said: list[Judgement]) -> list[Judgement]:
    """The judgements of `said` that no later one replaces."""
    notes: set[int | None] = set()
    hits: set[int | None] = set()
    last = []
    for verdict in reversed(said):
        note, hit = verdict.note_index, verdict.hit_index
        if (hit is not None and hit not in hits) or (hit is None and note not in notes):
            last.append(verdict)
        notes.add(note)
        hits.add(hit)
    return last[::-1]
