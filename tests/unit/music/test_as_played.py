"""A performance as a score: times by hand at 120 bpm, where a bar lasts two seconds."""

from station.core.events import Choke, Hit
from station.core.pieces import Dynamic, Piece, Zone
from station.core.units import PPQ
from station.music.as_played import score_as_played
from station.music.performance import Performance
from station.music.tempo import TempoMap

MAP = TempoMap.constant(120)


def hit(at_ms: float, piece: Piece, velocity: int = 80, zone: Zone = Zone.HEAD) -> Hit:
    return Hit(at_ns=round(at_ms * 1e6), piece=piece, zone=zone, velocity=velocity)


def test_every_hit_is_a_note_at_its_own_time_and_as_loud() -> None:
    played = Performance.from_hits([hit(507.3, Piece.SNARE, 33, Zone.RIM), hit(0, Piece.KICK, 101)])
    score = score_as_played(played, MAP, "Take")
    assert [(n.piece, n.zone, n.velocity) for n in score] == [
        (Piece.KICK, Zone.HEAD, 101),
        (Piece.SNARE, Zone.RIM, 33),
    ]
    at_ns = score.tempo_map.ns_at(score.notes["tick"])
    assert at_ns[0] == 0
    assert abs(int(at_ns[1]) - 507_300_000) < 2500, "half a tick of 500 ms / 107,520"
    assert {n.dynamic for n in score} == {Dynamic.NORMAL}
    assert (score.title, score.bar_count) == ("Take", 1)


def test_a_hit_before_the_beginning_moves_all_on_by_a_bar() -> None:
    score = score_as_played(Performance.from_hits([hit(-30, Piece.KICK), hit(1000, Piece.SNARE)]), MAP)
    assert score.notes["tick"].tolist() == [round(1.97 * 2 * PPQ), 6 * PPQ]


def test_a_choke_ends_the_last_stroke_on_its_cymbal() -> None:
    strokes = [hit(0, Piece.CRASH_1), hit(500, Piece.CRASH_1), hit(750, Piece.RIDE)]
    score = score_as_played(Performance.from_hits(strokes, [Choke(at_ns=1_000_000_000, piece=Piece.CRASH_1)]), MAP)
    assert score.notes["choke_ticks"].tolist() == [0, PPQ, 0]


def test_nothing_played_is_a_score_of_nothing() -> None:
    assert len(score_as_played(Performance.from_hits([]), MAP)) == 0
