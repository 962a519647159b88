"""What happens at the bars of a grid, its key `at`: words of the teacher, a camera, a style, a tempo.

`at` is a list of tables, one a line. Bars, beats and repetitions count from 1 in the file and from 0 here.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from station.core.counts import counted
from station.core.expected import TEXT, expects
from station.core.named_view import NamedView
from station.core.pieces import word
from station.core.toml.schema import Field, Fields, checked_values, list_of, number, one_of, optional, title, whole
from station.core.toml.toml_faults import Faults
from station.core.units import PPQ
from station.drills.lesson import BarCue
from station.drills.reading.tempo_marks import TempoMark
from station.motion.style.style_file import style_names
from station.music.tempo import MAX_BPM, MIN_BPM, MeterChange


@dataclass(frozen=True, slots=True)
class GridCue:
    """What happens at `beat` of `bar` of a grid, in repetition `time` (None: in each); `tick` counts from its start.

    `tempo` is None where the tempo stays.
    """

    bar: int
    time: int | None
    tick: int
    say: str
    camera: str
    style: str
    tempo: TempoMark | None

    def is_in(self, repetition: int) -> bool:
        """Whether it happens in that repetition, from 0."""
        return self.time in (None, repetition)

    def at_bar(self, first_bar: int) -> BarCue:
        """The cue in a repetition that begins with the lesson's bar `first_bar`."""
        return BarCue(first_bar + self.bar, self.say, self.camera, self.style)


@dataclass(frozen=True, slots=True)
class GridShape:
    """The bars of one repetition by their meters, how often it is played, and the ticks of the beat of its tempi.

    `is_sure` where they are what the file means: a faulty grid may have more bars than could be read.
    """

    meters: Sequence[MeterChange]
    times: int
    beat_ticks: int
    is_sure: bool = True

    @property
    def bars(self) -> int:
        """How many there are."""
        return len(self.meters)


@expects(TEXT)
def _style(value: object) -> str:
    return one_of(style_names(), "style")(value)


_DOES = ("say", "camera", "style", "tempo_bpm", "tempo_to_bpm")
AT: Fields = {
    "bar": Field(whole(1, 10**6), None, "the bar, such as bar = 2"),
    "beat": optional(whole(1, 10**6)),
    "time": optional(whole(1, 10**6)),
    "say": Field(title, ""),
    "camera": Field(one_of(map(word, NamedView), "view"), ""),
    "style": Field(_style, ""),
    "tempo_bpm": optional(number(MIN_BPM, MAX_BPM)),
    "tempo_to_bpm": optional(number(MIN_BPM, MAX_BPM)),
}
"""The keys of one table of `at`; bars, beats and repetitions are bounded when the grid is known."""


def read_cues(raw: object, shape: GridShape, faults: Faults) -> list[GridCue]:
    """The cues of a grid of this shape, in the order of their ticks; `faults` have paths from `at` down."""
    read = list_of(lambda one: _cue(one, shape), 'a list such as [{bar = 2, say = "Ghosts low"}]')
    nothing: tuple[GridCue, ...] = ()
    cues = nothing if raw is None else faults.attempt(read, raw, nothing, "at")
    _no_two_tempi(cues, faults)
    return sorted(cues, key=lambda cue: cue.tick)


def _cue(raw: object, shape: GridShape) -> GridCue:
    values, faults = checked_values(raw, AT)
    if not faults and not any(values[key] for key in _DOES):
        faults.add((), f"nothing happens here; expected one of {', '.join(_DOES)}")
    if values["beat"] is not None and values["tempo_bpm"] is None and values["tempo_to_bpm"] is None:
        faults.add(("beat",), "words, a camera and a style come with a bar; beat is for tempo_bpm and tempo_to_bpm")
    bar, beat, time = values["bar"] or 1, values["beat"] or 1, values["time"]
    if shape.is_sure and bar > shape.bars:
        faults.add(("bar",), f"the grid has {counted(shape.bars, 'bar')}, found {bar}")
    if shape.is_sure and time is not None and time > shape.times:
        faults.add(("time",), f"the grid is played {counted(shape.times, 'time')}, found {time}")
    meter = shape.meters[min(bar, shape.bars) - 1]
    if shape.is_sure and beat > meter.beats:
        faults.add(("beat",), f"bar {bar} is a {meter} bar of {counted(meter.beats, 'beat')}, found {beat}")
    to_quarters = _quarters(shape.beat_ticks, faults)
    tempo_bpm, tempo_to_bpm = (to_quarters(key, values[key]) for key in ("tempo_bpm", "tempo_to_bpm"))
    faults.check()
    tick = sum(m.bar_ticks for m in shape.meters[: bar - 1]) + (beat - 1) * meter.beat_ticks
    tempo = None if tempo_bpm is tempo_to_bpm is None else TempoMark(tick, tempo_bpm, tempo_to_bpm)
    return GridCue(
        bar - 1, None if time is None else time - 1, tick, values["say"], values["camera"], values["style"], tempo
    )


def _quarters(beat_ticks: int, faults: Faults) -> Callable[[str, float | None], float | None]:
    """Makes quarter notes a minute of beats a minute, or notes that there are none so quick or slow."""

    def quarters(key: str, beats: float | None) -> float | None:
        bpm = None if beats is None else beats * beat_ticks / PPQ
        if bpm is not None and not MIN_BPM <= bpm <= MAX_BPM:
            faults.add((key,), f"{bpm:g} quarter notes a minute; expected {MIN_BPM:g} to {MAX_BPM:g}")
        return bpm

    return quarters


def _no_two_tempi(cues: Iterable[GridCue], faults: Faults) -> None:
    """Note a tempo on the same beat of the same repetition as another."""
    times_of: dict[int, set[int | None]] = {}
    for index, cue in enumerate(cues):
        if cue.tempo is None:
            continue
        before = times_of.setdefault(cue.tick, set())
        if before and (cue.time is None or before & {None, cue.time}):
            faults.add(("at", index), "a tempo stands on this beat already; expected one")
        before.add(cue.time)
