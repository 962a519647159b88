"""Lessons that came from no text, imports and takes, written as files; `lesson_text` gives those of files back.

The text is laid out as `show` does it, and read again before it is given away: whoever gets a text gets the same lesson
back (all strokes but the MIDI numbers that they once came from).
"""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace

from station.core.errors import BadInput
from station.core.pieces import word
from station.core.toml.toml_write import toml_text
from station.core.units import PPQ
from station.drills.grid.grid_writer import LineText, frame_of, with_repeats, write_lines
from station.drills.grid.line_group import MAX_CELLS
from station.drills.grid.lines_from_score import WrittenStroke, graces_of, lines_of, strokes_by_bar
from station.drills.grid.skeletons import GridSetting
from station.drills.grid.stroke_settings import Velocities
from station.drills.lesson import Lesson
from station.drills.reading.lesson_file import parse_lesson
from station.drills.writing.form_text import form_text
from station.drills.writing.lesson_form import FormGrid, LessonForm, form_of
from station.drills.writing.lesson_text import show
from station.drills.writing.score_difference import heard, score_difference
from station.music.grace_strokes import Graces
from station.music.score import Score
from station.music.swing import Swing
from station.music.tempo import TempoChange

_DYNAMICS = ("ghost", "normal", "accent")


def write_lesson(lesson: Lesson, form: LessonForm | None = None) -> str:
    """The text of a lesson file that reads as `lesson`; see `as_written`."""
    return as_written(lesson, form).text


def as_written(lesson: Lesson, form: LessonForm | None = None) -> Lesson:
    """The lesson that is read from the text written of `lesson`, its grids as `form` says, else one for each section.

    Raises `BadInput` for music that the grid cannot write (times between its cells, velocities beside the lesson's
    dynamics, strokes without a letter): see `transcription.transcribe`, which makes a lesson of any part.
    """
    form = form or form_of(lesson)
    parts = [_head(lesson, form), _dynamics(lesson.velocities), _graces(lesson.score), _grids(lesson, form)]
    text = "".join(f"{line}\n" for part in parts for line in part)
    found = parse_lesson(text, lesson.name, lesson.name)
    if (read := found.lesson) is None:
        raise BadInput(lesson.name, "", f"cannot be written as a lesson: {found.faults[0].text}")
    difference = score_difference(lesson.score, read.score)
    if not difference and heard(lesson.beyond).tobytes() != heard(read.beyond).tobytes():
        difference = "what is beyond the player differs"
    if difference:
        raise BadInput(lesson.name, "", f"cannot be written as a lesson: {difference}")
    return replace(read, text=_shown(text))


def _shown(text: str) -> str:
    """A text without fault laid out; as it is where its blanks would make it longer than a lesson may be."""
    shown = show(text)
    is_short = len(shown) <= MAX_CELLS or parse_lesson(shown, "", "").lesson
    return shown if is_short else text


def _head(lesson: Lesson, form: LessonForm) -> list[str]:
    """What an import can know: what the file says of itself, tempo, meter, beat, swing, the form, and a loop."""
    lines = [f"title = {toml_text(lesson.title)}"]
    lines += [f"author = {toml_text(lesson.author)}"] if lesson.author else []
    lines += [f"level = {lesson.level}"] if lesson.level != 1 else []
    lines += [f"tags = [{', '.join(map(toml_text, lesson.tags))}]"] if lesson.tags else []
    lines += [f"about = {toml_text(lesson.about)}"] if lesson.about else []
    lines += [f"tempo_bpm = {number(lesson.beats_a_minute)}", f"meter = {toml_text(lesson.meter)}"]
    lines += [f"beat = {toml_text(note_length(lesson.beat_ticks))}"] if lesson.beat_ticks != PPQ else []
    lines += [f"swing_ratio = {number(lesson.swing.ratio)}"] if lesson.is_swung else []
    if lesson.swing.unit_ticks != Swing().unit_ticks:
        lines += [f"swing_unit = {toml_text(note_length(lesson.swing.unit_ticks))}"]
    if not form.is_as_written:
        lines += [f"form = {toml_text(form_text([form.grids[i].name for i in form.order]))}"]
    first, last = lesson.loop
    lines += [f"loop = [{first + 1}, {last + 1}]"] if lesson.loop != (0, lesson.score.bar_count - 1) else []
    return [*lines, ""]


def _dynamics(velocities: Velocities) -> list[str]:
    usual = Velocities().usual
    lines: list[str] = []
    if velocities.usual != usual:
        lines += ["[dynamics]", *_three(velocities.usual, usual), ""]
    for piece, own in velocities.of_piece.items():
        lines += [f"[dynamics.{word(piece)}]", *_three(own, velocities.usual), ""]
    return lines


def _graces(score: Score) -> list[str]:
    """The grace strokes where they are not the usual ones."""
    graces, usual = asdict(graces_of(score)), asdict(Graces())
    said = [f"{key} = {number(value)}" for key, value in graces.items() if value != usual[key]]
    return ["[graces]", *said, ""] if said else []


def _three(values: tuple[int, int, int], usual: tuple[int, int, int]) -> list[str]:
    return [f"{key} = {v}" for key, v, u in zip(_DYNAMICS, values, usual, strict=True) if v != u]


def _grids(lesson: Lesson, form: LessonForm) -> list[str]:
    single = len(form.grids) == 1 and not form.grids[0].name
    by_bar = strokes_by_bar(lesson.score, lesson.beyond)
    out: list[str] = []
    for i, grid in enumerate(form.grids):
        out += ["[grid]" if single else "[[grid]]"]
        out += [f"name = {toml_text(grid.name)}"] if grid.name else []
        out += [] if grid.like is None else [f"like = {toml_text(form.grids[grid.like].name)}"]
        out += _changes(lesson, grid, form.grids[i - 1 if grid.like is None else grid.like]) if i else []
        model = None if grid.like is None else form.grids[grid.like]
        out += [f"times = {grid.times}"] if grid.times != (1 if model is None else model.times) else []
        out += [*_lines(lesson, grid, model, by_bar), ""]
    return out[:-1]


def _changes(lesson: Lesson, grid: FormGrid, before: FormGrid) -> list[str]:
    """Meter and tempo where they differ from those of the grid that it goes on from."""
    tempo_map = lesson.score.tempo_map
    start, earlier = tempo_map.bar_start(grid.first_bar), tempo_map.bar_start(before.first_bar)
    meter = str(tempo_map.meter_at(start))
    lines = [f"meter = {toml_text(meter)}"] if meter != str(tempo_map.meter_at(earlier)) else []
    rate, old = tempo_map.us_per_quarter_at(start), tempo_map.us_per_quarter_at(earlier)
    return lines + (
        [f"tempo_bpm = {number(TempoChange(0, rate).short_bpm(lesson.beat_ticks / PPQ))}"] if rate != old else []
    )


def _lines(
    lesson: Lesson, grid: FormGrid, model: FormGrid | None, by_bar: Mapping[int, Sequence[WrittenStroke]]
) -> list[str]:
    """The lines of one grid; of a variation those that are not its model's."""
    start = lesson.score.tempo_map.bar_start(grid.first_bar)
    setting = GridSetting(frame_of(lesson.score.tempo_map.meter_at(start), lesson.beat_ticks), lesson.swing)
    lines, rests = _own_lines(grid, model, by_bar)
    silent = f"{'| - ' * grid.bars}|"
    if not lines and model is None:
        return [f'snare = "{silent}"']
    write_lines(lines, grid.bars, setting, grid.first_bar)
    new = [True] + [any(line.bars[i] != line.bars[i - 1] for line in lines) for i in range(1, grid.bars)]
    written = [f'{line.name} = "{with_repeats(line.bars, new)}"' for line in lines]
    timing = [f"timing.{line.name} = [{', '.join(map(number, line.late_ms))}]" for line in lines if line.late_ms]
    return [*written, *(f'{name} = "{silent}"' for name in rests), *timing]


def _own_lines(
    grid: FormGrid, model: FormGrid | None, by_bar: Mapping[int, Sequence[WrittenStroke]]
) -> tuple[list[LineText], list[str]]:
    """The lines that a grid says itself, and the names of its model's lines that it has not."""
    lines = lines_of(by_bar, grid.first_bar, grid.first_bar + grid.bars - 1)
    if model is None:
        return lines, []
    theirs = {line.name: line.marks for line in lines_of(by_bar, model.first_bar, model.first_bar + model.bars - 1)}
    own = [line for line in lines if line.marks != theirs.get(line.name)]
    return own, sorted(theirs.keys() - {line.name for line in lines})


def number(value: float) -> str:
    """A number without needless decimals."""
    return str(int(value)) if value == int(value) else repr(value)


def note_length(ticks: int) -> str:
    """Ticks as a note length such as 1/4 or 3/8."""
    for bottom in (1, 2, 4, 8, 16, 32):
        if ticks * bottom % (4 * PPQ) == 0:
            return f"{ticks * bottom // (4 * PPQ)}/{bottom}"
    raise AssertionError(f"{ticks} ticks are no note length")
