"""Draws the app's picture in a process of its own: `python -m station.bench.rigs.drawer [COUNT]`.

So many pictures, or 60 a second until it is ended. Prints "draws" when the first is there.
"""

import sys
import time
from itertools import count, islice

from station.bench.rows.drawing_rows import SIZE, snapshots
from station.render.picture import PictureMaker
from station.render.quality import QUALITIES

_KEPT = 12
"""So many moments are drawn in turn (our choice: a fifth of a second)."""
_EVERY_S = 1 / 60


def draw(pictures: int | None) -> None:
    """Draw so many; None goes on for ever."""
    frames = snapshots(_KEPT if pictures is None else min(pictures, _KEPT))
    maker = PictureMaker(SIZE, QUALITIES[0])
    for k in islice(count(), pictures):
        began_s = time.monotonic()
        maker.draw(frames[k % len(frames)])
        if k == 0:
            sys.stdout.write("draws\n")
            sys.stdout.flush()
        if pictures is None:
            time.sleep(max(0.0, began_s + _EVERY_S - time.monotonic()))


if __name__ == "__main__":
    draw(int(sys.argv[1]) if len(sys.argv) > 1 else None)
