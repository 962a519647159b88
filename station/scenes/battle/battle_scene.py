"""A battle as pictures: who stands where, how both move, who is in the light, what the camera shows, what is written.

`BattleScene(rules, cast).snapshot(view, hits, now_ns)` is the picture of a battle's view; whoever paints it leaves the
camera to it (`Snapshot.camera`), or puts one of their own in its place. The drummer's motion is planned as turns become
known (`motion_chain`). A player's is their own strokes': live the limbs answer what is heard (`live_figure`); of a
battle that is kept all strokes are known, and they move as the drummer does.

Times are battle time, as in `BattleView`.
"""

from collections.abc import Mapping, Sequence
from concurrent.futures import Future
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.events import Hit
from station.core.named_view import NamedView
from station.core.units import NS_PER_S
from station.motion.kinematics.pose import Pose
from station.motion.kit.kit import Kit
from station.music.as_played import score_as_played
from station.music.performance import Performance
from station.music.score import NOTE_DTYPE
from station.practice.battle.battle_rules import DRUMMER, BattleRules
from station.practice.battle.battle_view import BattleView, Doing, TurnView
from station.practice.battle.turn_plan import TurnKind
from station.render.camera import Camera
from station.render.framing import Stage, both, named, one_of_two
from station.render.place import TWO
from station.render.snapshot import OnStage, SeenStrike, Snapshot
from station.scenes.battle.battle_hud import battle_hud
from station.scenes.battle.camera_plan import Shot, ShotKind, shot_at, shots_of
from station.scenes.battle.cast import Sides, sides_on_stage
from station.scenes.battle.live_figure import LiveFigure
from station.scenes.battle.motion_chain import Body, MotionChain
from station.scenes.battle.stage_light import BOTH, Lights, lights_at
from station.scenes.battle.turn_score import score_fields
from station.scenes.battle.vocabulary import Vocabulary
from station.scenes.session_part import AHEAD
from station.scenes.session_scene import STRIKE_SHOWN_NS, strikes

REMEMBERED_NS = 2 * NS_PER_S
"""A stroke that comes later than that after it was made moves nobody (our choice)."""
WINNERS: Mapping[bool, Lights] = {True: (1.0, 0.0), False: (0.0, 1.0)}


@dataclass(frozen=True, slots=True)
class StageOptions:
    """What may be switched off: cuts of the camera, which then shows both throughout, and the crowd.

    `is_kept`: the battle is over and all strokes are known (`BattleScene.know`), so that players too are planned, each
    link when its time comes. `away` is the side of a player at another station: of them calls alone are known, which
    they play as a drummer does, and every stroke is of the player here.
    """

    cuts: bool = True
    crowd: bool = True
    is_kept: bool = False
    away: int | None = None


class BattleScene:
    """The pictures of one battle by `rules`; `cast` has a body for each side (`cast.cast_of`)."""

    def __init__(self, rules: BattleRules, cast: Mapping[int, Body], options: StageOptions = StageOptions()) -> None:
        self.rules, self.options = rules, options
        self._movers = {
            side: _Drummer(rules, body, options.is_kept)
            if options.is_kept or side in (DRUMMER, options.away)
            else _Player(rules, body, is_alone=options.away is not None)
            for side, body in cast.items()
        }
        self._cameras: dict[tuple[Sides, ShotKind, int | None], Camera] = {}

    def snapshot(self, view: BattleView, hits: Sequence[Hit], now_ns: int | None = None) -> Snapshot:
        """The picture of `view` at battle time `now_ns`, None for the view's own.

        `hits` are the players' strokes in battle time: all of them, or those of the last second or so.
        """
        at_ns = self._time_ns(view, now_ns)
        sides = sides_on_stage(self.rules, view.turns, at_ns)
        for side, mover in self._movers.items():
            mover.take(side, view, hits, at_ns)
        left, right = (self._movers[side] for side in sides)
        lights = self._lights(view, sides, at_ns)
        shown = _shown_turn(view, at_ns)
        return Snapshot(
            **score_fields(self.rules, shown, at_ns),
            kit=left.kit,
            figure=left.figure,
            pose=left.pose(at_ns),
            strikes=self._strikes(view, sides[0], hits, at_ns),
            hud=battle_hud(view, sides, at_ns),
            comes_again=_comes_again(view, shown),
            rival=OnStage(
                right.kit, right.figure, right.pose(at_ns), self._strikes(view, sides[1], hits, at_ns), lights[1]
            ),
            light=lights[0],
            crowd_beat=at_ns / self.rules.beat_ns if self.options.crowd else None,
            camera=self._camera(view, sides, at_ns),
        )

    def know(self, turns: Sequence[TurnView]) -> None:
        """Let all strokes of all `turns` be known from now on, of a battle that is kept."""
        for side, mover in self._movers.items():
            assert isinstance(mover, _Drummer), "whoever is heard live knows nothing beforehand"
            mover.know(side, turns)

    def camera_of(self, shot: Shot, view: BattleView, at_ns: int) -> Camera:
        """The camera of a shot of whoever is on stage then."""
        return self._camera_of(shot, sides_on_stage(self.rules, view.turns, at_ns))

    def cameras(self, view: BattleView) -> Sequence[Camera]:
        """All that the plan may use of who is on stage now, so that whoever paints may prepare them."""
        sides = sides_on_stage(self.rules, view.turns, view.at_ns or 0)
        shots = [Shot(0), *(Shot(0, kind, side) for side in sides for kind in ShotKind if kind is not ShotKind.BOTH)]
        return [self._camera_of(shot, sides) for shot in shots]

    def _time_ns(self, view: BattleView, now_ns: int | None) -> int:
        if now_ns is not None:
            return now_ns
        return -self.rules.ground.ns_of_bars(self.rules.count_in_bars) if view.at_ns is None else view.at_ns

    def _lights(self, view: BattleView, sides: Sides, at_ns: int) -> Lights:
        if view.doing is Doing.OVER:
            return BOTH if view.winner not in sides else WINNERS[view.winner == sides[0]]
        return lights_at(view.turns, sides, at_ns, self.rules.beat_ns)

    def _strikes(self, view: BattleView, side: int, hits: Sequence[Hit], at_ns: int) -> tuple[SeenStrike, ...]:
        """What a player struck a moment ago; the drummer's strokes show in their pose."""
        if side in (DRUMMER, self.options.away):
            return ()
        since_ns = at_ns - STRIKE_SHOWN_NS
        recent = (hit for hit in hits if since_ns <= hit.at_ns <= at_ns)
        is_alone = self.options.away is not None
        return strikes((hit for hit in recent if is_alone or _is_by(view, side, hit)), at_ns)

    # --- the camera ---------------------------------------------------------------------------------------------------

    def _camera(self, view: BattleView, sides: Sides, at_ns: int) -> Camera:
        turn = _turn_at(view, at_ns)
        if not self.options.cuts or turn is None or view.doing not in (Doing.CALL, Doing.ANSWER):
            return self._camera_of(Shot(0), sides)
        ground, rules = self.rules.ground, self.rules
        bar_ns = ground.ns_of_bars(1)
        first_bar = round(turn.start_ns / bar_ns)
        shots = shots_of(turn, first_bar, ground, rules.seed, rules.is_final(turn.round))
        return self._camera_of(shot_at(shots, first_bar + (at_ns - turn.start_ns) // bar_ns), sides)

    def _camera_of(self, shot: Shot, sides: Sides) -> Camera:
        side = shot.side if shot.side in sides else None
        key = sides, ShotKind.BOTH if side is None else shot.kind, side
        if key not in self._cameras:
            self._cameras[key] = self._made_camera(*key)
        return self._cameras[key]

    def _made_camera(self, sides: Sides, kind: ShotKind, side: int | None) -> Camera:
        stages = [Stage(self._movers[each].kit, self._movers[each].figure) for each in sides]
        if side is None:
            return both(list(zip(stages, TWO, strict=True)))
        stage, place = stages[sides.index(side)], TWO[sides.index(side)]
        if kind is ShotKind.FRONT:
            return one_of_two(stage, place)
        return place.camera(named(NamedView.HANDS if kind is ShotKind.HANDS else NamedView.SHOULDER, stage))


class _Drummer:
    """Whoever moves as planned: the drummer, or a player of whom all strokes are known."""

    def __init__(self, rules: BattleRules, body: Body, waits: bool) -> None:
        self._rules, self.figure = rules, body.figure
        self._chain = MotionChain(rules.ground, body, waits)
        self.kit = self._chain.kit
        self._added, self._knows_all = 0, False

    def take(self, side: int, view: BattleView, hits: Sequence[Hit], at_ns: int) -> None:
        """Plan what has become known, and leave what will not be played."""
        del hits, at_ns
        if self._knows_all:
            return
        bar_ns = self._rules.ground.ns_of_bars(1)
        if len(view.turns) < self._added:
            last = view.turns[-1]
            self._chain.cut(round(last.start_ns / bar_ns) + last.bars)
            self._added = len(view.turns)
        self._add(side, view.turns[self._added :])
        self._added = len(view.turns)

    def know(self, side: int, turns: Sequence[TurnView]) -> None:
        """Plan all `turns`; nothing becomes known after that."""
        self._add(side, turns)
        self._knows_all = True

    def _add(self, side: int, turns: Sequence[TurnView]) -> None:
        for turn in turns:
            notes = _notes_of(self._rules, side, turn)
            if len(notes):
                self._chain.add(round(turn.start_ns / self._rules.ground.ns_of_bars(1)), turn.bars, notes)

    def pose(self, at_ns: int) -> Pose:
        """How they are at a battle time."""
        return self._chain.pose(at_ns)


class _Player:
    """Whoever moves as they are heard; they sit still until their vocabulary is planned.

    Every stroke is theirs where they are the only ones here, `is_alone`.
    """

    def __init__(self, rules: BattleRules, body: Body, is_alone: bool) -> None:
        self._is_alone = is_alone
        self._rules, self.figure = rules, body.figure
        self._rest = MotionChain(rules.ground, body)
        self.kit: Kit = self._rest.kit
        self._body = body
        self._coming: Future[Vocabulary] | None = None
        self._figure: LiveFigure | None = None
        self._heard: set[Hit] = set()
        self._told_ns = -(2**62)
        self._expects: int | None = None

    def take(self, side: int, view: BattleView, hits: Sequence[Hit], at_ns: int) -> None:
        """Take in what was struck, and what is expected."""
        if self._figure is None:
            if self._coming is None:  # after the drummer's first phrase was asked for
                self._coming = AHEAD.submit(lambda: Vocabulary.of(self._body))
            if not self._coming.done():
                return
            self._figure = LiveFigure(self._coming.result())
        if at_ns < self._told_ns:  # a part is played again
            self._figure.forget_from(at_ns / NS_PER_S)
        self._told_ns = at_ns
        self._heard = {hit for hit in self._heard if at_ns - REMEMBERED_NS < hit.at_ns <= at_ns}
        for hit in hits:
            is_recent = at_ns - REMEMBERED_NS < hit.at_ns <= at_ns
            if is_recent and hit not in self._heard and (self._is_alone or _is_by(view, side, hit)):
                self._figure.strike(hit.at_ns / NS_PER_S, hit.piece, hit.velocity, hit.limb)
                self._heard.add(hit)
        self._expect(side, view)

    def _expect(self, side: int, view: BattleView) -> None:
        """Expect the phrase that is repeated now or next."""
        assert self._figure is not None
        own = [turn for turn in view.turns if turn.side == side and turn.kind is TurnKind.ANSWER]
        if not own or own[-1].index == self._expects:
            return
        turn, self._expects = own[-1], own[-1].index
        if turn.phrase is not None:
            self._figure.expect(turn.phrase.with_landing, turn.start_ns / NS_PER_S)

    def pose(self, at_ns: int) -> Pose:
        """How they are at a battle time."""
        if self._figure is None:
            return self._rest.pose(at_ns)
        return self._figure.pose(at_ns / NS_PER_S)


# --- what a view says of a time ---------------------------------------------------------------------------------------


def _turn_at(view: BattleView, at_ns: int) -> TurnView | None:
    """The turn that runs then."""
    begun = [turn for turn in view.turns if turn.start_ns <= at_ns]
    return begun[-1] if begun and at_ns < _end_ns(view.rules, begun[-1]) else None


def _shown_turn(view: BattleView, at_ns: int) -> TurnView | None:
    """The turn whose music is shown: that which runs, the first one before it begins, at the end the last one."""
    running = _turn_at(view, at_ns)
    if running is None and view.turns:
        return view.turns[0] if at_ns < view.turns[0].start_ns else view.turns[-1]
    return running


def _end_ns(rules: BattleRules, turn: TurnView) -> int:
    return turn.start_ns + rules.ground.ns_of_bars(turn.bars)


def _comes_again(view: BattleView, shown: TurnView | None) -> bool:
    """Whether the phrase that is shown is played once more in the next turn."""
    if shown is None or shown.phrase is None or shown.index + 1 >= len(view.turns):
        return False
    return view.turns[shown.index + 1].phrase is shown.phrase


def _notes_of(rules: BattleRules, side: int, turn: TurnView) -> NDArray[np.void]:
    """What a side plays in a turn as rows of a score, whose ticks count from the turn's beginning."""
    if side == DRUMMER:
        said = turn.phrase if turn.kind is TurnKind.CALL else turn.keeping
        return np.zeros(0, NOTE_DTYPE) if said is None else said.with_landing.notes
    if turn.side == side and turn.kind is TurnKind.CALL and turn.phrase is not None:
        return turn.phrase.with_landing.notes  # a player at another station, as they were heard
    if turn.side != side or not turn.played:
        return np.zeros(0, NOTE_DTYPE)
    bar_ns = rules.ground.ns_of_bars(1)
    played = score_as_played(Performance.from_hits(turn.played).shifted(bar_ns), rules.ground.tempo_map)
    notes = played.notes.copy()  # a bar later, so that what was early stands in it
    notes["tick"] -= rules.ground.bar_ticks
    return notes


def _is_by(view: BattleView, side: int, hit: Hit) -> bool:
    """Whether a side made a stroke: who plays on its device, and of those who share one whoever sits there."""
    rules = view.rules
    if not rules.player_of(side).plays_on(hit.device):
        return False
    if not rules.is_hot_seat:
        return True
    seats = [turn for turn in view.turns if turn.kind is not TurnKind.CALL]
    begun = [turn.side for turn in seats if turn.start_ns - rules.early_ns <= hit.at_ns]
    return side == (begun[-1] if begun else seats[0].side if seats else 1)
