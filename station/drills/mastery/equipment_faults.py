"""Faults that no practice mends: a latency that nobody measured, cables that are swapped.

Slowing down helps with neither, so that the policy must tell them from the student's own. A lean as wide and steady as
no habit is latency. Two pads that answer for each other are cables (or a wrong kit file): from then on their hits are
judged as if they were right, and the student reads so. If that was an error the pads answer for each other again, and
all is as before.
"""

from collections import Counter
from dataclasses import dataclass, replace

from station.core.labels import piece_name
from station.core.pieces import Piece
from station.drills.mastery.pass_measures.pass_facts import PassResult, StruckFor
from station.drills.mastery.rules import Rules
from station.music.performance import Performance

Swap = tuple[Piece, Piece]


@dataclass(frozen=True, slots=True)
class Equipment:
    """What is known of a student's kit: all `answers` so far, the passes in a row that `leaned`, the `swap` found."""

    answers: tuple[StruckFor, ...] = ()
    leaned: int = 0
    told_latency: bool = False
    swap: Swap | None = None

    def after(self, result: PassResult, rules: Rules) -> tuple["Equipment", str | None]:
        """After one more pass, and what the student should read now, in one sentence."""
        leans = result.lean_ms is not None and abs(result.lean_ms) >= rules.calibrate_ms
        known = replace(self, answers=_merged(self.answers, result.answers), leaned=self.leaned + 1 if leans else 0)
        found = _swap(known.answers, rules)
        if found is not None:
            undone = found == self.swap
            return replace(known, answers=(), swap=None if undone else found), _swap_words(found, undone)
        if known.leaned >= rules.calibrate_passes and not self.told_latency and result.lean_ms is not None:
            return replace(known, told_latency=True), _latency_words(result.lean_ms)
        return known, None


def rewired(performance: Performance, swap: Swap | None) -> Performance:
    """The performance as it would be with the cables of two pads put right."""
    if swap is None:
        return performance
    hits = performance.hits.copy()
    for struck, meant in (swap, swap[::-1]):
        hits["piece"][performance.hits["piece"] == struck] = meant
    return Performance.from_array(hits, performance.chokes)


def _merged(old: tuple[StruckFor, ...], new: tuple[StruckFor, ...]) -> tuple[StruckFor, ...]:
    counts = Counter({(row.written, row.played): row.count for row in old})
    counts.update({(row.written, row.played): row.count for row in new})
    return tuple(StruckFor(written, played, count) for (written, played), count in sorted(counts.items()))


def _swap(answers: tuple[StruckFor, ...], rules: Rules) -> Swap | None:
    """The pair of pads that answer for each other, if there is one."""
    totals: Counter[Piece] = Counter()
    for row in answers:
        totals[row.written] += row.count
    mostly = {
        row.written: row.played
        for row in answers
        if row.played != row.written
        and totals[row.written] >= rules.swap_strokes
        and row.count >= rules.swap_share * totals[row.written]
    }
    return next(((a, b) for a, b in mostly.items() if a < b and mostly.get(b) == a), None)


def _swap_words(swap: Swap, undone: bool) -> str:
    first, second = (piece_name(piece) for piece in swap)
    if undone:
        return f"{first.capitalize()} and {second} are as they should be again."
    return f"{first.capitalize()} and {second} answer for each other: look at their cables; they are judged as swapped."


def _latency_words(lean_ms: float) -> str:
    side = "late" if lean_ms > 0 else "early"
    how = "measure the latency once (station devices calibrate)"
    return f"All strokes are {abs(lean_ms):.0f} ms {side}, too evenly for a habit: {how}."
