"""The battle as a state machine: at 100 beats a minute in 4/4 a beat is 600 ms and a bar 2400 ms, by hand."""

from dataclasses import replace

import numpy as np
import pytest

from station.core.events import DeviceFound, DeviceLost
from station.core.pieces import Piece
from station.core.units import NS_PER_MS
from station.engine.messages import AddCues, Annotate, Bus, EngineEvent, Play, Started, Stop
from station.practice.battle.battle import Battle
from station.practice.battle.battle_rules import BattleRules
from station.practice.battle.battle_view import Doing
from station.practice.battle.ground import Ground
from station.practice.battle.people.handicap import Earlier, expectation
from station.practice.battle.people.player import Player
from station.practice.battle.phrase import Phrase
from station.practice.battle.phrase_request import PhraseRequest
from station.practice.battle.records.battle_document import battle_document
from station.practice.battle.repeating.answer_marks import AnswerMarks
from station.practice.battle.turn_plan import PlannedTurn, TurnKind
from station.scoring.matching.hit_windows import Level
from tests.fakes.played_battle import ZERO_NS, PlayedBattle, Stroke, as_written, nothing, phrase, quarters

BEAT_MS, BAR_MS = 600, 2400
RULES = BattleRules(Ground(100.0), rounds=2, has_final=False)


def answers(played: PlayedBattle) -> list[AnswerMarks]:
    return [turn.marks for turn in played.battle.result().turns if isinstance(turn.marks, AnswerMarks)]


# --- no gap -----------------------------------------------------------------------------------------------------------


def test_bars_run_on_from_the_count_in_to_the_end_without_a_gap() -> None:
    played = PlayedBattle(Battle(RULES, quarters)).until()
    bars = 1 + 2 * 2  # a count-in, and a call and an answer in each round
    expected = [(beat - 4) * BEAT_MS * NS_PER_MS for beat in range(4 * bars)]
    assert np.abs(np.array(played.clicks_ns) - expected).max() <= 1  # a tick's rounding
    assert [type(command) for _, command in played.sent].count(Play) == 1, "the transport is never started anew"


def test_what_sounds_is_sent_well_before_its_time() -> None:
    played = PlayedBattle(Battle(RULES, quarters)).until()
    for sent_ns, command in played.sent:
        if isinstance(command, AddCues):
            heard_ns = ZERO_NS + int(command.cues["at_ns"].min())
            assert heard_ns - sent_ns > 550 * NS_PER_MS, "0.6 s, less a frame"


def test_the_drummers_landing_sounds_on_the_students_first_downbeat() -> None:
    def landing(request: PhraseRequest) -> Phrase:
        return phrase(request.rules.ground, (0, Piece.SNARE), landing=True)

    cues = PlayedBattle(Battle(RULES, landing)).until().cues
    crashes = sorted(cues["at_ns"][(cues["bus"] == Bus.DEMONSTRATION) & (cues["piece"] == Piece.CRASH_1)].tolist())
    assert crashes == [BAR_MS * NS_PER_MS, 3 * BAR_MS * NS_PER_MS]


@pytest.mark.parametrize(("early_ms", "label"), [(0.0, 4), (60.0, 4), (74.0, 3)])
def test_the_first_stroke_may_come_before_the_downbeat_and_is_judged(early_ms: float, label: int) -> None:
    """At the windows of `intermediate` 70 ms are right; half a sixteenth, 75 ms, belongs to the answer."""

    def early(turn: PlannedTurn) -> list[Stroke]:
        return [(ms - (early_ms if ms == 0 else 0), piece) for ms, piece in as_written(turn)]

    marks = answers(PlayedBattle(Battle(RULES, quarters), early).until())
    assert [(one.right, one.answered, one.extras) for one in marks] == [(label, 4, 0)] * 2


def test_a_late_last_stroke_counts_to_its_answer_and_not_to_the_next() -> None:
    rules = replace(RULES, level=Level.BEGINNER)  # 120 ms are right

    def last_moment(request: PhraseRequest) -> Phrase:
        return phrase(request.rules.ground, (0, Piece.SNARE), (3 + 7 / 8, Piece.KICK))  # 75 ms before the bar's end

    def late(turn: PlannedTurn) -> list[Stroke]:
        return [(0.0, Piece.SNARE), (3.875 * BEAT_MS + 100, Piece.KICK)]

    marks = answers(PlayedBattle(Battle(rules, last_moment), late).until())
    assert [(one.right, one.extras) for one in marks] == [(2, 0)] * 2


def test_who_answers_a_beat_late_has_not_answered() -> None:
    def behind(turn: PlannedTurn) -> list[Stroke]:
        return [(ms + BEAT_MS, piece) for ms, piece in as_written(turn)]

    assert [one.right for one in answers(PlayedBattle(Battle(RULES, quarters), behind).until())] == [0, 0]


# --- frames -----------------------------------------------------------------------------------------------------------


def clumsy(turn: PlannedTurn) -> list[Stroke]:
    """Late and early in turn, a stroke too many in every third turn, a note left out of every fifth."""
    strokes = [(ms + 31 * (-1) ** beat - 9, piece) for beat, (ms, piece) in enumerate(as_written(turn))]
    if turn.index % 5 == 0:
        strokes.pop()
    return [*strokes, (700.0, Piece.TOM_1)] if turn.index % 3 == 0 else strokes


def by_step(request: PhraseRequest) -> Phrase:
    """More strokes with every step, so that what is chosen shows."""
    assert request.step is not None
    strokes = 2 + request.step
    return phrase(request.rules.ground, *((4 * n / strokes, Piece.SNARE) for n in range(strokes)))


@pytest.mark.parametrize("frames_per_s", [1.0, 7.0, 60.0, 240.0])
def test_a_battle_is_the_same_at_every_frame_rate(frames_per_s: float) -> None:
    rules = BattleRules(Ground(160.0), rounds=4, lives=9)
    often = PlayedBattle(Battle(rules, by_step), clumsy, 250.0).until().battle
    played = PlayedBattle(Battle(rules, by_step), clumsy, frames_per_s).until().battle
    assert battle_document(played.result()) == battle_document(often.result())
    assert len({turn.step for turn in played.plan}) > 2, "the steps change, or nothing is shown"


def test_the_next_call_is_chosen_a_moment_before_it_begins() -> None:
    asked: list[PhraseRequest] = []

    def listening(request: PhraseRequest) -> Phrase:
        asked.append(request)
        return quarters(request)

    played = PlayedBattle(Battle(RULES, listening), frames_per_s=1000.0)
    chosen_ns = (2 * BAR_MS - 600) * NS_PER_MS + ZERO_NS + played.count_in_ns
    played.until(chosen_ns - 2 * NS_PER_MS)
    assert len(asked) == 1
    played.until(chosen_ns + 2 * NS_PER_MS)
    assert len(asked) == 2
    heard_ms = [hit.at_ns / NS_PER_MS for hit in asked[1].heard[-1].played]
    assert heard_ms == [0.0, 600.0, 1200.0], "the stroke at 1800 ms is still to come"


# --- rounds and lives -------------------------------------------------------------------------------------------------


def test_whoever_never_answers_is_out_after_three_rounds_and_the_drummer_has_won() -> None:
    played = PlayedBattle(Battle(BattleRules(Ground(100.0)), quarters), nothing).until()
    result = played.battle.result()
    assert [turn.planned.kind for turn in result.turns] == [TurnKind.CALL, TurnKind.ANSWER] * 3
    assert result.winner == 0
    assert result.is_complete
    assert result.standings[1].lives == 0
    assert max(played.clicks_ns) < 6 * BAR_MS * NS_PER_MS, "nothing clicks after the end"


def test_whoever_answers_everything_wins_the_final() -> None:
    result = PlayedBattle(Battle(BattleRules(Ground(100.0), rounds=3), by_step)).until().battle.result()
    assert result.winner == 1
    assert result.standings[1].points == pytest.approx(100 * 3 + 200)
    final = result.turns[-1].planned
    assert (final.round, final.step) == (4, max(turn.planned.step or 0 for turn in result.turns))


def test_the_last_life_is_not_lost_before_the_last_stroke_can_have_come() -> None:
    """A life hangs on the stroke at 1800 ms, which nobody has heard when the next call is chosen."""
    rules = BattleRules(Ground(100.0), rounds=2, has_final=False, lives=1, target=0.6)

    def drops_the_second(turn: PlannedTurn) -> list[Stroke]:
        return [stroke for place, stroke in enumerate(as_written(turn)) if place != 1]

    result = PlayedBattle(Battle(rules, quarters), drops_the_second).until().battle.result()
    assert [one.planned.round for one in result.turns] == [1, 1, 2, 2]
    assert result.winner == 1


def test_a_last_life_lost_with_the_last_stroke_ends_the_battle_with_the_call_that_was_chosen() -> None:
    rules = BattleRules(Ground(100.0), lives=1)

    def drops_the_last(turn: PlannedTurn) -> list[Stroke]:
        return as_written(turn)[:-1]

    played = PlayedBattle(Battle(rules, quarters), drops_the_last).until()
    kinds = [turn.planned.kind for turn in played.battle.result().turns]
    assert kinds == [TurnKind.CALL, TurnKind.ANSWER, TurnKind.CALL], "the drummer has the last word"
    assert played.battle.result().winner == 0
    assert any(isinstance(c, Annotate) and "battle_cut" in c.text for _, c in played.sent)


# --- pauses, and what nobody hears ------------------------------------------------------------------------------------


def test_after_a_pause_the_part_is_played_again_from_its_call() -> None:
    battle = Battle(RULES, quarters)
    played = PlayedBattle(battle, nothing)
    played.until(ZERO_NS + played.count_in_ns + (BAR_MS + 500) * NS_PER_MS)
    assert battle.view().doing is Doing.ANSWER
    kept, stop = battle.pause()
    assert isinstance(kept, Annotate)
    assert isinstance(stop, Stop)
    assert battle.view().doing is Doing.PAUSED
    battle.advance(played.now_ns + 60_000 * NS_PER_MS)
    (play,) = battle.resume()
    assert isinstance(play, Play)
    count_in = play.cues[play.cues["at_ns"] < played.count_in_ns]
    assert len(count_in) == 4, "a bar is counted in"
    assert play.cues["at_ns"][play.cues["bus"] == Bus.DEMONSTRATION].tolist() == [
        (BAR_MS + beat * BEAT_MS) * NS_PER_MS for beat in range(4)
    ]
    again_ns = played.now_ns + 61_000 * NS_PER_MS
    battle.handle(Started(again_ns))
    battle.advance(again_ns)
    assert battle.view().doing is Doing.COUNT_IN
    assert battle.at_ns == -BAR_MS * NS_PER_MS
    assert not battle.view().turns[1].played


def test_a_kit_that_is_unplugged_costs_no_life() -> None:
    answer_ns = ZERO_NS + (BAR_MS + BAR_MS) * NS_PER_MS  # after the count-in and the call
    events: list[tuple[int, EngineEvent]] = [
        (0, DeviceFound(0, "kit")),
        (answer_ns - 10**8, DeviceLost(answer_ns - 10**8, "kit")),
        (answer_ns + 3 * 10**9, DeviceFound(answer_ns + 3 * 10**9, "kit")),
    ]
    played = PlayedBattle(Battle(RULES, quarters), nothing, events=events).until()
    marks = answers(played)
    assert [one.accuracy for one in marks] == [None, 0.0]
    assert played.battle.result().standings[1].lives == 2


# --- people -----------------------------------------------------------------------------------------------------------


def test_on_one_kit_players_change_seats_and_hear_the_same_call() -> None:
    rules = replace(RULES, players=(Player("Ann"), Player("Ben")))
    plan = PlayedBattle(Battle(rules, by_step)).until().battle.plan
    call, answer, change = TurnKind.CALL, TurnKind.ANSWER, TurnKind.CHANGEOVER
    assert [(turn.kind, turn.side) for turn in plan] == [
        (call, 0), (answer, 1), (change, 2), (call, 0), (answer, 2),
        (call, 0), (answer, 2), (change, 1), (call, 0), (answer, 1),
    ]  # fmt: skip
    assert plan[0].phrase is plan[3].phrase is plan[4].phrase
    assert plan[2].bars == 4, "8 s are three bars and a third"


def test_on_two_kits_each_is_judged_by_their_own_device() -> None:
    players = (Player("Ann", "TD-17"), Player("Ben", "nitro"))
    rules = replace(RULES, players=players, lives=9)

    def plays(turn: PlannedTurn) -> list[Stroke]:
        return as_written(turn) if turn.side == 1 else nothing(turn)

    battle = PlayedBattle(Battle(rules, quarters), plays, device=lambda _: "Roland TD-17 MIDI 1").until().battle
    assert [turn.side for turn in battle.plan if turn.kind is TurnKind.ANSWER] == [1, 2, 2, 1]
    result = battle.result()
    assert [side.points for side in result.standings] == [0, 200, 0]
    assert result.winner == 1


@pytest.mark.parametrize("devices", [("", ""), ("TD-17", "nitro")])
def test_with_a_handicap_each_is_called_phrases_of_their_own_step_the_final_too(devices: tuple[str, str]) -> None:
    players = (Player("Kid", devices[0]), Player("Mum", devices[1]))
    known = [expectation([Earlier(step, True, 95.0), Earlier(step + 2, False, 70.0)] * 10, []) for step in (1, 15)]
    rules = replace(RULES, players=players, expectations=tuple(known), has_final=True)
    played = PlayedBattle(Battle(rules, by_step), device=lambda turn: devices[turn.side - 1] or "kit")
    plan = [turn for turn in played.until().battle.plan if turn.kind is not TurnKind.CHANGEOVER]
    assert [turn.kind for turn in plan] == [TurnKind.CALL, TurnKind.ANSWER] * 6
    assert [turn.side for turn in plan[1::2]] == [1, 2, 2, 1, 1, 2]
    for call, answer in zip(plan[::2], plan[1::2], strict=True):
        assert answer.phrase is call.phrase
        assert abs((answer.step or 0) - (1, 15)[answer.side - 1]) <= 2
    assert [worth.handicapped for worth in played.battle.result().standings[1:]] == [100, 100], "all right beats 95"


def test_a_player_alone_with_lives_has_won_when_the_round_is_over() -> None:
    rules = replace(RULES, players=(Player("Ann", "a"), Player("Ben", "b")), lives=1, rounds=8)
    played = PlayedBattle(Battle(rules, quarters), lambda turn: as_written(turn) if turn.side == 2 else [])
    played.device = lambda _: "b"
    result = played.until().battle.result()
    assert result.winner == 2
    assert [turn.planned.round for turn in result.turns] == [1, 1, 1]


def test_equal_players_draw() -> None:
    rules = replace(RULES, players=(Player("Ann"), Player("Ben")))
    assert PlayedBattle(Battle(rules, quarters)).until().battle.result().winner is None


def test_the_view_tells_what_goes_on() -> None:
    played = PlayedBattle(Battle(RULES, quarters))
    assert played.battle.view().doing is Doing.WAITING
    played.until(ZERO_NS + 100 * NS_PER_MS)
    assert played.battle.view().doing is Doing.COUNT_IN
    played.until(ZERO_NS + 3 * BAR_MS * NS_PER_MS - 300 * NS_PER_MS)  # the last beat of the first answer
    view = played.battle.view()
    assert (view.doing, view.turn, view.round) == (Doing.ANSWER, 1, 1)
    assert len(view.turns[1].played) == 4
    assert len(view.turns[1].judged) == 4
    assert view.turns[2].kind is TurnKind.CALL, "the next turn is known"
    assert view.turns[1].phrase is view.turns[0].phrase
    done = played.until().battle.view()
    assert (done.doing, done.winner) == (Doing.OVER, 1)
    assert [side.is_drummer for side in done.sides] == [True, False]
