"""The quality that is found on machines made of numbers: what a picture takes them at each level, in milliseconds."""

import random
from itertools import pairwise

import pytest

from station.render.quality_choice import QualityChoice, first_choice

GPU = "NVIDIA H200/PCIe/SSE2"
FRAMES = 5000


def levels(costs_ms: tuple[float, ...], renderer: str = GPU, noise: float = 0.2, frames: int = FRAMES) -> list[int]:
    """The level of each picture; now and then one takes 60 ms, for another program."""
    dice, choice, seen = random.Random(1), first_choice(renderer, len(costs_ms)), []
    for _ in range(frames):
        seen.append(choice.level)
        took = 60.0 if dice.random() < 0.02 else costs_ms[choice.level] * dice.uniform(1 - noise, 1 + noise)
        choice = choice.drawn(took if choice.wants_time else None)
    return seen


def changes(seen: list[int]) -> int:
    return sum(one != other for one, other in pairwise(seen))


@pytest.mark.parametrize(
    ("costs_ms", "level"),
    [((0.5, 1.0, 2.0), 2), ((1.5, 4.0, 9.0), 2), ((3.0, 9.0, 20.0), 1), ((3.0, 40.0, 90.0), 0), ((8.0, 9.0, 10.0), 0)],
)
def test_the_highest_level_that_is_in_time_is_found_and_kept(costs_ms: tuple[float, ...], level: int) -> None:
    seen = levels(costs_ms)
    assert seen[1500:] == [level] * (FRAMES - 1500)
    assert costs_ms[level] < 1000 / 60


@pytest.mark.parametrize("costs_ms", [(4.4, 11.0, 12.0), (4.5, 4.5, 4.5), (2.0, 10.9, 11.1)])
def test_on_the_edge_it_does_not_go_to_and_fro(costs_ms: tuple[float, ...]) -> None:
    assert changes(levels(costs_ms)) <= 4


def test_without_a_graphics_card_nothing_dear_is_tried() -> None:
    assert set(levels((3.0, 150.0, 300.0), "llvmpipe (LLVM 15.0.7, 256 bits)")) == {0}


def test_a_machine_that_gets_slower_steps_down() -> None:
    """Another program takes the graphics card: from 5 to 20 ms, and 9 a level below."""
    choice = QualityChoice(level=2, highest=2)
    for _ in range(400):
        took_ms = {2: 20.0, 1: 9.0}[choice.level]
        choice = choice.drawn(took_ms if choice.wants_time else None)
    assert choice.level == 1


def test_while_somebody_plays_nothing_changes() -> None:
    choice = first_choice(GPU, 3)
    for _ in range(1000):
        choice = choice.drawn(1.0 if choice.wants_time else None, may_change=False)
    assert choice.level == 0


def test_few_pictures_are_waited_for() -> None:
    choice, waited = QualityChoice(2, 2), 0
    for _ in range(FRAMES):
        waited += choice.wants_time
        choice = choice.drawn(8.0 if choice.wants_time else None)
    assert waited < 0.05 * FRAMES
