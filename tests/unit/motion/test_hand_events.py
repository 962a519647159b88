import numpy as np
import pytest

from station.core.pieces import Articulation, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.motion.strokes.hand_events import GRAB, LAP, WAIT, hand_events
from station.music.score import Note, Score
from station.music.tempo import TempoMap

R, L = Limb.RIGHT_HAND, Limb.LEFT_HAND


def events_of(notes: list[Note], tempo_bpm: float = 120) -> tuple[list[tuple[float, int]], list[tuple[float, int]]]:
    """Time and articulation of what each hand does from its first stroke to its last."""
    score = Score.from_notes(notes, TempoMap.constant(tempo_bpm))
    right, left = hand_events(score, score.notes["limb"])
    pairs = [
        [(round(t, 4), int(k[2])) for t, k in zip(e.time_s.tolist(), e.key, strict=True)] if len(e.row) else []
        for e in (right, left)
    ]
    return _from_first_to_last(pairs[0]), _from_first_to_last(pairs[1])


def _from_first_to_last(events: list[tuple[float, int]]) -> list[tuple[float, int]]:
    struck = [t for t, a in events if a not in (WAIT, LAP)]
    return [(t, a) for t, a in events if struck[0] <= t <= struck[-1]]


def test_strikes_come_in_order_of_sound_grace_notes_included() -> None:
    notes = [
        Note(PPQ, Piece.SNARE, velocity=100, limb=R),
        Note(PPQ, Piece.SNARE, velocity=30, limb=L, ornament=Ornament.FLAM, lead_ms=25),
    ]
    right, left = events_of(notes)
    assert right == [(0.5, 0)]
    assert left == [(0.475, 0)]


def pressed(events: list[tuple[float, int]]) -> list[float]:
    """When the hand presses: what comes within 50 ms of the event before it is a bounce."""
    times = [t for t, _ in events]
    return [t for t, before in zip(times, [-1.0, *times], strict=False) if t - before > 0.05]


def test_a_long_buzz_is_pressed_by_both_hands_in_turn() -> None:
    buzz = Note(0, Piece.SNARE, articulation=Articulation.BUZZ, duration_ticks=2 * PPQ, limb=R)
    right, left = events_of([buzz])
    assert pressed(right) == pytest.approx([0, 0.2, 0.4, 0.6, 0.8])  # 1 s in ten presses
    assert pressed(left) == pytest.approx([0.1, 0.3, 0.5, 0.7, 0.9])


def test_one_hand_presses_alone_where_the_other_plays() -> None:
    buzz = Note(0, Piece.SNARE, articulation=Articulation.BUZZ, duration_ticks=2 * PPQ, limb=L)
    right, left = events_of([buzz, Note(PPQ, Piece.RIDE, limb=R)])
    assert len(pressed(left)) == 5
    assert [t for t, a in right if a != WAIT] == [0.5]


def test_a_choke_is_done_by_hand() -> None:
    crash = Note(0, Piece.CRASH_1, Zone.EDGE, limb=R, choke_ticks=PPQ)
    right, _ = events_of([crash])
    assert (0.5, GRAB) in right


def test_a_busy_hand_leaves_the_choke_to_the_other() -> None:
    notes = [Note(0, Piece.CRASH_1, Zone.EDGE, limb=R, choke_ticks=PPQ), Note(PPQ, Piece.SNARE, limb=R)]
    right, left = events_of(notes)
    assert (0.5, GRAB) not in right
    assert (0.5, GRAB) in left


def test_a_hand_waits_at_home_in_a_long_rest_but_not_at_its_station() -> None:
    away = [Note(0, Piece.FLOOR_TOM_1, limb=R), Note(5 * PPQ, Piece.FLOOR_TOM_1, limb=R)]
    assert [a for _, a in events_of(away)[0]] == [0, WAIT, 0]
    station = [Note(0, Piece.RIDE, limb=R), Note(5 * PPQ, Piece.RIDE, limb=R)]
    assert [a for _, a in events_of(station)[0]] == [0, 0]
    home = [Note(0, Piece.SNARE, limb=L), Note(5 * PPQ, Piece.SNARE, limb=L)]
    assert [a for _, a in events_of(home)[1]] == [0, 0]


@pytest.mark.parametrize("piece", [Piece.RIDE, Piece.SNARE, Piece.FLOOR_TOM_1])
def test_a_hand_lies_down_in_long_rests_before_its_first_stroke_and_after_its_last(piece: Piece) -> None:
    """At 120 bpm eight beats are 4 s."""
    notes = [Note(40 * PPQ, piece, limb=R), Note(48 * PPQ, piece, limb=R)]
    score = Score.from_notes(notes, TempoMap.constant(120))
    right, left = hand_events(score, score.notes["limb"])
    via = [WAIT] if piece != Piece.SNARE else []  # past the kit
    assert right.key[:, 2].tolist() == [LAP, *via, 0, *via, LAP, LAP, *via, 0, *via, LAP]
    assert left.key[:, 2].tolist() == [LAP]
    assert 18.0 < right.time_s[0] < 19.4  # rises in time, up to then it lies
    lies = right.time_s[right.key[:, 2] == LAP]
    assert (lies[1:3] > 20.6).all()
    assert (lies[1:3] < 23.4).all()


def test_grace_notes_and_cross_sticks_stay_low() -> None:
    notes = [
        Note(0, Piece.SNARE, velocity=127, limb=R, articulation=Articulation.CROSS_STICK),
        Note(PPQ, Piece.SNARE, velocity=127, limb=R, lead_ms=30),
        Note(PPQ, Piece.SNARE, velocity=127, limb=L),
    ]
    score = Score.from_notes(notes, TempoMap.constant(120))
    right, left = hand_events(score, score.notes["limb"])
    assert right.height_m.max() <= 0.06
    assert left.height_m.tolist() == pytest.approx([0.0, 15 * 0.0254, 0.0])
    assert np.diff(right.time_s).min() > 0


@pytest.mark.parametrize("piece", [Piece.RIDE, Piece.TOM_1])
def test_a_stick_that_waits_strikes_the_air_nowhere(piece: Piece) -> None:
    """Away from strikes the velocity of a tip has no break: it changes by less than 0.1 m/s from one ms to the next.

    That is 10 g; hands that strike bring their sticks to 30 g and more, hands that wait have no haste.
    """
    notes = [Note(0, Piece.RIDE, Zone.BOW, 100, limb=R), Note(8 * PPQ, piece, limb=R)]
    drummer = Drummer(Score.from_notes(notes, TempoMap.constant(120)))
    assert drummer.parts is not None
    events = drummer.parts[0].events
    waits = events.time_s[events.key[:, 2] == WAIT]
    assert len(waits) >= 4
    for at in waits.tolist():
        tip = drummer.rows(at + np.arange(-10, 11) * 1e-3)[:, frame.TIP][:, :3]
        assert np.linalg.norm(np.diff(tip, 2, axis=0), axis=1).max() < 1e-4


@pytest.mark.parametrize("piece", [Piece.KICK, Piece.HIHAT_PEDAL, Piece.SNARE])
def test_a_choke_on_what_does_not_ring_is_nobodys(piece: Piece) -> None:
    """A pad's aftertouch may say it of any pad; only cymbals are grabbed."""
    notes = [Note(0, Piece.SNARE, limb=R), Note(PPQ, piece, choke_ticks=60), Note(4 * PPQ, Piece.SNARE, limb=R)]
    score = Score.from_notes(notes, TempoMap.constant(120))
    assert all(GRAB not in events.key[:, 2] for events in hand_events(score, score.notes["limb"]))
