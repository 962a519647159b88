import pytest

from station.core.errors import BadInput
from station.simulation.student_spec import FAULTS, KEYS, PLAYERS, PlantedFault, StudentSpec, parse_spec


def test_keys_are_read() -> None:
    spec = parse_spec("seed=7,sd_ms=12,bias_ms=-8,miss_pct=3,extra_pct=2,drift_pct=1.5,wrong_piece_pct=1,velocity_sd=6")
    assert spec == StudentSpec(7, -8.0, 12.0, 1.5, 3.0, 2.0, 1.0, 6.0)


def test_what_nobody_says_is_zero() -> None:
    spec = parse_spec("seed=1")
    assert (spec.sd_ms, spec.velocity_sd, spec.miss_pct, spec.faults) == (0.0, 0.0, 0.0, ())


@pytest.mark.parametrize("text", ["pro,seed=3,sd_ms=9", "seed=3,sd_ms=9,pro", " seed=3 , pro, sd_ms=9"])
def test_a_key_overrides_the_player_in_any_order(text: str) -> None:
    spec = parse_spec(text)
    assert (spec.player, spec.seed, spec.sd_ms) == ("pro", 3, 9.0)
    assert spec.miss_pct == PLAYERS["pro"].miss_pct


def test_players_get_worse_from_pro_to_beginner() -> None:
    pro, middle, beginner = (parse_spec(name) for name in ("pro", "intermediate", "beginner"))
    for field in ("sd_interval_pct", "velocity_cv_pct", "miss_pct", "extra_pct", "wrong_piece_pct"):
        assert getattr(pro, field) < getattr(middle, field) < getattr(beginner, field), field


@pytest.mark.parametrize(("name", "low", "high"), [("pro", 2, 3), ("intermediate", 4, 5), ("beginner", 6, 10)])
def test_players_have_the_spread_that_is_published(name: str, low: float, high: float) -> None:
    """HUMANS, "Timing": professional 2–3 % of the interval, amateur 4–5, novice 6–10."""
    assert low <= parse_spec(name).sd_interval_pct <= high


def test_several_faults() -> None:
    assert parse_spec("fault=late_kick:20,sd_ms=5,fault=weak_left:6").faults == (
        PlantedFault("late_kick", 20.0),
        PlantedFault("weak_left", 6.0),
    )


def test_every_fault_of_the_design_is_there() -> None:
    """And those of craft, beyond the single stroke."""
    assert set(FAULTS) == {
        "late_kick", "rush_fills", "drag_slow", "weak_left", "loud_ghosts", "flat_accents", "straight_swing",
        "uneven_doubles", "wide_flams", "slow_hihat_foot",
        "open_hats", "late_grabs", "short_buzz",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("text", "place", "words"),
    [
        ("", "column 1", "nothing here"),
        ("seed=1,,sd_ms=2", "column 8", "nothing here"),
        ("seed=1,", "column 8", "nothing here"),
        ("sd=12", "column 1", "did you mean sd_ms?"),
        ("proo", "column 1", "did you mean pro?"),
        ("seed=1, sd_ms=many", "column 15", "expected ms, from 0 to 200"),
        ("sd_ms=-1", "column 7", "from 0 to 200"),
        ("sd_ms=nan", "column 7", "from 0 to 200"),
        ("bias_ms=inf", "column 9", "from -500 to 500"),
        ("seed=1.5", "column 6", "expected a whole number"),
        ("seed=-1", "column 6", "from 0"),
        ("sd_ms=", "column 7", "expected ms"),
        ("sd_ms=1,sd_ms=2", "column 9", "sd_ms is said twice"),
        ("pro,beginner", "column 5", "second player"),
        ("fault=late_kick", "column 7", "expected late_kick:SIZE with SIZE in ms"),
        ("fault=late_kik:3", "column 7", "did you mean late_kick?"),
        ("fault=late_kick:x", "column 17", "expected ms"),
        ("fault=late_kick:0", "column 17", "above 0 ms"),
        ("fault=weak_left:30", "column 17", "from 0 to 24"),
        ("fault=late_kick:3,fault=late_kick:4", "column 19", "late_kick is said twice"),
        ("fault:late_kick=3", "column 1", "no such key"),
        ("miss_pct=60,wrong_piece_pct=60", "column 1", "more than 100 percent"),
    ],
)
def test_a_fault_is_named_with_its_place(text: str, place: str, words: str) -> None:
    with pytest.raises(BadInput) as caught:
        parse_spec(text)
    assert caught.value.place == place
    assert words in caught.value.fault
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("key", KEYS)
def test_the_ends_of_every_range_are_inside(key: str) -> None:
    for end in (KEYS[key].low, KEYS[key].high):
        assert getattr(parse_spec(f"{key}={end:.0f}"), key) == end
        beyond = end - 1 if end == KEYS[key].low else end + 1
        with pytest.raises(BadInput):
            parse_spec(f"{key}={beyond:.0f}")
