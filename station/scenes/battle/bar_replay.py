"""Instant replay of one bar: how it was really played, stroke by stroke, slower if one likes.

Whoever played it moves as for a film, planned over the bar before, the bar and the one after it; the other sits in the
dark. The picture is of them from the front for the bar's first half and of their hands for the other, or of both from
one camera. It is the same stage, so that whoever paints builds nothing anew.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.core.events import Hit
from station.core.units import NS_PER_S
from station.practice.battle.battle_view import BattleView, Doing, TurnView
from station.practice.session.cues.stroke_cues import moved_by
from station.render.snapshot import Snapshot
from station.scenes.battle.battle_scene import BattleScene, StageOptions
from station.scenes.battle.camera_plan import Shot, ShotKind
from station.scenes.battle.motion_chain import Body
from station.scenes.phase_film import cues_of

_USUAL = StageOptions()
LEAD_S, TAIL_S = 0.5, 0.7
"""The replay begins so long before its bar and ends so long after it, as heard at its speed of 1 (our choice)."""
SLOWER = 0.5
"""The usual speed of a replay (our choice: a hand can be followed)."""


@dataclass(frozen=True, slots=True)
class ReplayedBar:
    """Bar `bar`, from 0, of a turn, at `speed` times its tempo."""

    turn: TurnView
    bar: int
    speed: float = SLOWER


class BarReplay:
    """The pictures and the sound of one bar of the battle of `view`; all its strokes are in the turn."""

    def __init__(
        self, view: BattleView, cast: Mapping[int, Body], what: ReplayedBar, options: StageOptions = _USUAL
    ) -> None:
        self._view, self.what = view, what
        rules, turn = view.rules, what.turn
        bar_ns = rules.ground.ns_of_bars(1)
        self._start_ns = turn.start_ns + what.bar * bar_ns
        self._bar_s = bar_ns / NS_PER_S
        self._options = options
        self._scene = BattleScene(rules, cast, replace(options, is_kept=True))
        self._scene.know((turn,))
        self._hits = [replace(hit, at_ns=hit.at_ns + turn.start_ns) for hit in turn.played]

    @property
    def length_s(self) -> float:
        """How long it lasts."""
        return (LEAD_S + self._bar_s + TAIL_S) / self.what.speed

    def cues(self) -> NDArray[np.void]:
        """What sounds, (n,) of `CUE_DTYPE` counted from the replay's beginning."""
        cues = cues_of(self._within(), 0.0)
        cues = moved_by(cues, round(LEAD_S * NS_PER_S) - self._start_ns)
        cues["at_ns"] = np.rint(cues["at_ns"] / self.what.speed)
        return cues

    def snapshot(self, at_s: float) -> Snapshot:
        """The picture `at_s` seconds after the replay's beginning."""
        at_ns = self._start_ns + round((at_s * self.what.speed - LEAD_S) * NS_PER_S)
        turn = self.what.turn
        shown = replace(self._view, at_ns=at_ns, doing=Doing.ANSWER, turn=0, turns=(turn,), message="", winner=None)
        snapshot = self._scene.snapshot(shown, self._hits, at_ns)
        words = "Replay" if self.what.speed == 1 else f"Replay, {self.what.speed:.0%} of the tempo"
        standings = snapshot.hud.standings
        hud = replace(snapshot.hud, standings=None if standings is None else replace(standings, words=words))
        seen = replace(snapshot, hud=hud, is_replay=True)
        if not self._options.cuts:
            return seen
        half = at_ns >= self._start_ns + round(self._bar_s / 2 * NS_PER_S)
        shot = Shot(0, ShotKind.HANDS if half else ShotKind.FRONT, turn.side)
        return replace(seen, camera=self._scene.camera_of(shot, shown, at_ns))

    def _within(self) -> list[Hit]:
        """The strokes that are heard: those of the bar and of what is seen about it."""
        first_ns = self._start_ns - round(LEAD_S * NS_PER_S)
        last_ns = self._start_ns + round((self._bar_s + TAIL_S) * NS_PER_S)
        return [hit for hit in self._hits if first_ns <= hit.at_ns < last_ns]
