"""Probes: blind passes, which alone say what has been learnt.

Every fifth pass is one, at the tempo of the day; every fourth rung up, the target tempo itself is tried once.
`mastery_pct` is the fastest tempo, in percent of the target, that was last shown blind: a clean probe lifts it to its
own tempo, a failed one at or below it takes it down a step. An item is stable when probes of the target succeed in a
row.
"""

from dataclasses import dataclass, replace

from station.drills.mastery.rules import Rules
from station.drills.mastery.tempo_ladder import TOP_PCT


@dataclass(frozen=True, slots=True)
class Probes:
    """`since` passes were played since the last probe; `tried_pct` is the rung from which the target was last tried."""

    tried_pct: float
    mastery_pct: float = 0.0
    in_a_row: int = 0
    since: int = 0

    def is_due(self, rules: Rules) -> bool:
        """Whether the next pass is blind."""
        return self.since + 1 >= rules.passes_a_probe

    def is_target_due(self, pct: float, rules: Rules) -> bool:
        """Whether the ladder, now at `pct`, has risen far enough to try the target tempo."""
        return pct < TOP_PCT and pct - self.tried_pct >= rules.rungs_a_target_probe * rules.up_pct

    def is_stable(self, rules: Rules) -> bool:
        """Whether the target tempo was shown often enough in a row."""
        return self.in_a_row >= rules.probes_to_be_stable

    def at_rung(self, pct: float) -> "Probes":
        """After the ladder came to `pct`: rungs are counted from the lowest since the last try."""
        return replace(self, tried_pct=min(self.tried_pct, pct))

    def passed_by(self) -> "Probes":
        """After a pass that was no probe."""
        return replace(self, since=self.since + 1)

    def after(self, is_clean: bool, pct: float, rules: Rules) -> "Probes":
        """After a probe at `pct` of the target tempo."""
        mastery_pct, in_a_row = self.mastery_pct, self.in_a_row
        if is_clean:
            mastery_pct = max(mastery_pct, min(pct, TOP_PCT))
            in_a_row += pct >= TOP_PCT
        elif pct <= mastery_pct:
            mastery_pct = max(mastery_pct - rules.down_pct, 0.0)
        return replace(self, mastery_pct=mastery_pct, in_a_row=in_a_row if is_clean else 0, since=0)
