"""The click of a take: what the student heard of it in count-in and passes, as cues in the take's time."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from station.engine.messages import Bus
from station.practice.session.cues.click_pattern import click_cues, counting
from station.practice.session.cues.stroke_cues import moved_by
from station.practice.session.plan import Plan
from station.scenes.report.take_clock import TakeClock


def take_clicks(plan: Plan, clock: TakeClock) -> NDArray[np.void]:
    """The clicks (n,) of `CUE_DTYPE`, from the take's start on."""
    if plan.rounds is not None:
        return _anew(plan, clock)
    first_ns = max(plan.demonstrations_end_ns, plan.passes_start_ns - clock.lead_ns)
    clicks = plan.cues[(plan.cues["bus"] == Bus.CLICK) & (plan.cues["at_ns"] >= first_ns)]
    return moved_by(clicks, clock.lead_ns - plan.passes_start_ns)


def _anew(plan: Plan, clock: TakeClock) -> NDArray[np.void]:
    """Those of passes that followed the student, of which a plan of them all keeps only where they were silent."""
    if plan.click is None:
        return plan.cues[:0]
    count = click_cues(clock.lead.tempo_map, clock.lead.end_tick, counting(plan.click))
    clicks = click_cues(plan.score.tempo_map, plan.score.end_tick, replace(plan.click, gap=None))
    for from_ns, until_ns in plan.silences:
        clicks = clicks[(clicks["at_ns"] < from_ns) | (clicks["at_ns"] >= until_ns)]
    clicks = np.concatenate([count, moved_by(clicks, clock.lead_ns)])
    return clicks[clicks["at_ns"] >= 0]
