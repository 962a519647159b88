"""What else came with the strokes that were asked for: double triggers and crosstalk, and how to tell them.

Who is asked for single strokes plays none within `ONE_STROKE_NS`, so that whatever is softer there is false. Margins
are our choice: three strokes do not show the worst.
"""

from collections.abc import Iterable, Mapping

from station.core.note_map import KitMap
from station.core.pieces import Piece
from station.core.units import NS_PER_MS
from station.devices.mapping.device_map import CROSSTALK_WITHIN_NS, Crosstalk, DeviceMap, Foot, Pad
from station.devices.wizard.answers import ONE_STROKE_NS, Said, StepAnswer, loudest
from station.devices.wizard.wizard_steps import HALF_BOW, SPLASH, STOMP, WizardQuestion, WizardStep

_MARGIN = 1.25
_LOUDEST_SHARE = 0.8
"""A second note louder than this share of the first is no crosstalk: a module that sends two notes a stroke."""
_EARLY_MARGIN_NS = 2 * NS_PER_MS
"""Crosstalk may come by so much earlier than they were seen to."""
LONGEST_MASK_NS = 40 * NS_PER_MS
"""No drummer strikes a pad twice within less on purpose, but in a flam (our choice)."""
_TWICE = 2
_SHUT_AFTER_NS = 15 * NS_PER_MS
"""By so much the note that a stomp fires may come before the pedal says that it is shut; our choice."""
_LEAST_TRAVEL = 0.3
"""What the pedal closes by when a foot stamps, and not when a stick makes the cymbals swing; our choice."""
_SPLASH_OPENS_BY = 0.3
LONGEST_SPLASH_NS = 150 * NS_PER_MS

Mains = Mapping[WizardStep, int]
Takes = Mapping[WizardStep, StepAnswer]


def learned_pads(takes: Takes, mains: Mains, notes: KitMap) -> dict[Piece, Pad]:
    """For each piece that was struck the least velocity that it sent, and a mask time where it triggered twice."""
    least: dict[Piece, int] = {}
    mask_ns: dict[Piece, int] = {}
    for step, main in mains.items():
        for stroke, first in _strokes(takes, step, main):
            if step.soft:
                least[step.piece] = min(first.value, least.get(step.piece, first.value))
            doubles = [n for n in stroke if n.at_ns > first.at_ns and _piece(notes, n) is step.piece]
            gaps_ns = [n.at_ns - first.at_ns for n in doubles if n.value < first.value]
            gap_ns = max((gap for gap in gaps_ns if gap * _MARGIN <= LONGEST_MASK_NS), default=0)
            if gap_ns:
                mask_ns[step.piece] = max(mask_ns.get(step.piece, 0), round(gap_ns * _MARGIN) + NS_PER_MS)
    return {
        piece: Pad(mask_ns=mask_ns.get(piece, 0), least_velocity=least.get(piece))
        for piece in sorted({*least, *mask_ns})
    }


def learned_crosstalk(takes: Takes, mains: Mains, notes: KitMap) -> tuple[Crosstalk, ...]:
    """A rule for each pad that answered to a stroke on another."""
    seen: dict[tuple[Piece, Piece], list[tuple[float, int]]] = {}
    for step, main in mains.items():
        for stroke, first in _strokes(takes, step, main):
            for note in stroke:
                victim, share = _piece(notes, note), note.value / first.value
                most = (
                    1.0 if step.piece is Piece.HIHAT_PEDAL else _LOUDEST_SHARE
                )  # a stomp may be softer than its crosstalk
                if victim is None or victim is step.piece or share > most or _is_foots(step, victim):
                    continue
                seen.setdefault((step.piece, victim), []).append((share, note.at_ns - first.at_ns))
    rules = [_rule(source, victim, answers) for (source, victim), answers in sorted(seen.items())]
    return (*rules, *_stomps_on_hats(takes, mains))


def _stomps_on_hats(takes: Takes, mains: Mains) -> Iterable[Crosstalk]:
    """For stomps without a note that fire the hi-hat all the same; how hard they are, the pedal hardly tells."""
    if STOMP in takes and STOMP not in mains and len(takes[STOMP].strokes()) >= _TWICE:
        yield Crosstalk(Piece.HIHAT_PEDAL, Piece.HIHAT, 1.0, before_ns=_SHUT_AFTER_NS)


def learned_foot(takes: Takes, mains: Mains, kit: DeviceMap) -> Foot:
    """What the hi-hat foot does: stomps without a note, false ones while half open, splashes that sound like stomps."""
    usual, stomp = kit.foot, takes.get(STOMP)
    by_controller = usual.by_controller if stomp is None else STOMP not in mains and bool(stomp.controllers)
    false = [n for n in takes.get(HALF_BOW, StepAnswer()).notes if _piece(kit.notes, n) is Piece.HIHAT_PEDAL]
    least_travel = _LEAST_TRAVEL if false and kit.pedal is not None else usual.least_travel
    return Foot(least_travel, _splash_ns(takes, mains, kit) or usual.splash_ns, by_controller)


def _splash_ns(takes: Takes, mains: Mains, kit: DeviceMap) -> int:
    """How long a splash takes to open again, where its note is a stomp's; 0 where the notes tell or nothing does."""
    if SPLASH not in mains or mains[SPLASH] != mains.get(STOMP) or kit.pedal is None:
        return 0
    take, times_ns = takes[SPLASH], []
    for stroke in take.strokes():
        at_ns, lowest = stroke[0].at_ns, 1.0
        for said in take.controllers:
            if said.number == kit.pedal.controller and at_ns <= said.at_ns <= at_ns + LONGEST_SPLASH_NS:
                openness = kit.pedal.openness(said.value)
                lowest = min(lowest, openness)
                if openness - lowest >= _SPLASH_OPENS_BY:
                    times_ns.append(said.at_ns - at_ns)
                    break
    return min(LONGEST_SPLASH_NS, round(max(times_ns) * _MARGIN)) if times_ns else 0


def _strokes(takes: Takes, step: WizardStep, main: int) -> Iterable[tuple[tuple[Said, ...], Said]]:
    """The strokes of a step that hit what was asked for, each with its own note."""
    if step.ask is not WizardQuestion.STRIKE:
        return
    for stroke in takes[step].strokes():
        own = [note for note in stroke if note.number == main]
        if own and (step is STOMP or step is SPLASH or loudest(stroke).number == main):
            yield stroke, max(own, key=lambda note: note.value)


def _is_foots(step: WizardStep, victim: Piece) -> bool:
    """Stomps that half-open playing fires are no crosstalk: `Foot.least_travel` tells them by the pedal."""
    return step.piece is Piece.HIHAT and victim is Piece.HIHAT_PEDAL


def _piece(notes: KitMap, note: Said) -> Piece | None:
    strike = notes.get(note.number)
    return None if strike is None else strike.piece


def _rule(source: Piece, victim: Piece, answers: list[tuple[float, int]]) -> Crosstalk:
    most = 1.0 if source is Piece.HIHAT_PEDAL else _LOUDEST_SHARE
    share = min(most, _MARGIN * max(share for share, _ in answers))
    late_ns = max(after_ns for _, after_ns in answers)
    early_ns = max(-after_ns for _, after_ns in answers)
    within_ns = min(ONE_STROKE_NS, max(CROSSTALK_WITHIN_NS, round(_MARGIN * late_ns)))
    before_ns = round(_MARGIN * early_ns) + _EARLY_MARGIN_NS if early_ns > 0 else 0
    return Crosstalk(source, victim, round(share, 2), within_ns, before_ns)
