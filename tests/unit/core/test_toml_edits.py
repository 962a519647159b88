"""Keys of TOML texts set, added and taken away; expected texts are written by hand."""

import pytest

from station.core.toml.toml_edits import with_value

TEXT = 'title = "T"  # mine\nloop = [1,\n  2]  # both\n\n[goals]\nmin_score = 3\n'


def test_a_key_is_set_in_its_place() -> None:
    assert with_value(TEXT, ("loop",), [2, 2]) == TEXT.replace("[1,\n  2]", "[2, 2]")
    assert with_value(TEXT, ("title",), 'A "B"') == TEXT.replace('"T"', '"A \\"B\\""')


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (TEXT, TEXT.replace("# both\n", "# both\npasses = 4\n")),
        ("[grid]\npasses = 3\n", "passes = 4\n[grid]\npasses = 3\n"),
        ("", "passes = 4\n"),
        ('title = "T"', 'title = "T"\npasses = 4'),
        ('about = """\n[x]\n"""\n[grid]\n', 'about = """\n[x]\n"""\npasses = 4\n[grid]\n'),
        ('goals.level = "studio"\n', 'goals.level = "studio"\npasses = 4\n'),
    ],
)
def test_a_key_that_is_not_there_follows_the_others(text: str, expected: str) -> None:
    assert with_value(text, ("passes",), 4) == expected
