"""What `station battle` is given that nobody can play: one line, exit status 2, and nothing is left behind."""

from pathlib import Path

import pytest

from station.cli.command_line import main

LARGEST_SEED = str(2**62 - 1)
"""A capture's whole numbers are below 2 to the 62nd."""
BYTE = "\udcff"
"""How Python hands on a byte of the command line that is no UTF-8 (PEP 383)."""


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--players", f"{BYTE},Ben"], "letter that nobody sees"),
        (["--players", "\u202eAnn,Ben"], "letter that nobody sees"),
        (["--players", "Ann\u200b,Ann"], "letter that nobody sees"),
        (["--players", f"Ann={BYTE},Ben=x"], "letter that nobody sees"),
        (["--student", BYTE], "letter that nobody sees"),
        (["--style", BYTE], "style"),
        (["--style", "jazz\x1b[31m"], "style"),
        (["--style", "x" * 41], "style"),
        (["--tempo", "0"], "tempo"),
        (["--seed", str(2**62)], "seed"),
        (["--host", "--port", "65536"], "port"),
        (["--host", "--port", "-1"], "port"),
        (["--host", "--bind", BYTE], "address"),
        (["--join", "127.0.0.1", "--port", "99999"], "port"),
        (["--join", "127.0.0.1", "--port", "0"], "port"),
        (["--join", f"127.0.0.1:{'9' * 5000}"], "port"),  # more digits than Python reads
        (["--join", "list", "--port", "99999"], "port"),
    ],
)
def test_what_nobody_can_play_is_refused_in_one_line(
    words: list[str], said: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    played = ["battle", "--headless", "--rounds", "1", "--no-final", "--report", str(tmp_path / "left"), *words]
    assert main(played) == 2
    heard = capfd.readouterr()
    assert said in heard.err
    assert heard.err.count("\n") == 1
    assert heard.out == ""


def test_a_battle_of_the_largest_seed_is_judged_again(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    left = str(tmp_path / "left")
    words = ["--headless", "--json", "--rounds", "1", "--no-final", "--seed", LARGEST_SEED, "--report", left]
    assert main(["battle", *words]) == 0
    document = capfd.readouterr().out
    assert main(["battle", "--judge-again", left, "--json"]) == 0
    assert capfd.readouterr().out == document
