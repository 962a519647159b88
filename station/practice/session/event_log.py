"""What a session has written into its capture beside the bytes, so that the capture alone can be judged again.

Each text is one JSON object: `said` (`pass`, `pause`, `go_on`, `end`, `unheard`, `track`), and `strokes`, how many strokes and grabbed
cymbals the session had heard since the capture began (or went on in another engine's hand). By that count, and not by
the clock, a text has its place among the strokes: the session heard them later than the engine did.

| `said` | besides |
|---|---|
| `pass` | what is to be played and judged: `lesson`, `title`, `tempo_bpm`, `beat_ticks`, `first_bar`, `passes`, `click`, `gap` (as `quiet_bars.gap_of` reads it, null without one), `steps` (bar and tempo, where it rises), `level`, `notes` (rows of `NOTE_DTYPE`, without `swing_ticks` in old captures), `tempos`, `meters`, `end_tick` of one pass, `landing` (rows; none in old captures), `passes_start_ns`, `end_ns`; `latency`, `waits` |
| `pause` | `now_ns`, the session time that it knew; `command`: the strokes that asked for it, each as `stroke_key` has it |
| `go_on` | `asked`, `whole`, as `Session.resume` takes them |
| `end` | `now_ns`, the session time at which nothing more was awaited |
| `unheard` | `from_ns`, `until_ns`: the session times between which no stroke could be heard |
| `track` | from here on the sticks are tracked through a section: its `notes`, `tempos`, `meters`, `end_tick`; it stands among the samples where it was heeded, and tells no `strokes` |

The score is kept as it was judged, strokes and tempo, so that a lesson that has changed since changes nothing.
"""  # noqa: E501 - a table

import json
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

import numpy as np

from station.core.errors import BadInput
from station.core.events import Hit
from station.devices.capture.replay import LoggedText
from station.drills.lesson import Lesson
from station.engine.messages import CUE_DTYPE
from station.motion.kit.kit import DEFAULT_KIT, load_kit
from station.music.score import Score
from station.practice.session.cues.click_pattern import PLAIN, ClickPattern
from station.practice.session.cues.quiet_bars import gap_of
from station.practice.session.device_latency import Latency
from station.practice.session.log_values import (
    MOST_TICKS,
    landing_of,
    latency_fields,
    latency_from,
    note_rows,
    rows_in,
    score_fields,
    score_of,
    whole,
)
from station.practice.session.plan import MAX_LOOPS, MAX_TEMPO_BPM, MIN_TEMPO_BPM, Plan
from station.practice.session.rising_tempo import TempoStep, risen
from station.scoring.matching.hit_windows import Level

StrokeKey = tuple[int, str, int, int]
"""A stroke's session time, device, piece and velocity."""


def stroke_key(hit: Hit) -> StrokeKey:
    """What tells one stroke from all others."""
    return hit.at_ns, hit.device, int(hit.piece), hit.velocity


@dataclass(frozen=True, slots=True)
class PassBegan:
    """A session was laid out as `plan` and set going."""

    strokes: int
    plan: Plan
    latency: Latency
    waits: bool


@dataclass(frozen=True, slots=True)
class Paused:
    """It stood still at `now_ns`; the strokes of the `command` were not played to the score."""

    strokes: int
    now_ns: int
    command: tuple[StrokeKey, ...]


@dataclass(frozen=True, slots=True)
class WentOn:
    """It went on, as `Session.resume` says."""

    strokes: int
    asked: bool
    whole: bool


@dataclass(frozen=True, slots=True)
class Ended:
    """It was over, or was stopped, at `now_ns`."""

    strokes: int
    now_ns: int


@dataclass(frozen=True, slots=True)
class WasUnheard:
    """No stroke could be heard between these session times."""

    strokes: int
    from_ns: int
    until_ns: int


Said = PassBegan | Paused | WentOn | Ended | WasUnheard


@dataclass(frozen=True, eq=False)
class Tracked:
    """The sticks are tracked through the model of `section` (`drummed_model.shipped_model`) from here on."""

    section: Score


# --- writing ----------------------------------------------------------------------------------------------------------


def text_of(said: Said | Tracked) -> str:
    """The text as it is kept."""
    match said:
        case Tracked():
            return _json({"said": "track", **score_fields(said.section)})
        case PassBegan():
            fields = {"said": "pass", **_plan_fields(said.plan), "latency": latency_fields(said.latency)}
            fields["waits"] = said.waits
        case Paused():
            fields = {"said": "pause", "now_ns": said.now_ns, "command": [list(key) for key in said.command]}
        case WentOn():
            fields = {"said": "go_on", "asked": said.asked, "whole": said.whole}
        case Ended():
            fields = {"said": "end", "now_ns": said.now_ns}
        case WasUnheard():
            fields = {"said": "unheard", "from_ns": said.from_ns, "until_ns": said.until_ns}
    return _json({**fields, "strokes": said.strokes})


def _json(fields: dict[str, object]) -> str:
    return json.dumps(fields, ensure_ascii=False, allow_nan=False, separators=(",", ":"))


def _plan_fields(plan: Plan) -> dict[str, object]:
    return {
        "lesson": plan.lesson.name,
        "title": plan.lesson.title,
        "tempo_bpm": plan.tempo_bpm,
        "beat_ticks": plan.lesson.beat_ticks,
        "first_bar": plan.first_bar,
        "passes": plan.passes,
        "click": plan.click is not None,
        "gap": None if plan.click is None or plan.click.gap is None else str(plan.click.gap),
        "steps": [[step.bar, step.tempo_bpm] for step in plan.steps],
        "level": plan.level,
        **score_fields(plan.section),
        "landing": note_rows(plan.landing),
        "passes_start_ns": plan.passes_start_ns,
        "end_ns": plan.end_ns,
    }


# --- reading ----------------------------------------------------------------------------------------------------------


def said_in(logged: LoggedText) -> Said | Tracked | None:
    """What a session said; None for what no session of this version says. Raises `BadInput` where it is damaged."""
    try:
        fields = json.loads(logged.text)
        reader = _READERS.get(fields.get("said"))
        return None if reader is None else reader(fields)
    except (ValueError, TypeError, KeyError, AttributeError, OverflowError, RecursionError):
        raise BadInput("capture", f"remark at {logged.at_ns} ns", "it cannot be read") from None


def _paused(fields: dict[str, Any]) -> Paused:
    keys = ((whole(at), str(device), whole(p), whole(v)) for at, device, p, v in fields["command"])
    return Paused(whole(fields["strokes"]), whole(fields["now_ns"]), tuple(keys))


_READERS: Mapping[object, Callable[[dict[str, Any]], Said | Tracked]] = MappingProxyType(
    {
        "pass": lambda said: PassBegan(
            whole(said["strokes"]), _plan(said), latency_from(said["latency"]), bool(said["waits"])
        ),
        "pause": _paused,
        "go_on": lambda said: WentOn(whole(said["strokes"]), bool(said["asked"]), bool(said["whole"])),
        "end": lambda said: Ended(whole(said["strokes"]), whole(said["now_ns"])),
        "unheard": lambda said: WasUnheard(*(whole(said[key]) for key in ("strokes", "from_ns", "until_ns"))),
        "track": lambda said: Tracked(score_of(said)),
    }
)


def _plan(fields: dict[str, object]) -> Plan:
    """As much of the plan as judgement needs: nothing sounds, and nobody demonstrates."""
    section, landing, steps = score_of(fields), landing_of(fields), _steps(fields)
    passes, start_ns, end_ns = (whole(fields[key]) for key in ("passes", "passes_start_ns", "end_ns"))
    beat_ticks, tempo_bpm = whole(fields["beat_ticks"]), float(str(fields["tempo_bpm"]))
    if not (1 <= passes <= MAX_LOOPS and 0 < beat_ticks <= MOST_TICKS and 0 < tempo_bpm < math.inf):
        raise ValueError
    lesson = Lesson(name=str(fields["lesson"]), title=str(fields["title"]), score=section, beat_ticks=beat_ticks)
    return Plan(
        lesson=lesson,
        kit=load_kit(DEFAULT_KIT),
        tempo_bpm=tempo_bpm,
        section=section,
        score=risen(section.repeated(passes).landing_on(landing), steps),
        first_bar=whole(fields["first_bar"]),
        passes=passes,
        segments=(),
        passes_start_ns=start_ns,
        end_ns=end_ns,
        cues=np.zeros(0, CUE_DTYPE),
        click=_click(fields),
        level=Level(str(fields.get("level", Level.INTERMEDIATE))),  # at which all was judged before there was a choice
        landing=landing,
        steps=steps,
    )


def _click(fields: dict[str, object]) -> ClickPattern | None:
    """What clicked, as far as judgement asks: whether it did, and where it fell silent."""
    if not fields["click"]:
        return None
    gap = fields.get("gap")  # old captures tell none
    return PLAIN if gap is None else replace(PLAIN, gap=gap_of(str(gap)))


def _steps(fields: dict[str, object]) -> tuple[TempoStep, ...]:
    """The tempi of the passes where they rose; old captures tell none."""
    rows = [rows_in(row) for row in rows_in(fields.get("steps", []))]
    steps = tuple(TempoStep(whole(bar), float(str(tempo_bpm))) for bar, tempo_bpm in rows)
    bars = [step.bar for step in steps]
    are_tempi = all(MIN_TEMPO_BPM <= step.tempo_bpm <= MAX_TEMPO_BPM for step in steps)
    if bars[:1] not in ([], [0]) or bars != sorted(set(bars)) or not are_tempi:
        raise ValueError
    return steps
