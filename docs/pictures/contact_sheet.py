"""Draws stills of all that can be chosen, labelled, on one sheet, and a film: `contact_sheet.py --to DIR [--film]`.

What can be chosen (grips, what is held, drummers, kits, styles) is read when it runs, so that whatever is added is
shown. Stills are chosen one by one: each is the one, of many drawn by lot, that shows the most pairs of choices that no
still before it has shown. `--only N` draws a single still again, large.
"""

import argparse
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache
from itertools import combinations
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.pieces import Limb
from station.core.settings import load_settings
from station.drills.library import find_lesson
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import figure_names, load_figure
from station.motion.kinematics.grip import GRIPS, HELD
from station.motion.kinematics.pose import LEFT, RIGHT
from station.motion.kit.kit import kit_names, load_kit
from station.motion.style.style_file import load_style, style_names
from station.render.camera import Camera, NamedView
from station.render.files.png_file import write_png
from station.render.files.video_file import EFFORTS, VideoFormat, VideoSink, video_file
from station.render.framing import Stage, named
from station.render.gpu.gl import RenderTarget, standalone_context
from station.render.gpu.shape_renderer import ShapeRenderer, Transform
from station.render.palette import BRAND, INK, INK_SOFT, NIGHT
from station.render.picture import PictureMaker, Shot
from station.render.quality import QUALITIES
from station.render.render_pool import artist
from station.render.snapshot import Hud, Snapshot
from station.render.text.atlas import Atlas
from station.render.text.draw_list import DrawList, TypeStyle
from station.render.text.fonts import Face
from station.scenes.pictures import picture_of
from station.scenes.soundtrack import Sounds, Soundtrack
from station.sound.samples.load_kit import load_kit as load_sounds

Row = Mapping[str, str]
"""What one still shows: the name that was chosen, by the name of the choice."""

STILLS, COLUMNS = 40, 8
STILL_SIZE, LABEL_HEIGHT = (480, 360), 44
"""Pixels; two lines of label below each still."""
LARGE_SIZE = (1280, 720)
FILM_S, EXCERPTS, FILM_FPS, FILM_SIZE = 60.0, 12, 30, (1280, 720)
_LOTS = 400
"""Candidates a still is chosen from; our choice: more of them cover no more pairs."""
_LESSONS = (
    "rock-2",
    "jazz-ride-1",
    "funk-2",
    "samba-1",
    "double-kick-1",
    "single-paradiddle",
    "rock-fill-2",
    "bossa-1",
    "half-time-shuffle-1",
    "hihat-foot-1",
    "flam-tap",
    "ride-bell-1",
)
"""Slow and fast, all pieces, all limbs."""
_STRIKE, _TOP = "strike", "top"
_SEARCH_S = 0.005
"""How finely the highest place of a stick is looked for."""


def choices() -> dict[str, Sequence[str]]:
    """All that a still may show, by choice."""
    return {
        "lesson": _LESSONS,
        "style": style_names(),
        "kit": kit_names(),
        "drummer": figure_names(),
        "grip": list(GRIPS),
        "held": list(HELD),
        "view": [view.name.lower() for view in NamedView],
        "moment": (_STRIKE, _TOP),
    }


def covering(options: Mapping[str, Sequence[str]], count: int, seed: int = 8) -> list[Row]:
    """`count` rows that can be played and together show as many pairs of choices as can be had."""
    lot = np.random.default_rng(seed)
    seen: set[tuple[tuple[str, str], ...]] = set()
    rows: list[Row] = []
    while len(rows) < count:
        lots = [{name: names[int(lot.integers(len(names)))] for name, names in options.items()} for _ in range(_LOTS)]
        best = max(lots, key=lambda row: len(_pairs(row) - seen))
        try:
            drummer_of(best)
        except BadInput as fault:
            _say(f"not shown: {fault}")
        else:
            rows.append(best)
        seen |= _pairs(best)
    return rows


def _pairs(row: Row) -> set[tuple[tuple[str, str], ...]]:
    return set(combinations(row.items(), 2))


@lru_cache(maxsize=STILLS)
def _drummer(lesson: str, kit: str, figure: str, style: str, held: tuple[str, str, str]) -> Drummer:
    left, right, what = held
    manner = replace(load_style(style), grip_left=left, grip_right=right, held=what)
    return Drummer(find_lesson(lesson).loop_score.repeated(3), load_kit(kit), load_figure(figure), manner)


def drummer_of(row: Row) -> Drummer:
    """Who plays a still; the traditional grip is the left hand's, and the right one's beside it is American."""
    right = "american" if row["grip"] == "traditional" else row["grip"]
    return _drummer(row["lesson"], row["kit"], row["drummer"], row["style"], (row["grip"], right, row["held"]))


def moment_s(drummer: Drummer, moment: str) -> float:
    """When a hand strikes in the second pass, or where its stick is highest before it strikes again."""
    limbs = drummer.assignment.limbs
    hand = LEFT if np.count_nonzero(limbs == Limb.LEFT_HAND) > len(limbs) // 4 else RIGHT
    onsets = drummer.score.onset_s[limbs == (Limb.LEFT_HAND if hand == LEFT else Limb.RIGHT_HAND)]
    first = len(onsets) // 3
    if moment == _STRIKE:
        return float(onsets[first])
    times = np.arange(onsets[first], onsets[first + 1], _SEARCH_S)
    return float(max(times, key=lambda at_s: drummer.pose(float(at_s)).tip_m[hand][2]))


def snapshot_of(row: Row) -> Snapshot:
    """The instant that a still shows, without words over it."""
    drummer = drummer_of(row)
    return replace(picture_of(drummer, moment_s(drummer, row["moment"])), hud=Hud())


# --- the sheet --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Cell:
    """Where a still lies: its upper left corner on the sheet, in pixels."""

    left: int
    top: int


def cells(count: int) -> list[Cell]:
    """Places for `count` stills, row by row."""
    width, height = STILL_SIZE[0], STILL_SIZE[1] + LABEL_HEIGHT
    return [Cell(k % COLUMNS * width, k // COLUMNS * height) for k in range(count)]


def draw_sheet(rows: Sequence[Row], quality: int, path: Path) -> None:
    """All stills, each over its label."""
    places = cells(len(rows))
    size = COLUMNS * STILL_SIZE[0], places[-1].top + STILL_SIZE[1] + LABEL_HEIGHT
    sheet = _labels(rows, places, size)
    maker = PictureMaker(STILL_SIZE, QUALITIES[quality])
    for number, (row, place) in enumerate(zip(rows, places, strict=True), 1):
        still = maker.draw(snapshot_of(row), _camera(row), with_score=False)
        sheet[place.top : place.top + STILL_SIZE[1], place.left : place.left + STILL_SIZE[0]] = still
        _say(f"{number:2} {_label(row)}")
    maker.release()
    write_png(sheet, path)


def _camera(row: Row) -> Camera:
    drummer = drummer_of(row)
    return named(NamedView[row["view"].upper()], Stage(drummer.kit, drummer.figure, drummer.style.stand))


def _label(row: Row) -> str:
    return ", ".join(row.values())


def _labels(rows: Sequence[Row], places: Sequence[Cell], size: tuple[int, int]) -> NDArray[np.uint8]:
    """The sheet with every label and no still, shape (height, width, 3)."""
    ctx = standalone_context()
    with ctx:
        atlas = Atlas()
        target, printer, draw_list = RenderTarget(ctx, size), ShapeRenderer(ctx, atlas), DrawList(atlas)
        for number, (row, place) in enumerate(zip(rows, places, strict=True), 1):
            words = list(row.values())
            x, y = place.left + 8.0, float(place.top + STILL_SIZE[1])
            x += draw_list.text(str(number), (x, y + 18), TypeStyle(17, BRAND, Face.BOLD)) + 8
            draw_list.text(" · ".join(words[:4]), (x, y + 18), TypeStyle(15, INK))
            draw_list.text(" · ".join(words[4:]), (x, y + 36), TypeStyle(15, INK_SOFT))
        target.framebuffer.use()
        target.framebuffer.clear(*NIGHT)
        printer.draw(draw_list.shapes(), Transform(size))
        picture = target.read().copy()
        target.release()
    ctx.release()
    return picture


# --- the film ---------------------------------------------------------------------------------------------------------


def draw_film(rows: Sequence[Row], quality: int, path: Path) -> None:
    """A minute of excerpts, one a row, with their sound."""
    sounds = Sounds(load_sounds(load_settings().drums, _RATE_HZ), None)
    pictures = round(FILM_S * FILM_FPS / len(rows))
    video = VideoFormat(FILM_SIZE, Fraction(FILM_FPS), _RATE_HZ, EFFORTS[quality])
    with video_file(path, video) as sink:
        for row in rows:
            _excerpt(row, sounds, pictures, quality, sink)
            _say(_label(row))


_RATE_HZ = 48_000


def _excerpt(row: Row, sounds: Sounds, pictures: int, quality: int, sink: VideoSink) -> None:
    drummer = drummer_of(row)
    start_s = float(drummer.score.onset_s[len(drummer.score) // 3])
    soundtrack = Soundtrack.of_score(drummer.score, start_s, sounds)
    shot = Shot(FILM_SIZE, QUALITIES[quality], _camera(row))
    with artist(shot, pictures) as drawer:
        snapshots = _snapshots(row, drummer, start_s, pictures)
        for done, planes in enumerate(drawer.film(snapshots), 1):
            sink.add_picture(planes)
            sink.add_sound(soundtrack.until(done / FILM_FPS))


def _snapshots(row: Row, drummer: Drummer, start_s: float, pictures: int) -> Iterator[Snapshot]:
    words = " · ".join(row[name] for name in ("style", "kit", "drummer", "grip", "held"))
    for k in range(pictures):
        snapshot = picture_of(drummer, start_s + k / FILM_FPS)
        yield replace(snapshot, hud=replace(snapshot.hud, phase=words))


def _say(line: str) -> None:
    sys.stdout.write(line + "\n")
    sys.stdout.flush()


def main() -> None:
    """Draw what the command line asks for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--to", type=Path, required=True, metavar="DIR", help="where sheet.png and film.mp4 go")
    parser.add_argument("--film", action="store_true", help="the film too")
    parser.add_argument("--quality", type=int, choices=range(len(QUALITIES)), default=1, help="0 lowest … 2 highest")
    parser.add_argument("--only", type=int, metavar="N", help="one still alone, large, as still-N.png")
    said = parser.parse_args()
    said.to.mkdir(parents=True, exist_ok=True)
    rows = covering(choices(), STILLS)
    if said.only is not None:
        row = rows[said.only - 1]
        picture = PictureMaker(LARGE_SIZE, QUALITIES[said.quality]).draw(snapshot_of(row), _camera(row), False)
        write_png(picture, said.to / f"still-{said.only}.png")
        return
    if said.film:
        seen = {**choices(), "view": ("front", "shoulder", "eyes", "top"), "moment": (_STRIKE,)}
        draw_film(covering(seen, EXCERPTS), said.quality, said.to / "film.mp4")
    draw_sheet(rows, said.quality, said.to / "sheet.png")


if __name__ == "__main__":
    main()
