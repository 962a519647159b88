"""`station limbs SCORE`: who plays what."""

import argparse
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.app.commands.output import print_json, say, say_beyond
from station.app.commands.scores import TEXT_ENDING, load_led_score
from station.core.errors import BadInput
from station.core.pieces import Limb, Piece, word
from station.music.score import Score

SCHEMA = "drum-station/limbs/1"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add this command's words."""
    from station.motion.limbs import METHODS

    parser.add_argument("score", metavar="SCORE", help="a lesson, a MIDI file or a text score")
    parser.add_argument("--method", choices=METHODS, default=METHODS[0], help="how limbs are assigned (%(default)s)")
    parser.add_argument("--kit", default="", metavar="NAME", help="the drummer's kit: a shipped name or a file")
    parser.add_argument(
        "--as-written", action="store_true", help="on a left-handed kit, do not change the sides of a lesson's sticking"
    )
    parser.add_argument("--text", type=Path, metavar="FILE.txt", help="write a text score whose limbs can be edited")
    parser.add_argument("--json", action="store_true", help="print one JSON document")


def run(arguments: argparse.Namespace) -> int:
    """Assign limbs and print them."""
    from station.motion.kit import DEFAULT_KIT, load_kit
    from station.motion.limbs import assign_limbs

    kit = load_kit(arguments.kit or DEFAULT_KIT)
    score = load_led_score(arguments.score, kit, arguments.as_written)
    assigned = assign_limbs(score, kit, method=arguments.method)
    if arguments.text is not None:
        _write_text(score, assigned.limbs, arguments.text)
    rows = [
        {
            "index": i,
            "time_s": round(float(score.onset_s[i]), 6),
            "piece": word(Piece(score.notes["piece"][i])),
            "limb": word(Limb(assigned.limbs[i])),
            "why": assigned.why[i],
        }
        for i in range(len(score))
    ]
    if arguments.json:
        print_json(
            {"schema": SCHEMA, "method": assigned.method, "notes": rows, "beyond_human": list(assigned.warnings)}
        )
    else:
        for row in rows:
            print(f"{row['index']:6d} {row['time_s']:10.3f} s  {row['piece']:14} {row['limb']:11} {row['why']}")
    say_beyond(assigned.warnings)
    return 0


def _write_text(score: Score, limbs: NDArray[np.int8], path: Path) -> None:
    from station.motion.text_score import write_text_score

    if path.suffix.lower() != TEXT_ENDING:
        raise BadInput(path, "", f"expected a name that ends in {TEXT_ENDING}")
    write_text_score(score, limbs, path)
    say(f"score    {path}")
