"""What the pixels of a picture mean, drawn off screen at the lowest quality."""

import os
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.named_view import NamedView
from station.core.pieces import Limb, Piece
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import Joint, figure_of
from station.motion.kinematics.pose import RIGHT, Pose
from station.motion.kit.kit import load_kit
from station.music.judgement import Label
from station.music.score import Note, Score
from station.render.camera import Camera
from station.render.framing import named
from station.render.gpu.gl import RenderTarget, standalone_context
from station.render.gpu.moving_parts import DoublePlace
from station.render.hud import band_height
from station.render.notation.screen.score_place import SHARES, ScoreForm, ScorePlace
from station.render.notation.screen.score_view import lead_spaces
from station.render.notation.screen.time_span import BEHIND_SHARE, MOST_AHEAD_S
from station.render.notation.staff import PLACES, height
from station.render.notation.staff_rows import staff_rows
from station.render.painter import Arrangement, Painter
from station.render.palette import BRAND, MISSED, Theme
from station.render.picture import PictureMaker, Shot, draw_png
from station.render.quality import QUALITIES, Quality
from station.render.report.report_layout import page_for
from station.render.report.report_picture import draw_report_png
from station.render.report.result_facts import ResultWords, result_facts
from station.render.snapshot import (
    BarNumbers,
    Hud,
    LimbParting,
    SeenStrike,
    Snapshot,
    StudentShown,
    TimingCue,
    no_marks,
)
from tests.unit.render.scores import rock, score_of
from tests.unit.render.test_png_file import decode

pytestmark = pytest.mark.gl

SIZE = (640, 360)
SCORE_TOP = SIZE[1] - round(SIZE[1] * SHARES[ScoreForm.SCROLLING])
Picture = NDArray[np.uint8]
Draw = Callable[..., Picture]

KIT, FIGURE = load_kit(), figure_of()
SCORE = rock(2)
DRUMMER = Drummer(SCORE, KIT, FIGURE)


@pytest.fixture(scope="module")
def draw() -> Draw:
    return PictureMaker(SIZE, QUALITIES[0]).draw


def at(position_s: float, **changes: object) -> Snapshot:
    snapshot = Snapshot(SCORE, position_s, KIT, FIGURE, DRUMMER.pose(position_s))
    return replace(snapshot, **changes)  # type: ignore[arg-type] # the tests name fields of Snapshot


def pixel_of(point: NDArray[np.float64], camera: Camera, width: int = SIZE[0]) -> tuple[int, int]:
    """Row and column of a point of the world in the scene's part of a picture so wide."""
    clip = camera.matrix(width / SCORE_TOP) @ np.append(point, 1.0)
    x, y = clip[:2] / clip[3]
    return round((0.5 - y / 2) * SCORE_TOP - 0.5), round((x / 2 + 0.5) * width - 0.5)


def differs(one: Picture, other: Picture, where: tuple[int, int], reach: int) -> bool:
    row, column = where
    box = np.s_[row - reach : row + reach + 1, column - reach : column + reach + 1]
    return int(np.abs(one[box].astype(int) - other[box]).max()) > 24


def test_the_same_snapshot_gives_the_same_picture_whatever_was_drawn_before(draw: Draw) -> None:
    first = draw(at(1.0))
    draw(at(0.2, hud=Hud(title="another")), named(NamedView.TOP))
    assert np.array_equal(draw(at(1.0)), first)


def test_the_stick_s_tip_is_seen_on_the_snare_when_it_strikes(draw: Draw) -> None:
    """A snare stroke of the right hand alone: its tip's pixel is the stick's, and lies on the head."""
    score = score_of(Note(0, Piece.SNARE, limb=Limb.RIGHT_HAND), Note(4 * 107520, Piece.SNARE, limb=Limb.RIGHT_HAND))
    drummer = Drummer(score, KIT, FIGURE)
    strike_s = float(score.onset_s[1])
    pose = drummer.pose(strike_s)
    camera = named(NamedView.EYES)
    snapshot = Snapshot(score, strike_s, KIT, FIGURE, pose)
    tip = pose.tip_m[RIGHT]
    snare = KIT.pieces[Piece.SNARE]
    assert abs((tip - snare.centre) @ snare.normal) < 0.003
    assert np.linalg.norm(tip - snare.centre) < snare.radius_m
    with_stick, without = draw(snapshot, camera), draw(replace(snapshot, pose=None), camera)
    assert differs(with_stick, without, pixel_of(tip, camera), 2)


@pytest.mark.parametrize("joint", [Joint.RIGHT_ELBOW, Joint.LEFT_WRIST, Joint.RIGHT_SHOULDER, Joint.HEAD])
def test_the_body_is_where_its_joints_are(draw: Draw, joint: Joint) -> None:
    camera = named(NamedView.SHOULDER)
    snapshot = at(0.6)
    assert snapshot.pose is not None
    place = pixel_of(snapshot.pose.joints_m[joint], camera)
    empty = draw(replace(snapshot, pose=None), camera)
    assert differs(draw(snapshot, camera), empty, place, 1)


@pytest.mark.parametrize(
    ("view", "hand"), [(NamedView.LEFT_HAND, Joint.LEFT_HAND), (NamedView.RIGHT_HAND, Joint.RIGHT_HAND)]
)
def test_nothing_of_the_kit_hides_the_hand_that_a_close_up_shows(draw: Draw, view: NamedView, hand: Joint) -> None:
    for at_s in (0.0, 0.37, 0.5, 1.1):
        snapshot = at(at_s)
        assert snapshot.pose is not None
        row, column = pixel_of(snapshot.pose.joints_m[hand], named(view))
        assert 0 < row < SCORE_TOP
        assert SIZE[0] * 0.2 < column < SIZE[0] * 0.9
        empty = draw(replace(snapshot, pose=None), named(view))
        assert differs(draw(snapshot, named(view)), empty, (row, column), 1)


def test_a_struck_piece_glows_and_no_other(draw: Draw) -> None:
    camera = named(NamedView.EYES)
    still = replace(at(-2.0), pose=None)
    lit = replace(still, strikes=(SeenStrike(Piece.TOM_1, 110, 0.0),))
    before, after = draw(still, camera), draw(lit, camera)
    tom, floor_tom = (pixel_of(KIT.pieces[p].centre, camera) for p in (Piece.TOM_1, Piece.FLOOR_TOM_1))
    assert differs(before, after, tom, 1)
    assert not differs(before, after, floor_tom, 1)
    faded = draw(replace(still, strikes=(SeenStrike(Piece.TOM_1, 110, 2.0),)), camera)
    assert not differs(before, faded, tom, 1)


def test_a_missing_piece_s_stroke_glows_on_its_stand_in(draw: Draw) -> None:
    assert Piece.SPLASH not in KIT.pieces
    still = replace(at(-2.0), pose=None)
    lit = replace(still, strikes=(SeenStrike(Piece.SPLASH, 110, 0.0),))
    assert not np.array_equal(draw(still), draw(lit))


@pytest.mark.parametrize("piece", [Piece.SNARE, Piece.CRASH_1])
def test_a_stroke_that_comes_while_the_picture_is_drawn_is_in_it(piece: Piece) -> None:
    """A drum stands still, a cymbal swings: both are lit, the drum to the pixel as if it had been known before."""
    before, after = at(0.75), at(0.75, strikes=(SeenStrike(piece, 100, 0.0),))
    with standalone_context() as ctx:
        painter, target = Painter(ctx, QUALITIES[0]), RenderTarget(ctx, SIZE)

        def drawn(snapshot: Snapshot, newest: Snapshot) -> Picture:
            painter.begin(snapshot, target.framebuffer, (0, 0, *SIZE))(newest)
            return target.read().astype(np.int16)

        dark, known, late = drawn(before, before), drawn(after, after), drawn(before, after)
    changed = np.abs(known - dark).max(axis=2) > 8
    assert changed.any()
    assert (late - dark)[changed].mean() > 0.5 * (known - dark)[changed].mean() > 0
    if piece is Piece.SNARE:
        assert np.array_equal(late, known)


def test_a_painter_that_goes_to_another_quality_draws_as_one_that_began_with_it() -> None:
    snapshot, size = at(0.75), (160, 90)
    with standalone_context() as ctx:
        target = RenderTarget(ctx, size)

        def drawn(painter: Painter) -> Picture:
            target.framebuffer.clear(depth=1.0)
            painter.draw(snapshot, target.framebuffer, (0, 0, *size))
            return target.read().copy()

        painter = Painter(ctx, QUALITIES[0])
        before = drawn(painter)
        painter.draw_at(QUALITIES[1])
        after = drawn(painter)
        assert np.array_equal(after, drawn(Painter(ctx, QUALITIES[1])))
        assert not np.array_equal(before, after)


@pytest.mark.parametrize("quality", QUALITIES[:2])
def test_beside_the_demonstrator_the_student_has_a_picture_of_his_own(quality: Quality) -> None:
    """Left the demonstrator as if he were alone there, right a drummer who is where the student is."""
    camera, half = named(NamedView.SHOULDER), SIZE[0] // 2
    away = DRUMMER.pose(0.63)
    ctx = standalone_context()
    with ctx:
        painter, target = Painter(ctx, quality), RenderTarget(ctx, SIZE, quality.samples)

        def drawn(double: Pose) -> Picture:
            shown, arrangement = at(0.75, double=StudentShown(double)), Arrangement(double=DoublePlace.BESIDE)
            painter.draw(shown, target.framebuffer, (0, 0, *SIZE), camera, arrangement=arrangement)
            return target.read()

        together, parted = drawn(DRUMMER.pose(0.75)), drawn(away)
        painter.draw(at(0.75), target.framebuffer, (0, 0, half, SIZE[1]), camera)
        alone = target.read()
    between = np.s_[round(0.4 * SCORE_TOP) : round(0.8 * SCORE_TOP), 4 : half - 4]  # the words above, the names below
    assert np.array_equal(parted[between], alone[between])
    assert np.array_equal(together[:, :half], parted[:, :half]), "the student moves nothing of the demonstrator's"
    hand, edge = pixel_of(away.tip_m[RIGHT], camera, half), (round(0.6 * SCORE_TOP), 12)
    assert differs(together[:, half:], parted[:, half:], hand, 3)
    assert differs(parted[:, half:], parted[:, :half], hand, 3)
    assert not differs(parted[:, half:], parted[:, :half], edge, 5), "the same room from the same place"


@pytest.mark.parametrize("quality", QUALITIES[:2])
def test_the_student_s_double_is_seen_where_his_limbs_are_and_glows_where_they_part(quality: Quality) -> None:
    """His right arm is where the demonstrator's was a moment ago; missed, it has the colour of a miss."""
    camera, area = named(NamedView.SHOULDER), (0, 0, *SIZE)
    away = DRUMMER.pose(0.63)
    ctx = standalone_context()
    with ctx:
        painter, target = Painter(ctx, quality), RenderTarget(ctx, SIZE, quality.samples)

        def drawn(double: StudentShown | None, shown: bool) -> Picture:
            arrangement = Arrangement(double=DoublePlace.OVER if shown else DoublePlace.NOWHERE)
            painter.draw(at(0.75, double=double), target.framebuffer, area, camera, arrangement=arrangement)
            return target.read()

        parted = StudentShown(away, {Limb.RIGHT_HAND: LimbParting(TimingCue.MISSED, 1.0)})
        alone, hidden, seen, red = (
            drawn(None, True),
            drawn(parted, False),
            drawn(StudentShown(away), True),
            drawn(parted, True),
        )
    assert np.array_equal(alone, hidden), "only for those who want to see it"
    elbow, head = (pixel_of(away.joints_m[joint], camera) for joint in (Joint.RIGHT_ELBOW, Joint.HEAD))
    assert differs(alone, seen, elbow, 2)
    assert not differs(alone, seen, head, 1), "the trunk is the demonstrator's"
    expected = np.array(MISSED[:3])
    reds = [float(picture[elbow].astype(float) @ expected / np.linalg.norm(picture[elbow])) for picture in (seen, red)]
    assert reds[1] > 0.95 * np.linalg.norm(expected) > reds[0]


def test_what_is_kept_follows_the_colours_and_the_form_of_the_score() -> None:
    """By day the paper is light (F6F3EC), the highway has no staff: also where the room is drawn once."""
    ctx = standalone_context()
    with ctx:
        painter, target = Painter(ctx, QUALITIES[0]), RenderTarget(ctx, SIZE)

        def drawn(theme: Theme, form: ScoreForm) -> Picture:
            painter.theme = theme
            painter.draw(at(1.0), target.framebuffer, (0, 0, *SIZE), arrangement=Arrangement(form=form))
            return target.read()[SCORE_TOP + 2 :]

        night, day = drawn(Theme.NIGHT, ScoreForm.SCROLLING), drawn(Theme.DAY, ScoreForm.SCROLLING)
        highway, again = drawn(Theme.NIGHT, ScoreForm.HIGHWAY), drawn(Theme.NIGHT, ScoreForm.SCROLLING)
    assert np.median(day[..., 0]) == pytest.approx(0xF6, abs=2)
    assert np.median(night[..., 0]) < 0x20
    assert np.array_equal(night, again)
    place = ScorePlace(0.0, 0.0, float(SIZE[0]), float(SIZE[1] - SCORE_TOP), staff_rows(SCORE).reach)
    line = round(place.middle_line) - 2
    between = np.s_[line - 1 : line + 2, 8:20]  # left of the clef
    assert night[between].max() > highway[between].max() + 30


# --- the score --------------------------------------------------------------------------------------------------------


def place_of(score: Score) -> ScorePlace:
    return ScorePlace(0, SCORE_TOP, SIZE[0], SIZE[1] - SCORE_TOP, staff_rows(score).reach)


PLACE = place_of(SCORE)
CLEF = lead_spaces(SCORE) * PLACE.space
LINE_X = CLEF + BEHIND_SHARE * (SIZE[0] - CLEF)
PER_S = (SIZE[0] - LINE_X) / MOST_AHEAD_S  # two bars at 120


def near(colour: tuple[float, float, float, float], picture: Picture, tolerance: int = 60) -> NDArray[np.bool_]:
    wanted = np.array(colour[:3]) * 255
    return np.asarray(np.abs(picture.astype(float) - wanted).max(axis=2) < tolerance)


def test_the_play_line_leaves_most_of_the_width_to_what_comes(draw: Draw) -> None:
    score = draw(at(-3.0))[SCORE_TOP + 4 :]
    columns = np.flatnonzero(near(BRAND, score).mean(axis=0) > 0.8)
    assert len(columns)
    assert np.abs(columns - LINE_X).max() < 3


@pytest.mark.parametrize("position_s", [0.0, 0.5, 1.0])
def test_a_note_is_at_the_play_line_when_it_is_due(draw: Draw, position_s: float) -> None:
    """The kick of beat one, the snare of two: a bright head at the line, and none a little earlier."""
    score = score_of(Note(0, Piece.SNARE), Note(107520, Piece.SNARE), Note(2 * 107520, Piece.SNARE))
    place = place_of(score)
    row = round(place.middle_line + height(PLACES[Piece.SNARE].step) * place.space)
    snapshot = Snapshot(score, position_s, KIT, FIGURE)
    clef = lead_spaces(score) * place.space
    line_x = clef + BEHIND_SHARE * (SIZE[0] - clef)
    beside = round(line_x + 0.4 * place.space)  # the head's right half, clear of the line itself
    assert draw(snapshot)[row, beside].min() > 170
    assert draw(replace(snapshot, position_s=position_s - 0.2))[row, beside].min() < 170


def test_a_missed_note_is_marked_where_it_stands(draw: Draw) -> None:
    marks = no_marks(SCORE)
    snares = np.flatnonzero(SCORE.notes["piece"] == Piece.SNARE)
    marks["label"][snares[0]] = Label.MISS
    picture = draw(at(1.5, marks=marks))
    played = np.s_[SCORE_TOP:, : round(LINE_X - PLACE.space)]  # the play line's soft edge is of nearly that colour
    rows, columns = np.nonzero(near(MISSED, picture[played], 40))
    due_x = LINE_X + (0.5 - 1.5) * PER_S
    assert abs(columns.mean() - due_x) < 3
    assert abs(rows.mean() + SCORE_TOP - (PLACE.middle_line + height(5) * PLACE.space)) < 3
    assert not near(MISSED, draw(at(1.5))[played], 40).any()


def test_early_and_late_differ_in_shape_too(draw: Draw) -> None:
    """Without colour, an early and a late stroke still look different."""
    pictures = []
    for asynchrony_ms in (-45.0, 45.0):
        marks = no_marks(SCORE)
        marks["label"][:], marks["asynchrony_ms"][:] = Label.MATCH, asynchrony_ms
        pictures.append(draw(at(1.5, marks=marks))[SCORE_TOP:].mean(axis=2))
    assert np.abs(pictures[0] - pictures[1]).max() > 60


# --- words ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("hud", "box"),
    [
        (Hud(message="Ready", say="Rock"), np.s_[50:250, 200:440]),
        (Hud(count_in=4), np.s_[80:190, 270:370]),
        (Hud(cue=TimingCue.EARLY), np.s_[200:252, 260:380]),
        (Hud(message="Play when you are ready"), np.s_[50:90, 200:440]),
    ],
)
def test_words_stand_in_their_places(draw: Draw, hud: Hud, box: tuple[slice, slice]) -> None:
    plain, said = draw(at(-1.0)), draw(at(-1.0, hud=hud))
    changed = np.abs(plain[:SCORE_TOP].astype(int) - said[:SCORE_TOP]).max(axis=2) > 24
    assert changed[box].any()
    changed[box] = False
    assert not changed.any(), "and nowhere else"


@pytest.mark.parametrize("quality", QUALITIES[:2])
@pytest.mark.parametrize("size", [(640, 360), (300, 420)])
def test_no_drum_ever_lies_under_the_title(quality: Quality, size: tuple[int, int]) -> None:
    """The band has the same pixels from wherever one looks, however near: paper (11141B) and letters."""
    hud = Hud("Rock 2: the kick moves", "Pass 1 of 4", 2, 3, 4, 2, 84.0)
    ctx = standalone_context()
    with ctx:
        painter, target = Painter(ctx, quality), RenderTarget(ctx, size, quality.samples)
        bands = []
        for view, mirrored, zoom in product(NamedView, (False, True), (1.0, 2.5)):
            camera = replace(named(view), mirrored=mirrored).zoomed(zoom)
            painter.draw(at(0.5, hud=hud), target.framebuffer, (0, 0, *size), camera)
            above = size[1] - round(size[1] * SHARES[ScoreForm.SCROLLING])
            bands.append(target.read()[: band_height(hud, (size[0], above))])
    assert bands[0].shape[0] > 20
    assert (np.abs(bands[0].astype(int) - (0x11, 0x14, 0x1B)).max(axis=2) < 4).mean() > 0.6
    assert all(np.array_equal(band, bands[0]) for band in bands)


# --- files and faults -------------------------------------------------------------------------------------------------


def test_a_picture_is_written_as_png(tmp_path: Path) -> None:
    draw_png(at(0.5), tmp_path / "drummer.png", Shot((320, 180)))
    picture = decode((tmp_path / "drummer.png").read_bytes())
    assert picture.shape == (180, 320, 3)
    assert picture.std() > 20


def test_a_result_is_written_as_png(tmp_path: Path) -> None:
    label = np.full(len(SCORE), Label.MATCH, np.uint8)
    facts = result_facts(
        SCORE,
        label,
        np.zeros(len(SCORE), np.int64),
        np.ones(len(SCORE), bool),
        np.empty(0),
        ResultWords("Rock", "120 bpm", 100.0),
    )
    draw_report_png(facts, tmp_path / "report.png", (640, 400))
    picture = decode((tmp_path / "report.png").read_bytes())
    dial = picture[66:156, 28:118]  # 62 units round (102, 156), 0.71 pixels each
    lit = near(BRAND, dial)
    assert lit[:45].any()
    assert lit[45:].any()
    assert lit[:, :45].any(), "all of the dial is lit at 100 points"


def test_the_result_shows_what_hands_and_feet_did(tmp_path: Path) -> None:
    """Two lines below the pieces; without them that part of the card is empty."""
    label = np.full(len(SCORE), Label.MATCH, np.uint8)
    pictures = []
    for craft in ((), ("Swing: 1.8:1 held, 2.0:1 written", "Hi-hat: 9 of 12 as open as written")):
        words = ResultWords("Rock", "120 bpm", 100.0, technique=craft)
        facts = result_facts(
            SCORE, label, np.zeros(len(SCORE), np.int64), np.ones(len(SCORE), bool), np.empty(0), words
        )
        draw_report_png(facts, tmp_path / "report.png", (1280, 800))
        pictures.append(decode((tmp_path / "report.png").read_bytes()).astype(int))
    changed = np.abs(pictures[0] - pictures[1]).max(axis=2) > 24
    pieces = page_for((1280, 800)).pieces
    assert pieces is not None
    left, top, right, low = (round(1280 / 900 * at) for at in (pieces.left, pieces.top, pieces.right, pieces.bottom))
    assert changed[(top + low) // 2 : low, left:right].any()
    changed[(top + low) // 2 : low, left:right] = False
    assert not changed.any(), "and nowhere else"


def test_no_opengl_is_said_with_what_to_install() -> None:
    program = (
        "from station.render.gpu.gl import standalone_context\n"
        "from station.core.errors import DeviceError\n"
        "try:\n    standalone_context()\nexcept DeviceError as fault:\n    print(fault)\n"
    )
    nothing = {**os.environ, "__EGL_VENDOR_LIBRARY_FILENAMES": "/none", "__EGL_VENDOR_LIBRARY_DIRS": "/none"}
    nothing["GLCONTEXT_LINUX_LIBX11"] = "/none"  # else :0 is tried, which a test of the window may own
    root = Path(__file__).parents[2]
    done = subprocess.run(
        [sys.executable, "-c", program],
        env={**nothing, "PYTHONPATH": str(root)},
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    assert "OpenGL 3.3 cannot be had" in done.stdout
    if sys.platform == "linux":
        assert "libegl1" in done.stdout


@pytest.mark.parametrize("level", [1, 2])
def test_higher_qualities_draw_the_same_scene_more_finely(level: int) -> None:
    small = (160, 90)
    low, high = (PictureMaker(small, QUALITIES[q]).draw(at(0.5)).astype(int) for q in (0, level))
    assert np.abs(low - high).mean() < 12


def test_views_show_different_pictures(draw: Draw) -> None:
    pictures = [draw(at(0.5), named(view)) for view in NamedView]
    for i, one in enumerate(pictures):
        for other in pictures[i + 1 :]:
            assert np.abs(one[:SCORE_TOP].astype(int) - other[:SCORE_TOP]).mean() > 5


@pytest.mark.parametrize("form", ScoreForm)
def test_what_a_score_keeps_is_made_anew_when_marks_or_bars_change(form: ScoreForm) -> None:
    """The same snapshot looks the same, whatever was drawn before; a missed note is seen at once, then gone again."""
    marks = no_marks(SCORE)
    marks["label"][:6] = Label.MISS
    with standalone_context() as ctx:
        painter, target = Painter(ctx, QUALITIES[0]), RenderTarget(ctx, SIZE)

        def drawn(snapshot: Snapshot) -> Picture:
            arrangement = Arrangement(form=form, has_legend=True)
            painter.draw(replace(snapshot, pose=None), target.framebuffer, (0, 0, *SIZE), arrangement=arrangement)
            return target.read().copy()

        plain, marked = drawn(at(1.0)), drawn(at(1.0, marks=marks))
        longer = Snapshot(rock(6), 7.0, KIT, FIGURE)
        drawn(longer)
        again = drawn(at(1.0))
    assert np.array_equal(plain, again)
    assert near(MISSED, marked, 40).sum() > near(MISSED, plain, 40).sum() + 20


def test_the_line_that_comes_next_stands_beside_the_one_that_is_played(draw: Draw) -> None:
    """Four bars of sixteenths, two to a line: heads on both rows; after the second line is begun the first is gone."""
    notes = [Note(k * 107520 // 4, Piece.SNARE) for k in range(16 * 8)]
    score = Score.from_notes(notes, SCORE.tempo_map)
    with standalone_context() as ctx:
        painter, target = Painter(ctx, QUALITIES[0]), RenderTarget(ctx, SIZE)

        def rows(position_s: float) -> list[Picture]:
            arrangement = Arrangement(form=ScoreForm.PAGED)
            snapshot = Snapshot(score, position_s, KIT, FIGURE, bar_numbers=BarNumbers(0, 8, 1))
            painter.draw(snapshot, target.framebuffer, (0, 0, *SIZE), arrangement=arrangement)
            paper = target.read()[SIZE[1] - round(SIZE[1] * SHARES[ScoreForm.PAGED]) :].copy()
            return [paper[: len(paper) // 2, 80:], paper[len(paper) // 2 :, 80:]]

        first, second = rows(2.0), rows(6.0)
    for row in (*first, *second):
        assert (row.min(axis=2) > 200).sum() > 300, "heads, stems and beams on both rows"
    assert np.abs(first[0].astype(int) - second[0]).max() > 100, "another line, and no play line"
    lines = [near(BRAND, row).mean(axis=0).max() > 0.8 for row in (*first, *second)]
    assert lines == [True, False, False, True]
