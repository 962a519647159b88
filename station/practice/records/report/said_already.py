"""Whether a remark of the advice says already that a goal was missed: one thing is told once.

Advice names what a listener hears, a goal what a lesson asks; a late kick and a late right foot are one thing.
"""

from collections.abc import Mapping
from types import MappingProxyType

from station.core.pieces import Limb
from station.drills.mastery.goals_missed import Miss, PassFault
from station.scoring.report.assessment_document import Json

_OF_LIMBS: Mapping[str, tuple[Limb, PassFault]] = MappingProxyType(
    {
        **{
            f"{word}_{name}": (limb, fault)
            for word, fault in (("late", PassFault.LEAN), ("early", PassFault.LEAN), ("unsteady", PassFault.SPREAD))
            for name, limb in (
                ("left_hand", Limb.LEFT_HAND),
                ("right_hand", Limb.RIGHT_HAND),
                ("left_foot", Limb.LEFT_FOOT),
                ("right_foot", Limb.RIGHT_FOOT),
                ("kick", Limb.RIGHT_FOOT),
            )
        },
        "slow_hihat_foot": (Limb.LEFT_FOOT, PassFault.LEAN),
        "early_hihat_foot": (Limb.LEFT_FOOT, PassFault.LEAN),
        "weak_left": (Limb.LEFT_HAND, PassFault.LOUDNESS),
        "weak_right": (Limb.RIGHT_HAND, PassFault.LOUDNESS),
    }
)
"""What a fault says of which limb; the kick is the right foot's, as the sticking has it where nothing else is said."""
_OF_ALL: Mapping[str, PassFault] = MappingProxyType(
    {
        "late": PassFault.LEAN,
        "early": PassFault.LEAN,
        "unsteady": PassFault.SPREAD,
        "missed": PassFault.RIGHT,
        "rushing": PassFault.TEMPO,
        "dragging": PassFault.TEMPO,
    }
)
"""What a fault of everything says, of the bars that it names."""
_SIDES: Mapping[str, int] = MappingProxyType({"early": -1, "late": 1, "slow": 1, "rushing": 1, "dragging": -1})
"""To which side of the click, or of its tempo, a fault's first word says one is."""


def says_so(advice: Mapping[str, Json], miss: Miss) -> bool:
    """Whether `advice`, a row of the assessment's, says what `miss` says: the same measure of the same limb or bars."""
    fault = str(advice.get("fault"))
    if miss.part is None or miss.value * _SIDES.get(fault.partition("_")[0], 0) < 0:
        return False
    if miss.part.bars is None:
        return _OF_LIMBS.get(fault) == (miss.part.limb, miss.fault)
    first, last = miss.part.bars
    bars = advice.get("bars")
    named = [bar - 1 for bar in bars if isinstance(bar, int)] if isinstance(bars, list) else []
    return _OF_ALL.get(fault) is miss.fault and bool(named) and all(first <= bar <= last for bar in named)
