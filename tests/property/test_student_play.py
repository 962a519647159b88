"""Whatever is written and whatever the student is like, the truth adds up and the decoder reads what was played."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from station.core.events import Hit
from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.devices.mapping.presets import GENERAL_MIDI_PRESET
from station.devices.midi.midi_decoder import MidiDecoder
from station.music.judgement import Label
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap
from station.simulation.student_spec import FAULTS, PlantedFault, StudentSpec
from station.simulation.virtual_student import play

NOTES = st.builds(
    Note,
    tick=st.integers(0, 64).map(lambda i: i * PPQ // 8) | st.integers(0, 8 * PPQ),
    piece=st.sampled_from(Piece),
    zone=st.sampled_from(Zone),
    velocity=st.integers(1, 127),
    articulation=st.sampled_from(Articulation),
    dynamic=st.sampled_from(Dynamic),
    limb=st.sampled_from(Limb),
    openness=st.none() | st.floats(0, 1, width=32),
    ornament=st.sampled_from(Ornament),
    lead_ms=st.sampled_from([0.0, 0.0, 0.0, 30.0, 60.0]),
    choke_ticks=st.just(0),
)
TEMPO_MAPS = st.builds(
    lambda bpm, later, meter: TempoMap.build(
        [TempoChange.from_bpm(0, bpm), TempoChange.from_bpm(4 * PPQ, later)], [MeterChange(0, *meter)]
    ),
    st.floats(30, 300),
    st.floats(30, 300),
    st.sampled_from([(4, 4), (7, 8), (12, 8), (3, 4)]),
)
SCORES = st.builds(Score.from_notes, st.lists(NOTES, max_size=40), TEMPO_MAPS)
SPECS = st.builds(
    StudentSpec,
    seed=st.integers(0, 2**32 - 1),
    bias_ms=st.floats(-100, 100),
    sd_ms=st.none() | st.floats(0, 100),
    drift_pct=st.floats(0, 20),
    miss_pct=st.sampled_from([0.0, 5.0, 60.0]),
    extra_pct=st.sampled_from([0.0, 5.0, 100.0]),
    wrong_piece_pct=st.sampled_from([0.0, 5.0, 40.0]),
    velocity_sd=st.none() | st.floats(0, 60),
    sd_interval_pct=st.floats(0, 10),
    velocity_cv_pct=st.floats(0, 30),
    faults=st.lists(st.sampled_from(sorted(FAULTS)), unique=True, max_size=3).map(
        lambda names: tuple(PlantedFault(name, FAULTS[name].largest / 5) for name in names)
    ),
)


@given(SCORES, SPECS)
def test_the_truth_adds_up(score: Score, spec: StudentSpec) -> None:
    played = play(score, spec)
    truth, hits = played.truth, played.performance.hits
    assert len(truth.note_label) == len(truth.hit_of_note) == len(score)
    assert len(truth.hit_label) == len(truth.note_of_hit) == len(hits)
    answered = truth.hit_of_note >= 0
    assert (truth.note_of_hit[truth.hit_of_note[answered]] == np.flatnonzero(answered)).all()
    assert (answered == (truth.note_label != Label.MISS)).all()
    assert ((truth.note_of_hit < 0) == (truth.hit_label == Label.EXTRA)).all()
    rightly = np.flatnonzero(truth.note_label == Label.MATCH)
    assert (hits["piece"][truth.hit_of_note[rightly]] == score.notes["piece"][rightly]).all()
    assert (np.diff(hits["at_ns"]) >= 0).all()
    assert ((hits["velocity"] >= 1) & (hits["velocity"] <= 127)).all()


@given(SCORES, SPECS)
def test_the_decoder_reads_what_was_played(score: Score, spec: StudentSpec) -> None:
    played = play(score, spec)
    decoder = MidiDecoder(GENERAL_MIDI_PRESET)
    events = [event for at_ns, data in played.midi for event in decoder.feed(data, at_ns)]
    read = [(e.at_ns, e.piece, e.zone, e.articulation, e.velocity) for e in events if isinstance(e, Hit)]
    assert read == [(h.at_ns, h.piece, h.zone, h.articulation, h.velocity) for h in played.performance]


@given(SCORES, st.integers(0, 1000), st.floats(-50, 50))
def test_a_bias_moves_every_stroke_and_nothing_else(score: Score, seed: int, bias_ms: float) -> None:
    one, two = (play(score, StudentSpec(seed=seed, sd_ms=4.0, bias_ms=b)) for b in (0.0, bias_ms))
    moved = two.performance.hits["at_ns"] - one.performance.hits["at_ns"]
    assert (np.abs(moved - bias_ms * 1e6) <= 1).all()
