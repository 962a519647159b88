"""What changed between two texts, as one piece of text that took another's place."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class TextChange:
    """From character `at` on, `taken` gave way to `given`."""

    at: int
    taken: str
    given: str

    @property
    def undone(self) -> "TextChange":
        """The way back."""
        return TextChange(self.at, self.given, self.taken)

    def fits(self, text: str) -> bool:
        """Whether `text` has what is taken where it is taken."""
        return self.at >= 0 and text.startswith(self.taken, self.at) and self.at <= len(text)

    def applied(self, text: str) -> str:
        """`text` with the change, which must fit."""
        assert self.fits(text), "a change is of one text alone"
        return text[: self.at] + self.given + text[self.at + len(self.taken) :]


def change_between(before: str, after: str) -> TextChange:
    """The shortest change of one piece that makes `after` of `before`."""
    at = _alike(before, after)
    most = min(len(before), len(after)) - at
    tail = _alike(before[at:][::-1], after[at:][::-1]) if most else 0
    return TextChange(at, before[at : len(before) - tail], after[at : len(after) - tail])


def _alike(one: str, other: str) -> int:
    """How many characters both begin with, found by halving: comparing slices costs a thousandth of a loop."""
    low, high = 0, min(len(one), len(other))
    while low < high:
        middle = (low + high + 1) // 2
        if one[low:middle] == other[low:middle]:
            low = middle
        else:
            high = middle - 1
    return low
