"""A piece's strokes that are written together: each goes to its like, whatever the times alone would say."""

from station.core.events import Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.music.performance import Performance
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.scoring.align import align


def test_strokes_of_one_slot_go_to_their_like() -> None:
    """Rim and head written together, played as a flam after a stray rim stroke: times alone would cross them."""
    notes = [Note(PPQ, Piece.SNARE, Zone.RIM), Note(PPQ, Piece.SNARE, Zone.HEAD)]
    score = Score.from_notes(notes, TempoMap.constant(120))
    due = NS_PER_S // 2
    played = [(due - 51, Zone.RIM), (due - 24, Zone.RIM), (due + 47, Zone.HEAD)]
    hits = [Hit(due + (at - due) * NS_PER_MS, Piece.SNARE, zone, 80) for at, zone in played]
    alignment = align(score, Performance.from_hits(hits), clocked=True)
    by_zone = {int(score.notes["zone"][i]): int(alignment.hit_of_note[i]) for i in range(2)}
    assert by_zone[Zone.HEAD] == 2
    assert by_zone[Zone.RIM] in (0, 1)
