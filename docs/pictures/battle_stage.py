"""Draws the pictures of docs/battle-stage.md: `python docs/pictures/battle_stage.py [FOLDER]`, no screen needed.

A virtual student trades fours with the jazz cat; the battle is kept, and two instants of its film are drawn.
"""

import sys
import tempfile
from fractions import Fraction
from pathlib import Path

from station.core.units import NS_PER_S
from station.practice.battle.battle import Battle
from station.practice.battle.battle_rules import BattleMode, BattleRules
from station.practice.battle.drummed import drummed
from station.practice.battle.ground import Feel, Ground
from station.practice.headless.virtual_battle import battle_virtually
from station.practice.headless.virtual_performers import virtual_performers
from station.render.picture import Shot, draw_png
from station.render.quality import QUALITIES
from station.scenes.battle.battle_film import BattleFilm, film_span
from station.scenes.battle.cast import cast_of
from station.scenes.battle.motion_chain import Body

RULES = BattleRules(Ground(120, feel=Feel.TRIPLET, style="jazz"), BattleMode.IMPROVISE, "jazz", rounds=1)
BARS = {"battle-stage-call.png": 0.6, "battle-stage-answer.png": 6.7}
"""Which bar of the battle each shows, from 0."""


def main(folder: Path) -> None:
    """Draw both."""
    with tempfile.TemporaryDirectory() as home:
        battle = Battle(RULES, drummed)
        battle_virtually(battle, virtual_performers(RULES, ("pro,seed=3",)), Path(home) / "battle.capture")
    result = battle.result()
    film = BattleFilm(result, cast_of(RULES, Body()), film_span(result, Fraction(10)))
    at_s = [bar * RULES.bar_ns / NS_PER_S for bar in BARS.values()]
    for time_s, snapshot in zip(film.span.times_s.tolist(), film.snapshots(), strict=True):
        for name, wanted_s in zip(BARS, at_s, strict=True):
            if abs(time_s - wanted_s) <= 0.05:
                draw_png(snapshot, folder / name, Shot((1280, 720), QUALITIES[2]))
        if time_s > max(at_s) + 0.1:
            return


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent)
