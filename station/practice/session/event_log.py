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
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.events import Hit
from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.devices.capture.replay import LoggedText
from station.drills.lesson import Lesson
from station.engine.messages import CUE_DTYPE
from station.motion.kit.kit import DEFAULT_KIT, load_kit
from station.music.score import NOTE_DTYPE, Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap
from station.practice.session.cues.click_pattern import PLAIN, ClickPattern
from station.practice.session.cues.quiet_bars import gap_of
from station.practice.session.device_latency import KitLatency, Latency
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
            return _json({"said": "track", **_section_fields(said.section)})
        case PassBegan():
            fields = {"said": "pass", **_plan_fields(said.plan), "latency": _latency_fields(said.latency)}
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
        **_section_fields(plan.section),
        "landing": _rows(plan.landing),
        "passes_start_ns": plan.passes_start_ns,
        "end_ns": plan.end_ns,
    }


def _section_fields(section: Score) -> dict[str, object]:
    tempo_map = section.tempo_map
    return {
        "notes": _rows(section.notes),
        "tempos": [[change.tick, change.us_per_quarter] for change in tempo_map.tempos],
        "meters": [[change.tick, change.beats, change.unit, *change.groups] for change in tempo_map.meters],
        **({"tempo_is_played": True} if tempo_map.is_played else {}),
        "end_tick": section.end_tick,
    }


def _rows(notes: NDArray[np.void]) -> list[list[float | int | None]]:
    return [_without_nan(row) for row in notes.tolist()]


def _without_nan(row: tuple[float | int, ...]) -> list[float | int | None]:
    return [None if isinstance(value, float) and math.isnan(value) else value for value in row]


def _latency_fields(latency: Latency) -> dict[str, object]:
    kits = {
        name: {"kit_ns": kit.kit_ns, "pads_ns": {str(int(piece)): ns for piece, ns in kit.pads_ns.items()}}
        for name, kit in latency.kits.items()
    }
    return {
        "input_ns": latency.input_ns,
        "output_ns": latency.output_ns,
        "kits": kits,
        "outputs_ns": dict(latency.outputs_ns),
    }


_MOST_TICKS = 2**32
"""So long may what is judged be (our choice: five hours at 120 bpm); what is longer is damage."""
_MOST_LEAD_MS = 10_000.0
"""No grace stroke lies so far from its note."""
_NEWER_COLUMNS = 2
"""The last columns of `NOTE_DTYPE`, swing and timing, are not in older captures, and 0 there."""

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
    keys = ((_whole(at), str(device), _whole(p), _whole(v)) for at, device, p, v in fields["command"])
    return Paused(_whole(fields["strokes"]), _whole(fields["now_ns"]), tuple(keys))


_READERS: Mapping[object, Callable[[dict[str, Any]], Said | Tracked]] = MappingProxyType(
    {
        "pass": lambda said: PassBegan(
            _whole(said["strokes"]), _plan(said), _latency(said["latency"]), bool(said["waits"])
        ),
        "pause": _paused,
        "go_on": lambda said: WentOn(_whole(said["strokes"]), bool(said["asked"]), bool(said["whole"])),
        "end": lambda said: Ended(_whole(said["strokes"]), _whole(said["now_ns"])),
        "unheard": lambda said: WasUnheard(*(_whole(said[key]) for key in ("strokes", "from_ns", "until_ns"))),
        "track": lambda said: Tracked(_section(said)),
    }
)


def _plan(fields: dict[str, object]) -> Plan:
    """As much of the plan as judgement needs: nothing sounds, and nobody demonstrates."""
    section, landing, steps = _section(fields), _landing(fields), _steps(fields)
    passes, start_ns, end_ns = (_whole(fields[key]) for key in ("passes", "passes_start_ns", "end_ns"))
    beat_ticks, tempo_bpm = _whole(fields["beat_ticks"]), float(str(fields["tempo_bpm"]))
    if not (1 <= passes <= MAX_LOOPS and 0 < beat_ticks <= _MOST_TICKS and 0 < tempo_bpm < math.inf):
        raise ValueError
    lesson = Lesson(name=str(fields["lesson"]), title=str(fields["title"]), score=section, beat_ticks=beat_ticks)
    return Plan(
        lesson=lesson,
        kit=load_kit(DEFAULT_KIT),
        tempo_bpm=tempo_bpm,
        section=section,
        score=risen(section.repeated(passes).landing_on(landing), steps),
        first_bar=_whole(fields["first_bar"]),
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
    rows = [_list(row) for row in _list(fields.get("steps", []))]
    steps = tuple(TempoStep(_whole(bar), float(str(tempo_bpm))) for bar, tempo_bpm in rows)
    bars = [step.bar for step in steps]
    are_tempi = all(MIN_TEMPO_BPM <= step.tempo_bpm <= MAX_TEMPO_BPM for step in steps)
    if bars[:1] not in ([], [0]) or bars != sorted(set(bars)) or not are_tempi:
        raise ValueError
    return steps


def _landing(fields: dict[str, object]) -> NDArray[np.void]:
    notes = [_note(_list(row)) for row in _list(fields.get("landing", []))]
    if any(note.tick for note in notes):
        raise ValueError
    return Score.from_notes(notes, TempoMap()).notes


def _section(fields: dict[str, object]) -> Score:
    rows, tempos, meters = (_list(fields[key]) for key in ("notes", "tempos", "meters"))
    tempo_map = TempoMap.build(
        [TempoChange(*map(_whole, _list(change))) for change in tempos],
        [_meter(*map(_whole, _list(change))) for change in meters],
        fields.get("tempo_is_played") is True,
    )
    end_tick, notes = _whole(fields["end_tick"]), [_note(_list(row)) for row in rows]
    if not 0 < end_tick <= _MOST_TICKS or any(not 0 <= note.tick < end_tick for note in notes):
        raise ValueError
    if any(meter.beats > _MOST_TICKS for meter in tempo_map.meters):
        raise ValueError
    return Score.from_notes(notes, tempo_map, end_tick)


def _meter(tick: int, beats: int, unit: int, *groups: int) -> MeterChange:
    if groups and sum(groups) != beats:
        raise ValueError
    return MeterChange(tick, beats, unit, groups)


def _note(row: list[object]) -> Note:
    names = NOTE_DTYPE.names or ()
    newer = [0] * min(len(names) - len(row), _NEWER_COLUMNS)
    value = dict(zip(names, [*row, *newer], strict=True))
    openness, lead_ms, late_ms = value["openness"], value["lead_ms"], value["late_ms"]
    if not isinstance(openness, float | int | None):
        raise TypeError
    if not isinstance(lead_ms, float | int) or not isinstance(late_ms, float | int):
        raise TypeError
    if not (abs(lead_ms) <= _MOST_LEAD_MS and abs(late_ms) <= _MOST_LEAD_MS):
        raise ValueError
    if openness is not None and not 0 <= openness <= 1:
        raise ValueError
    if not 0 <= _whole(value["swing_ticks"]) <= _whole(value["tick"]):
        raise ValueError
    return Note(
        tick=_whole(value["tick"]),
        piece=Piece(_whole(value["piece"])),
        zone=Zone(_whole(value["zone"])),
        velocity=_whole(value["velocity"]),
        articulation=Articulation(_whole(value["articulation"])),
        dynamic=Dynamic(_whole(value["dynamic"])),
        limb=Limb(_whole(value["limb"])),
        openness=openness,
        ornament=Ornament(_whole(value["ornament"])),
        lead_ms=lead_ms,
        duration_ticks=_whole(value["duration_ticks"]),
        choke_ticks=_whole(value["choke_ticks"]),
        midi_note=_whole(value["midi_note"]),
        swing_ticks=_whole(value["swing_ticks"]),
        late_ms=late_ms,
    )


def _latency(fields: dict[str, object]) -> Latency:
    kits, outputs = (_table(fields[key]) for key in ("kits", "outputs_ns"))
    return Latency(
        _whole(fields["input_ns"]),
        _whole(fields["output_ns"]),
        MappingProxyType({name: _kit_latency(_table(kit)) for name, kit in kits.items()}),
        MappingProxyType({name: _whole(ns) for name, ns in outputs.items()}),
    )


def _kit_latency(fields: dict[str, object]) -> KitLatency:
    pads = {Piece(int(piece)): _whole(ns) for piece, ns in _table(fields["pads_ns"]).items()}
    return KitLatency(_whole(fields["kit_ns"]), MappingProxyType(pads))


def _whole(value: object) -> int:
    if not isinstance(value, int) or isinstance(value, bool) or abs(value) >= 2**62:
        raise TypeError
    return value


def _list(value: object) -> list[object]:
    if not isinstance(value, list):
        raise TypeError
    return value


def _table(value: object) -> dict[str, object]:
    if not isinstance(value, dict):
        raise TypeError
    return value
