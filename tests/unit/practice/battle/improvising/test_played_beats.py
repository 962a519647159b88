"""What was played, beat by beat: strokes whose cells are known by hand."""

from pathlib import Path

import numpy as np
import pytest

from station.core.events import Hit
from station.core.pieces import Articulation, Ornament, Piece, Zone
from station.core.units import NS_PER_MS, PPQ
from station.music.formats.smf.standard_midi import performance_from_midi, read_midi
from station.music.performance import Performance
from station.practice.battle.ground import Feel, Ground
from station.practice.battle.improvising.played_beats import (
    Beats,
    Instrument,
    beats_of,
    instrument_of,
    joined,
    landing_of,
    strokes_of,
)
from station.practice.battle.phrase import Turn
from tests.unit.practice.battle.improvising.played_by_hand import every, turn_of

GROUND = Ground(100.0)
BACKBEAT = [(0.0, Piece.KICK, 90), (1.0, Piece.SNARE, 100), (2.0, Piece.KICK, 90), (3.0, Piece.SNARE, 100)]
GMD = Path(__file__).resolve().parents[4] / "data/gmd"


def gmd_beats(name: str, ground: Ground, first: int) -> Beats:
    """Eight bars from bar `first` on."""
    played = performance_from_midi(read_midi(GMD / name))
    return beats_of(Turn(ground, 8, played.shifted(-ground.ns_of_bars(first))))


@pytest.mark.parametrize(("step", "division"), [(1 / 4, 4), (1 / 3, 3), (1 / 6, 6), (1 / 8, 8)])
@pytest.mark.parametrize("bpm", [70.0, 100.0])
def test_even_strokes_have_their_division(step: float, division: int, bpm: float) -> None:
    beats = beats_of(turn_of(every(step, 4), Ground(bpm)))
    assert beats.division.tolist() == [division] * 4
    assert beats.struck[:, :division, Instrument.CLOSED_HIHAT].all()
    assert beats.struck.sum() == 4 * division


def test_each_beat_has_a_division_of_its_own() -> None:
    strokes = every(1 / 4, 1) + every(1 / 3, 1, start=1.0) + every(1 / 6, 1, start=2.0) + every(1 / 8, 1, start=3.0)
    assert beats_of(turn_of(strokes, GROUND)).division.tolist() == [4, 3, 6, 8]


@pytest.mark.parametrize(
    ("share", "bpm", "feel"),
    [
        (0.6, 120.0, Feel.STRAIGHT),  # 1.5:1
        (2 / 3, 120.0, Feel.STRAIGHT),
        (0.6, 215.0, Feel.TRIPLET),  # fast jazz swings lightly
        (0.73, 120.0, Feel.TRIPLET),  # 2.7:1, as drummers swing at that tempo (Friberg & Sundström)
    ],
)
def test_swung_eighths_are_triplets(share: float, bpm: float, feel: Feel) -> None:
    swung = [(beat + place, Piece.RIDE, 80) for beat in range(8) for place in (0.0, share)]
    beats = beats_of(turn_of(swung, Ground(bpm, feel=feel), bars=2))
    assert beats.division.tolist() == [3] * 8
    assert np.argwhere(beats.struck[0]).tolist() == [[0, Instrument.RIDE], [2, Instrument.RIDE]]


@pytest.mark.parametrize("noise_ms", [15.0, 25.0])
@pytest.mark.parametrize("lean_ms", [-20.0, 0.0, 30.0])
def test_a_played_groove_keeps_its_cells(noise_ms: float, lean_ms: float) -> None:
    groove = [(bar * 4 + at, piece, v) for bar in range(4) for at, piece, v in BACKBEAT] + every(1 / 2, 16)
    beats = beats_of(turn_of(groove, GROUND, 4, noise_ms, lean_ms))
    assert np.mean(beats.division == 4) > 0.9
    played = beats.struck[:, :, [Instrument.KICK, Instrument.SNARE, Instrument.CLOSED_HIHAT]]
    written = np.zeros_like(played)
    written[:, [0, 2], 2] = True
    written[0::2, 0, 0] = written[1::2, 0, 1] = True
    assert (played != written)[beats.division == 4].sum() <= (0 if noise_ms < 20 else 2)
    assert beats.late_ms[beats.struck].mean() == pytest.approx(lean_ms, abs=6.0)


def test_beats_with_little_follow_their_neighbours() -> None:
    triplets = [*every(1 / 3, 3), (3.0, Piece.SNARE, 90), *every(1 / 3, 3, start=4.0), (7.0, Piece.KICK, 90)]
    assert beats_of(turn_of(triplets, Ground(100.0), 2)).division.tolist() == [3] * 8


def test_a_silent_turn_has_the_feel_of_its_ground() -> None:
    for feel, division in ((Feel.STRAIGHT, 4), (Feel.TRIPLET, 3)):
        beats = beats_of(turn_of([], Ground(90.0, feel=feel), 2))
        assert beats.division.tolist() == [division] * 8
        assert not beats.struck.any()


def test_an_early_downbeat_and_the_landing_are_where_they_belong() -> None:
    turn = turn_of([(-0.03, Piece.CRASH_1, 110), (3.98, Piece.KICK, 100)], GROUND)
    beats, landing = beats_of(turn), landing_of(turn)
    assert np.argwhere(beats.struck).tolist() == [[0, 0, Instrument.CRASH]]
    assert beats.late_ms[0, 0, Instrument.CRASH] == pytest.approx(-18.0, abs=0.1)  # 0.03 beats of 600 ms
    assert np.argwhere(landing.struck).tolist() == [[0, 0, Instrument.KICK]]
    assert len(landing) == 4


@pytest.mark.parametrize("bpm", [60.0, 100.0, 215.0])
def test_a_first_stroke_that_comes_early_is_the_turns(bpm: float) -> None:
    beats = beats_of(turn_of([(-0.03 * bpm / 60, Piece.CRASH_1, 110), *every(1.0, 3, start=1.0)], Ground(bpm)))
    assert beats.struck[0, 0, Instrument.CRASH]


def test_a_flam_is_one_stroke_with_its_word() -> None:
    beats = beats_of(turn_of([*every(1 / 2, 4), (0.95, Piece.SNARE, 40), (1.0, Piece.SNARE, 100)], GROUND))
    assert np.argwhere(beats.struck[:, :, Instrument.SNARE]).tolist() == [[1, 0]]
    assert beats.ornament[1, 0, Instrument.SNARE] == Ornament.FLAM
    assert beats.velocity[1, 0, Instrument.SNARE] == 100


def test_dotted_beats_of_a_compound_meter_have_eighths() -> None:
    beats = beats_of(turn_of(every(1 / 3, 2), Ground(100.0, 6, 8)))  # the beat is a dotted quarter
    assert beats.division.tolist() == [3, 3]
    assert beats.struck[:, :3, Instrument.CLOSED_HIHAT].all()


def test_the_last_beat_of_seven_eighths_is_short() -> None:
    ground = Ground(100.0, 7, 8)
    turn = turn_of(every(1 / 2, 3.5), ground)
    beats = beats_of(turn)
    assert len(beats) == 4
    assert [note.tick for note in strokes_of(beats, ground)] == [i * PPQ // 2 for i in range(7)]


@pytest.mark.parametrize(
    ("piece", "openness", "articulation", "instrument"),
    [
        (Piece.HIHAT, None, Articulation.NORMAL, Instrument.CLOSED_HIHAT),
        (Piece.HIHAT, 1.0, Articulation.NORMAL, Instrument.OPEN_HIHAT),
        (Piece.HIHAT_PEDAL, None, Articulation.CHICK, Instrument.CLOSED_HIHAT),
        (Piece.HIHAT_PEDAL, None, Articulation.SPLASH, Instrument.OPEN_HIHAT),
        (Piece.TOM_3, None, Articulation.NORMAL, Instrument.MID_TOM),
        (Piece.FLOOR_TOM_2, None, Articulation.NORMAL, Instrument.FLOOR_TOM),
        (Piece.CHINA, None, Articulation.NORMAL, Instrument.CRASH),
        (Piece.COWBELL, None, Articulation.NORMAL, Instrument.RIDE),
    ],
)
def test_every_piece_is_one_of_nine(
    piece: Piece, openness: float | None, articulation: Articulation, instrument: Instrument
) -> None:
    assert instrument_of(piece, openness, articulation) is instrument


def test_all_pieces_are_read() -> None:
    for piece in Piece:
        assert instrument_of(piece, None, Articulation.NORMAL) in Instrument


def test_strokes_come_back_where_they_were_played() -> None:
    turn = turn_of([*BACKBEAT, *every(1 / 4, 2), *every(1 / 3, 2, Piece.RIDE, 2.0)], GROUND, noise_ms=10.0)
    notes = strokes_of(beats_of(turn), GROUND)
    played = sorted((int(h.at_ns), int(h.piece)) for h in turn.played)
    back = sorted(
        (int(GROUND.tempo_map.ns_at(n.tick)) + round(n.late_ms * NS_PER_MS), int(n.piece), n.velocity) for n in notes
    )
    assert [piece for _, piece, _ in back] == [piece for _, piece in played]
    for (ns, _, _), (at_ns, _) in zip(back, played, strict=True):
        assert ns == pytest.approx(at_ns, abs=20_000)  # two ticks


def test_an_open_hihat_is_played_back_open() -> None:
    hit = Hit(0, Piece.HIHAT, Zone.EDGE, 90, openness=0.9)
    (note,) = strokes_of(beats_of(Turn(GROUND, 1, Performance.from_hits([hit]))), GROUND)
    assert (note.piece, note.openness, note.velocity) == (Piece.HIHAT, 1.0, 90)


def test_bars_are_taken_and_joined() -> None:
    beats = beats_of(turn_of(every(1 / 4, 8), GROUND, 2))
    again = joined([beats.of_bars(1, 2), beats.of_bars(0, 1)])
    assert again.bars == 2
    assert np.array_equal(again.struck[:4], beats.struck[4:])


def test_jazz_of_the_dataset_is_triplet_and_funk_straight() -> None:
    jazz = gmd_beats("drummer10/session1/2_jazz-swing_215_beat_4-4.mid", Ground(215.0, feel=Feel.TRIPLET), 0)
    slow = gmd_beats("drummer1/session1/48_jazz_93_beat_4-4.mid", Ground(93.0, feel=Feel.TRIPLET), 8)
    funk = gmd_beats("drummer1/eval_session/1_funk-groove1_138_beat_4-4.mid", Ground(138.0), 0)
    assert np.mean(np.isin(jazz.division, (3, 6))) > 0.9
    assert np.mean(np.isin(slow.division, (3, 6))) > 0.7
    assert np.mean(funk.division == 4) > 0.9


def test_what_was_played_before_the_turn_is_none_of_its_downbeat() -> None:
    """An eighth before the turn is the bar before's; a twentieth of a beat before it is an early one."""
    beats = beats_of(turn_of([(-0.5, Piece.CRASH_1, 90), (-0.25, Piece.SNARE, 90), *BACKBEAT], GROUND))
    assert np.argwhere(beats.struck[0]).tolist() == [[0, Instrument.KICK]]
    early = beats_of(turn_of([(-0.05, Piece.KICK, 90), *BACKBEAT[1:]], GROUND))
    assert early.struck[0, 0, Instrument.KICK]
    assert early.late_ms[0, 0, Instrument.KICK] == pytest.approx(-30, abs=1)  # of 600 ms
