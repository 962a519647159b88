"""How drummers play: writes `data/human_playing.json` and, whole phrases, `data/human_phrases.npz`.

    python -m tools.human_playing [--data ../shared/data/gmd]

Measured on the files of the Groove MIDI Dataset that are there (Gillick et al. 2019, CC BY 4.0), read as beats, four
bars at a time.
"""

import argparse
import json
from collections.abc import Sequence
from dataclasses import fields
from pathlib import Path

import numpy as np

from station.core.pieces import Ornament, word
from station.practice.battle.improvising.human_phrases import HUMAN_PHRASES, HumanPhrases, phrases_of
from station.practice.battle.improvising.human_playing import HUMAN_PLAYING
from station.practice.battle.improvising.played_beats import Beats, Instrument
from station.practice.battle.improvising.stroke_place import StrokePlace, places_of, struck_cells
from tools.battle_training.takes import GrooveTake, groove_takes

ENOUGH = 25
"""Fewer strokes of an instrument at a place are measured with those at all its places."""
SOURCE = "Groove MIDI Dataset v1.0.0, Gillick et al. 2019, CC BY 4.0"


def table(takes: Sequence[GrooveTake]) -> dict[str, object]:
    """The whole document."""
    beats = [take.beats for take in takes]
    phrases = [phrase for one in beats for phrase in phrases_of(one)]
    return {
        "source": SOURCE,
        "made_by": "python -m tools.human_playing",
        "takes": len(beats),
        "phrases": len(phrases),
        "strokes": sum(int(one.struck.sum()) for one in beats),
        "strokes_a_beat": round(sum(int(p.struck.sum()) for p in phrases) / sum(map(len, phrases)), 2),
        "velocity": velocity(phrases),
        "ornaments": ornaments(beats),
    }


def velocity(phrases: Sequence[Beats]) -> dict[str, dict[str, int]]:
    """The middle velocity by instrument and place."""
    struck = [struck_cells(phrase) for phrase in phrases]
    instrument = np.concatenate([rows[:, 2] for rows in struck])
    place = np.concatenate([places_of(phrase, rows) for phrase, rows in zip(phrases, struck, strict=True)])
    played = np.concatenate([phrase.velocity[phrase.struck] for phrase in phrases])

    def middle(one: Instrument, where: StrokePlace) -> int:
        is_one = instrument == one
        here = is_one & (place == where)
        return round(float(np.median(played[here if here.sum() >= ENOUGH else is_one])))

    return {one.name.lower(): {where.name.lower(): middle(one, where) for where in StrokePlace} for one in Instrument}


def ornaments(takes: Sequence[Beats]) -> dict[str, float]:
    """Share of the snare's strokes that have each ornament."""
    found = np.concatenate(
        [take.ornament[:, :, Instrument.SNARE][take.struck[:, :, Instrument.SNARE]] for take in takes]
    )
    return {word(one): round(float((found == one).mean()), 4) for one in Ornament if one is not Ornament.NONE}


def main() -> None:
    """Write both files."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=Path, default=Path("../shared/data/gmd"))
    takes = groove_takes(parser.parse_args().data)
    HUMAN_PLAYING.write_text(json.dumps(table(takes), indent=1) + "\n", encoding="utf-8")
    phrases = HumanPhrases.of([(take.ground.beats_a_minute, take.beats) for take in takes])
    np.savez_compressed(HUMAN_PHRASES, **{field.name: getattr(phrases, field.name) for field in fields(phrases)})


if __name__ == "__main__":
    main()
