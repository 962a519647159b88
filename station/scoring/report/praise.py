"""One true sentence on what went well, read from the figures."""

from collections.abc import Iterator, Sequence

import numpy as np

from station.core.labels import piece_name
from station.core.pieces import Dynamic
from station.scoring.analysis.summary import Summary
from station.scoring.analysis.technique.estimates import scatter
from station.scoring.analysis.timing_spread import asynchrony_ms, timed_notes
from station.scoring.report.advice import Advice

FEWEST = 12
"""Strokes that a praise rests on, at least (our choice)."""

STEADY_MS = 20.0
"""Spread that is worth praise: professionals in the Groove data play 26–28 ms in all (HUMANS)."""

_CLOSE_DB = 1.5
"""Marks on average this near to what is written are as written: the just noticeable difference is 1–3 dB (HUMANS)."""

_NEARLY_ALL = 0.98


def praise(summary: Summary, advice: Sequence[Advice]) -> str | None:
    """The first of the sentences that hold beside `advice`; None where too little was played or nothing holds."""
    if summary.counts.matched < FEWEST:
        return None
    return next(_sentences(summary, frozenset(one.fault for one in advice)), None)


def _sentences(summary: Summary, named: frozenset[str]) -> Iterator[str]:
    counts, sd = summary.counts, summary.timing.sd_ms
    if counts.matched == counts.notes and counts.extras == 0:
        yield f"You played all {counts.notes} notes, and nothing else."
    if sd is not None and sd < STEADY_MS and not any(word.startswith("unsteady") for word in named):
        yield f"Your time is steady: your strokes lie within {sd:.0f} ms of each other (SD)."
    sticking = summary.sticking
    if sticking is not None and sticking.told >= FEWEST and not sticking.wrong.any():
        yield f"Your sticking is as written: all {sticking.told} strokes came from the right hand or the left as asked."
    if counts.matched >= _NEARLY_ALL * counts.notes:
        yield f"You played {counts.matched} of {counts.notes} notes."
    if (marks := _marks(summary)) is not None:
        yield marks
    if (steadiest := _steadiest(summary)) is not None:
        yield steadiest


def _steadiest(summary: Summary) -> str | None:
    """The piece that is steady, on time, and surely steadier than every other; None where there is none.

    Surely: the 95 % intervals of the spreads part. A piece whose strokes lie together but away from their time is none.
    """
    off_ms, ticks = asynchrony_ms(summary.alignment), summary.score.notes["tick"].astype(np.int64)
    timed = timed_notes(summary.score, summary.alignment)
    found = []
    for piece, group in summary.by_piece.items():
        if group.timing.count >= FEWEST:
            here = timed & (summary.score.notes["piece"] == piece)
            found.append((scatter(off_ms[here], np.zeros(int(here.sum()), np.int64), ticks[here]), piece, group))
    if len(found) < 2 or any(spread.ci is None for spread, _, _ in found):
        return None
    (best, piece, group), *others = sorted(found, key=lambda one: one[0].sd or 0.0)
    assert best.sd is not None
    assert best.ci is not None
    is_on_time = abs(group.timing.mean_ms or 0.0) <= summary.view.windows.on_time_ms
    is_surely = all(best.ci[1] < other.ci[0] for other, _, _ in others if other.ci is not None)
    if not (is_on_time and is_surely and best.sd < STEADY_MS):
        return None
    return f"Your {piece_name(piece)} is the steadiest: its strokes spread by {best.sd:.0f} ms."


def _marks(summary: Summary) -> str | None:
    """Accents or ghosts that are as loud as written."""
    names = {"accent_level": (Dynamic.ACCENT, "accents"), "ghost_level": (Dynamic.GHOST, "ghost notes")}
    for name, (dynamic, said) in names.items():
        effect, group = summary.habits.effects.get(name), summary.by_dynamic.get(dynamic)
        if effect is None or group is None or group.matched < FEWEST:
            continue
        if abs(effect.value) + 2 * effect.error < _CLOSE_DB:
            return f"Your {said} are as loud as they are written."
    return None
