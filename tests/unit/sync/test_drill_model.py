"""What the model of a drill holds, and for what there is none."""

import pickle
from dataclasses import replace

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.pieces import Piece
from station.drills.library import find_lesson
from station.motion.kinematics.figure import figure_of
from station.motion.kit.kit import load_kit
from station.motion.style.style import Style
from station.music.score import Score
from station.sync.drill.drill_model import HANDS
from station.sync.drill.drummed_model import Demonstrated, drill_model, low_passed
from tests.unit.sync.drummed_sticks import model_of

PLAYED = Demonstrated(load_kit(), figure_of(), Style())


def test_sixteen_centres_and_more_for_each_stroke_of_the_busiest_hand() -> None:
    model = model_of("single-paradiddle")
    strokes = max(int(np.count_nonzero(model.limb == hand)) for hand in HANDS)
    assert strokes == 8
    assert model.centre_count * model.repeats >= 16 * strokes
    assert all(each.centre_count == model.centre_count for each in model.models)


def test_it_crosses_a_pipe_in_less_than_a_megabyte() -> None:
    assert len(pickle.dumps(model_of("single-paradiddle"))) < 1e6


def test_a_stroke_shows_where_it_is_written() -> None:
    """About each stroke of the right hand its stick's rate turns round: it falls before, and rises after."""
    model = model_of("single-paradiddle")
    table = model.table().values[model.tempi.index(1.0), :, 4] * model.scale[4] + model.mean[4]
    cycle = model.onset_s[model.limb == HANDS[0]]
    for onset in cycle[cycle < model.cycle_s - 1e-6]:
        at = onset / model.cycle_s * model.centre_count
        before, after = (table[round(at + step) % len(table)] for step in (-1, 1))
        assert before > 0 > after


def test_feet_alone_have_no_phase_for_sticks() -> None:
    score = find_lesson("rock-1").score
    feet = Score.from_array(score.notes[score.notes["piece"] == Piece.KICK], score.tempo_map)
    with pytest.raises(BadInput, match="no hand plays"):
        drill_model(feet, PLAYED)


def test_what_is_too_long_to_be_told_apart_is_refused() -> None:
    """Nine bars of the same are one bar; with a stroke less in the first they are nine, 72 strokes of a hand."""
    score = find_lesson("single-paradiddle").score.repeated(9)
    with pytest.raises(BadInput, match="too long"):
        drill_model(Score.from_array(score.notes[1:], score.tempo_map), PLAYED)


def test_the_low_pass_keeps_what_is_slow_and_delays_nothing() -> None:
    slow = np.sin(2 * np.pi * np.arange(2000) / 1000)[:, None]
    spare = int(np.ceil(4 * 12.0))
    assert np.abs(low_passed(slow, 12.0) - slow[spare:-spare]).max() < 0.005
    spike = np.zeros((201, 1))
    spike[100] = 1
    assert np.argmax(low_passed(spike, 5.0)) == 100 - 20


def test_a_style_that_waves_its_sticks_about_is_watched_without_that() -> None:
    shown = replace(PLAYED, style=replace(Style(), flourish=100.0))
    table = drill_model(find_lesson("rock-1").score, shown).table().values
    assert np.abs(table - model_of("rock-1").table().values).max() < 1e-6
