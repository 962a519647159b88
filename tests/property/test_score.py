"""What must hold for any score."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from station.core.pieces import Dynamic, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap

SPAN = 32 * PPQ

notes = st.builds(
    Note,
    tick=st.integers(0, SPAN),
    piece=st.sampled_from(Piece),
    zone=st.sampled_from(Zone),
    velocity=st.integers(1, 127),
    dynamic=st.sampled_from(Dynamic),
    limb=st.sampled_from(Limb),
    openness=st.none() | st.floats(0, 1, width=32),
    ornament=st.sampled_from(Ornament),
    lead_ms=st.sampled_from([0.0, 0.0, 0.0, 25.5, 60.0]),
    choke_ticks=st.integers(0, PPQ),
    midi_note=st.integers(0, 127),
)
tempo_maps = st.builds(
    TempoMap.build,
    st.lists(st.builds(TempoChange, st.integers(0, SPAN), st.integers(200_000, 1_500_000)), max_size=4),
    st.lists(st.builds(MeterChange, st.integers(0, SPAN), st.integers(1, 7), st.sampled_from([4, 8])), max_size=3),
)
scores = st.builds(Score.from_notes, st.lists(notes, max_size=20), tempo_maps)


@given(st.lists(notes, max_size=20), tempo_maps, st.data())
def test_any_order_of_writing_gives_the_same_strokes(
    written: list[Note], tempo_map: TempoMap, data: st.DataObject
) -> None:
    score = Score.from_notes(data.draw(st.permutations(written)), tempo_map)
    assert sorted(map(repr, score)) == sorted(map(repr, written))
    order = [(n.tick, -n.lead_ms, n.piece) for n in score]
    assert order == sorted(order)


@given(scores)
def test_all_bars_together_are_the_score(score: Score) -> None:
    """Cut into single bars and joined again, every stroke sounds when it did (a rounding a bar allowed)."""
    again = Score.joined([score.bars(bar, bar) for bar in range(score.bar_count)])
    assert sorted(map(repr, again)) == sorted(map(repr, score))
    assert (np.abs(np.sort(again.onset_ns) - np.sort(score.onset_ns)) <= 1).all()
    assert again.bar_count == score.bar_count
    assert again.end_tick == score.end_tick


@given(scores)
def test_every_stroke_lies_in_its_bar(score: Score) -> None:
    for note, bar in zip(score, score.bar.tolist(), strict=True):
        assert score.tempo_map.bar_start(bar) <= note.tick < score.tempo_map.bar_start(bar + 1)
    assert not len(score) or score.bar.max() == score.bar_count - 1


@given(scores, st.integers(1, 4))
def test_a_repeat_is_the_same_music_later(score: Score, times: int) -> None:
    repeated = score.repeated(times)
    assert len(repeated) == times * len(score)
    assert repeated.bar_count == times * score.bar_count
    for again in range(times):
        of_this = repeated.bars(again * score.bar_count, (again + 1) * score.bar_count - 1)
        assert list(map(repr, of_this)) == list(map(repr, score))
        assert of_this.onset_ns.tolist() == score.onset_ns.tolist()


@given(scores, st.floats(0.3, 3))
def test_speed_changes_every_distance_alike(score: Score, factor: float) -> None:
    """Within half a microsecond a quarter note, to which tempos are rounded."""
    quick = score.at_speed(factor)
    beats = score.notes["tick"] / PPQ
    leads = np.rint(score.notes["lead_ms"].astype(np.float64) * 1e6)
    expected = (score.onset_ns + leads) / factor - leads
    assert (np.abs(quick.onset_ns - expected) <= 500 * beats + 2).all()
