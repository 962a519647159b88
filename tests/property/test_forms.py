"""A form, its endings and variations mean what the same grids mean when they are written out one after the other."""

from dataclasses import dataclass

from hypothesis import given, settings
from hypothesis import strategies as st

from station.drills.lesson import Lesson
from station.drills.reading.lesson_file import parse_lesson
from station.music.swing import Swing

LINES = ("snare", "kick", "hihat")
LETTERS = {"snare": "oOg-", "kick": "oO-", "hihat": "xX-"}
METERS = {"4/4": 4, "3/4": 3, "2+3/8": 5}
NAMES = "ABC"


@dataclass(frozen=True)
class Written:
    """One grid: what stands at each of its keys, lines included."""

    keys: dict[str, str]

    def text(self, **more: str) -> str:
        return "[[grid]]\n" + "".join(f"{key} = {value}\n" for key, value in {**self.keys, **more}.items())


@st.composite
def grids(draw: st.DrawFn) -> Written:
    meter = draw(st.sampled_from(sorted(METERS)))
    bars = draw(st.integers(1, 3))
    keys = {
        "meter": f'"{meter}"',
        "tempo_bpm": str(draw(st.sampled_from((50, 61.5, 70)))),
        "swing_ratio": str(draw(st.sampled_from((1, 1.5)))),
        "swing_unit": '"1/16"',
    }
    for line in draw(st.lists(st.sampled_from(LINES), min_size=1, max_size=3, unique=True)):
        cells = METERS[meter]
        letters = st.text(LETTERS[line], min_size=cells, max_size=cells)
        keys[line] = '"' + " | ".join(draw(letters) for _ in range(bars)) + '"'
    return Written(keys)


def lesson(text: str) -> Lesson:
    head = 'title = "T"\nbeat = "1/8"\n'  # swung sixteenths fill every eighth
    reading = parse_lesson(head + text, "t", "t")
    assert reading.faults == []
    assert reading.lesson
    return reading.lesson


def swings(lesson: Lesson) -> list[Swing]:
    """How each bar swings."""
    return [s.swing for s in lesson.sections for _ in range(s.first_bar, s.last_bar + 1)]


def same_music(one: Lesson, other: Lesson) -> bool:
    a, b = one.score, other.score
    return (
        a.notes.tobytes() == b.notes.tobytes()
        and (a.tempo_map, a.end_tick) == (b.tempo_map, b.end_tick)
        and swings(one) == swings(other)
    )


LAST = Written({"meter": '"4/4"', "tempo_bpm": "60", "swing_ratio": "1", "snare": '"o---"'})
"""Some stroke, for a lesson of rests alone is none."""


@settings(max_examples=50)
@given(st.lists(grids(), min_size=1, max_size=3), st.data())
def test_a_form_is_its_grids_written_out(some: list[Written], data: st.DataObject) -> None:
    order = data.draw(st.lists(st.sampled_from(range(len(some))), max_size=5)) + list(range(len(some)))
    times = [data.draw(st.integers(1, 3)) for _ in some]
    written = "".join(g.text(name=f'"{NAMES[i]}"', times=str(times[i])) for i, g in enumerate(some))
    form = ", ".join([*(NAMES[i] for i in order), "end"])
    unrolled = "".join(some[i].text() * times[i] for i in order) + LAST.text()
    assert same_music(
        lesson(f'form = "{form}"\n{written}{LAST.text(name=chr(34) + "end" + chr(34))}'), lesson(unrolled)
    )


@settings(max_examples=50)
@given(grids(), st.lists(grids(), min_size=1, max_size=3), st.data())
def test_endings_are_written_out_between_the_repetitions(
    main: Written, endings: list[Written], data: st.DataObject
) -> None:
    times = data.draw(st.integers(len(endings), 5))
    numbers = data.draw(st.permutations(range(1, times + 1)))
    of: dict[int, Written] = {}
    written = main.text(times=str(times))
    for i, ending in enumerate(endings):
        own = [n for k, n in enumerate(numbers) if k % (len(endings) + 1) == i] or [numbers[i]]
        own = [n for n in own if n not in of] or [min(set(numbers) - set(of))]
        of |= dict.fromkeys(own, ending)
        written += ending.text(ending=str(own))
    unrolled = "".join(main.text() + (of[n].text() if n in of else "") for n in range(1, times + 1))
    assert same_music(lesson(written + LAST.text()), lesson(unrolled + LAST.text()))


@settings(max_examples=50)
@given(grids(), grids())
def test_a_variation_is_its_model_with_other_lines(model: Written, other: Written) -> None:
    own = {key: value for key, value in other.keys.items() if key in LINES}
    if other.keys["meter"] != model.keys["meter"] or any(v.count("|") != _bars(model) for v in own.values()):
        bar = "x" * METERS[model.keys["meter"].strip('"')]
        own = {"hihat_pedal": '"' + " | ".join([bar] * (_bars(model) + 1)) + '"'}
    variation = Written({"like": '"A"', **own})
    written_out = Written({**model.keys, **own})
    text = model.text(name='"A"') + LAST.text()
    assert same_music(lesson(text + variation.text()), lesson(text + written_out.text()))


def _bars(grid: Written) -> int:
    return next(value.count("|") for key, value in grid.keys.items() if key in LINES)
