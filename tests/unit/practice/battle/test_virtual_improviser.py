"""Virtual students who improvise: what published work says of novices and experts, and bytes for the engine."""

import numpy as np

from station.core.pieces import Piece
from station.devices.mapping.presets import GENERAL_MIDI_PRESET
from station.practice.battle.ground import Ground
from station.practice.battle.phrase import Turn
from station.practice.battle.virtual_improviser import VirtualImproviser, choosing_at, skill_of
from station.simulation.student_midi import midi_stream
from station.simulation.student_spec import PLAYERS, parse_spec
from station.simulation.virtual_student import VirtualPerformance

_GROUND = Ground(100)


def _turns(word: str, seed: int, count: int = 3) -> list[VirtualPerformance]:
    player = VirtualImproviser(parse_spec(f"{word},seed={seed}"))
    said: list[Turn] = []
    played = []
    for _ in range(count):
        played.append(player.improvise(_GROUND, 4, said=said))
        said.append(Turn(_GROUND, 4, played[-1].performance))
    return played


def test_skill_follows_the_named_players() -> None:
    skills = [skill_of(PLAYERS[name]) for name in ("beginner", "intermediate", "pro")]
    assert skills == sorted(skills)
    assert np.allclose(skills, (0.1, 0.6, 0.9), atol=0.03)
    assert skill_of(parse_spec("seed=1")) == 1.0


def test_novices_have_fewer_bars_in_store_and_slip_more() -> None:
    novice, expert = choosing_at(0.1), choosing_at(0.9)
    assert novice.patterns < expert.patterns
    assert novice.repeats > expert.repeats
    assert novice.slips > expert.slips
    assert novice.accents < expert.accents


def test_experts_use_more_of_the_kit_and_say_more() -> None:
    pieces, strokes = {}, {}
    for word in ("beginner", "pro"):
        turns = [turn for seed in range(4) for turn in _turns(word, seed)]
        pieces[word] = np.mean([len(np.unique(turn.performance.hits["piece"])) for turn in turns])
        strokes[word] = np.mean([len(turn.performance) for turn in turns])
    assert pieces["pro"] > pieces["beginner"] + 1
    assert strokes["pro"] > strokes["beginner"]


def test_novices_repeat_themselves() -> None:
    """Distinct bars of four, by what is written in them."""
    distinct = {}
    for word in ("beginner", "pro"):
        counts = []
        for seed in range(6):
            score = _turns(word, seed, 1)[0].score
            bars = [score.bars(bar, bar).notes[["tick", "piece"]].tobytes() for bar in range(4)]
            counts.append(len(set(bars)))
        distinct[word] = np.mean(counts)
    assert distinct["beginner"] < distinct["pro"]


def test_experts_land_on_the_one() -> None:
    scores = [_turns("pro", seed, 1)[0].score for seed in range(6)]
    landed = [Piece.CRASH_1 in score.notes["piece"][score.notes["tick"] >= 4 * _GROUND.bar_ticks] for score in scores]
    assert sum(landed) >= 4


def test_a_turn_is_bytes_too_and_the_same_for_the_same_seed() -> None:
    first, again, other = _turns("intermediate", 1)[1], _turns("intermediate", 1)[1], _turns("intermediate", 2)[1]
    assert first.performance.hits.tobytes() == again.performance.hits.tobytes()
    assert first.performance.hits.tobytes() != other.performance.hits.tobytes()
    assert len(first.midi) >= len(first.performance)
    assert first.midi == midi_stream(first.performance, GENERAL_MIDI_PRESET)
