"""The benchmark's player scatters as HUMANS says, does what its sheet says, and its oracle finds what it should."""

from dataclasses import replace

import numpy as np
import pytest

from station.bench.rigs.planted.planted_faults import FAULTS
from station.bench.rigs.planted.planted_music import Music, lesson
from station.bench.rigs.planted.planted_oracle import Z_FALSE_ALARM, smallest_share, timing_precision
from station.bench.rigs.planted.planted_player import Conditions, Sheet, play, strokes_played
from station.bench.rigs.planted.planted_routes import left_out_bars, repeated_bars, sounds_as_repeated, stopped
from station.bench.rigs.planted.planted_stage import Planted, Stage
from station.bench.rigs.planted.planted_strokes import Floats, Written, level_db
from station.core.pieces import Limb, Piece
from station.core.units import NS_PER_S, PPQ
from station.music.score import Note, Score
from station.music.tempo import TempoMap

CLICK = Conditions(20.0, clocked=True)


def of_lesson(name: str, conditions: Conditions = CLICK) -> Stage:
    return Stage(Written(lesson(name)), conditions)


def planted(name: str, on: Stage) -> Planted:
    fault = FAULTS[name](on)
    assert fault is not None
    return fault


def late_ms(on: Stage, seed: int, fault: Planted | None = None) -> Floats:
    """How much later than written each stroke of a take without omissions comes, (n,) in the score's order."""
    rng = np.random.default_rng(seed)
    sheet = Sheet.as_written(on.written)
    sheet = replace(sheet, left_out=np.zeros_like(sheet.left_out))
    row, at_s, later_ms = strokes_played(on.written, fault.plant(sheet, rng) if fault else sheet, on.conditions, rng)
    in_order = np.argsort(row)
    return np.asarray(((at_s - on.written.time_s[row]) * 1000 + later_ms)[in_order], np.float64)


def eighths(bars: int) -> Written:
    """Kick and hi-hat together on every eighth."""
    notes = [Note(k * PPQ // 2, piece) for k in range(8 * bars) for piece in (Piece.KICK, Piece.HIHAT)]
    return Written(Music("eighths", Score.from_notes(notes, TempoMap.constant(100))))


def test_scatter_correlation_and_gap_are_those_of_humans() -> None:
    played = late_ms(Stage(eighths(1000), CLICK), 1).reshape(-1, 2)
    lean = played.mean(axis=0)
    noise = played - lean
    assert noise.std() == pytest.approx(20, rel=0.03)
    assert np.corrcoef(noise[1:, 0], noise[:-1, 0])[0, 1] == pytest.approx(0.3, abs=0.03)
    assert (noise[:, 0] - noise[:, 1]).std() / 20 == pytest.approx(17 / 27, rel=0.05)  # HUMANS: 15–20 of 26–28 ms
    assert np.all(np.abs(lean + 8) < 25)


def test_a_late_kick_is_late_by_its_size_and_nothing_else_is() -> None:
    on = of_lesson("rock-3")
    fault = planted("late_kick", on)
    difference = late_ms(on, 5, fault) - late_ms(on, 5)
    kick = on.written.piece(Piece.KICK)
    assert difference[kick] == pytest.approx(fault.size)
    assert difference[~kick] == pytest.approx(0)
    assert 25 <= fault.size <= 50


@pytest.mark.parametrize(
    ("name", "fault", "clocked"),
    [("rock-1", "late_kick", True), ("rock-1", "early_snare", False), ("rock-fill-2", "fill_lands_late", False)],
)
def test_the_oracle_finds_its_size_in_99_of_100_takes_and_is_right_about_its_errors(
    name: str, fault: str, clocked: bool
) -> None:
    on = of_lesson(name, Conditions(20.0, clocked=clocked))
    main, what = on.written.main, planted(fault, on)
    precision, shape = timing_precision(on.written, on.conditions), on.shapes["time"][fault][main]
    error = np.sqrt(shape @ precision @ shape)
    mean_ms = -8.0 if clocked else 0.0
    faulty = [float(shape @ precision @ (late_ms(on, k, what)[main] - mean_ms) / error) for k in range(100)]
    calm = [float(shape @ precision @ (late_ms(on, k)[main] - mean_ms) / error) for k in range(100, 200)]
    assert np.mean(np.array(faulty) > Z_FALSE_ALARM) >= 0.96  # 99 % expected of 100
    assert 0.75 < np.std(calm) < 1.3
    assert np.max(calm) < Z_FALSE_ALARM


def test_a_limb_that_scatters_has_its_size_in_all() -> None:
    on = Stage(eighths(400), Conditions(10.0, clocked=True))
    notes = on.written.score.notes.copy()
    notes["limb"] = np.where(notes["piece"] == Piece.KICK, Limb.RIGHT_FOOT, Limb.RIGHT_HAND)
    on = Stage(Written(Music("limbs", replace(on.written.score, notes=notes))), on.conditions)
    played = late_ms(on, 3, planted("unsteady_right_foot", on))
    assert played[on.written.limb(Limb.RIGHT_FOOT)].std() == pytest.approx(30, rel=0.06)
    assert played[on.written.limb(Limb.RIGHT_HAND)].std() == pytest.approx(10, rel=0.06)


def test_a_tempo_that_rushes_gains_four_percent_in_eight_bars() -> None:
    on = Stage(eighths(16), Conditions(10.0, clocked=False))
    fault = planted("rushing", on)
    assert fault.size == 4.0
    gains = []
    for seed in range(60):
        faster = np.diff(late_ms(on, seed, fault)[::2]) - np.diff(late_ms(on, seed)[::2])
        gains.append(-faster[-8:].mean() / 300)  # an eighth at 100 bpm, in ms
    assert np.mean(gains) == pytest.approx(0.08 / 1.08, rel=0.15)  # sixteen bars


def test_levels_scatter_by_eight_percent_and_a_weak_hand_is_weaker() -> None:
    on = of_lesson("single-paradiddle")
    fault, rng = planted("weak_left", on), np.random.default_rng(2)
    sheet = replace(Sheet.as_written(on.written), left_out=np.zeros(len(on.written.score)), added=0.0)
    hits = play(on.written, sheet, Conditions(1.0, clocked=True), rng).hits
    tap = on.written.score.notes["velocity"] == on.written.score.notes["velocity"].min()
    assert hits["velocity"][tap].std() / hits["velocity"][tap].mean() == pytest.approx(0.08, abs=0.02)
    weak = play(on.written, fault.plant(sheet, rng), Conditions(1.0, clocked=True), rng).hits
    difference = level_db(weak["velocity"]) - level_db(hits["velocity"])
    hands = [difference[on.written.limb(hand)].mean() for hand in (Limb.LEFT_HAND, Limb.RIGHT_HAND)]
    assert hands[0] - hands[1] == pytest.approx(-fault.size, abs=0.6)


def test_a_quarter_of_the_hats_is_open_that_should_be_closed() -> None:
    on = of_lesson("rock-1")
    hits = play(
        on.written,
        planted("open_hats", on).plant(Sheet.as_written(on.written), np.random.default_rng(1)),
        CLICK,
        np.random.default_rng(2),
    ).hits
    hats = hits["openness"][hits["piece"] == Piece.HIHAT]
    assert np.mean(hats > 0.5) == pytest.approx(0.25, abs=0.04)


def test_who_stops_begins_the_pass_again_on_the_click() -> None:
    on = of_lesson("rock-1")  # passes of two bars of three seconds
    sheet = stopped(on.written, True, Sheet.as_written(on.written), np.random.default_rng(0))
    assert sheet is not None
    before, after = sheet.runs
    assert after.from_s % 6 == pytest.approx(0)
    assert after.at_s % 3 == pytest.approx(0)
    assert 3 <= after.at_s - before.until_s <= 6
    assert after.at_s + after.until_s - after.from_s == pytest.approx(16 * 3)


def test_a_bar_left_out_is_planted_only_where_bars_differ() -> None:
    sheet, rng = Sheet.as_written, np.random.default_rng(0)
    alike, unlike = Written(lesson("single-paradiddle")), Written(lesson("rock-fill-1"))
    for route in (left_out_bars, repeated_bars):
        assert route(alike, True, sheet(alike), rng) is None
        assert route(unlike, True, sheet(unlike), rng) is not None


def test_in_a_loop_of_two_bars_one_left_out_sounds_like_one_repeated() -> None:
    assert sounds_as_repeated(Written(lesson("rock-1")))
    assert not sounds_as_repeated(Written(lesson("rock-fill-1")))


def test_a_tenth_left_out_is_told_from_two_percent_by_220_strokes() -> None:
    # by hand: .02 + 3.48·√(.02·.98/n) + 2.33·√(.1·.9/n) = .1 gives n = (0.487 + 0.699)²/.08² = 220
    assert smallest_share(230, 0.02) < 0.101 < smallest_share(200, 0.02)


def test_a_take_begins_with_its_first_bar_and_lasts_as_long_as_the_music() -> None:
    on = of_lesson("rock-1")
    at_ns = play(on.written, Sheet.as_written(on.written), CLICK, np.random.default_rng(4)).hits["at_ns"]
    assert abs(at_ns[0]) < 0.5 * NS_PER_S
    assert abs(int(at_ns[-1]) - on.written.score.length_ns) < NS_PER_S
