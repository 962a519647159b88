"""What the stage of a battle costs: pictures a second with one drummer and with two, and how long links take to plan.

    python -m benchmarks.battle_stage

One and two drummers are drawn in turn in the same run, so that what else the computer does weighs on both alike.
"""

import time
from dataclasses import replace
from statistics import median

import numpy as np

from station.motion.drummer import Drummer
from station.practice.battle.battle_rules import BattleRules
from station.practice.battle.ground import Ground
from station.practice.battle.opponents.opponent import OPPONENTS
from station.practice.battle.repeating.phrase_to_repeat import phrase_to_repeat
from station.render.framing import Stage, both
from station.render.picture import PictureMaker
from station.render.place import TWO
from station.render.quality import QUALITIES
from station.render.snapshot import OnStage, Snapshot
from station.scenes.battle.cast import cast_of
from station.scenes.battle.motion_chain import Body
from station.scenes.battle.vocabulary import Vocabulary
from station.scenes.pictures import picture_of

SIZE = (1280, 720)
ROUNDS, PICTURES = 4, 60
STEPS = (4, 10, 16, 22)


def main() -> None:
    """Print both tables."""
    ground = Ground()
    cast = cast_of(BattleRules(ground), Body())
    phrases = [phrase_to_repeat(OPPONENTS["pocket"], ground, step, np.random.default_rng(step)).score for step in STEPS]
    for name, bars in (("a first bar", 1), ("two bars", 2), ("four bars", 4)):
        scores = [score.repeated(4).bars(0, bars) for score in phrases]  # and the bar before them
        took = [_seconds(lambda score=score: Drummer(score, cast[0].kit, cast[0].figure)) for score in scores]
        print(f"{name:>12} and the one before: {median(took):.2f} s, {max(took):.2f} s at most")
    print(f"  vocabulary of a player: {_seconds(lambda: Vocabulary.of(cast[1])):.2f} s, once")
    one, other = (Drummer(phrases[1], body.kit, body.figure) for body in (cast[0], cast[1]))
    camera = both([(Stage(who.kit, who.figure), place) for who, place in zip((one, other), TWO, strict=True)])

    def alone(at_s: float) -> Snapshot:
        return picture_of(one, at_s)

    def together(at_s: float, share: float = 0.0) -> Snapshot:
        rival = OnStage(other.kit, other.figure, other.pose(at_s), light=share)
        return replace(alone(at_s), rival=rival, light=1 - share, crowd_beat=2 * at_s, camera=camera)

    maker, second = PictureMaker(SIZE, QUALITIES[0]), PictureMaker(SIZE, QUALITIES[0])
    for number in range(ROUNDS):
        times = [_pictures(maker, alone), _pictures(second, together)]
        rates = [f"{1 / median(each):.0f} ({1 / np.percentile(each, 20):.0f})" for each in times]
        print(f"run {number + 1}: one drummer {rates[0]}, two {rates[1]} pictures a second, median (quickest fifth)")
    fade = [_seconds(lambda k=k: second.draw(together(1 + k / 60, k / 40))) for k in range(41)]
    print(
        f"while light goes over: {1 / median(fade):.0f}; pictures of both ends once, {max(fade) * 1e3:.0f} ms at most"
    )


def _pictures(maker: PictureMaker, of: object) -> list[float]:
    assert callable(of)
    for k in range(3):
        maker.draw(of(1 + k / 60))
    return [_seconds(lambda k=k: maker.draw(of(1 + k / 60))) for k in range(PICTURES)]


def _seconds(work: object) -> float:
    assert callable(work)
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


if __name__ == "__main__":
    main()
