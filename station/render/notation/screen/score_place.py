"""Where the score lies in the picture, and how it is shown.

Sizes are pixels, y down, from the picture's upper left corner, unless a name says otherwise.
"""

from dataclasses import dataclass, replace
from enum import IntEnum

LEAST_SPACES = 48.0
"""So many staff spaces are as wide as the score: eighths at 150 beats a minute stay apart (our choice)."""
MOST_SPACES = 130.0
"""Nor does anything make the staff so small that more of them are as wide: the densest lesson that ships, in 32nds,
asks for 121 where it scrolls."""
_USUAL_REACH = (-8.3, 7.5)
"""What a staff with sticking and accents takes up and down of its middle line, in staff spaces."""


class ScoreForm(IntEnum):
    """How the score is shown."""

    SCROLLING = 0
    PAGED = 1
    HIGHWAY = 2
    FALLING = 3

    @property
    def is_staff(self) -> bool:
        """Whether it stands on a staff."""
        return self in (ScoreForm.SCROLLING, ScoreForm.PAGED)


SHARES = {ScoreForm.SCROLLING: 0.30, ScoreForm.PAGED: 0.50, ScoreForm.HIGHWAY: 0.30, ScoreForm.FALLING: 0.30}
"""The score's share of the picture's height, that of the falling highway of its width. Two lines of a page are to be
read at two metres: on a screen 30 cm high a staff space is then as tall, seen from there, as a printed one on a stand
(1.75 mm at 0.9 m)."""


@dataclass(frozen=True, slots=True)
class ScorePlace:
    """Where the score lies; how far up and down its staff reaches (`staff_rows`), and how much must go across it.

    `rows` is the number of staves below each other, `spaces` how many staff spaces the width must hold.
    """

    left: float
    top: float
    width: float
    height: float
    reach: tuple[float, float] = _USUAL_REACH
    spaces: float = LEAST_SPACES
    rows: int = 1

    @property
    def space(self) -> float:
        """Pixels a staff space: the height holds what is engraved, and the width enough of them to tell notes apart."""
        return min(self.height / self.rows / (self.reach[1] - self.reach[0]), self.width / self.spaces)

    @property
    def middle_line(self) -> float:
        """Where the staff's middle line lies."""
        return self.top + self.height / 2 - sum(self.reach) / 2 * self.space

    @property
    def top_y(self) -> float:
        """The upper edge in staff spaces from the middle line."""
        return (self.top - self.middle_line) / self.space

    def row(self, row: int) -> "ScorePlace":
        """The place of one of the rows, from 0."""
        height = self.height / self.rows
        return replace(self, top=self.top + row * height, height=height, rows=1)


@dataclass(frozen=True, slots=True)
class Halves:
    """A picture cut in two, each (left, top, width, height): the room, whose top is the picture's, and the score."""

    scene: tuple[int, int, int, int]
    score: tuple[int, int, int, int]


def halves(size: tuple[int, int], form: ScoreForm | None) -> Halves:
    """The room above and the score below it, the falling highway to the right of the room; None: the room alone."""
    width, height = size
    if form is None:
        return Halves((0, 0, width, height), (0, height, width, 0))
    if form is ScoreForm.FALLING:
        across = round(width * SHARES[form])
        return Halves((0, 0, width - across, height), (width - across, 0, across, height))
    down = round(height * SHARES[form])
    return Halves((0, 0, width, height - down), (0, height - down, width, down))
