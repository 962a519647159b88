"""What a writer loses of a part, gathered a stroke at a time and told a sentence at a time, each with its bars."""

from dataclasses import dataclass, field

from station.music.bar_numbers import named_bars
from station.music.formats.music_format import Feature, Loss


@dataclass(slots=True)
class LostBars:
    """Bars (from 0) by feature and sentence."""

    _bars: dict[tuple[Feature, str], set[int]] = field(default_factory=dict)

    def add(self, feature: Feature, text: str, bar: int | None = None) -> None:
        """`text` says what of `feature` is lost, in `bar` or throughout."""
        known = self._bars.setdefault((feature, text), set())
        if bar is not None:
            known.add(bar)

    def told(self) -> tuple[Loss, ...]:
        """A loss for each sentence, its bars from 1 before it."""
        return tuple(Loss(feature, _with_bars(text, bars)) for (feature, text), bars in self._bars.items())


def _with_bars(text: str, bars: set[int]) -> str:
    if not bars:
        return text
    return f"{named_bars(bars)}: {text}"
