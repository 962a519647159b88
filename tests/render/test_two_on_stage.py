"""Two drummers on one stage: each where they belong and in their own light, however the picture is drawn."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import Joint, load_figure
from station.motion.kit.kit import load_kit
from station.render.camera import Camera
from station.render.framing import Stage, both, one_of_two
from station.render.picture import PictureMaker
from station.render.place import TWO, Place
from station.render.quality import QUALITIES
from station.render.snapshot import OnStage, Snapshot
from tests.unit.render.scores import rock

pytestmark = pytest.mark.gl

SIZE = (480, 240)
ONE = Drummer(rock(2), load_kit(), load_figure("headphones"))
OTHER = Drummer(rock(2), load_kit("jazz"), load_figure("ponytail"))
STAGES = [(Stage(who.kit, who.figure), place) for who, place in zip((ONE, OTHER), TWO, strict=True)]
CAMERA = both(STAGES)
AT_S = 1.3
TRUNK = [Joint.PELVIS, Joint.NECK, Joint.RIGHT_SHOULDER, Joint.LEFT_SHOULDER]


def snapshot(light: float, rival: float, camera: Camera = CAMERA) -> Snapshot:
    beside = OnStage(OTHER.kit, OTHER.figure, OTHER.pose(AT_S), light=rival)
    return Snapshot(
        ONE.score, AT_S, ONE.kit, ONE.figure, ONE.pose(AT_S), rival=beside, light=light, crowd_beat=0.0, camera=camera
    )


def seen(points: NDArray[np.float64], place: Place, camera: Camera = CAMERA) -> NDArray[np.float64]:
    """Where points in a place's own axes are in the picture, (n, 2) pixels from its upper left corner."""
    at = np.column_stack([points, np.ones(len(points))]) @ (camera.matrix(SIZE[0] / SIZE[1]) @ place.matrix).T
    return np.asarray((at[:, :2] / at[:, 3:] * [1, -1] + 1) / 2 * SIZE, np.float64)


def box_of(drummer: Drummer, place: Place) -> tuple[slice, slice]:
    """Rows and columns of a picture in which a trunk is."""
    spots = seen(drummer.pose(AT_S).joints_m[TRUNK], place)
    (left, top), (right, low) = spots.min(axis=0).astype(int), spots.max(axis=0).astype(int)
    return slice(top, low), slice(left, right)


@pytest.fixture(scope="module", params=[0, 1], ids=["in layers", "whole"])
def maker(request: pytest.FixtureRequest) -> PictureMaker:
    return PictureMaker(SIZE, QUALITIES[request.param])


def brightness(picture: NDArray[np.uint8]) -> tuple[float, float]:
    """The mean of 255ths where each drummer's trunk is."""
    one, other = (picture[box_of(who, place)] for who, place in zip((ONE, OTHER), TWO, strict=True))
    return float(one.mean()), float(other.mean())


def test_light_shows_who_plays_and_goes_over_gradually(maker: PictureMaker) -> None:
    shares = (0.0, 0.25, 0.5, 0.75, 1.0)
    means = [brightness(maker.draw(snapshot(1 - share, share), with_score=False)) for share in shares]
    (lit, dark), (dim, bright) = means[0], means[-1]
    assert lit > 1.5 * dim
    assert bright > 1.2 * dark, "one in a dark shirt gains less"
    assert min(dim, dark) > 8, "who is not in the light is still seen"
    assert np.all(np.diff([mean[0] for mean in means]) < 0)
    assert np.all(np.diff([mean[1] for mean in means]) > 0)


def test_two_layers_show_what_one_picture_shows() -> None:
    """All but shadows on what moves and fine light agree, in the light and while it goes over."""
    layered, whole = PictureMaker(SIZE, QUALITIES[0]), PictureMaker(SIZE, replace(QUALITIES[0], is_layered=False))
    for lights in ((1.0, 0.0), (0.5, 0.5)):
        one, other = (maker.draw(snapshot(*lights), with_score=False).astype(int) for maker in (layered, whole))
        assert np.mean(np.abs(one - other).max(axis=2) > 24) < 0.06


def test_the_two_stand_apart_from_where_they_are_seen() -> None:
    """As the audience sees them one kit and its drummer are left of the other, and all of both is in the picture."""
    rims = []
    for who, place in zip((ONE, OTHER), TWO, strict=True):
        centres = np.array([piece.centre for piece in who.kit.pieces.values()])
        rims.append(seen(np.concatenate([centres, who.pose(AT_S).joints_m]), place))
    assert rims[0][:, 0].max() < rims[1][:, 0].min()
    inside = np.concatenate(rims)
    assert inside.min() > 0
    assert (inside < SIZE).all()
    for (stage, place), (who, _) in zip(STAGES, ((ONE, 0), (OTHER, 1)), strict=True):
        close = one_of_two(stage, place)
        spots = seen(who.pose(AT_S).joints_m, place, close)
        assert spots.min() > 0
        assert (spots < SIZE).all()


def test_a_tip_is_on_its_drum_at_the_stroke_where_the_kit_stands() -> None:
    """The rival's snare stroke on two: its tip is at the snare's height over its own place of the room."""
    row = np.flatnonzero(OTHER.score.notes["piece"] == Piece.SNARE)[0]
    hand = OTHER.assignment.limbs[row]
    tip = OTHER.pose(float(OTHER.score.onset_s[row])).tip_m[0 if hand == Limb.RIGHT_HAND else 1]
    snare = OTHER.kit.pieces[Piece.SNARE]
    at, middle = np.array(TWO[1].placed(tuple(tip))), np.array(TWO[1].placed(tuple(snare.centre)))
    assert np.linalg.norm(at - middle) < snare.radius_m
    assert middle[0] < 0 < TWO[0].placed((0.0, 0.0, 0.0))[0], "they are on their own side of the room"


def test_a_pose_is_of_one_place(maker: PictureMaker) -> None:
    """What the rival does moves no pixel where the first drummer is."""
    base = snapshot(1.0, 1.0)
    assert base.rival is not None
    moved = replace(base, rival=replace(base.rival, pose=OTHER.pose(AT_S + 0.2)))
    one, other = (maker.draw(each, with_score=False).astype(int) for each in (base, moved))
    changed = np.abs(one - other).max(axis=2) > 12
    assert changed[:, SIZE[0] // 2 :].any()
    assert changed[:, : SIZE[0] // 3].mean() < 0.002
