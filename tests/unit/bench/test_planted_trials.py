"""What counts as named, as innocent and as one explanation."""

from station.bench.rigs.planted.planted_music import lesson
from station.bench.rigs.planted.planted_table import missed_on, row
from station.bench.rigs.planted.planted_trials import Heard, Tally, accepted, exercised, pairs_on, spread_takes, stage

ROCK = stage(lesson("rock-1"), 10.0, True)


def test_a_hand_that_plays_only_the_snare_is_the_snare() -> None:
    fault = exercised(ROCK)["late_snare"]
    assert {"late_snare", "late_left_hand"} <= accepted(fault, ROCK)
    assert not {"early_snare", "late_kick", "late_hihat", "late_offbeats"} & accepted(fault, ROCK)


def test_without_a_click_a_hand_is_late_when_the_other_is_early_and_with_one_only_where_leads_could_be_so() -> None:
    free, click = (stage(lesson("single-paradiddle"), 10.0, clocked).explanations["time"] for clocked in (False, True))
    assert "early_right_hand" in free.as_good({"late_left_hand": 60.0})
    assert "early_right_hand" not in click.as_good({"late_left_hand": 60.0})  # nobody leads a click by 60 ms
    assert "early_right_hand" in click.as_good({"late_left_hand": 15.0})


def test_pairs_are_faults_that_can_be_told_apart() -> None:
    words = [{one.word, other.word} for one, other in pairs_on(ROCK)]
    assert {"late_kick", "late_snare"} in words
    assert {"late_snare", "late_left_hand"} not in words
    assert {"late_snare", "early_snare"} not in words


def test_a_word_counts_first_also_as_an_alternative() -> None:
    heard = Heard((("late_hihat", "late_right_hand"), ("fades",)))
    assert heard.first(frozenset({"late_right_hand"}))
    assert heard.first_only_beside(frozenset({"late_right_hand"}))
    assert not heard.first_only_beside(frozenset({"late_hihat"}))
    assert not heard.first(frozenset({"fades"}))
    assert heard.anywhere(frozenset({"fades"}))
    assert not Heard(()).first(frozenset({"fades"}))


def test_a_tally_tells_innocents_from_silence() -> None:
    tally = Tally()
    for items in ((("late_kick",),), (("late_snare",),), (("missed",),), ()):
        tally.add(ROCK, 25.0, frozenset({"late_kick"}), Heard(items))
    assert (tally.takes, tally.first, tally.innocent, tally.silent) == (4, 1, 1, 1)
    assert (
        row("late_kick", tally)
        == "| `late_kick` | 4 | 25.0 | 25.0 | 0.0 | 25.0 | 25.0 | 25.0 | late_snare 1, missed 1, - 1 |"
    )
    assert missed_on(tally) == "rock-1 click 3"


def test_takes_are_dealt_out_evenly() -> None:
    assert [(at, len(takes)) for at, takes in spread_takes([7, 3, 5], 8)] == [(7, 3), (3, 3), (5, 2)]
    assert list(spread_takes([], 8)) == []
