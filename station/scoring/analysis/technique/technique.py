"""All of a drummer's technique in one place, as the report shows it."""

from collections.abc import Mapping
from dataclasses import dataclass

from station.core.pieces import Ornament
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.analysis.habits import Habits
from station.scoring.analysis.points import Feel
from station.scoring.analysis.technique.click_gaps import ClickGaps, Silences, gaps
from station.scoring.analysis.technique.dynamics import PadDynamics, pad_dynamics
from station.scoring.analysis.technique.feel import Fills, HeldSwing, Lean, fills_against_groove, leans, swing
from station.scoring.analysis.technique.openness import Chokes, HihatOpenness, chokes, hats
from station.scoring.analysis.technique.ornaments import Ornaments, ornaments
from station.scoring.analysis.technique.rolls import BuzzRolls, OpenRolls, buzz_rolls, open_rolls
from station.scoring.analysis.technique.synchrony import Synchrony, synchrony
from station.scoring.analysis.technique.wing_kristofferson import WingKristofferson, wing_kristofferson
from station.scoring.matching.alignment import Alignment


@dataclass(frozen=True, eq=False)
class Technique:
    """Each is None where the score asks for nothing of the kind; `shades` where the input hears no loudness."""

    leans: tuple[Lean, ...]
    swing: HeldSwing | None
    fills: Fills | None
    together: Synchrony | None
    keeper: WingKristofferson
    gaps: ClickGaps | None
    open_rolls: OpenRolls | None
    buzz_rolls: BuzzRolls | None
    ornaments: Mapping[Ornament, Ornaments]
    hats: HihatOpenness | None
    chokes: Chokes | None
    shades: PadDynamics | None


@dataclass(frozen=True, slots=True)
class Circumstances:
    """What was asked and where: the feel that is free, when the click was silent, what the kit sends."""

    feel: Feel
    silences: Silences
    tells_chokes: bool | None
    hears_velocity: bool


def technique(
    score: Score, performance: Performance, alignment: Alignment, found: Habits, circumstances: Circumstances
) -> Technique:
    """All that the performance shows."""
    feel = circumstances.feel
    return Technique(
        leans=leans(found, feel),
        swing=swing(score, alignment, found, feel),
        fills=fills_against_groove(score, alignment),
        together=synchrony(score, alignment),
        keeper=wing_kristofferson(score, performance, alignment),
        gaps=gaps(score, alignment, circumstances.silences),
        open_rolls=open_rolls(score, performance, alignment),
        buzz_rolls=buzz_rolls(score, performance, alignment),
        ornaments=ornaments(score, performance, alignment),
        hats=hats(score, performance, alignment),
        chokes=chokes(score, performance, alignment, circumstances.tells_chokes),
        shades=pad_dynamics(score, performance, alignment, found.effects.get("left_level"))
        if circumstances.hears_velocity
        else None,
    )
