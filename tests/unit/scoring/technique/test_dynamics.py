"""Contrast, evenness, own levels and crescendos: by hand and with planted shapes."""

import numpy as np
import pytest

from station.core.pieces import Dynamic, Limb, Piece, Zone
from station.core.units import PPQ
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.scoring.analysis.habits import habits
from station.scoring.analysis.loudness import level_db
from station.scoring.analysis.technique.dynamics import PadDynamics, crescendo_runs, pad_dynamics
from tests.fakes.answers import Played, take
from tests.fakes.scores import rock_beat

SNARE = Piece.SNARE


def of(score: Score, how: Played) -> PadDynamics:
    played = take(score, how)
    found = habits(score, played.performance, played.alignment, hears_velocity=True)
    return pad_dynamics(score, played.performance, played.alignment, found.effects.get("left_level"))


def accents(bars: int) -> Score:
    """Quarters on the snare, the first of each bar accented: 112 against 80."""
    notes = [
        Note(
            i * PPQ, SNARE, velocity=112 if i % 4 == 0 else 80, dynamic=Dynamic.ACCENT if i % 4 == 0 else Dynamic.NORMAL
        )
        for i in range(4 * bars)
    ]
    return Score.from_notes(notes, TempoMap.constant(120))


def db(loud: float, soft: float) -> float:
    return float(40 * np.log10(loud / soft))


def test_contrast_by_hand() -> None:
    """100.5 against 80 is 40·log10(1.256) = 4.0 dB where 40·log10(1.4) = 5.8 are written; exact playing, no width."""
    score = accents(8)
    found = of(score, Played(velocity=np.where(score.notes["dynamic"] == Dynamic.ACCENT, 100.5, 80)))
    (contrast,) = found.contrasts
    assert (contrast.piece, contrast.loud, contrast.soft) == (SNARE, Dynamic.ACCENT, Dynamic.NORMAL)
    assert contrast.played_db == pytest.approx(db(100.5, 80))
    assert contrast.written_db == pytest.approx(db(112, 80))
    assert contrast.ci == pytest.approx((db(100.5, 80), db(100.5, 80)))


def test_contrast_is_against_the_players_own_level() -> None:
    """A player at 0.7 of everything has the written contrast, but for rounding to whole velocities."""
    score = accents(8)
    found = of(score, Played(velocity=np.rint(0.7 * score.notes["velocity"])))
    assert found.contrasts[0].played_db == pytest.approx(db(78, 56))
    assert found.own[SNARE][Dynamic.NORMAL].mean == pytest.approx(float(level_db(np.array([56]))[0]))


def test_few_strokes_have_a_contrast_without_interval() -> None:
    assert of(accents(3), Played()).contrasts[0].ci is None


def test_unmarked_bars_ask_for_no_contrast() -> None:
    notes = [Note(i * PPQ, SNARE) for i in range(16)]
    assert of(Score.from_notes(notes, TempoMap.constant(120)), Played()).contrasts == ()


def test_the_balance_of_the_hands_by_hand() -> None:
    """Singles right left, the left at 64 where the right has 80: 40·log10(0.8) = −3.9 dB, give or take 0.5."""
    limbs = (Limb.RIGHT_HAND, Limb.LEFT_HAND)
    notes = [Note(i * PPQ // 4, SNARE, limb=limbs[i % 2]) for i in range(64)]
    score = Score.from_notes(notes, TempoMap.constant(100))
    velocity = np.tile([80, 64], 32) + np.random.default_rng(1).integers(-3, 4, 64)
    balance = of(score, Played(velocity=velocity)).left_less_right
    assert balance is not None
    assert balance.louder_db == pytest.approx(db(64, 80), abs=0.5)
    assert balance.ci[0] < db(64, 80) < balance.ci[1]
    assert of(accents(8), Played()).left_less_right is None


def hats(bars: int) -> Score:
    notes = [Note(i * PPQ // 2, Piece.HIHAT, Zone.BOW, 80, openness=0.0) for i in range(8 * bars)]
    return Score.from_notes(notes, TempoMap.constant(120))


def test_shaping_a_repeated_hat_is_free() -> None:
    """Strong–weak throughout, 100 and 60: no unevenness at all, no fault, full points."""
    found = of(hats(8), Played(velocity=np.tile([100, 60], 32)))
    assert found.evenness_db.sd == pytest.approx(0.0, abs=1e-9)


def test_evenness_by_hand() -> None:
    """Every other bar 80 and 100: half of 40·log10(1.25) = 1.94 dB beside its place's mean; eight places of 8 bars.

    Pooled variance = 1.94²·8/7.
    """
    found = of(hats(8), Played(velocity=np.tile(np.repeat([80, 100], 8), 4)))
    assert found.evenness_db.sd == pytest.approx(db(100, 80) / 2 * (8 / 7) ** 0.5)


def rising(first: int = 40, last: int = 110, strokes: int = 15) -> Score:
    notes = [Note(i * PPQ, SNARE, velocity=round(v)) for i, v in enumerate(np.geomspace(first, last, strokes))]
    return Score.from_notes(notes, TempoMap.constant(120))


def test_what_a_crescendo_is() -> None:
    assert [len(run) for run in crescendo_runs(rising())] == [15]
    assert [len(run) for run in crescendo_runs(rising(110, 40))] == [15]
    assert crescendo_runs(rising(70, 80)) == []
    assert crescendo_runs(rising(strokes=5)) == []
    assert crescendo_runs(rock_beat(4)) == []
    both = Score.joined([rising(strokes=16), rising(110, 40, 16)])
    assert [len(run) for run in crescendo_runs(both)] == [16, 16]


def test_half_a_crescendo_by_hand() -> None:
    """Played from 60 to 60·√2.75 = 99.5 at even steps in dB: half of the written rise of 40·log10(2.75) = 17.6 dB."""
    found = of(rising(), Played(velocity=np.rint(np.geomspace(60, 60 * 2.75**0.5, 15))))
    (crescendo,) = found.crescendos
    assert (crescendo.piece, crescendo.bars, crescendo.strokes) == (SNARE, (0, 3), 15)
    assert crescendo.written_db == pytest.approx(db(110, 40))
    assert crescendo.played_db == pytest.approx(db(110, 40) / 2, abs=0.2)
    assert crescendo.ci is not None
    assert crescendo.ci[0] < crescendo.played_db < crescendo.ci[1]  # type: ignore[operator] # it was told above
    assert crescendo.bend_db == pytest.approx(0.0, abs=0.3)


def test_a_crescendo_that_comes_late_bends_down() -> None:
    """Ten strokes at 40, then 110 at once: the written middle third lies far above what is played."""
    found = of(rising(), Played(velocity=np.repeat([40, 110], [10, 5])))
    bend = found.crescendos[0].bend_db
    level = level_db(rising().notes["velocity"])
    played = level_db(np.repeat([40, 110], [10, 5]))
    off = played - level
    assert bend is not None
    assert bend == pytest.approx(float(off[5:10].mean() - (off[:5].mean() + off[10:].mean()) / 2))
    assert bend < -3


def test_a_diminuendo_played_level_is_told() -> None:
    found = of(rising(110, 40), Played(velocity=80))
    assert found.crescendos[0].played_db == pytest.approx(0.0, abs=1e-9)
    assert found.crescendos[0].written_db == pytest.approx(db(40, 110))


def test_a_crescendo_of_which_little_was_heard_is_not_told() -> None:
    found = of(rising(), Played(left_out=tuple(range(3, 15))))
    assert (found.crescendos[0].strokes, found.crescendos[0].played_db, found.crescendos[0].ci) == (3, None, None)
