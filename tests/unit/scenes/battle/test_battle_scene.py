"""The pictures of a battle: who is lit, what moves, what stands below; a kept battle, its film's sound, a replay."""

from dataclasses import replace
from fractions import Fraction
from functools import lru_cache

import numpy as np
import pytest

from station.core.events import Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_S
from station.engine.messages import Bus
from station.motion.kinematics import frame
from station.motion.kinematics.figure import load_figure
from station.music.performance import Performance
from station.music.score import Score
from station.practice.battle.battle_result import BattleResult, JudgedTurn
from station.practice.battle.battle_rules import BattleMode
from station.practice.battle.battle_view import SideView, TurnView
from station.practice.battle.opponents.opponent import OPPONENTS
from station.practice.battle.people.player import Player
from station.practice.battle.phrase import Turn
from station.practice.battle.turn_plan import PlannedTurn, TurnKind
from station.practice.session.device_latency import Latency
from station.render.camera import Camera
from station.render.snapshot import Snapshot
from station.scenes.battle.bar_replay import LEAD_S, BarReplay, ReplayedBar
from station.scenes.battle.battle_film import BattleFilm, battle_cues, film_span
from station.scenes.battle.battle_scene import BattleScene, StageOptions
from station.scenes.battle.cast import cast_of, opponent_body, sides_on_stage
from station.scenes.battle.motion_chain import Body
from tests.unit.scenes.battle.battles_on_stage import BAR_NS, GROUND, RULES, SIDES, all_hits, phrase, turns, view_at

FPS = Fraction(30)
KNOWN = turns(4)
CAST = cast_of(RULES, Body())


@lru_cache(maxsize=1)
def kept() -> BattleScene:
    """The battle as it is filmed; times are asked for in order."""
    scene = BattleScene(RULES, CAST, StageOptions(is_kept=True))
    scene.know(KNOWN)
    return scene


def shown(at_ns: int, scene: BattleScene | None = None) -> Snapshot:
    return (scene or kept()).snapshot(view_at(at_ns, KNOWN, 1), all_hits(KNOWN))


def test_who_plays_is_lit_moves_and_has_the_mark() -> None:
    for index, turn in enumerate(KNOWN):
        snapshot = shown(turn.start_ns + BAR_NS)
        assert snapshot.rival is not None
        assert snapshot.hud.standings is not None
        lights, plays = (snapshot.light, snapshot.rival.light), index % 2
        assert lights == pytest.approx((1 - plays, plays))
        assert [side.is_playing for side in snapshot.hud.standings.sides] == [plays == 0, plays == 1]
        assert turn.phrase is not None
        assert snapshot.score.onset_ns.tolist() == turn.phrase.with_landing.onset_ns.tolist()
        assert snapshot.position_s == pytest.approx(BAR_NS / NS_PER_S)


def test_what_does_not_change_is_the_same_object_from_picture_to_picture() -> None:
    """Whoever draws keeps by identity what they made of score, kit, marks and camera."""
    start = KNOWN[3].start_ns + BAR_NS
    one, other = shown(start + 1_000_000), shown(start + 2_000_000)
    assert one.score is other.score
    assert one.marks is other.marks
    assert one.kit is other.kit
    assert one.camera is other.camera


def test_words_of_standings_count_and_end() -> None:
    scene = BattleScene(RULES, CAST, StageOptions(is_kept=True))
    scene.know(KNOWN)
    counting = shown(-RULES.beat_ns + 1000, scene)
    assert counting.hud.count_in == 4
    assert counting.hud.standings is not None
    left, right = counting.hud.standings.sides
    assert (left.name, right.name) == (OPPONENTS["pocket"].title, "Robin")
    assert (right.points, right.lives, right.most_lives) == ("180.0 points · 0 won", 2, 3)
    over = shown(8 * BAR_NS + NS_PER_S, scene)
    assert over.hud.halt == "Robin wins"
    assert over.rival is not None
    assert (over.light, over.rival.light) == (0.0, 1.0), "the winner is in the light"


def test_the_camera_changes_on_downbeats_alone_and_can_stand_still() -> None:
    scene, fixed = (BattleScene(RULES, CAST, StageOptions(cuts, is_kept=True)) for cuts in (True, False))
    seen: list[tuple[int, Camera | None]] = []
    for tenth in range(80):
        at_ns = tenth * BAR_NS // 10
        view = view_at(at_ns, KNOWN)
        seen.append((tenth, scene._camera(view, (0, 1), at_ns)))
        assert fixed._camera(view, (0, 1), at_ns) == fixed._camera(view, (0, 1), 0)
    changes = [tenth for (tenth, camera), (_, before) in zip(seen[1:], seen, strict=False) if camera != before]
    assert changes
    assert all(tenth % 20 == 0 for tenth in changes), "bars are of 2.4 s: two of them at least"


def test_a_live_player_sits_until_planned_and_answers_what_is_heard() -> None:
    scene = BattleScene(RULES, CAST)
    scene.snapshot(view_at(-BAR_NS, ()), [], -BAR_NS)
    player = scene._movers[1]
    player._coming.result(timeout=60)  # type: ignore[union-attr]
    hits = all_hits(KNOWN)
    first = hits[0].at_ns
    tips = {}
    for at_ns in (first - NS_PER_S, first + 33_000_000, first + 133_000_000):
        past = [hit for hit in hits if hit.at_ns <= at_ns]
        snapshot = scene.snapshot(view_at(at_ns, KNOWN), past)
        assert snapshot.rival is not None
        assert snapshot.rival.pose is not None
        tips[at_ns] = snapshot.rival.pose.row[frame.TIP].copy()
        assert len(snapshot.rival.strikes) == len([hit for hit in past if hit.at_ns > at_ns - 600_000_000])
    places = list(tips.values())
    assert np.abs(places[1] - places[0]).max() > 0.05
    assert np.abs(places[2] - places[1]).max() > 0.02


def test_a_player_away_moves_as_they_are_heard_and_every_stroke_is_of_the_player_here() -> None:
    rules = replace(RULES, mode=BattleMode.IMPROVISE, players=(Player("Ann"), Player("Ben")))
    turn = TurnView(0, 1, 2, TurnKind.CALL, 2 * BAR_NS, 2, phrase(2), None, None)
    scene = BattleScene(rules, cast_of(rules, Body()), StageOptions(away=2))
    stroke = Hit(turn.start_ns + BAR_NS // 2, Piece.SNARE, Zone.HEAD, 100, device="kit")
    sides = (*SIDES, SideView("Ben", False, 0.0, None, 0))
    tips = []
    for share in (0.0, 0.5, 0.6):
        at_ns = turn.start_ns + round(share * BAR_NS)
        snapshot = scene.snapshot(replace(view_at(at_ns, (turn,)), rules=rules, sides=sides), [stroke])
        assert snapshot.rival is not None
        assert snapshot.rival.pose is not None
        assert snapshot.rival.strikes == ()
        for link in scene._movers[2]._chain._links:  # type: ignore[union-attr]
            link.coming.result(timeout=60)
        tips.append(snapshot.rival.pose.row[frame.TIP].copy())
    assert [strike.piece for strike in snapshot.strikes] == [Piece.SNARE]
    assert np.abs(tips[2] - tips[1]).max() > 0.02


def test_strokes_at_one_time_and_late_news_move_all_limbs() -> None:
    """Kick and hi-hat together, and a snare stroke that is told after a later one."""
    scene = BattleScene(RULES, CAST)
    scene.snapshot(view_at(-BAR_NS, ()), [], -BAR_NS)
    player = scene._movers[1]
    player._coming.result(timeout=60)  # type: ignore[union-attr]
    start = KNOWN[1].start_ns
    kick, hat = (Hit(start, piece, Zone.HEAD, 100) for piece in (Piece.KICK, Piece.HIHAT))
    early = Hit(start - 5_000_000, Piece.SNARE, Zone.HEAD, 100)
    view = view_at(start + 50_000_000, KNOWN)
    scene.snapshot(view, [kick, hat], start + 10_000_000)
    scene.snapshot(view, [kick, hat, early], start + 20_000_000)
    struck = [stroke.piece for row in player._figure._strokes.values() for stroke in row]  # type: ignore[union-attr]
    assert sorted(struck) == sorted([Piece.KICK, Piece.HIHAT, Piece.SNARE])


def test_every_opponent_can_stand_there_and_looks_unlike_the_player() -> None:
    for name in OPPONENTS:
        for figure in ("headphones", "curls"):
            player = Body(figure=load_figure(figure))
            body = opponent_body(name, player)
            assert body.figure.look != player.figure.look
            assert body.kit.finish != player.kit.finish
    assert sides_on_stage(RULES, KNOWN, 0) == (0, 1)


def result() -> BattleResult:
    judged = []
    for turn in KNOWN:
        planned = PlannedTurn(
            turn.index, turn.round, turn.side, turn.kind, turn.start_ns // BAR_NS, turn.bars, turn.phrase, step=5
        )
        played = Turn(GROUND, turn.bars, Performance.from_hits(turn.played))
        judged.append(JudgedTurn(planned, played if turn.kind is TurnKind.ANSWER else None, None))
    return BattleResult(RULES, tuple(judged), True, Latency())


def test_a_film_sounds_as_the_battle_did() -> None:
    """Count-in and clicks, every stroke of both phrases with its landing, every stroke of both answers."""
    film = BattleFilm(result(), CAST, film_span(result(), FPS))
    cues = battle_cues(result(), film.span.start_s)
    strokes = cues[cues["bus"] == Bus.DEMONSTRATION]
    written = sum(len(turn.phrase.with_landing) for turn in KNOWN[::2] if turn.phrase is not None)
    assert len(strokes) == written + sum(len(turn.played) for turn in KNOWN)
    clicks = np.sort(cues["at_ns"][cues["bus"] == Bus.CLICK])
    assert len(clicks) == 4 * 9, "one bar of count-in and eight bars"
    assert np.diff(clicks) == pytest.approx(RULES.beat_ns, abs=2)
    assert film.span.start_s == pytest.approx(-BAR_NS / NS_PER_S)
    assert film.span.pictures / FPS == pytest.approx((9 * BAR_NS) / NS_PER_S + 4.0, abs=0.05)


def test_a_replay_shows_the_bar_as_it_was_played_and_slower() -> None:
    """The second bar of the second turn at half its tempo: its first stroke sounds a second after the beginning."""
    turn = KNOWN[1]
    replay = BarReplay(view_at(turn.start_ns, KNOWN), CAST, ReplayedBar(turn, 1, 0.5))
    cues = replay.cues()
    inside = [hit for hit in turn.played if BAR_NS <= hit.at_ns < 2 * BAR_NS]
    assert len(cues) >= len(inside)
    assert np.abs(cues["at_ns"] - LEAD_S / 0.5 * NS_PER_S).min() < 2e6
    snapshot = replay.snapshot(LEAD_S / 0.5)
    assert snapshot.is_replay
    assert snapshot.position_s == pytest.approx(BAR_NS / NS_PER_S)
    assert snapshot.rival is not None
    assert (snapshot.light, snapshot.rival.light) == pytest.approx((0.0, 1.0))
    assert snapshot.rival.pose is not None
    assert replace(snapshot, pose=None).hud.standings is not None
    assert replay.length_s == pytest.approx((0.5 + 2.4 + 0.7) / 0.5)
    assert isinstance(snapshot.score, Score)
