"""Draws the pictures of the documentation anew: `python docs/pictures/make.py`."""

from pathlib import Path

import numpy as np
from paper_picture import page_pixels

from station.core.pieces import Piece
from station.drills.library import find_lesson
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import figure_of
from station.motion.kit.kit import load_kit
from station.music.judgement import Label
from station.render.camera import NamedView
from station.render.files.png_file import write_png
from station.render.framing import named
from station.render.notation.page.sheet import PAPERS, sheet
from station.render.picture import PictureMaker
from station.render.quality import QUALITIES
from station.render.report.report_picture import draw_report_png
from station.render.report.result_facts import ResultWords, result_facts
from station.render.snapshot import Hud, SeenStrike, Snapshot, TimingCue, no_marks
from station.scenes.sheets import lesson_labels
from station.scoring.matching.hit_windows import DEFAULT_LEVEL

SIZE = (960, 540)
HERE = Path(__file__).parent
LESSON = "rock-2"
SHEET = "rock-endings-1"
POSITION_S = 4.05


def main() -> None:
    """A demonstration from the front, a pass from the drummer's eyes, a result, a sheet."""
    draw_sheet(SHEET)
    lesson = find_lesson(LESSON)
    score = lesson.loop_score.repeated(3)
    kit, figure = load_kit(), figure_of()
    drummer = Drummer(score, kit, figure)
    random = np.random.default_rng(5)
    late_ns = random.normal(4e6, 16e6, len(score)).astype(np.int64)
    marks = no_marks(score)
    played = score.onset_s < POSITION_S
    marks["label"][played], marks["asynchrony_ms"][played] = Label.MATCH, late_ns[played] / 1e6
    marks["label"][np.flatnonzero(played)[-6]] = Label.MISS
    place = lesson.loop_score.tempo_map.position_at(
        int(score.tempo_map.ticks_at(POSITION_S)) % lesson.loop_score.end_tick
    )
    where = (place.bar + 1, place.beat + 1, 4, lesson.loop_score.bar_count, lesson.beats_a_minute)
    hud = Hud(lesson.title, "Demonstration", *where)
    snapshot = Snapshot(score, POSITION_S, kit, figure, drummer.pose(POSITION_S), drummer.assignment.limbs, hud=hud)
    maker = PictureMaker(SIZE, QUALITIES[1])
    write_png(maker.draw(snapshot, named(NamedView.FRONT)), HERE / "demonstration.png")
    hud = Hud(lesson.title, "Pass 1 of 3", *where, None, 18, 19, "", TimingCue.LATE, 0.2)
    passing = Snapshot(
        score,
        POSITION_S,
        kit,
        figure,
        drummer.pose(POSITION_S),
        drummer.assignment.limbs,
        marks,
        strikes=(SeenStrike(Piece.SNARE, 100, 0.02),),
        hud=hud,
    )
    write_png(maker.draw(passing, named(NamedView.EYES)), HERE / "pass.png")
    label = np.where(random.random(len(score)) < 0.05, Label.MISS, Label.MATCH).astype(np.uint8)
    words = ResultWords(
        lesson.title,
        "3 passes of bars 1–2 at 84 bpm",
        86.0,
        ("Nothing stands out: raise the tempo.",),
    )
    right = (label == Label.MATCH) & (np.abs(late_ns) <= 1e6 * DEFAULT_LEVEL.edges_ms[-1])
    draw_report_png(result_facts(score, label, late_ns, right, np.empty(0), words), HERE / "result.png", (960, 600))


def draw_sheet(name: str) -> None:
    """The first page of a lesson's sheet."""
    lesson = find_lesson(name)
    score, size = lesson.played_once, PAPERS["a4"]
    words = lesson_labels(lesson, (0, score.bar_count - 1))
    write_png(page_pixels(sheet(score, words, size)[0], size, 1.25), HERE / "sheet.png")


if __name__ == "__main__":
    main()
