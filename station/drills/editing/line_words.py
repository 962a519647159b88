"""One line of a grid as text, edited bar by bar: what stands between bar lines is a word, a written bar or a `%`.

Bars count from 0 as they are played; `%3` is three of them. A bar that other bars repeat stands for those too: editing
the written bar changes all of them, editing a repeat writes it out and leaves the others as they sounded.
"""

from collections.abc import Sequence

from station.core.toml.toml_edits import Splice, spliced
from station.drills.grid.grid import BarWord, bar_words
from station.drills.grid.grid_writer import REPEAT


def word_at(line: str, bar: int) -> tuple[int, BarWord, int]:
    """Index of the word that holds `bar`, the word, and the bar it begins with; raises `IndexError` where none does."""
    first = 0
    for index, word in enumerate(bar_words(line)):
        if bar < first + word.bars:
            return index, word, first
        first += word.bars
    raise IndexError(bar)


def bar_total(line: str) -> int:
    """How many bars the line has."""
    return sum(word.bars for word in bar_words(line))


def is_repeat(line: str, bar: int) -> bool:
    """Whether `bar` is written as a repeat."""
    return word_at(line, bar)[1].repeats is not None


def written_text(line: str, bar: int) -> str:
    """What `bar` plays: its own word, or that which it repeats."""
    words = bar_words(line)
    index = word_at(line, bar)[0]
    return next((word.text for word in reversed(words[: index + 1]) if word.repeats is None), "")


def written_out(line: str, bar: int) -> str:
    """The same music with `bar` written as a bar of its own that begins a word; bars after it repeat it as they did."""
    index, word, first = word_at(line, bar)
    if word.repeats is None:
        return line
    before, after = bar - first, first + word.bars - bar - 1
    new = [*_repeats(before), written_text(line, bar), *_repeats(after)]
    return _with_words(line, index, index + 1, new)


def with_bar(line: str, bar: int, text: str) -> str:
    """The line with another text in `bar`; bars that repeat it are changed, too, if it is a written one."""
    if is_repeat(line, bar):
        line = alone(line, bar)
    index = word_at(line, bar)[0]
    return _with_words(line, index, index + 1, [text])


def alone(line: str, bar: int) -> str:
    """The same music with `bar` written out and no other bar that repeats it."""
    if bar + 1 < bar_total(line):
        line = written_out(line, bar + 1)
    return written_out(line, bar)


def with_all_bars(line: str, texts: Sequence[str]) -> str:
    """The line with these texts in all its bars; where nothing differs from what a repeat says, the repeat stays.

    A written bar that gets another text changes those that repeat it, which are then compared with that; the bar behind
    a repeat that had to be written out is written out, too.
    """
    changes: list[Splice] = []
    bar, said, is_beside = 0, "", False
    for word in bar_words(line):
        wanted = texts[bar : bar + word.bars]
        bar += word.bars
        if word.repeats is None:
            said, is_beside = wanted[0] if wanted else word.text, False
            new = [said]
        else:
            new, said, is_beside = _rewritten([*wanted, *[said] * (word.bars - len(wanted))], said, is_beside)
        if is_beside or (new != [word.text] and new != _repeats(word.bars)):
            changes.append((word.first, word.first + len(word.text), " | ".join(new)))
    return spliced(line, changes)


def _rewritten(texts: Sequence[str], said: str, is_beside: bool) -> tuple[list[str], str, bool]:
    """The words for bars that repeated one that says `said`, what the last says, and whether the next is written out.

    `is_beside` says that the bar before them has been written out.
    """
    found: list[str] = []
    kept = 0
    for text in texts:
        if text == said and not is_beside:
            kept += 1
            continue
        is_beside = not is_beside
        found += [*_repeats(kept), text]
        said, kept = text, 0
    return [*found, *_repeats(kept)], said, is_beside


def with_bars(line: str, at: int, texts: Sequence[str]) -> str:
    """The line with new bars before bar `at`, at its end where `at` is their number."""
    if at == bar_total(line):
        count = len(bar_words(line))
        return _with_words(line, count, count, texts)
    line = written_out(line, at)
    index = word_at(line, at)[0]
    return _with_words(line, index, index, texts)


def without_bars(line: str, first: int, last: int) -> str:
    """The line without bars `first` to `last`, which are not all it has; the others sound as they did."""
    if last + 1 < bar_total(line):
        line = written_out(line, last + 1)
    line = written_out(line, first)
    end = len(bar_words(line)) if last + 1 == bar_total(line) else word_at(line, last + 1)[0]
    return _with_words(line, word_at(line, first)[0], end, [])


def bars_of(line: str, first: int, last: int) -> list[str]:
    """The words of bars `first` to `last`, the first of them written out."""
    line = written_out(line, first)
    if last + 1 < bar_total(line):
        line = _split_before(line, last + 1)
        words = bar_words(line)[word_at(line, first)[0] : word_at(line, last + 1)[0]]
    else:
        words = bar_words(line)[word_at(line, first)[0] :]
    return [word.text for word in words]


def _split_before(line: str, bar: int) -> str:
    """The same music with no `%3` that goes on over the start of `bar`."""
    index, word, first = word_at(line, bar)
    if bar == first:
        return line
    return _with_words(line, index, index + 1, [*_repeats(bar - first), *_repeats(first + word.bars - bar)])


def _repeats(count: int) -> list[str]:
    return [] if not count else [REPEAT if count == 1 else f"{REPEAT}{count}"]


def _with_words(line: str, first: int, end: int, texts: Sequence[str]) -> str:
    """The line with these words in the place of words `first` to `end - 1`; rows and bar lines around them stay."""
    words = bar_words(line)
    spans = [(word.first, word.first + len(word.text)) for word in words]
    new = " | ".join(texts)
    if first < end and texts:
        return line[: spans[first][0]] + new + line[spans[end - 1][1] :]
    if texts:
        at = spans[first - 1][1] if first else spans[0][0]
        return f"{line[:at]} | {new}{line[at:]}" if first else f"{line[:at]}{new} | {line[at:]}"
    if end < len(words):
        return line[: spans[first][0]] + line[spans[end][0] :]
    return line[: spans[first - 1][1]] + line[spans[-1][1] :]
