"""Lessons that are made: whatever the seed, each is a lesson that two hands and two feet can play, and lands on 1."""

import re
from pathlib import Path

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.pieces import Limb, Piece
from station.drills.difficulty import goal_difficulty
from station.drills.families.family_table import FAMILIES, MAX_BARS, lesson_text
from station.drills.lesson import Lesson
from station.drills.reading.lesson_file import parse_lesson
from station.motion.feasibility.playable import impossible
from station.motion.kit.kit import load_kit
from station.motion.sticking.limbs import assign_limbs

SEEDS = 200
BARS = (1, 2, 3, 4, 8)


def made(family: str, level: int, seed: int, bars: int = 4) -> Lesson:
    reading = parse_lesson(lesson_text(family, level, seed, bars), f"{family} {level} {seed} {bars}", "made")
    assert reading.faults == []
    assert reading.lesson
    return reading.lesson


@pytest.mark.parametrize("family", FAMILIES)
def test_every_seed_is_a_lesson(family: str) -> None:
    for seed in range(SEEDS):
        level, bars = seed % 5 + 1, BARS[seed // 5 % len(BARS)]
        lesson = made(family, level, seed, bars)
        assert lesson.score.bar_count == bars
        assert lesson.level == level
        assert lesson.score.notes["tick"][0] == 0, "it begins, and so its loop lands, on 1"
        assert lesson.target_tempo_bpm >= lesson.tempo_bpm
        loop = lesson.loop_score.repeated(2).at_speed(lesson.target_tempo_bpm / lesson.tempo_bpm)
        assert impossible(loop) == []
        assert len(lesson.about) > 60
        assert len(lesson.landing), "something is struck where the last loop ends"


@pytest.mark.parametrize("family", FAMILIES)
def test_a_higher_level_is_harder_on_average(family: str) -> None:
    means = [np.mean([goal_difficulty(made(family, level, seed)) for seed in range(6)]) for level in range(1, 6)]
    assert (np.argsort(means) == np.arange(5)).sum() >= 3, means  # neighbours may change places
    assert means[0] < means[2] < means[4]


@pytest.mark.parametrize("family", FAMILIES)
def test_the_same_words_give_the_same_text(family: str) -> None:
    assert lesson_text(family, 3, 17, 4) == lesson_text(family, 3, 17, 4)
    assert len({lesson_text(family, 4, seed, 8) for seed in range(20)}) >= 10 or family == "polyrhythms"


def test_the_manual_has_every_family() -> None:
    manual = (Path(__file__).parents[2] / "docs" / "lessons.md").read_text(encoding="utf-8")
    assert re.findall(r"^\| `(\w+)` \| [^|]*\|$", manual.split("## Drills that are made")[1], re.MULTILINE) == [
        *FAMILIES
    ]


def hands(lesson: Lesson) -> str:
    return "".join("RL"[n.limb] for n in lesson.score if n.limb in (Limb.RIGHT_HAND, Limb.LEFT_HAND))


@pytest.mark.parametrize(("level", "most"), [(1, 2), (2, 2), (3, 2), (4, 3), (5, 3)])
def test_permutations_share_the_work_and_keep_runs_short(level: int, most: int) -> None:
    for seed in range(30):
        sticking = hands(made("permutations", level, seed, 1))
        assert sticking.count("R") == sticking.count("L")
        assert not re.search(rf"(R{{{most + 1}}}|L{{{most + 1}}})", sticking * 2)


def test_a_turned_paradiddle_is_a_paradiddle() -> None:
    around = "RLRRLRLL" * 3
    for seed in range(30):
        sticking = hands(made("paradiddles", 4, seed, 1))
        assert len(sticking) == 16
        assert sticking[:8] in around
        assert sticking[8:] in around


@pytest.mark.parametrize("family", ["paradiddles", "linear", "ostinato"])
def test_no_hand_flies_over_the_kit(family: str) -> None:
    """The drummer's own judgement of what limbs can reach in time, at the tempo to reach."""
    for seed in range(10):
        lesson = made(family, 5 - seed % 2, seed, 2)
        loop = lesson.loop_score.repeated(2).at_speed(lesson.target_tempo_bpm / lesson.tempo_bpm)
        assert assign_limbs(loop, load_kit()).warnings == ()


def test_linear_patterns_never_strike_two_at_once_and_leave_no_sixteenth_empty() -> None:
    for seed in range(30):
        ticks = made("linear", 2 + seed % 4, seed, 4).score.notes["tick"].tolist()
        assert len(ticks) == len(set(ticks)) == 64


def test_accents_alternate() -> None:
    assert all(hands(made("accents", 2, seed, 2)) == "RL" * 16 for seed in range(10))


def test_polyrhythms_have_their_number() -> None:
    """The numbers are read from the title, the strokes counted in the score; distances are even."""
    for seed in range(40):
        lesson = made("polyrhythms", seed % 5 + 1, seed, 2)
        over, beats = map(int, re.findall(r"(\d) against (\d)", lesson.title)[0])
        start = lesson.score.tempo_map.bar_start(1)
        by_piece: dict[Piece, list[int]] = {}
        for note in lesson.score:
            if note.tick >= start and note.piece is not Piece.HIHAT_PEDAL:
                by_piece.setdefault(note.piece, []).append(note.tick - start)
        assert sorted(map(len, by_piece.values())) == sorted([over, beats])
        assert all(len(set(np.diff(ticks).tolist())) == 1 for ticks in by_piece.values())


def test_an_ostinato_never_changes() -> None:
    for seed in range(20):
        lesson = made("ostinato", 4, seed, 4)
        for piece in (Piece.KICK, Piece.RIDE, Piece.HIHAT_PEDAL):
            starts = [lesson.score.tempo_map.bar_start(bar) for bar in range(4)]
            bars = [
                {n.tick - s for n in lesson.score if n.piece is piece and n.tick // starts[1] == i}
                for i, s in enumerate(starts)
            ]
            assert all(bar == bars[0] for bar in bars)


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (("ostinati", 2, 1, 4), "did you mean ostinato"),
        (("linear", 0, 1, 4), "expected 1 to 5, found 0"),
        (("linear", 2, 1, MAX_BARS + 1), f"expected 1 to {MAX_BARS}, found {MAX_BARS + 1}"),
    ],
)
def test_what_there_is_not_is_refused(words: tuple[str, int, int, int], says: str) -> None:
    with pytest.raises(BadInput, match=says):
        lesson_text(*words)
