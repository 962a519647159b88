"""What a page shows and plays of a take, made by `station.scenes.report.take_media`.

Times are seconds of the sound. Ticks count from the start of the practised section, notes as its rows.
"""

from dataclasses import dataclass

Point = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class ShownPass:
    """A pass over the section.

    `ticks` are (time, tick), both rising, straight between; `notes` are (note, time, state), state a word of
    `session_page.NoteState`.
    """

    ticks: tuple[tuple[float, float], ...]
    notes: tuple[tuple[int, float, str], ...]


@dataclass(frozen=True, slots=True)
class ShownStroke:
    """A stroke of the student: when, on which node of the model, its velocity 1–127, and what became of it.

    `state` is that of its note, `extra`, or `free` where nobody counts it.
    """

    time_s: float
    node: str
    velocity: int
    state: str


@dataclass(frozen=True, slots=True)
class ShownView:
    """A place to look from: `eye` and `target` in the model's axes, metres; the angle of view `fov_deg` up and down.

    Pictures that are narrower than `narrow` times as wide as high widen it.
    """

    name: str
    eye: Point
    target: Point
    fov_deg: float
    narrow: float


@dataclass(frozen=True, eq=False)
class ShownTake:
    """A take: `model` a .glb whose animation runs with `sound`, an Ogg file of Opus, `length_s` long.

    `remark` says in words what of the take is shown, and the strokes that no note answers.
    """

    model: bytes
    sound: bytes
    length_s: float
    passes: tuple[ShownPass, ...]
    strokes: tuple[ShownStroke, ...]
    views: tuple[ShownView, ...]
    remark: str = ""
