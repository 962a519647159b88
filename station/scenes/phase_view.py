"""A sonified recording as pictures: its plot, and the body that walks beside it."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb
from station.core.units import NS_PER_S
from station.render.palette import INK, INK_SOFT, NIGHT, with_opacity
from station.render.phase.phase_plot import PhaseMark, PhaseTrace, PlotAxes, draw_phase_plot
from station.render.phase.walker import Walker, draw_walker
from station.render.report.report_layout import ReportBox
from station.render.text.atlas import Atlas
from station.render.text.draw_list import DrawList, TypeStyle
from station.render.text.fonts import Face
from station.sync.sonification.sonified import Sonified
from station.sync.sonification.triggers import Trigger, share_of
from station.sync.walking.footfall import Steps
from station.sync.walking.trial import Trial

PAGE = (1280.0, 720.0)
"""Units of a page with a body and its plot."""
FLASH_S = 0.25
"""A trigger shows so long after it sounded (our choice)."""
_EDGE, _HEAD, _BODY = 20.0, 64.0, 430.0


def trace_of(
    told: Sonified,
    triggers: Sequence[Trigger],
    title: str,
    steps: tuple[Steps, Steps] | None = None,
    remark: str = "",
) -> PhaseTrace:
    """What the plot shows: the phase, E_max, what sounded, and where feet came down if that is known."""
    share = np.array([share_of(phase) for phase in told.track.phase_rad.tolist()])
    thresholds = {trigger.limb: trigger.threshold for trigger in triggers}
    marks = [PhaseMark(hit.at_ns / NS_PER_S, hit.limb, thresholds[hit.limb]) for hit in told.hits]
    for limb, foot in zip((Limb.RIGHT_FOOT, Limb.LEFT_FOOT), steps or (), strict=False):
        marks += [PhaseMark(at_s, limb) for at_s in foot.contact_s.tolist()]
    lines = tuple((trigger.threshold, trigger.limb) for trigger in triggers)
    time_s = told.signal.time_s
    return PhaseTrace(title, time_s, share, told.track.quality, told.track.locked, tuple(marks), lines, remark)


@dataclass(frozen=True, slots=True, eq=False)
class WalkingScene:
    """A trial that walks: its joints' `places` (n, joints, 3) at the times of `trace`."""

    walker: Walker
    places: NDArray[np.float64]
    trace: PhaseTrace

    @classmethod
    def of(cls, trial: Trial, trace: PhaseTrace) -> "WalkingScene":
        """The scene of a trial that `trace` is of."""
        return cls(Walker.of(trial.skeleton.names, trial.skeleton.bones), trial.places, trace)

    def still(self, atlas: Atlas, words: str) -> tuple[NDArray[np.void], PlotAxes]:
        """What does not move, drawn once: the heading and the plot; and where its axes lie."""
        draw_list = DrawList(atlas)
        draw_list.text(words, (_EDGE, 42), TypeStyle(24, INK, Face.BOLD))
        left = _EDGE + _BODY + 12
        axes = draw_phase_plot(
            draw_list, self.trace, ReportBox(left, _HEAD, PAGE[0] - _EDGE - left, PAGE[1] - _EDGE - _HEAD)
        )
        return draw_list.shapes(), axes

    def moving(self, atlas: Atlas, axes: PlotAxes, at_s: float) -> NDArray[np.void]:
        """What moves, as it is at a time of the trace: the body, its triggers' light, and the line in the plot."""
        draw_list, trace = DrawList(atlas), self.trace
        place = ReportBox(_EDGE, _HEAD, _BODY, PAGE[1] - _EDGE - _HEAD)
        draw_walker(draw_list, self.walker, self.places_at(at_s), place, self.struck(at_s))
        x = axes.x(at_s)
        high = axes.quality.bottom - axes.phase.top
        if (hidden := axes.phase.right - x) > 1:
            draw_list.box((x + 1, axes.phase.top), (hidden, high), with_opacity(NIGHT, 0.72))
        draw_list.box((x - 1, axes.phase.top), (2, high), INK)
        share = trace.share[self._sample(at_s)]
        draw_list.ellipse((x, axes.y_of_share(float(share))), (5, 5), INK)
        style = TypeStyle(15, INK_SOFT)
        draw_list.text(f"{at_s:.1f} s", (_EDGE + 4, PAGE[1] - _EDGE - 6), style)
        return draw_list.shapes()

    def struck(self, at_s: float) -> dict[Limb, float]:
        """How brightly each foot's last trigger still shows, 1 as it sounds, 0 after `FLASH_S`."""
        found: dict[Limb, float] = {}
        for mark in self.trace.marks:
            if mark.share is not None and 0 <= at_s - mark.at_s < FLASH_S:
                found[mark.limb] = 1 - (at_s - mark.at_s) / FLASH_S
        return found

    def _sample(self, at_s: float) -> int:
        return int(np.clip(np.searchsorted(self.trace.time_s, at_s), 0, len(self.trace.time_s) - 1))

    def places_at(self, at_s: float) -> NDArray[np.float64]:
        """Where the joints are at a time, between two samples by the straight line: (joints, 3)."""
        later = self._sample(at_s)
        before = max(later - 1, 0)
        gap = self.trace.time_s[later] - self.trace.time_s[before]
        part = (at_s - self.trace.time_s[before]) / gap if gap > 0 else 0.0
        places: NDArray[np.float64] = self.places[before] + part * (self.places[later] - self.places[before])
        return places
