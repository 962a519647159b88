"""Technique in words, a line a matter, from the report's own table: only what the data bear and a student can use.

What lies within its interval of nothing is not said; figures are rounded to what the interval allows.
"""

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from station.core.labels import name_of

Table = Mapping[str, Any]
"""A part of the document that `technique_table.plain` wrote."""

LEAST_MS = 3.0
"""Half of what is just heard in fast strokes (HUMANS) is worth no word."""


def technique_lines(document: Table) -> list[str]:
    """The lines of a whole document, most general first; empty where nothing can be said."""
    technique = document["craft"]
    lines = [line for say in _SAYINGS for line in say(technique)]
    lines += [
        f"Cannot tell {one['what']} ({one['count']}): {one['why']}" for one in document["cannot_tell"] if one["judged"]
    ]
    return lines


def _side(ms: float, early: str, late: str) -> str:
    return f"{abs(ms):.0f} ms {early if ms < 0 else late}"


def _sure(figure: Table, least: float = 0.0) -> bool:
    """Whether the mean has an interval that leaves out 0, and is worth a word."""
    mean, ci = figure["mean"], figure["ci"]
    return ci is not None and ci[0] * ci[1] > 0 and abs(mean) >= least


def _leans(technique: Table) -> Iterator[str]:
    leans = [
        name_of(one["piece"])
        + f" {_side(one['lean_ms'], 'ahead', 'behind')}{'' if one['free'] else ' (more than feel)'}"
        for one in technique["leans"]
        if one["ci"][0] * one["ci"][1] > 0 and abs(one["lean_ms"]) >= LEAST_MS
    ]
    if leans:
        yield f"Feel: {', '.join(leans)}"


def _swing(technique: Table) -> Iterator[str]:
    if (swing := technique["swing"]) is not None:
        beyond = "" if swing["free"] else ", beyond feel"
        yield f"Swing: {swing['held']:.1f}:1 held, {swing['written']:.1f}:1 written{beyond}"


def _fills(technique: Table) -> Iterator[str]:
    fills = technique["fills"]
    if fills is not None and _sure({"mean": fills["apart_ms"], "ci": fills["ci"]}, LEAST_MS):
        yield f"Fills: {_side(fills['apart_ms'], 'ahead of', 'behind')} your groove"


def _synchrony(technique: Table) -> Iterator[str]:
    synchrony = technique["together"]
    if synchrony is not None and synchrony["sd_ms"]["ci"] is not None:
        yield f"Limbs that strike together: {synchrony['sd_ms']['sd']:.0f} ms apart (SD)"


def _wing_kristofferson(technique: Table) -> Iterator[str]:
    clock_and_hand = technique["keeper"]
    if clock_and_hand["timekeeper"] is not None:
        clock, hand = clock_and_hand["timekeeper"]["sd_ms"], clock_and_hand["motor"]["sd_ms"]
        yield f"Inner clock: {clock:.0f} ms, hand: {hand:.0f} ms (SD at {clock_and_hand['interval_ms']:.0f} ms)"


def _gaps(technique: Table) -> Iterator[str]:
    gaps = technique["gaps"]
    if gaps is not None and gaps["size_ms"]["mean"] is not None:
        side = f", {_side(gaps['drift_ms']['mean'], 'early', 'late')} on average" if _sure(gaps["drift_ms"]) else ""
        size = gaps["size_ms"]
        yield f"When the click comes back: {size['mean']:.0f} ms off in {size['count']} gaps{side}"


def _open_rolls(technique: Table) -> Iterator[str]:
    rolls = technique["open_rolls"]
    if rolls is not None and rolls["intervals_pct"]["ci"] is not None:
        yield f"Rolls: intervals spread by {rolls['intervals_pct']['sd']:.0f} % (SD)"
        if _sure(rolls["second_ms"], LEAST_MS):
            yield f"Second strokes: {_side(rolls['second_ms']['mean'], 'early', 'late')}"
        if _sure(rolls["second_db"], 1.0):
            yield f"Second strokes: {_db(rolls['second_db']['mean'])} than the first"


def _db(level: float) -> str:
    return f"{abs(level):.1f} dB {'softer' if level < 0 else 'louder'}"


def _buzz_rolls(technique: Table) -> Iterator[str]:
    buzz = technique["buzz_rolls"]
    if buzz is None or buzz["continuous"] is None:
        return
    words = [f"Buzz rolls: {buzz['continuous']} of {buzz['judged']} without a hole"]
    words += [f"they end {_side(buzz['end_ms']['mean'], 'early', 'late')}"] if _sure(buzz["end_ms"], LEAST_MS) else []
    if _sure(buzz["shape_db"], 1.0):
        shape = buzz["shape_db"]["mean"]
        words.append(f"they {'fade' if shape < 0 else 'grow'} by {abs(shape):.0f} dB")
    yield ", ".join(words)


def _ornaments(technique: Table) -> Iterator[str]:
    for kind, found in technique["ornaments"].items():
        spacing, softness = found["spacing_ms"], found["level_db"]
        if spacing["ci"] is not None:
            steady = f"{spacing['mean']:.0f} ms (SD {spacing['sd']:.0f})"
            yield f"{kind.capitalize()}s: strokes {steady} apart, grace strokes {_db(softness['mean'])}"


def _cymbals(technique: Table) -> Iterator[str]:
    if (hats := technique["hats"]) is not None and hats["judged"]:
        yield f"Hi-hat: {hats['right']} of {hats['judged']} as open as written"
    if (chokes := technique["chokes"]) is not None and chokes["judged"]:
        ring = chokes["ring_ms"]
        late = f", {_side(ring['mean'], 'early', 'late')}" if _sure(ring, LEAST_MS) else ""
        yield f"Grabbed cymbals: {chokes['made']} of {chokes['judged']}{late}"


_CLASSES = {"ghost": "ghost notes", "normal": "plain strokes", "accent": "accents"}


def _pad_dynamics(technique: Table) -> Iterator[str]:
    if (dynamics := technique["shades"]) is None:
        return
    for one in dynamics["contrasts"]:
        if one["ci"] is not None:
            loud, soft = (_CLASSES[one[which]] for which in ("loud", "soft"))
            heard = f"{one['played_db']:+.1f} dB, written {one['written_db']:+.1f}"
            yield f"{name_of(one['piece']).capitalize()}, {loud} against {soft}: {heard}"
    if dynamics["evenness_db"]["ci"] is not None:
        yield f"Evenness of plain strokes: {dynamics['evenness_db']['sd']:.1f} dB (SD)"
    balance = dynamics["left_less_right"]
    if balance is not None and _sure({"mean": balance["louder_db"], "ci": balance["ci"]}, 1.0):
        yield f"Hands: the left is {_db(balance['louder_db'])} than the right"
    for one in dynamics["crescendos"]:
        if one["ci"] is not None:
            where = f"{name_of(one['piece']).capitalize()}, bars {one['bars'][0]}-{one['bars'][1]}"
            yield f"{where}: {one['played_db']:+.0f} dB for {one['written_db']:+.0f}"


_SAYINGS: tuple[Callable[[Table], Iterator[str]], ...] = (
    _fills,
    _leans,
    _swing,
    _synchrony,
    _wing_kristofferson,
    _gaps,
    _open_rolls,
    _buzz_rolls,
    _ornaments,
    _cymbals,
    _pad_dynamics,
)
