"""What is written as MIDI comes back: scores tick for tick, performances to half a tick of the file."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from station.core.events import Choke, Hit
from station.core.note_map import GENERAL_MIDI, V_DRUMS
from station.core.pieces import CYMBALS, Piece
from station.core.units import PPQ
from station.music.formats.smf.standard_midi import (
    performance_from_midi,
    read_midi,
    score_from_midi,
    write_performance,
    write_score,
)
from station.music.formats.smf.track_writer import PERFORMANCE_TICK_NS
from station.music.performance import Performance
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap

WRITTEN_TICK = PPQ // 26_880
"""The finest that a score file holds."""

written_ticks = st.integers(0, 64 * PPQ // WRITTEN_TICK).map(lambda tick: tick * WRITTEN_TICK)
numbers = st.sampled_from(sorted(set(GENERAL_MIDI) - {35}))
"""Every number that a writer uses: the two kicks are one piece, and 36 is written."""


def note_of(number: int, tick: int, velocity: int, lead_ms: float) -> Note:
    strike = GENERAL_MIDI[number]
    return Note(
        tick=tick,
        piece=strike.piece,
        zone=strike.zone,
        articulation=strike.articulation,
        openness=strike.openness,
        velocity=velocity,
        lead_ms=lead_ms,
    )


notes = st.builds(note_of, numbers, written_ticks, st.integers(1, 127), st.just(0.0))
tempo_maps = st.builds(
    TempoMap.build,
    st.lists(st.builds(TempoChange, written_ticks, st.integers(60_000, 6_000_000)), max_size=6),
    st.lists(
        st.builds(MeterChange, written_ticks, st.integers(1, 17), st.sampled_from([1, 2, 4, 8, 16, 32])), max_size=4
    ),
)


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("midi") / "written.mid"


def strokes(score: Score) -> list[tuple[int, Piece, int, int, int, float | None]]:
    return sorted((n.tick, n.piece, n.zone, n.articulation, n.velocity, n.openness) for n in score)


def one_of_each(written: list[Note]) -> list[Note]:
    """No two notes of one tick that mean the same strike: those are read as one."""
    return list({(n.tick, n.piece, n.zone, n.articulation, n.openness): n for n in written}.values())


@given(written=st.lists(notes, max_size=30).map(one_of_each), tempo_map=tempo_maps)
def test_a_score_comes_back_tick_for_tick(path: Path, written: list[Note], tempo_map: TempoMap) -> None:
    score = Score.from_notes(written, tempo_map, title="Round trip")
    write_score(score, path)
    again = score_from_midi(read_midi(path))
    assert strokes(again) == strokes(score)
    assert again.tempo_map == tempo_map
    assert (again.end_tick, again.title) == (score.end_tick, "Round trip")
    assert again.onset_ns.tolist() == score.onset_ns.tolist()


@given(
    written=st.lists(
        st.builds(note_of, numbers, written_ticks, st.integers(1, 127), st.sampled_from([0.0, 25.0, 60.0]))
    ),
    us_per_quarter=st.integers(150_000, 2_000_000),
)
def test_grace_strokes_sound_when_they_did(path: Path, written: list[Note], us_per_quarter: int) -> None:
    """To half a tick of ours and half a tick of the file, after the bar that may have been put before."""
    score = Score.from_notes(written, TempoMap.build([TempoChange(0, us_per_quarter)]))
    write_score(score, path)
    played = performance_from_midi(read_midi(path)).hits["at_ns"]
    bar_ns = int(score.tempo_map.ns_at(4 * PPQ))
    pickup_ns = bar_ns if np.any(score.onset_ns < 0) else 0
    half_ticks_ns = us_per_quarter * 1000 / 2 * (1 / 26_880 + 1 / PPQ)
    assert len(played) == len(score)
    assert (np.abs(np.sort(played) - pickup_ns - np.sort(score.onset_ns)) <= half_ticks_ns + 1).all()


@given(
    grabs=st.lists(st.integers(1, PPQ // WRITTEN_TICK - 1).map(lambda t: t * WRITTEN_TICK), min_size=1, max_size=8),
    piece=st.sampled_from(sorted(CYMBALS - {Piece.RIDE_2})),
)
def test_chokes_come_back(path: Path, grabs: list[int], piece: Piece) -> None:
    """A stroke every quarter, each choked before the next."""
    written = [Note(i * PPQ, piece, choke_ticks=grab) for i, grab in enumerate(grabs)]
    write_score(Score.from_notes(written, TempoMap()), path)
    assert score_from_midi(read_midi(path)).notes["choke_ticks"].tolist() == grabs


@given(opens=st.lists(st.integers(0, 127), min_size=1, max_size=20))
def test_openness_comes_back_to_the_controllers_step(path: Path, opens: list[int]) -> None:
    written = [Note(i * PPQ, Piece.HIHAT, openness=o / 127) for i, o in enumerate(opens)]
    write_score(Score.from_notes(written, TempoMap()), path)
    again = score_from_midi(read_midi(path)).notes["openness"]
    assert again.tolist() == pytest.approx([o / 127 for o in opens], abs=0.5 / 127)


# --- performances -----------------------------------------------------------------------------------------------------

times = st.integers(0, 3600 * 10**9)


def hit_of(number: int, at_ns: int, velocity: int, own_number: bool) -> Hit:
    strike = V_DRUMS[number]
    return Hit(
        at_ns=at_ns,
        piece=strike.piece,
        zone=strike.zone,
        articulation=strike.articulation,
        openness=strike.openness,
        velocity=velocity,
        midi_note=number if own_number else 0,
    )


v_drums_hits = st.builds(hit_of, st.sampled_from(sorted(V_DRUMS)), times, st.integers(1, 127), st.just(True))
any_hits = st.builds(hit_of, st.sampled_from(sorted(V_DRUMS)), times, st.integers(1, 127), st.booleans())


def kinds(performance: Performance) -> list[tuple[int, int]]:
    return sorted((h.piece, h.velocity) for h in performance)


@given(hits=st.lists(v_drums_hits, max_size=30))
def test_hits_of_a_known_kit_come_back_whole(path: Path, hits: list[Hit]) -> None:
    performance = Performance.from_hits(hits)
    write_performance(performance, path)
    again = performance_from_midi(read_midi(path))
    assert (np.abs(again.hits["at_ns"] - performance.hits["at_ns"]) <= PERFORMANCE_TICK_NS // 2).all()

    def seen(played: Performance) -> list[tuple[int, ...]]:
        return sorted((h.piece, h.zone, h.articulation, h.velocity, h.midi_note) for h in played)

    assert seen(again) == seen(performance)


@given(hits=st.lists(any_hits, max_size=30))
def test_any_hits_keep_their_time_piece_and_velocity(path: Path, hits: list[Hit]) -> None:
    performance = Performance.from_hits(hits)
    write_performance(performance, path)
    again = performance_from_midi(read_midi(path))
    assert (np.abs(again.hits["at_ns"] - performance.hits["at_ns"]) <= PERFORMANCE_TICK_NS // 2).all()
    assert kinds(again) == kinds(performance)


@given(hits=st.lists(any_hits, min_size=1, max_size=10), by_ns=st.integers(-(10**9), 10**9))
def test_shifting_all_hits_only_shifts_them(path: Path, hits: list[Hit], by_ns: int) -> None:
    performance = Performance.from_hits(hits).shifted(by_ns)
    write_performance(performance, path)
    start_ns = min(int(performance.hits["at_ns"].min()), 0)
    again = performance_from_midi(read_midi(path)).hits["at_ns"]
    assert (np.abs(again - (performance.hits["at_ns"] - start_ns)) <= PERFORMANCE_TICK_NS // 2).all()


@given(at=st.lists(times, unique=True, max_size=6), piece=st.sampled_from(sorted(CYMBALS)))
def test_chokes_of_a_performance_come_back(path: Path, at: list[int], piece: Piece) -> None:
    performance = Performance.from_hits([], [Choke(ns, piece) for ns in at])
    write_performance(performance, path)
    again = performance_from_midi(read_midi(path)).chokes
    assert again["piece"].tolist() == performance.chokes["piece"].tolist()
    assert (np.abs(again["at_ns"] - performance.chokes["at_ns"]) <= PERFORMANCE_TICK_NS // 2).all()
