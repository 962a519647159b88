"""A battle that is over as a video to keep, with its sound: the click, the drummer, and the players' own strokes.

Players move as they played: all their strokes are known, so that each is prepared and falls when it sounds. What was
said of an answer while it was played comes on the staff as it did then.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from math import ceil
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_S
from station.practice.battle.battle_cues import count_in_cues, turn_cues
from station.practice.battle.battle_result import BattleResult
from station.practice.session.cues.stroke_cues import in_order, moved_by
from station.render.picture import Shot
from station.render.snapshot import Snapshot
from station.scenes.battle.battle_scene import BattleScene, StageOptions
from station.scenes.battle.kept_views import KeptViews
from station.scenes.battle.motion_chain import Body
from station.scenes.film import FilmSpan, ShowProgress, write_video
from station.scenes.phase_film import cues_of
from station.scenes.soundtrack import Sounds, Soundtrack

_USUAL = StageOptions()
ENDING_S = 4.0
"""The film goes on so long after the last bar: it rings out, and one reads who has won (our choice)."""


def film_span(result: BattleResult, fps: Fraction) -> FilmSpan:
    """All of a battle, from its count-in to the end."""
    ground = result.rules.ground
    start_s = -ground.ns_of_bars(result.rules.count_in_bars) / NS_PER_S
    length_s = KeptViews(result).end_ns / NS_PER_S - start_s + ENDING_S
    return FilmSpan(start_s, ceil(length_s * fps), fps)


@dataclass(frozen=True, eq=False)
class BattleFilm:
    """What is filmed of `result`: its `span`; `cast` has a body for each side (`cast.cast_of`)."""

    result: BattleResult
    cast: Mapping[int, Body]
    span: FilmSpan
    options: StageOptions = _USUAL

    def snapshots(self) -> Iterator[Snapshot]:
        """The pictures at the times of the span, in order."""
        views = KeptViews(self.result)
        scene = BattleScene(self.result.rules, self.cast, replace(self.options, is_kept=True))
        scene.know(views.whole_turns())
        for at_s in self.span.times_s.tolist():
            at_ns = round(at_s * NS_PER_S)
            yield scene.snapshot(views.at(at_ns), views.hits, at_ns)


def battle_cues(result: BattleResult, start_s: float) -> NDArray[np.void]:
    """All that sounds in a battle, counted from `start_s` of it, (n,) of `CUE_DTYPE` in order."""
    rules = result.rules
    parts = [count_in_cues(rules, 0), *(turn_cues(rules, turn.planned) for turn in result.turns)]
    parts.append(cues_of(KeptViews(result).hits, 0.0))
    cues = moved_by(in_order([part for part in parts if len(part)]), -round(start_s * NS_PER_S))
    return cues[cues["at_ns"] >= 0]


def write_battle_film(film: BattleFilm, shot: Shot, sounds: Sounds, path: Path, show: ShowProgress) -> None:
    """The video of a battle at `path`, whole or not at all; raises `DeviceError` without OpenGL, disk or encoder."""
    soundtrack = Soundtrack(battle_cues(film.result, film.span.start_s), sounds)
    write_video(film.snapshots(), film.span, shot, soundtrack, (path, show))
