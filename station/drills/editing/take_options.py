"""How what is played over the click is written into a lesson."""

from dataclasses import dataclass, field

from station.drills.editing.lesson_edits import Quantise


@dataclass(frozen=True, slots=True)
class TakeOptions:
    """How what is played is written: brought to the grid by `quantise`, in place of what stands there or `over` it.

    With `guide` what stands in the bars sounds meanwhile.
    """

    quantise: Quantise = field(default_factory=Quantise)
    over: bool = True
    guide: bool = True
