"""A song as a session: the track of the bars that are practised, and the click that follows the band."""

from pathlib import Path

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.pieces import Piece
from station.devices.capture.replay import LoggedText
from station.drills.band_sound import BandSound
from station.drills.library import find_lesson
from station.drills.songs.song_lesson import read_song_lesson
from station.music.score import Score
from station.music.tempo_words import read_tempo_words
from station.practice.headless.virtual_session import practise_virtually
from station.practice.session.backing_track import LEAD_S, RING_S, BackingRequest, song_request
from station.practice.session.event_log import Tracked, said_in, text_of
from station.practice.session.plan import Plan, PlanOptions, plan_practice
from station.render.notation.page.sheet import line_words
from station.scenes.sheets import lesson_labels
from station.simulation.student_spec import parse_spec
from tests.fakes.song_files import write_song

TIMES_S = np.round(0.8 + np.cumsum(0.5 + 0.03 * np.sin(np.arange(33))), 4)
"""A band that wavers by 6 %: 32 quarters and the end."""


def plan(folder: Path, options: PlanOptions) -> Plan:
    top = f"quarters_s = [{', '.join(map(str, TIMES_S))}]"
    return plan_practice(read_song_lesson(write_song(folder, top=top)), options)


def asked(request: BackingRequest | None) -> BackingRequest:
    assert request is not None
    return request


def test_the_bars_that_are_practised_loop_as_they_are_in_the_file(tmp_path: Path) -> None:
    laid = plan(tmp_path, PlanOptions(bars=(3, 4), loops=4))
    request = asked(song_request(laid))
    begin_s, end_s = TIMES_S[8], TIMES_S[16]
    assert request.start_s == pytest.approx(begin_s, abs=1e-5)
    assert request.loop_s == pytest.approx((begin_s, end_s), abs=1e-5)
    assert request.turns == 4
    assert request.piece_s == pytest.approx((begin_s - LEAD_S, end_s + RING_S), abs=1e-5)


def test_the_track_is_as_much_slower_as_the_practice_and_each_stroke_on_its_beat(tmp_path: Path) -> None:
    own = plan(tmp_path, PlanOptions()).lesson.tempo_bpm
    laid = plan(tmp_path, PlanOptions(tempo_bpm=0.6 * own, bars=(3, 4), loops=3))
    track = asked(song_request(laid)).track(laid, 48_000)
    assert track.speed == pytest.approx(0.6)
    once_s = (TIMES_S[8:17] - TIMES_S[8]) / 0.6
    expected = np.concatenate([once_s[:-1] + turn * once_s[-1] for turn in range(3)])
    assert np.abs(laid.score.onset_s - expected).max() < 1e-4
    clicks_s = (np.sort(laid.cues["at_ns"]) - laid.passes_start_ns)[-24:] / 1e9
    assert np.abs(clicks_s - expected).max() < 1e-4


def test_a_song_that_is_played_once_rings_out(tmp_path: Path) -> None:
    laid = plan(tmp_path, PlanOptions())
    assert laid.passes == 1
    assert asked(song_request(laid)).loop_s is None


def test_without_a_click_the_band_still_keeps_the_time(tmp_path: Path) -> None:
    laid = plan(tmp_path, PlanOptions(click=None, bars=(1, 2), loops=2))
    assert laid.click is not None
    assert not (laid.cues["at_ns"] >= laid.passes_start_ns).any()
    assert (laid.cues["at_ns"] < laid.passes_start_ns).sum() == 4  # the count-in is heard


def test_drums_are_left_out_where_they_have_stems_of_their_own() -> None:
    bass, drums = Path("bass.ogg"), Path("drums.ogg")
    assert BandSound((bass,), 0.0, (drums,)).files(with_drums=True) == (bass, drums)
    assert BandSound((bass,), 0.0, (drums,)).files(with_drums=False) == (bass,)


def test_in_a_mix_the_strokes_of_the_part_are_turned_down(tmp_path: Path) -> None:
    laid = plan(tmp_path, PlanOptions(bars=(3, 4), loops=2))
    assert asked(song_request(laid)).softer == ()
    softer = asked(song_request(laid, with_drums=False)).softer
    begin_s, end_s = TIMES_S[8] - LEAD_S, TIMES_S[16] + RING_S
    assert [at_s for at_s, _ in softer] == pytest.approx([t for t in TIMES_S[:-1] if begin_s <= t < end_s], abs=1e-4)
    assert {piece for _, piece in softer} == {Piece.KICK}


def test_a_lesson_without_a_band_asks_for_no_track() -> None:
    assert song_request(plan_practice(find_lesson("rock-1"), PlanOptions())) is None


def test_a_song_slower_than_stretching_reaches_is_refused(tmp_path: Path) -> None:
    laid = plan(tmp_path, PlanOptions(tempo_bpm=40.0))
    with pytest.raises(BadInput, match="of its own speed"):
        asked(song_request(laid)).check(laid, 48_000)


def test_a_student_is_judged_by_the_bands_time(tmp_path: Path) -> None:
    """They lie 12 ms behind a band that wavers by 6 %, at 60 %."""
    own = plan(tmp_path, PlanOptions()).lesson.tempo_bpm
    laid = plan(tmp_path, PlanOptions(tempo_bpm=0.6 * own, bars=(2, 5), loops=4))
    virtual = practise_virtually(laid, parse_spec("seed=3,bias_ms=12,sd_ms=4"))
    asynchrony_ms = virtual.result.alignment.asynchrony_ns / 1e6
    assert len(asynchrony_ms) == 64
    assert np.mean(asynchrony_ms) == pytest.approx(12.0, abs=2.0)


def test_nobody_reads_how_the_band_s_tempo_wavers(tmp_path: Path) -> None:
    """One tempo stands over the song, its mean: 33 beats of 0.5 s and what a sine has over."""
    laid = plan(tmp_path, PlanOptions(tempo_bpm=90.0, bars=(3, 4), loops=3))
    joined = Score.joined([laid.section, laid.score.bars(0, 1)])
    for score in (laid.lesson.played_once, laid.score, laid.section, joined):
        assert len(score.tempo_map.tempos) > 4
        assert read_tempo_words(score.tempo_map) == []
    words = line_words(laid.lesson.played_once, lesson_labels(laid.lesson, (0, 7)), {})
    (told,) = [word.tempo.beats_a_minute for bar in words.values() for _, word in bar if word.tempo is not None]
    assert told == round(60 * 32 / (TIMES_S[-1] - TIMES_S[0]))
    assert not any(word.ramp for bar in words.values() for _, word in bar)


def test_a_capture_of_a_song_is_read_without_them_too(tmp_path: Path) -> None:
    laid = plan(tmp_path, PlanOptions(bars=(3, 4), loops=2))
    said = said_in(LoggedText(0, text_of(Tracked(laid.section))))
    assert isinstance(said, Tracked)
    assert said.section.tempo_map == laid.section.tempo_map
    assert read_tempo_words(said.section.tempo_map) == []
