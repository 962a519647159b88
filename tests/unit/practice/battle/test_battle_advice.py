"""What is said of a battle's turns once they are over: no lean of a few notes, no place of what was not played."""

from dataclasses import replace

import pytest

from station.app.battle.board_words import evidence_of
from station.core.pieces import Piece
from station.drills.library import lesson_rows
from station.music.performance import Performance
from station.practice.battle.battle import Battle
from station.practice.battle.battle_result import BattleResult, JudgedTurn
from station.practice.battle.battle_rules import BattleMode, BattleRules
from station.practice.battle.ground import Ground
from station.practice.battle.judging.improvisation_marks import Component, ComponentMarks, ImprovisationMarks
from station.practice.battle.judging.judged_improvisation import WEIGHTS
from station.practice.battle.phrase import Phrase, Turn
from station.practice.battle.phrase_request import PhraseRequest
from station.practice.battle.records.battle_advice import practise_next
from station.practice.battle.repeating.answer_marks import answer_marks
from station.practice.battle.turn_plan import PlannedTurn, TurnKind
from station.practice.session.device_latency import Latency
from station.scoring.matching.hit_windows import Level
from tests.fakes.played_battle import PlayedBattle, Stroke, hit, phrase, quarters

GROUND = Ground(100.0)
RULES = BattleRules(GROUND, rounds=2, has_final=False)


def eighths(request: PhraseRequest) -> Phrase:
    """Two bars of eighths on the snare: sixteen notes, 300 ms apart."""
    return phrase(request.rules.ground, *((i / 2, Piece.SNARE) for i in range(16)), bars=2)


def time_words(asked: Phrase, late_ms: float, notes: int) -> list[str]:
    """What is said of the time of an answer whose first `notes` are played, so late and 4 ms before or after it."""
    onsets = asked.score.onset_ns.tolist()[:notes]
    hits = [
        hit(onset + round((late_ms + (4 if i % 2 else -4)) * 1e6), Piece(asked.score.notes["piece"][i]))
        for i, onset in enumerate(onsets)
    ]
    marks = answer_marks(asked, Turn(GROUND, asked.bars, Performance.from_hits(hits)), Level.INTERMEDIATE.windows)
    return [one.words for one in evidence_of(marks) if one.title == "Time"]


def test_a_lean_is_told_of_right_notes_that_bear_one() -> None:
    asked = phrase(GROUND, *((i / 2, Piece.SNARE) for i in range(16)), bars=2)
    assert time_words(asked, 10.0, 16) == ["10 ms late on the whole"]
    assert time_words(asked, 10.0, 7) == [], "an interval asks for eight"
    assert time_words(asked, 0.0, 16) == [], "as early as late"
    assert time_words(asked, 100.0, 16) == [], "none of them is right"


def test_next_to_nothing_right_asks_for_something_easier() -> None:
    def elsewhere(turn: PlannedTurn) -> list[Stroke]:
        """Something else: toms between the notes."""
        return [(150.0 + 300.0 * i, Piece.FLOOR_TOM_1) for i in range(16)]

    result = PlayedBattle(Battle(RULES, eighths), elsewhere).until().battle.result()
    (advice,) = practise_next(result)
    assert advice.text == "begin with easier phrases, or a slower tempo such as 85 bpm: 0 of 32 notes were right"
    assert advice.lesson is None


def test_at_the_easiest_step_only_the_tempo_can_be_easier() -> None:
    result = PlayedBattle(Battle(replace(RULES, first_step=0), quarters), lambda turn: []).until().battle.result()
    assert practise_next(result)[0].text == "begin with a slower tempo such as 85 bpm: 0 of 8 notes were right"


def flat_turn(style: str, level: Level) -> BattleResult:
    """A turn whose dynamics are its weakest part."""
    rules = BattleRules(replace(GROUND, style=style), BattleMode.IMPROVISE, level=level)
    components = tuple(ComponentMarks(one, 10.0 if one is Component.DYNAMICS else 90.0, "") for one in Component)
    marks = ImprovisationMarks(components, WEIGHTS)
    return BattleResult(rules, (JudgedTurn(PlannedTurn(0, 1, 1, TurnKind.ANSWER, 0, 4), None, marks),), True, Latency())


@pytest.mark.parametrize("style", ["rock", "jazz", "metal", "funk", "latin"])
@pytest.mark.parametrize("level", list(Level))
def test_loud_and_soft_leads_to_accents(style: str, level: Level) -> None:
    (advice,) = practise_next(flat_turn(style, level))
    tags = {row.name: row.tags for row in lesson_rows()}
    assert advice.lesson is not None
    assert "accents" in tags[advice.lesson]


def test_a_stricter_level_is_offered_a_harder_lesson() -> None:
    offered = [practise_next(flat_turn("rock", level))[0].lesson for level in Level]
    difficulty = {row.name: row.difficulty or 0.0 for row in lesson_rows()}
    asked = [difficulty[name] for name in offered if name is not None]
    assert asked == sorted(asked)
    assert asked[0] < asked[-1]
