"""Text scores: any score reads back the same to the tick; any damage is bad input that names its line and column."""

import re

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from station.core.errors import BadInput
from station.core.pieces import HAND_PIECES, Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.music.formats.text_score import parse_text_score, score_text
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap

METERS = st.tuples(st.integers(1, 13), st.sampled_from((2, 4, 8, 16)))


@st.composite
def tempo_maps(draw: st.DrawFn) -> TempoMap:
    meters = [MeterChange(draw(st.integers(0, 40)) * PPQ // 2 if i else 0, *draw(METERS)) for i in range(3)]
    tempos = [TempoChange(draw(st.integers(0, 20 * PPQ)) if i else 0, draw(st.integers(1, 10**7))) for i in range(3)]
    return TempoMap.build(sorted(tempos, key=lambda t: t.tick), sorted(meters, key=lambda m: m.tick))


@st.composite
def notes(draw: st.DrawFn) -> Note:
    piece = draw(st.sampled_from(Piece))
    hands = piece in HAND_PIECES
    limbs = (Limb.RIGHT_HAND, Limb.LEFT_HAND) if hands else (Limb.RIGHT_FOOT, Limb.LEFT_FOOT)
    return Note(
        tick=draw(st.integers(0, 40 * PPQ)),
        piece=piece,
        zone=draw(st.sampled_from(Zone)),
        velocity=draw(st.integers(1, 127)),
        articulation=draw(st.sampled_from(Articulation)),
        dynamic=draw(st.sampled_from(Dynamic)),
        limb=draw(st.sampled_from((Limb.UNKNOWN, *limbs))),
        openness=draw(st.none() | st.floats(0, 1, width=32)),
        ornament=draw(st.sampled_from(Ornament)),
        lead_ms=draw(st.just(0.0) | st.floats(0.125, 500, width=32)),
        duration_ticks=draw(st.integers(0, 8 * PPQ)),
        choke_ticks=draw(st.integers(0, 8 * PPQ)),
        midi_note=draw(st.integers(0, 127)),
    )


@st.composite
def scores(draw: st.DrawFn) -> Score:
    title = " ".join(draw(st.lists(st.text("abc#:/é", min_size=1, max_size=5), max_size=3)))
    return Score.from_notes(draw(st.lists(notes(), max_size=8)), draw(tempo_maps()), title=title)


@given(scores())
@settings(max_examples=60)
def test_what_is_written_reads_back_to_the_tick(score: Score) -> None:
    again = parse_text_score(score_text(score, score.notes["limb"]))
    for name in score.notes.dtype.names or ():
        assert np.array_equal(again.notes[name], score.notes[name], equal_nan=name == "openness"), name
    assert again.tempo_map == score.tempo_map
    assert (again.end_tick, again.title) == (score.end_tick, score.title)


@given(scores(), st.data())
@settings(max_examples=60)
def test_damage_is_read_or_refused_with_its_place(score: Score, data: st.DataObject) -> None:
    words = re.split(r"( +|\n)", score_text(score, score.notes["limb"]))
    at = data.draw(st.integers(0, len(words) - 1))
    words[at] = data.draw(st.text(max_size=8) | st.sampled_from((*words, "-1", "1e999", "9" * 25, "=", "1:1+1/0")))
    place = "line 1, column 1"  # of no fault
    try:
        parse_text_score("".join(words)).onset_ns  # noqa: B018 # what is read can be played
    except BadInput as fault:
        place = fault.place
    assert re.fullmatch(r"line \d+, column \d+", place)
