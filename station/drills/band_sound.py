"""The sound of a band that a lesson is played along to: which files, which of them are its drums, where tick 0 lies."""

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True, slots=True)
class BandSound:
    """Sound files that sound together; the score's tick 0 lies at `start_s` of them, which may be negative.

    `drums` are stems of the drums alone, `others` all other files: with no `drums` they are a mix, drums and all.
    """

    others: tuple[Path, ...]
    start_s: float
    drums: tuple[Path, ...] = ()

    def files(self, with_drums: bool) -> tuple[Path, ...]:
        """What sounds; a mix has its drums in it either way."""
        return self.others + (self.drums if with_drums else ())
