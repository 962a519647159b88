"""A fold written out again is what was folded, whatever the bars."""

from hypothesis import given
from hypothesis import strategies as st

from station.core.pieces import Dynamic, Limb, Piece
from station.core.units import PPQ
from station.music.loudness_marks import LoudnessMark
from station.music.repeats import folded
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap
from tests.played_passages import played_bars

_BARS: tuple[list[tuple[int, Limb, Dynamic]], ...] = (
    [(0, Limb.RIGHT_HAND, Dynamic.NORMAL), (2, Limb.LEFT_HAND, Dynamic.NORMAL)],
    [(0, Limb.RIGHT_HAND, Dynamic.ACCENT), (2, Limb.LEFT_HAND, Dynamic.NORMAL)],
    [(0, Limb.LEFT_HAND, Dynamic.NORMAL), (2, Limb.LEFT_HAND, Dynamic.NORMAL)],
    [],
)
_UNITS = {"3/4": (3, 4), "6/8": (6, 8)}


@st.composite
def scores(draw: st.DrawFn) -> Score:
    """Bars of few kinds, so that many come again, with changes of tempo, meter and loudness between them."""
    phrase = draw(st.lists(st.integers(0, 3), min_size=1, max_size=6))
    kinds = draw(st.lists(st.one_of(st.just(phrase), st.lists(st.integers(0, 3), min_size=1, max_size=3)), max_size=8))
    bars = [kind for part in kinds or [phrase] for kind in part]
    length = 3 * PPQ
    changed = st.dictionaries(st.integers(0, len(bars) - 1), st.sampled_from([90, 120]), max_size=3)
    tempi = [TempoChange.from_bpm(bar * length, bpm) for bar, bpm in draw(changed).items()]
    meters = draw(st.dictionaries(st.integers(0, len(bars) - 1), st.sampled_from(sorted(_UNITS)), max_size=2))
    signs = draw(st.dictionaries(st.integers(0, len(bars) - 1), st.sampled_from(["p", "f", "<"]), max_size=3))
    notes = [
        Note(bar * length + beat * PPQ, Piece.SNARE, limb=limb, dynamic=dynamic)
        for bar, kind in enumerate(bars)
        for beat, limb, dynamic in _BARS[kind]
    ]
    tempo_map = TempoMap.build(
        tempi, [MeterChange(0, 3, 4)] + [MeterChange(bar * length, *_UNITS[name]) for bar, name in meters.items()]
    )
    plain = Score.from_notes(notes, tempo_map, len(bars) * length)
    marks = tuple(LoudnessMark(bar * length, sign) for bar, sign in sorted(signs.items()))
    return Score.from_array(plain.notes, tempo_map, plain.end_tick, "", marks)


@given(scores(), st.dictionaries(st.integers(0, 30), st.sampled_from("xy"), max_size=3))
def test_written_out_again_it_is_the_same(score: Score, sections: dict[int, str]) -> None:
    passages = folded(score, sections)
    written = played_bars(passages)
    assert len(written) == score.bar_count
    for played, bar in enumerate(written):
        one, other = score.bars(played, played), score.bars(bar, bar)
        assert one.notes.tobytes() == other.notes.tobytes()
        assert one.tempo_map == other.tempo_map
        assert _loud(one) == _loud(other)
        assert sections.get(played) in (None, sections.get(bar)), "a section's name stands where it begins"


def _loud(score: Score) -> list[tuple[int, str]]:
    """The marks of one bar, with the usual loudness where nothing is said."""
    marks = [(mark.tick, mark.sign) for mark in score.loudness]
    return marks if marks[:1] and marks[0][0] == 0 else [(0, "mf"), *marks]
