"""The page about the drummer says what the code does."""

from tools.battle_drummer_page import PAGE, with_tables


def test_its_tables_are_those_of_the_code() -> None:
    text = PAGE.read_text(encoding="utf-8")
    assert with_tables(text) == text
    assert "| 24 | 4 | 9.0 | four limbs | ornaments |" in text
