"""One true sentence on what went well, read from the figures."""

from collections.abc import Iterator, Sequence

from station.core.labels import piece_name
from station.core.pieces import Dynamic
from station.scoring.analysis.summary import Summary
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
    known = [
        (group.timing.sd_ms, piece_name(piece))
        for piece, group in summary.by_piece.items()
        if group.timing.sd_ms is not None and group.timing.count >= FEWEST
    ]
    if len(known) > 1:
        sd_ms, piece = min(known)
        yield f"Your {piece} is the steadiest: its strokes spread by {sd_ms:.0f} ms."


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
