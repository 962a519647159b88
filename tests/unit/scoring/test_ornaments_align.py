"""Buzz rolls and flams in the alignment: bounces are nobody's extras, a far flam is a flam."""

import numpy as np
import pytest

from station.core.events import Hit
from station.core.pieces import Articulation, Ornament, Piece, Zone
from station.core.units import NS_PER_MS, PPQ
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.scoring.align import align
from station.scoring.following.follower import Follower
from station.scoring.matching.alignment import Alignment
from station.scoring.matching.played_graces import main_of_grace
from tests.fakes.scores import flams


def snare(at_ms: float, velocity: int = 80) -> Hit:
    return Hit(round(at_ms * NS_PER_MS), Piece.SNARE, Zone.HEAD, velocity)


def kick(at_ms: float) -> Hit:
    return Hit(round(at_ms * NS_PER_MS), Piece.KICK, Zone.HEAD, 90)


def buzz_then_stroke(bars: int = 4) -> Score:
    """At 120 bpm: a buzz over two beats (0–1000 ms), strokes on 3 and 4, kicks on every beat; 7 notes a bar."""
    notes = [
        Note(0, Piece.SNARE, articulation=Articulation.BUZZ, ornament=Ornament.ROLL, duration_ticks=2 * PPQ),
        Note(2 * PPQ, Piece.SNARE),
        Note(3 * PPQ, Piece.SNARE),
        *(Note(beat * PPQ, Piece.KICK, velocity=90) for beat in range(4)),
    ]
    return Score.from_notes(notes, TempoMap.constant(120)).repeated(bars)


def bounced(every_ms: float, bars: int = 4) -> list[Hit]:
    """Bounces all through each buzz, the strokes and the kicks, all on time but the bounces 3 ms beside any grid."""
    hits = []
    for bar in range(bars):
        start = 2000.0 * bar
        hits += [snare(start + at, 60) for at in np.arange(0, 990, every_ms)]
        hits += [snare(start + 1000), snare(start + 1500), *(kick(start + 500 * k) for k in range(4))]
    return hits


@pytest.mark.parametrize("every_ms", [23, 35, 61])
@pytest.mark.parametrize("clocked", [True, False])
def test_bounces_are_neither_extras_nor_misses(every_ms: float, clocked: bool) -> None:
    """However many there are: 28 notes are matched, the rest of the hits is ignored."""
    score, performance = buzz_then_stroke(), Performance.from_hits(bounced(every_ms))
    alignment = align(score, performance, clocked)
    counted = [alignment.count(label) for label in Label]
    assert counted == [28, 0, 0, 0, len(performance) - 28, 0, 0, 0]


def test_a_bounce_never_stands_in_for_another_piece() -> None:
    """The kick on 2 is left out while the snare buzzes: a miss, and no wrong piece."""
    hits = [hit for hit in bounced(35) if hit.piece is Piece.SNARE or hit.at_ns % (2000 * NS_PER_MS) != 500 * NS_PER_MS]
    alignment = align(buzz_then_stroke(), Performance.from_hits(hits), clocked=True)
    assert (alignment.count(Label.MISS), alignment.count(Label.WRONG_PIECE), alignment.count(Label.EXTRA)) == (4, 0, 0)


def test_a_stroke_beside_the_buzz_is_an_extra_still() -> None:
    hits = [*bounced(35), snare(1250)]
    assert align(buzz_then_stroke(), Performance.from_hits(hits), clocked=True).count(Label.EXTRA) == 1


def test_a_lone_stroke_in_a_buzz_that_never_bounced_is_an_extra() -> None:
    """One hit answers the buzz; another 600 ms later is no bounce of it."""
    hits = [hit for hit in bounced(2000) if hit.piece is Piece.SNARE]
    counted = align(buzz_then_stroke(), Performance.from_hits([*hits, snare(600)]), clocked=True)
    assert counted.count(Label.EXTRA) == 1


def test_live_bounces_are_ignored_too() -> None:
    score = buzz_then_stroke()
    follower = Follower(score)
    verdicts = {}
    for hit in sorted(bounced(35), key=lambda hit: hit.at_ns):
        for said in (*follower.advance(hit.at_ns), *follower.hit(hit, hit.at_ns)):
            if said.hit_index is not None:
                verdicts[said.hit_index] = said.label
    labels = list(verdicts.values())
    assert (labels.count(Label.MATCH), labels.count(Label.EXTRA), labels.count(Label.WRONG_PIECE)) == (28, 0, 0)


def flammed(leads_ms: list[float], clocked: bool = True) -> tuple[Score, Alignment]:
    """Main strokes on time, each grace stroke as far before as `leads_ms` says in turn; None plays none."""
    score = flams(6)
    hits, k = [], 0
    for at, grace, velocity in zip(score.onset_ns, score.is_grace, score.notes["velocity"], strict=True):
        late = 30 - leads_ms[k % len(leads_ms)] if grace else 0.0
        k += bool(grace)
        hits.append(snare(at / NS_PER_MS + late, int(velocity)))
    return score, align(score, Performance.from_hits(hits), clocked)


@pytest.mark.parametrize("clocked", [True, False])
@pytest.mark.parametrize("leads_ms", [[105.0], [30.0, 30.0, 30.0, 105.0], [8.0, 105.0, 30.0], [30.0] * 23 + [109.0]])
def test_a_far_flam_is_a_flam(leads_ms: list[float], clocked: bool) -> None:
    """Flams of 105 ms lie 75 ms from what is written, alone among right ones or all alike: 48 notes, 48 pairs."""
    _, alignment = flammed(leads_ms, clocked)
    assert [alignment.count(label) for label in Label] == [48, 0, 0, 0, 0, 0, 0, 0]


def test_farther_than_any_flam_is_none() -> None:
    """150 ms before is a stroke of its own: beyond 30 + 80."""
    _, alignment = flammed([30.0] * 23 + [150.0])
    assert alignment.count(Label.MISS) == 1


def test_a_wide_drag_keeps_its_order() -> None:
    """Written 110 and 55 ms before, one drag of nine played 180 and 120 before: first grace stroke first."""
    notes = [
        Note(beat * PPQ, Piece.SNARE, velocity=v, lead_ms=lead, ornament=Ornament.DRAG)
        for beat in range(12)
        for v, lead in ((32, 110.0), (32, 55.0), (90, 0.0))
    ]
    score = Score.from_notes(notes, TempoMap.constant(60))
    more = {15: -70.0, 16: -65.0}
    hits = [snare(at / NS_PER_MS + more.get(i, 0.0)) for i, at in enumerate(score.onset_ns.tolist())]
    alignment = align(score, Performance.from_hits(hits), clocked=True)
    assert alignment.hit_of_note.tolist() == list(range(36))


def test_the_main_stroke_of_a_grace_is_on_its_own_piece_where_there_is_one() -> None:
    """A kick stands first on the tick of the first flam; the second leads to a tom alone."""
    notes = [
        Note(0, Piece.KICK),
        Note(0, Piece.SNARE, lead_ms=30.0, ornament=Ornament.FLAM),
        Note(0, Piece.SNARE, ornament=Ornament.FLAM),
        Note(PPQ, Piece.SNARE, lead_ms=30.0, ornament=Ornament.FLAM),
        Note(PPQ, Piece.TOM_1, ornament=Ornament.FLAM),
        Note(2 * PPQ, Piece.SNARE, lead_ms=30.0, ornament=Ornament.FLAM),
    ]
    score = Score.from_notes(notes, TempoMap.constant(120))
    rows = main_of_grace(score)
    told = {int(score.notes["tick"][g]) // PPQ: int(rows[g]) for g in np.flatnonzero(score.is_grace)}
    assert score.notes["piece"][told[0]] == Piece.SNARE
    assert score.notes["piece"][told[1]] == Piece.TOM_1
    assert told[2] == -1


def test_a_score_of_flams_of_which_the_main_strokes_alone_are_played() -> None:
    """Every grace stroke is missed, every main stroke is matched, however many there are."""
    score = flams(40)
    hits = [snare(at / NS_PER_MS) for at, grace in zip(score.onset_ns, score.is_grace, strict=True) if not grace]
    result = align(score, Performance.from_hits(hits), clocked=True)
    assert np.array_equal(result.note_label == Label.MISS, score.is_grace)
    assert result.count(Label.MATCH) == len(hits) == 160
