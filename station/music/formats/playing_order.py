"""The order in which written bars are played: repeats, endings, D.C., D.S., coda and fine.

A repeat is taken when first met; after a D.C. or D.S. none is taken again and of endings the last is played, as
musicians read it. Each D.C. or D.S. is followed once. Where it says what follows ("al Fine", "al Coda"), only that is
heeded; where it does not, the first that comes.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from station.core.errors import BadInput

MOST_BARS = 5_000
"""Bars as played (our choice: close to three hours of fours at 120)."""


AL_FINE, TO_THE_END = "al fine", "to the end"
"""What a D.C. or D.S. may lead to besides a coda, which has a label of its own."""


@dataclass(slots=True)
class BarSigns:
    """What stands at a bar that says where to go on.

    `repeat_from` a forward repeat, `repeat_times` how often what ends with this bar is played (0: no backward repeat);
    `endings` the passes that this bar is for, empty for all; `segno`, `coda` and `dal_segno` are labels, None where
    there is none. `until` is what the D.C. or D.S. of this bar says: `AL_FINE`, `TO_THE_END`, the label of a coda, or
    None.
    """

    repeat_from: bool = False
    repeat_times: int = 0
    endings: frozenset[int] = field(default_factory=frozenset)
    segno: str | None = None
    coda: str | None = None
    to_coda: str | None = None
    da_capo: bool = False
    dal_segno: str | None = None
    fine: bool = False
    until: str | None = None


def playing_order(bars: Sequence[BarSigns], source: str) -> list[int]:
    """The indices of `bars` as they are played; raises `BadInput` for more than `MOST_BARS`, and where none is."""
    order: list[int] = []
    signposts = _Signposts(bars)
    start, turn, bar, steps = 0, 1, 0, 0
    jumps_taken: set[int] = set()
    until: str | None = None
    while bar < len(bars):
        signs, last = bars[bar], signposts.last_endings[bar]
        steps += 1
        if len(order) >= MOST_BARS or steps > _MOST_STEPS:
            raise BadInput(source, f"bar {bar + 1}", f"with its repeats the part has more than {MOST_BARS:,} bars")
        if bar != start and (signs.repeat_from or (signposts.last_endings[bar - 1] and not last)):
            start, turn = bar, 1  # what is repeated later begins here
        if signs.endings and (last if jumps_taken else turn) not in signs.endings:
            bar = signposts.after_ending[bar]
            continue
        order.append(bar)
        if signs.repeat_times and not jumps_taken and turn < max(signs.repeat_times, last):
            bar, turn = start, turn + 1
            continue
        if signs.repeat_times and not last:
            start, turn = bar + 1, 1
        if signs.fine and jumps_taken and until in (None, AL_FINE):
            break
        target, then = signposts.jump(bar, jumps_taken, until)
        if target is not None:
            start, turn, until = target, 1, then
        bar = bar + 1 if target is None else target
    if bars and not order:
        raise BadInput(source, "bar 1", "its endings leave no bar to play the first time")
    return order


_MOST_STEPS = 10 * MOST_BARS
"""Bars played and endings passed over; ten endings a played bar nobody writes (our choice)."""


class _Signposts:
    """What is looked up of all bars.

    `last_endings` is the greatest number of the group of endings that a bar is in, 0 outside any; `after_ending` the
    first bar after its ending.
    """

    def __init__(self, bars: Sequence[BarSigns]) -> None:
        self._bars = bars
        self._segnos = {signs.segno: i for i, signs in reversed(list(enumerate(bars))) if signs.segno is not None}
        self._codas = {signs.coda: i for i, signs in reversed(list(enumerate(bars))) if signs.coda is not None}
        self.last_endings = [max(signs.endings, default=0) for signs in bars]
        self.after_ending = list(range(1, len(bars) + 1))
        for i in range(1, len(bars)):
            if bars[i].endings and bars[i - 1].endings:
                self.last_endings[i] = max(self.last_endings[i - 1 : i + 1])
        for i in reversed(range(len(bars) - 1)):
            if bars[i].endings and bars[i + 1].endings:
                self.last_endings[i] = self.last_endings[i + 1]
            if bars[i].endings == bars[i + 1].endings:
                self.after_ending[i] = self.after_ending[i + 1]

    def jump(self, bar: int, taken: set[int], until: str | None) -> tuple[int | None, str | None]:
        """Where to go on after `bar` if not with the next, and until what from there; `taken` grows by the jump."""
        signs = self._bars[bar]
        if signs.to_coda is not None and taken and until in (None, signs.to_coda):
            return _labelled(self._codas, signs.to_coda), TO_THE_END if until else None
        if bar in taken or not (signs.da_capo or signs.dal_segno is not None):
            return None, None
        taken.add(bar)
        return 0 if signs.da_capo else _labelled(self._segnos, signs.dal_segno or ""), signs.until


def _labelled(places: Mapping[str, int], label: str) -> int | None:
    """The bar with this label; where none has it, the only one there is, for not every program labels both ends."""
    return places.get(label, next(iter(places.values())) if len(places) == 1 else None)
