"""All of a drummer's craft in one place, as the report shows it."""

from collections.abc import Mapping
from dataclasses import dataclass

from station.core.pieces import Ornament
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.alignment import Alignment
from station.scoring.craft.cymbals import Chokes, Hats, chokes, hats
from station.scoring.craft.feel import Fills, Lean, Swing, fills_against_groove, leans, swing
from station.scoring.craft.gaps import Gaps, Silences, gaps
from station.scoring.craft.keeper import Keeper, keeper
from station.scoring.craft.ornaments import Ornaments, ornaments
from station.scoring.craft.rolls import BuzzRolls, OpenRolls, buzz_rolls, open_rolls
from station.scoring.craft.shades import Shades, shades
from station.scoring.craft.together import Together, together
from station.scoring.craft.untold import KitFacts
from station.scoring.habits import Habits
from station.scoring.points import Feel


@dataclass(frozen=True, eq=False)
class Craft:
    """Each is None where the score asks for nothing of the kind; `shades` where the input hears no loudness."""

    leans: tuple[Lean, ...]
    swing: Swing | None
    fills: Fills | None
    together: Together | None
    keeper: Keeper
    gaps: Gaps | None
    open_rolls: OpenRolls | None
    buzz_rolls: BuzzRolls | None
    ornaments: Mapping[Ornament, Ornaments]
    hats: Hats | None
    chokes: Chokes | None
    shades: Shades | None


@dataclass(frozen=True, slots=True)
class Circumstances:
    """What was asked and where: the feel that is free, when the click was silent, what the kit is and hears."""

    feel: Feel
    silences: Silences
    kit: KitFacts
    hears_velocity: bool


def craft(
    score: Score, performance: Performance, alignment: Alignment, found: Habits, circumstances: Circumstances
) -> Craft:
    """All that can be told."""
    feel = circumstances.feel
    return Craft(
        leans=leans(found, feel),
        swing=swing(score, alignment, found, feel),
        fills=fills_against_groove(score, alignment),
        together=together(score, alignment),
        keeper=keeper(score, performance, alignment),
        gaps=gaps(score, alignment, circumstances.silences),
        open_rolls=open_rolls(score, performance, alignment),
        buzz_rolls=buzz_rolls(score, performance, alignment),
        ornaments=ornaments(score, performance, alignment),
        hats=hats(score, performance, alignment),
        chokes=chokes(score, performance, alignment, circumstances.kit.tells_chokes),
        shades=shades(score, performance, alignment, found.effects.get("left_level"))
        if circumstances.hears_velocity
        else None,
    )
