from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.pieces import Piece
from station.motion.drummer import Drummer
from station.motion.style.proposal import propose_style
from station.motion.style.style import MOST, NUMBERS, Style, bent, checked, range_of
from station.motion.style.style_file import SLOTS, Slots, load_style, save_style, style_names
from tests.unit.motion.patterns import ROCK, score_of

TABLE_5_2 = ("subdued", "crisp", "dramatic", "smooth", "sweeping")
GENRES = ("jazz", "blues", "latin", "funk", "rock")


def test_the_natural_drummer_multiplies_nothing() -> None:
    style = Style()
    for kind in ("amplitude", "frequency"):
        for joint in ("wrist", "elbow", "shoulder"):
            assert style.joint_factor(kind, joint, 1.0) == pytest.approx(1.0)


def test_a_gain_goes_with_its_share_and_never_passes_the_most() -> None:
    assert Style(amplitude_gain=25).joint_factor("amplitude", "wrist", 1.0) == pytest.approx(0.5)
    assert Style(amplitude_gain=0).joint_factor("amplitude", "wrist", 1.0) == pytest.approx(0.0)
    loud = Style(amplitude_gain=100, amplitude_wrist=100).joint_factor("amplitude", "wrist", 1.0)
    assert 2.0 < loud < MOST


def test_the_bend_is_smooth_and_rises_over_the_whole_range() -> None:
    x = np.linspace(0, 10, 1001)
    y = bent(x)
    assert (np.diff(y) > 0).all()
    assert np.abs(np.diff(y, 2)).max() < 1e-4 * 2


def test_one_share_moves_and_the_others_keep_their_ratio() -> None:
    """Thesis § 4.1.1: a change by A changes the other two by −A in all, their ratio kept."""
    style = Style(amplitude_wrist=40, amplitude_elbow=40, amplitude_shoulder=20).with_share("amplitude", "wrist", 70)
    assert style.amplitude_wrist == pytest.approx(70)
    assert style.amplitude_elbow == pytest.approx(20)
    assert style.amplitude_shoulder == pytest.approx(10)


def test_from_a_full_share_the_others_come_back_evenly() -> None:
    full = Style().with_share("frequency", "elbow", 100)
    back = full.with_share("frequency", "elbow", 40)
    assert (back.frequency_wrist, back.frequency_shoulder) == pytest.approx((30, 30))


def test_automation_is_read_by_straight_lines() -> None:
    style = Style(automation={"amplitude_gain": ((1.0, 20.0), (5.0, 60.0))})
    assert style.value("amplitude_gain", np.array([1.0, 3.0, 5.0, 9.0])).tolist() == pytest.approx([20, 40, 60, 60])
    assert style.value("amplitude_back", np.array([1.0, 3.0])).tolist() == [50.0, 50.0]


def test_automated_phrases_are_played_differently() -> None:
    """Four bars of quarters on the snare: small in the first bar, large in the last."""
    score = score_of([(4 * i, Piece.SNARE) for i in range(16)], tempo_bpm=60, velocity=100)
    points = ((1.0, 15.0), (2.0, 15.0), (4.0, 80.0))
    drummer = Drummer(score, style=Style(automation={"amplitude_gain": points}))
    plain = Drummer(score)
    first, last = (heights(drummer, t) / heights(plain, t) for t in (2.0, 14.0))
    assert first < 0.5
    assert last > 1.2


def heights(drummer: Drummer, strike_s: float) -> float:
    at = np.linspace(strike_s - 0.5, strike_s, 200)
    tips = np.stack([drummer.pose(t).tip_m for t in at.tolist()])
    return float(np.ptp(tips[:, :, 2], axis=0).max())


def test_a_single_piece_can_be_played_larger() -> None:
    score = score_of([(0, Piece.SNARE), (8, Piece.SNARE)], tempo_bpm=60)
    small, natural = (Drummer(score, style=Style(pieces=p)) for p in ({Piece.SNARE: 20.0}, {}))
    assert heights(small, 2.0) < 0.6 * heights(natural, 2.0)


@pytest.mark.parametrize("name", style_names())
def test_every_shipped_style_loads_is_legal_and_draws(name: str) -> None:
    style = checked(load_style(name))
    pose = Drummer(score_of(ROCK), style=style).pose(1.1)
    assert np.isfinite(pose.row).all()


def test_the_five_settings_and_the_five_genres_are_there() -> None:
    assert set(TABLE_5_2) | set(GENRES) <= set(style_names())


def test_the_settings_are_what_table_5_2_says() -> None:
    subdued, crisp, dramatic, smooth, sweeping = (load_style(name) for name in TABLE_5_2)
    assert max(subdued.amplitude_gain, subdued.amplitude_neck) < 50
    assert crisp.amplitude_wrist == max(s.amplitude_wrist for s in (subdued, crisp, dramatic, smooth, sweeping))
    assert min(crisp.frequency_gain, dramatic.frequency_gain) > 70  # the snap
    assert dramatic.amplitude_neck > 80
    assert sweeping.amplitude_neck < 50
    assert smooth.amplitude_back < 20
    assert sweeping.amplitude_back > 80


def test_the_genres_differ_as_the_users_set_them() -> None:
    """Thesis § 5.3.5: the jazz score got the least back, neck and elbow, the funk score the most."""
    styles = {name: load_style(name) for name in GENRES}
    for control in ("amplitude_back", "amplitude_neck"):
        order = sorted(GENRES, key=lambda name, c=control: getattr(styles[name], c))  # type: ignore[misc]
        assert order[0] == "jazz"
        assert order[-1] == "funk"


def test_a_style_written_reads_back(tmp_path: Path) -> None:
    style = replace(
        Style(name="mine", amplitude_gain=33.5, grip_left="traditional", seed=7, heel="up"),
        pieces={Piece.RIDE: 20.0},
        automation={"stand": ((1.0, 0.0), (4.5, 1.0))},
    )
    save_style(style, tmp_path / "mine.toml")
    read = load_style(tmp_path / "mine.toml")
    assert read == replace(style, pieces=read.pieces, automation=read.automation)
    assert dict(read.pieces) == dict(style.pieces)
    assert dict(read.automation) == dict(style.automation)


@pytest.mark.parametrize(
    ("text", "place", "fault"),
    [
        ("amplitude_gain = 101", "line 1, column 18", "amplitude_gain: expected a number from 0 to 100, found 101"),
        ("title = 'x'\namplitude_gain = 'big'", "line 2, column 18", "amplitude_gain: expected a number"),
        ("# a\n\n  amplitude = 5", "line 3, column 3", "no such key: amplitude; did you mean amplitude_"),
        ("held = 'hammer'", "line 1, column 8", "held: expected stick, brush, mallet or hand"),
        ("seed = 1.5", "line 1, column 8", "seed: expected a whole number from 0 to 2147483648, found 1.5"),
        ("[pieces]\nsnair = 5", "line 2, column 1", "no such piece: snair; did you mean snare?"),
        ("[automation]\nstand = [[1, 0], [1, 1]]", "line 2, column 9", "automation.stand: the bars must rise"),
        ("[automation]\nstand = [[2, 5]]", "line 2, column 14", "automation.stand: expected a number from 0 to 1"),
        ("[automation]\nstand = [[2]]", "line 2, column 10", "expected [bar, value], found 1 entries"),
        ("[automation]\nheld = [[2, 5]]", "line 2, column 1", "no such control: held"),
        ("stand = 1\nshrug = = 5", "line 2, column 9", "expected a value"),
    ],
)
def test_a_faulty_style_names_the_place(tmp_path: Path, text: str, place: str, fault: str) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(text)
    with pytest.raises(BadInput) as caught:
        load_style(path)
    assert caught.value.place == place
    assert fault in caught.value.fault


def test_eight_slots_keep_what_is_stored(tmp_path: Path) -> None:
    path = tmp_path / "slots.toml"
    slots = Slots.load(path).stored(0, load_style("jazz")).stored(7, Style(name='my "own"', amplitude_back=80))
    slots.save(path)
    read = Slots.load(path)
    assert len(read.styles) == SLOTS
    assert [s.name if s else None for s in read.styles] == ["jazz", *[None] * 6, 'my "own"']
    last = read.styles[7]
    assert last is not None
    assert last.amplitude_back == 80


def test_every_number_has_a_range_that_holds_its_natural_value() -> None:
    for control in NUMBERS:
        low, high = range_of(control)
        assert low <= getattr(Style(), control) <= high


def test_a_proposed_style_follows_the_music() -> None:
    calm = propose_style(score_of([(4 * i, Piece.RIDE) for i in range(32)], tempo_bpm=70, velocity=45))
    wild = propose_style(score_of([(4 * i, Piece.SNARE) for i in range(32)], tempo_bpm=90, velocity=125))
    dense = propose_style(score_of([(i, Piece.SNARE) for i in range(256)], tempo_bpm=180, velocity=80))
    assert calm.grip_left == "traditional"
    assert wild.amplitude_gain > calm.amplitude_gain > 0
    assert wild.amplitude_neck > calm.amplitude_neck
    assert dense.amplitude_gain < wild.amplitude_gain
    for style in (calm, wild, dense):
        checked(style)


RESTS = [(i, Piece.SNARE) for i in (*range(0, 16, 4), 64, 128, *range(192, 208, 4))]
"""A bar of quarters, rests of three bars and more, and a bar again: at 100 bpm bars 1 to 13."""
RESTING = Drummer(
    score_of(
        [*((i + 4, Piece.CRASH_1) for i in (0, 200)), *RESTS, *((i + 2, Piece.RIDE) for i, _ in RESTS)],
        tempo_bpm=100,
        velocity=90,
    )
)
ENDS = {"stand": (0.0, 1.0), "bobs_per_beat": (0.5, 2.0), "half_time_bpm": (30.0, 1000.0)}


@pytest.mark.parametrize("control", NUMBERS)
def test_every_control_can_change_over_the_bars(control: str) -> None:
    """From its least to its greatest value: the first bars are as under the one, the last as under the other."""
    low, high = ENDS.get(control, range_of(control))
    styles = (
        replace(Style(), **{control: low}),  # type: ignore[arg-type] # numbers only
        replace(Style(), **{control: high}),  # type: ignore[arg-type]
        replace(Style(), automation={control: ((7.5, low), (8.0, high))}),
    )
    at = np.arange(0.0, 31.0, 0.04)
    first, last, changing = (RESTING.with_style(style).rows(at) for style in styles)
    early, late = at < 9.0, at > 27.0
    assert np.abs(changing[early] - first[early]).max() < 1e-6
    assert np.abs(changing[late] - last[late]).max() < 1e-6
    assert np.abs(first - last).max() > 1e-3


def test_a_piece_can_change_over_the_bars() -> None:
    score = score_of([(4 * i, Piece.SNARE) for i in range(16)], tempo_bpm=60, velocity=100)
    drummer = Drummer(score, style=Style(automation={"snare": ((2.0, 15.0), (3.0, 85.0))}))
    assert heights(drummer, 14.0) > 2 * heights(drummer, 2.0)


def test_shares_may_also_be_set_without_constraint() -> None:
    """Wish of SMED's users (thesis § 5.3.5): a joint alone is changed, the others stay as they are."""
    style = replace(Style(), amplitude_wrist=80.0)
    assert style.joint_factor("amplitude", "elbow", 1.0) == pytest.approx(1.0)
    assert style.joint_factor("amplitude", "wrist", 1.0) > 1.5
