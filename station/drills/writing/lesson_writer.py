"""Lessons that came from no text, imports and takes, written as files; `lesson_text` gives those of files back.

The text is laid out as `show` does it, and read again before it is given away: whoever gets a text gets the same lesson
back (all strokes but the MIDI numbers that they once came from).
"""

from collections.abc import Mapping, Sequence
from dataclasses import asdict

from station.core.errors import BadInput
from station.core.pieces import word
from station.core.toml_write import toml_text
from station.core.units import PPQ
from station.drills.grid.grid_writer import GridSetting, frame_of, with_repeats, write_lines
from station.drills.grid.lines_from_score import WrittenStroke, graces_of, lines_of, strokes_by_bar
from station.drills.grid.stroke_settings import Velocities
from station.drills.lesson import Lesson, Section, tidy_bpm
from station.drills.reading.lesson_file import parse_lesson
from station.drills.writing.lesson_text import show
from station.drills.writing.score_difference import score_difference
from station.music.grace_strokes import Graces
from station.music.score import Score
from station.music.swing import Swing

_DYNAMICS = ("ghost", "normal", "accent")


def write_lesson(lesson: Lesson) -> str:
    """The text of a lesson file that reads as `lesson`.

    Raises `BadInput` for music that the grid cannot write (times between its cells, velocities beside the lesson's
    dynamics, strokes without a letter): see `quantise.quantise_score`, which brings any score onto the grid.
    """
    parts = [_head(lesson), _dynamics(lesson.velocities), _graces(lesson.score), _grids(lesson)]
    text = "".join(f"{line}\n" for part in parts for line in part)
    read = parse_lesson(text, lesson.name, lesson.name)
    if read.lesson is None:
        raise BadInput(lesson.name, "", f"cannot be written as a lesson: {read.faults[0].text}")
    difference = score_difference(lesson.score, read.lesson.score)
    if difference:
        raise BadInput(lesson.name, "", f"cannot be written as a lesson: {difference}")
    return show(text)


def _head(lesson: Lesson) -> list[str]:
    """What an import can know: the title, tempo, meter, beat and swing, and the loop where it is not all."""
    lines = [f"title = {toml_text(lesson.title)}"]
    lines += [f"tempo_bpm = {number(lesson.beats_a_minute)}", f"meter = {toml_text(lesson.meter)}"]
    lines += [f"beat = {toml_text(note_length(lesson.beat_ticks))}"] if lesson.beat_ticks != PPQ else []
    lines += [f"swing_ratio = {number(lesson.swing.ratio)}"] if lesson.is_swung else []
    if lesson.swing.unit_ticks != Swing().unit_ticks:
        lines += [f"swing_unit = {toml_text(note_length(lesson.swing.unit_ticks))}"]
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


def _grids(lesson: Lesson) -> list[str]:
    sections = lesson.sections or (Section("", 0, lesson.score.bar_count - 1),)
    single = len(sections) == 1 and not sections[0].name
    by_bar = strokes_by_bar(lesson.score)
    out: list[str] = []
    for i, section in enumerate(sections):
        out += ["[grid]" if single else "[[grid]]"]
        out += [f"name = {toml_text(section.name)}"] if section.name else []
        out += _changes(lesson, section) if i else []
        out += [*_lines(lesson, section, by_bar), ""]
    return out[:-1]


def _changes(lesson: Lesson, section: Section) -> list[str]:
    """Meter and tempo where they differ from those before the section."""
    tempo_map = lesson.score.tempo_map
    start = tempo_map.bar_start(section.first_bar)
    meter, before = tempo_map.meter_at(start), tempo_map.meter_at(start - 1)
    lines = [f"meter = {toml_text(str(meter))}"] if str(meter) != str(before) else []
    here = next((t for t in tempo_map.tempos if t.tick == start), None)
    return lines + ([f"tempo_bpm = {number(tidy_bpm(here.us_per_quarter, lesson.beat_ticks))}"] if here else [])


def _lines(lesson: Lesson, section: Section, by_bar: Mapping[int, Sequence[WrittenStroke]]) -> list[str]:
    """The lines of one section."""
    start = lesson.score.tempo_map.bar_start(section.first_bar)
    setting = GridSetting(frame_of(lesson.score.tempo_map.meter_at(start), lesson.beat_ticks), lesson.swing)
    lines = lines_of(by_bar, section.first_bar, section.last_bar)
    count = section.last_bar - section.first_bar + 1
    if not lines:
        return [f'snare = "{"| -" * count} |"']
    write_lines(lines, count, setting)
    new = [True] + [any(line.bars[i] != line.bars[i - 1] for line in lines) for i in range(1, count)]
    return [f'{line.name} = "{with_repeats(line.bars, new)}"' for line in lines]


def number(value: float) -> str:
    """A number without needless decimals."""
    return str(int(value)) if value == int(value) else repr(value)


def note_length(ticks: int) -> str:
    """Ticks as a note length such as 1/4 or 3/8."""
    for bottom in (1, 2, 4, 8, 16, 32):
        if ticks * bottom % (4 * PPQ) == 0:
            return f"{ticks * bottom // (4 * PPQ)}/{bottom}"
    raise AssertionError(f"{ticks} ticks are no note length")
