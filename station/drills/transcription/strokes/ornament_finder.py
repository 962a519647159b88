"""Flams, drags and buzz strokes found again among plain strokes, by the time between them and by their loudness.

Asked of each drum by itself, for other pieces have no such letters, and before strokes go onto a grid: an ornament's
spacing belongs to the hand, not to the beat. What a stroke is called, by the gap to the next one of its drum:

* gap ≤ `BOUNCE_MS` and far softer than its neighbour, or no gap: the pad triggered twice; no stroke (any piece);
* three or more gaps ≤ `CLOSE_MS` long that do not lead up to a louder stroke: a buzz, as long as it rebounds;
* one soft stroke ≤ `CLOSE_MS` before a louder one, or two hands at nearly one moment: a flam;
* two soft strokes, each `DRAG_MS` before the next, and then a louder one: a drag.

What a file says itself (ornaments, grace strokes, buzzes) stays, and then nothing is looked for.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import inf, log
from statistics import median

from station.core.pieces import DRUMS, Articulation, Ornament, Piece, Zone
from station.core.units import NS_PER_MS, PPQ
from station.drills.transcription.strokes.close_pairs import Neighbours, is_two_of_a_run, neighbours
from station.drills.transcription.strokes.press_rolls import FEWEST, Roll, hands_strokes
from station.music.grace_strokes import DRAG_RANGE_MS, FLAM_RANGE_MS, Graces
from station.music.score import Note, Score

BOUNCE_MS = 10.0
"""Modules tell strokes apart from 8–10 ms on (their retrigger time); nobody strikes one drum twice so soon."""
_BOUNCE_SHARE = 0.5
"""A second hand is never half as loud as the first so soon; a pad that still shakes is (our choice)."""
LAYERED_MS = 1.0
"""What a pad says of head and rim at once is one stroke; two hands are hardly ever so exact (our choice)."""
AT_ONCE_MS = 8.0
"""Two hands that mean to strike together are within this: half the just noticeable order of two sounds, 15–20 ms."""
CLOSE_MS = 45.0
"""A flam's grace stroke comes 15–40 ms before its note (HUMANS, Timing); a hand's own next stroke after 50 ms or more
(`limb_speeds`)."""
WIDE_MS = 60.0
"""A soft stroke so near before a louder one, and alone with it, is its grace stroke (our choice: as in a drag)."""
DRAG_MS = (15.0, 78.0)
"""The strokes of a drag are 40–70 ms apart (HUMANS, Timing); tight ruffs go down to a buzz's spacing."""
_SOFT = 0.75
"""Grace strokes have 25–50 % of their note's velocity (HUMANS, Timing); human spread allows half as much again."""
_DRAG_SOFT = 0.62
_LATE_GAP, _LATE_HAND = 1.2, 1.2
_NEXT_HAND = 1.35
"""So much louder than rebounds is the other hand's stroke after them: rebounds lose a third; where it also
comes so much later than a rebound would, less will do (our choice)."""
_ALIKE = 0.25
"""Both strokes of a drag are of one bounce: the softer has at least this share of the louder (our choice)."""
_APART = 1.3
"""So many times as far as its own spacing a drag stands from the stroke before it, or so many times softer than it is,
else the three are a run (our choice)."""
_EVEN = 1.6
"""A louder stroke that comes by so much earlier before a grace stroke is a stroke of its own (our choice)."""
_ALONE = 3.0
"""So many times as far as its own spacing from the stroke before it nothing but a drag is so quick (our choice)."""
_RUN_TICKS = (PPQ // 8, PPQ // 12)
"""Strokes that lie exactly on these cells of an exact score are written strokes, not grace strokes."""
_FEWEST = 3
"""Strokes of a buzz."""
_EXACT_MS = 0.1
"""Grace strokes so near to a whole number of milliseconds, in a whole file, were written by a program (our choice)."""
_EXACT_SHARE = 0.02
"""Velocities are whole numbers: of a ghost stroke's 13, one more is another 3 % of its note's (our choice)."""


@dataclass(frozen=True, slots=True)
class FoundOrnaments:
    """The main strokes in order, flams and drags by their ornament, buzzes one row each with its duration.

    `graces` is how grace strokes are spaced where all are alike, else the usual; `counts` says how many of each were
    found, `bounces` how many strokes were none but a pad that shook.
    """

    mains: tuple[Note, ...]
    graces: Graces
    flams: int = 0
    drags: int = 0
    buzzes: int = 0
    bounces: int = 0


@dataclass(slots=True)
class _Stroke:
    """A stroke at `ms`; `leads_ms` and `shares` are those of the grace strokes that it has swallowed."""

    note: Note
    ms: float
    leads_ms: tuple[float, ...] = ()
    shares: tuple[float, ...] = ()


def found_ornaments(score: Score, graces: Graces | None = None) -> FoundOrnaments:
    """The main strokes of `score`, with their ornaments; `graces` is their spacing where the file says it."""
    onsets = (score.onset_ns / NS_PER_MS).tolist()
    strokes = [_Stroke(note, ms) for note, ms in zip(score, onsets, strict=True)]
    if any(_is_said(stroke.note) for stroke in strokes):
        mains = tuple(stroke.note for stroke in strokes if not stroke.note.lead_ms)
        return FoundOrnaments(mains, graces or Graces())
    by_piece: dict[Piece, list[_Stroke]] = {}
    for stroke in strokes:
        by_piece.setdefault(stroke.note.piece, []).append(stroke)
    kept = [stroke for piece, line in by_piece.items() for stroke in _line(piece, _without_bounces(line), score)]
    kept.sort(key=lambda s: (s.note.tick, s.note.piece))
    return FoundOrnaments(
        tuple(s.note for s in kept),
        graces or _spacing(kept),
        flams=sum(s.note.ornament is Ornament.FLAM for s in kept),
        drags=sum(s.note.ornament is Ornament.DRAG for s in kept),
        buzzes=sum(s.note.articulation is Articulation.BUZZ for s in kept),
        bounces=len(strokes) - sum(len(_without_bounces(line)) for line in by_piece.values()),
    )


def _is_said(note: Note) -> bool:
    is_buzz = note.articulation is Articulation.BUZZ
    return note.lead_ms > 0 or (note.ornament is not Ornament.NONE and not is_buzz)


def _without_bounces(line: Sequence[_Stroke]) -> list[_Stroke]:
    """The strokes of one piece without those that a pad made by itself, before or after a louder one."""
    soft: set[int] = set()
    for i, (a, b) in enumerate(pairwise(line)):
        low, high = sorted((a.note.velocity, b.note.velocity))
        gap = b.ms - a.ms
        if gap < LAYERED_MS or (gap <= BOUNCE_MS and low < _BOUNCE_SHARE * high):
            at = i if a.note.velocity < b.note.velocity else i + 1
            soft |= set() if gap >= LAYERED_MS and _begins_a_drag(line[at : at + 3]) else {at}
    return [stroke for i, stroke in enumerate(line) if i not in soft]


def _begins_a_drag(three: Sequence[_Stroke]) -> bool:
    """Whether a soft stroke is the first of a drag that begins right behind the note before it."""
    return len(three) == 3 and _is_drag((), *three)


def _line(piece: Piece, line: list[_Stroke], score: Score) -> list[_Stroke]:
    """The main strokes of one piece."""
    if piece not in DRUMS:
        return line
    return [found for segment in _segments(_with_drags(line), score) for found in segment]


# --- chains of close strokes ------------------------------------------------------------------------------------------


def _segments(line: Sequence[_Stroke], score: Score) -> Iterator[list[_Stroke]]:
    """The line, its rolls of rebounds parted into hands' strokes, and what lies between them as the strokes it is."""
    rest: list[_Stroke] = []
    together = list(_rolls(line))
    presses = [roll for roll in together if _may_be_pressed(roll)]
    hands = {id(roll): at for roll, at in zip(presses, _hands(presses, score), strict=True)}
    for roll in together:
        at = hands.get(id(roll), ())
        if not at:
            rest += roll
            continue
        yield _without_chains(rest, score)
        rest = []
        yield [_buzz(roll[a:b], score) for a, b in pairwise([*at, len(roll)])]
    yield _without_chains(rest, score)


def _rolls(line: Sequence[_Stroke]) -> Iterator[list[_Stroke]]:
    """The line cut where a gap is wider than `CLOSE_MS`."""
    roll: list[_Stroke] = []
    for stroke in line:
        if roll and stroke.ms - roll[-1].ms > CLOSE_MS:
            yield roll
            roll = []
        roll.append(stroke)
    if roll:
        yield roll


def _may_be_pressed(roll: Sequence[_Stroke]) -> bool:
    return len(roll) >= FEWEST and not any(stroke.leads_ms or not _is_plain(stroke.note) for stroke in roll)


def _hands(presses: Sequence[Sequence[_Stroke]], score: Score) -> list[tuple[int, ...]]:
    rolls = [Roll([s.ms for s in press], [s.note.velocity for s in press]) for press in presses]
    return hands_strokes(rolls, score.tempo_map)


def _without_chains(line: Sequence[_Stroke], score: Score) -> list[_Stroke]:
    """Each chain of strokes at most `CLOSE_MS` apart as the strokes that it is."""
    chains: list[list[_Stroke]] = []
    for stroke in line:
        if chains and stroke.ms - chains[-1][-1].ms <= CLOSE_MS and not _begins_another(chains[-1], stroke):
            chains[-1].append(stroke)
        else:
            chains.append([stroke])
    chains = _with_wide_flams(chains)
    starts, ends = [chain[0].ms for chain in chains], [chain[-1].ms for chain in chains]
    runs = [neighbours(starts, ends, i) if len(chain) == 2 else None for i, chain in enumerate(chains)]
    likely = [len(c) == 2 and not _is_two_of_run(c, run, 0.0) for c, run in zip(chains, runs, strict=True)]
    rare = log((len(chains) + 1) / (sum(likely) + 0.5))
    return [
        found for c, run in zip(chains, runs, strict=True) for found in _meant(c, _is_two_of_run(c, run, rare), score)
    ]


def _with_wide_flams(chains: Sequence[list[_Stroke]]) -> list[list[_Stroke]]:
    """The chains, a soft stroke a little farther before a louder one in its chain where both stand alone."""
    found: list[list[_Stroke]] = []
    for i, chain in enumerate(chains):
        after = chains[i + 1][0].ms if i + 1 < len(chains) else inf
        if found and _is_wide_flam(found[-2:-1], found[-1], chain, after):
            found[-1] = [*found[-1], *chain]
        else:
            found.append(chain)
    return found


def _is_wide_flam(before: Sequence[list[_Stroke]], soft: list[_Stroke], loud: list[_Stroke], after_ms: float) -> bool:
    gap = loud[0].ms - soft[-1].ms
    room = min(soft[0].ms - before[0][-1].ms if before else inf, after_ms - loud[0].ms)
    return (
        len(soft) == len(loud) == 1
        and gap <= WIDE_MS
        and room >= _ALONE * gap
        and not soft[0].leads_ms
        and not loud[0].leads_ms
        and soft[0].note.velocity <= _DRAG_SOFT * loud[0].note.velocity
        and not _is_written_run((*soft, *loud))
    )


def _is_two_of_run(chain: Sequence[_Stroke], run: Neighbours | None, rare: float) -> bool:
    """Whether two close strokes are two of the run; a flam costs `rare` more, as seldom as the drum has them."""
    if run is None or len(chain) != 2:
        return False
    first, second = chain
    share = first.note.velocity / second.note.velocity
    if second.ms - first.ms <= AT_ONCE_MS and share >= _BOUNCE_SHARE:
        return False
    return is_two_of_a_run(first.ms, second.ms, share, run, rare)


def _begins_another(chain: Sequence[_Stroke], stroke: _Stroke) -> bool:
    """Whether the stroke is none of the chain: it is a drag's, or the first stroke of the next hand after rebounds."""
    if stroke.leads_ms or chain[-1].leads_ms:
        return True
    if len(chain) < _FEWEST:
        return False
    heard, velocity = [s.note.velocity for s in chain], stroke.note.velocity
    gap = median(b.ms - a.ms for a, b in pairwise(chain))
    is_late = stroke.ms - chain[-1].ms >= _LATE_GAP * gap
    is_louder = velocity >= (_LATE_HAND if is_late else _NEXT_HAND) * median(heard[1:])
    return is_louder and max(heard) > _SOFT * velocity


def _meant(chain: Sequence[_Stroke], is_run: bool, score: Score) -> list[_Stroke]:
    """What a chain is; `is_run`: its two strokes are two of a run."""
    first, last = chain[0], chain[-1]
    if len(chain) == 1 or not all(_is_plain(s.note) for s in chain):
        return list(chain)
    if len(chain) == 2:
        return list(chain) if is_run else _flam(first, last)
    before = max(s.note.velocity for s in chain[:-1])
    if before <= _SOFT * last.note.velocity:
        return [_graced(last, Ornament.DRAG, chain[-3:-1])]
    return [_buzz(chain, score)]


def _buzz(chain: Sequence[_Stroke], score: Score) -> _Stroke:
    """A stroke and its rebounds as one; alone it is the stroke after a roll."""
    first, last = chain[0], chain[-1]
    if len(chain) == 1:
        return first
    rebounds_until = last.ms + (last.ms - first.ms) / (len(chain) - 1)
    end = int(score.tempo_map.ticks_at_ns(round(rebounds_until * NS_PER_MS)))
    note = replace(
        first.note,
        velocity=max(s.note.velocity for s in chain),
        articulation=Articulation.BUZZ,
        ornament=Ornament.ROLL,
        duration_ticks=max(1, end - first.note.tick),
    )
    return _Stroke(note, first.ms)


def _is_plain(note: Note) -> bool:
    return note.articulation in (Articulation.NORMAL, Articulation.RIM_SHOT)


def _flam(first: _Stroke, second: _Stroke) -> list[_Stroke]:
    """Two close strokes: a flam, but where the first is by far the louder, a stroke and its rebound."""
    share = first.note.velocity / second.note.velocity
    is_at_once = second.ms - first.ms <= AT_ONCE_MS and share >= _BOUNCE_SHARE
    if share <= _SOFT or is_at_once:
        return [_graced(second, Ornament.FLAM, [first])]
    if share <= 1 / _SOFT:
        louder = replace(second.note, velocity=max(first.note.velocity, second.note.velocity))
        return [_graced(_Stroke(louder, second.ms), Ornament.FLAM, [first])]
    return [first, second]


def _graced(main: _Stroke, ornament: Ornament, graces: Sequence[_Stroke]) -> _Stroke:
    note = replace(main.note, ornament=ornament, zone=Zone.HEAD, articulation=Articulation.NORMAL)
    leads = tuple(main.ms - grace.ms for grace in graces)
    return _Stroke(note, main.ms, leads, tuple(g.note.velocity / main.note.velocity for g in graces))


# --- drags ------------------------------------------------------------------------------------------------------------


def _with_drags(line: Sequence[_Stroke]) -> list[_Stroke]:
    """The strokes with two soft ones before a louder one made its drag."""
    kept: list[_Stroke] = []
    for stroke in line:
        if len(kept) >= 2 and _is_drag(kept[-4:-2], kept[-2], kept[-1], stroke):
            graces = [kept.pop(-2), kept.pop()]
            kept.append(_graced(stroke, Ornament.DRAG, graces))
        else:
            kept.append(stroke)
    return kept


def _is_drag(before: Sequence[_Stroke], first: _Stroke, second: _Stroke, main: _Stroke) -> bool:
    three = (first, second, main)
    if _are_rebounds((*before, first, second)) or any(
        s.note.ornament is not Ornament.NONE or s.note.articulation is not Articulation.NORMAL for s in three
    ):
        return False
    gaps = (second.ms - first.ms, main.ms - second.ms)
    if not all(DRAG_MS[0] <= gap <= DRAG_MS[1] for gap in gaps) or _is_written_run(three):
        return False
    low, high = sorted((first.note.velocity, second.note.velocity))
    is_alone = not before or first.ms - before[-1].ms >= _ALONE * max(gaps)
    is_even = max(gaps) <= _APART * min(gaps)
    heard = (low + high) / 2 if is_even else high
    if (not is_alone and heard > _DRAG_SOFT * main.note.velocity) or high > _SOFT * main.note.velocity:
        return False
    if low < _ALIKE * high:
        return False
    if gaps[0] > _EVEN * gaps[1] and first.note.velocity > second.note.velocity / _SOFT:
        return False
    return not before or first.ms - before[-1].ms >= _APART * gaps[0] or before[-1].note.velocity >= _APART * high


def _are_rebounds(strokes: Sequence[_Stroke]) -> bool:
    """Whether so many strokes follow each other as closely as rebounds: a drag's two come after a hand's one."""
    is_close = all(b.ms - a.ms <= CLOSE_MS for a, b in pairwise(strokes))
    return len(strokes) > _FEWEST and is_close and not any(s.leads_ms for s in strokes)


def _is_written_run(strokes: Sequence[_Stroke]) -> bool:
    """Whether all of them lie exactly on the cells of one division of the beat."""
    return any(all(s.note.tick % cell == 0 for s in strokes) for cell in _RUN_TICKS)


def _spacing(strokes: Sequence[_Stroke]) -> Graces:
    """The grace strokes of a file in which all are alike, as a program writes them; the usual ones for people's."""
    usual = Graces()
    flams = [s.leads_ms[0] for s in strokes if s.note.ornament is Ornament.FLAM]
    drags = [s.leads_ms[1] for s in strokes if s.note.ornament is Ornament.DRAG]
    shares = [share for s in strokes for share in s.shares]
    share = round(median(shares), 2) if _are_alike(shares, _EXACT_SHARE) else usual.share
    return Graces(
        _exact(flams, usual.flam_ms, FLAM_RANGE_MS),
        _exact(drags, usual.drag_ms, DRAG_RANGE_MS),
        usual.share if abs(share - usual.share) <= _EXACT_SHARE else share,
    )


def _exact(leads_ms: Sequence[float], usual_ms: float, range_ms: tuple[int, int]) -> float:
    """The whole number of milliseconds that all of them are, if a lesson may say it, else the usual one."""
    whole = round(median(leads_ms)) if leads_ms else usual_ms
    is_exact = all(abs(lead - whole) <= _EXACT_MS for lead in leads_ms)
    return float(whole) if is_exact and range_ms[0] <= whole <= range_ms[1] else usual_ms


def _are_alike(values: Sequence[float], spread: float) -> bool:
    """Whether there are several, all of one size."""
    return len(values) > 1 and max(values) - min(values) <= 2 * spread
