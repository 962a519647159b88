"""What is said of a word that nobody knows stays short."""

from station.core.did_you_mean import did_you_mean


def test_a_word_that_looks_like_one_is_asked_for() -> None:
    assert did_you_mean("sytle", ["style", "theme"]) == "; did you mean style?"


def test_few_names_are_told_all() -> None:
    assert did_you_mean("zzz", ["style", "theme", "style"]) == "; there are style, theme"
    assert did_you_mean("zzz", ["style"]) == "; there is style"


def test_of_many_names_the_nearest_three_are_told() -> None:
    """By hand: of the words with an o the shorter ones share most of their letters with "oxx"."""
    many = [f"{letter}{letter}{letter}" for letter in "abcdefghijklmn"]
    assert did_you_mean("oxx", [*many, "oyy"]).startswith("; the nearest are oyy, ")
    assert did_you_mean("oxx", [*many, "oyy"]).count(",") == 2
