"""`station limbs SCORE`: who plays what."""

from dataclasses import dataclass
from pathlib import Path

from station.cli.console import print_json, say, say_infeasible, write
from station.cli.drummer_options import DrumsOptions, assigned, drums_of, led_score
from station.cli.options.option_fields import Command, argument, flag, group, option
from station.core.errors import BadInput
from station.core.labels import limb_name, piece_name
from station.core.pieces import Limb, Piece, word
from station.motion.sticking.limbs import Assignment
from station.music.formats.text_score import TEXT_ENDING, write_text_score
from station.music.score import Score

SCHEMA = "drum-station/limbs/1"


@dataclass(frozen=True, slots=True, kw_only=True)
class LimbsOptions:
    """Whose limbs are printed, and how."""

    score: str = argument("SCORE", "a lesson, a MIDI file, a text score or a take (.capture)", str)
    drums: DrumsOptions = group(DrumsOptions)
    text: Path | None = option(
        f"FILE{TEXT_ENDING}", "write a text score whose limbs can be edited, for every command to read", Path, None
    )
    json: bool = flag("print one JSON document")


def run(options: LimbsOptions) -> int:
    """Assign limbs and print them, or write them as a text score."""
    text = options.text
    if text is not None and text.suffix.lower() != TEXT_ENDING:
        raise BadInput(text, "", f"expected a name that ends in {TEXT_ENDING}")
    score = led_score(options.score, options.drums)
    assignment = assigned(score, drums_of(options.score, options.drums), options.drums)
    if text is not None:
        write_text_score(score, assignment.limbs, text)
        say(f"score    {text}")
    if options.json:
        print_json(_document(score, assignment))
    elif text is None:
        _print(score, assignment)
    say_infeasible(assignment.warnings)
    return 0


def _document(score: Score, assignment: Assignment) -> dict[str, object]:
    notes = [
        {
            "index": i,
            "time_s": round(float(score.onset_s[i]), 6),
            "bar": int(score.bar[i]) + 1,
            "beat": round(_beat(score, i), 4),
            "piece": word(Piece(score.notes["piece"][i])),
            "limb": word(Limb(assignment.limbs[i])),
            "why": assignment.why[i],
        }
        for i in range(len(score))
    ]
    return {"schema": SCHEMA, "method": assignment.method, "notes": notes, "beyond_human": list(assignment.warnings)}


def _print(score: Score, assignment: Assignment) -> None:
    """A line a note: bar:beat, time, piece, limb and reason."""
    for i, why in enumerate(assignment.why):
        place = f"{score.bar[i] + 1}:{_beat(score, i):.2f}"
        piece, limb = piece_name(Piece(score.notes["piece"][i])), limb_name(Limb(assignment.limbs[i]))
        write(f"{place:>9} {score.onset_s[i]:9.3f} s  {piece:16} {limb:11} {why}")


def _beat(score: Score, row: int) -> float:
    """The beat of its bar, from 1, that a note is written on."""
    place = score.tempo_map.position_at(int(score.notes["tick"][row]))
    return 1 + place.beat + place.tick / score.tempo_map.meter_at(int(score.notes["tick"][row])).beat_ticks


COMMAND = Command(LimbsOptions, run)
