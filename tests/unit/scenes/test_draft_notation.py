"""The notation of a lesson while it is written: what was kept of the text before changes nothing that is shown."""

import numpy as np

from station.core.units import PPQ
from station.drills.library import lesson_names
from station.scenes.draft_notation import DraftNotation, Notation
from tests.shipped_lesson import shipped_lesson

ROCK = 'title = "R"\n[grid]\nhihat = "| x-x-x-x- | x-x-x-x- |"\nkick = "| o---o--- | o---o-o- |"\n'
DRAWN = ("centre", "half", "axis", "style", "kind", "colour")
"""What a shape looks like but for its glyph, which every atlas numbers for itself."""


def shown(draft: DraftNotation, text: str, width: float = 60.0) -> Notation:
    notation = draft.of(text, width)
    assert notation is not None
    return notation


def assert_alike(one: Notation, other: Notation) -> None:
    assert len(one.page.shapes) == len(other.page.shapes)
    for name in DRAWN:
        np.testing.assert_array_equal(one.page.shapes[name], other.page.shapes[name])
    assert one.page.height == other.page.height


def test_bars_that_were_kept_look_as_they_do_when_all_is_set_anew() -> None:
    draft, texts = DraftNotation(), [shipped_lesson(name).text for name in lesson_names()[::25]]
    for text in [*texts, *texts[:3]]:
        assert_alike(shown(draft, text), shown(DraftNotation(), text))


def test_a_bar_is_set_anew_where_its_beat_or_its_neighbour_changes_it() -> None:
    draft = DraftNotation()
    shown(draft, ROCK)
    for change in (
        ("x-x-x-x- |", "x-x-x-xx |"),
        ('title = "R"', 'title = "R"\nbeat = "1/2"'),
        ('title = "R"', 'title = "R"\nswing_ratio = 2'),
        ("| o---o--- |", "| oo--o--- |"),
        ('title = "R"', 'title = "R"\ntempo_bpm = 120'),
    ):
        text = ROCK.replace(*change)
        assert_alike(shown(draft, text), shown(DraftNotation(), text))


def test_the_same_text_and_width_is_the_same_page() -> None:
    draft = DraftNotation()
    first = shown(draft, ROCK)
    assert shown(draft, ROCK) is first
    assert shown(draft, ROCK, 30.0) is not first
    assert len(shown(draft, ROCK, 30.0).page.places.lines) > len(first.page.places.lines)


def test_a_text_that_is_none_leaves_what_was_there() -> None:
    draft = DraftNotation()
    assert draft.of("title =", 60.0) is None
    before = shown(draft, ROCK)
    after = shown(draft, ROCK + "snare = ")
    assert after.page.shapes.tobytes() == before.page.shapes.tobytes()
    assert not after.can_be_edited
    assert shown(draft, ROCK).can_be_edited


def test_long_music_waits_until_nobody_types() -> None:
    long = ROCK.replace("x-x-x-x- |", "x-x-x-x- | %28 |", 1).replace("o---o--- |", "o---o--- | %28 |", 1)
    draft = DraftNotation()
    first = shown(draft, long)
    assert len(first.music.bars) == 30
    typed = long.replace("o---o-o-", "o---oooo")
    late = draft.of(typed, 60.0, is_settled=False)
    assert late is not None
    assert late.is_late
    assert late.page is first.page
    settled = draft.of(typed, 60.0)
    assert settled is not None
    assert settled.can_be_edited
    assert len(settled.page.shapes) > len(first.page.shapes)


def test_what_was_typed_and_taken_back_is_there_again() -> None:
    long = ROCK.replace("x-x-x-x- |", "x-x-x-x- | %28 |", 1).replace("o---o--- |", "o---o--- | %28 |", 1)
    draft = DraftNotation()
    shown(draft, long)
    draft.of(long + "#", 60.0, is_settled=False)
    back = draft.of(long, 60.0, is_settled=False)
    assert back is not None
    assert back.can_be_edited


def test_ticks_of_a_bar_count_from_its_start() -> None:
    notation = shown(DraftNotation(), ROCK)
    heads = [head for line in notation.page.places.lines for head in line.heads if head.bar == 1]
    assert min(head.tick for head in heads) == 4 * PPQ
