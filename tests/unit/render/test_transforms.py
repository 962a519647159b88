"""Views and frames against numbers by hand."""

import numpy as np
import pytest

from station.core.named_view import NamedView
from station.motion.kinematics.figure import figure_of
from station.motion.kit.kit import load_kit
from station.render.camera import Camera
from station.render.framing import Stage, named
from station.render.geometry.transforms import frame, gl_bytes, look_at, perspective, rotation


def project(camera: Camera, point: tuple[float, float, float], aspect: float = 16 / 9) -> np.ndarray:
    clip = camera.matrix(aspect) @ [*point, 1.0]
    return np.asarray(clip[:3] / clip[3])


def test_a_frame_is_rigid() -> None:
    m = frame([1, 2, 3], [0.3, -0.2, 0.9], [1, 1, 0])
    assert np.allclose(m[:3, :3] @ m[:3, :3].T, np.eye(3))
    assert np.linalg.det(m[:3, :3]) == pytest.approx(1)
    assert np.allclose(m[:3, 2], np.array([0.3, -0.2, 0.9]) / np.linalg.norm([0.3, -0.2, 0.9]))
    assert np.allclose(frame([0, 0, 0], [0, 0, 1], [0, 0, 1])[:3, :3] @ [0, 0, 1], [0, 0, 1])


def test_turns() -> None:
    assert np.allclose(rotation([0, 0, 1], np.pi / 2) @ [1, 0, 0, 1], [0, 1, 0, 1])


def test_looking() -> None:
    view = look_at([0, -5, 0], [0, 0, 0])
    assert np.allclose(view @ [0, 0, 0, 1], [0, 0, -5, 1])
    assert np.allclose((view @ [1, 0, 0, 1])[:2], [1, 0]), "x stays to the right for who looks along y"
    assert np.allclose((view @ [0, 0, 1, 1])[:2], [0, 1])


def test_perspective() -> None:
    clip = perspective(np.pi / 2, 2.0, 1.0, 10.0)
    assert np.allclose(clip @ [2, 1, -1, 1], [1, 1, -1, 1]), "the corner of the near plane"
    far = clip @ [0, 0, -10, 1]
    assert far[2] / far[3] == pytest.approx(1)


def test_matrices_go_to_opengl_by_columns() -> None:
    m = np.arange(16.0).reshape(4, 4)
    assert np.frombuffer(gl_bytes(m), np.float32).tolist() == m.T.ravel().tolist()


@pytest.mark.parametrize("view", list(NamedView))
def test_named_views_look_at_what_they_are_named_for(view: NamedView) -> None:
    camera = named(view)
    assert np.allclose(project(camera, camera.target)[:2], 0, atol=1e-9)
    snare = (-0.07, 0.45, 0.66)
    if view is not NamedView.FEET:
        assert np.abs(project(camera, snare)[:2]).max() < 1, "the snare is in the picture"


def test_the_front_view_shows_the_drummer_s_right_on_the_left_and_its_mirror_does_not() -> None:
    from dataclasses import replace

    camera = named(NamedView.FRONT)
    floor_tom = (0.55, 0.38, 0.62)
    assert project(camera, floor_tom)[0] < 0
    assert project(replace(camera, mirrored=True), floor_tom)[0] > 0
    assert project(named(NamedView.SHOULDER), floor_tom)[0] > 0


def test_orbiting_keeps_the_distance_and_stays_in_the_room() -> None:
    camera = named(NamedView.FRONT)
    turned = camera.orbited(0.5, 0.2)
    assert np.linalg.norm(np.subtract(turned.eye, turned.target)) == pytest.approx(camera.distance_m)
    for _ in range(100):
        camera = camera.orbited(0.0, -0.1)
    assert camera.eye[2] > 0, "never under the floor"
    assert camera.zoomed(1000).distance_m == 0.5
    assert camera.zoomed(0.001).distance_m == 4.4


def test_panning_shifts_the_target_in_the_picture() -> None:
    camera = named(NamedView.FRONT)
    moved = camera.panned(0.2, 0.0)
    assert project(camera, moved.target)[0] > 0.01
    assert project(camera, moved.target)[1] == pytest.approx(0, abs=1e-6)


def test_narrow_pictures_see_as_far_to_the_sides() -> None:
    camera = named(NamedView.FRONT)
    ride = (0.65, 0.75, 0.95)
    wide, square = project(camera, ride, 1.5), project(camera, ride, 1.0)
    assert square[0] == pytest.approx(wide[0])


def test_a_left_handed_kit_is_seen_from_the_other_side() -> None:
    right, left = named(NamedView.SHOULDER), named(NamedView.SHOULDER, Stage(load_kit().mirrored, figure_of()))
    assert np.allclose(np.array(left.eye), np.array(right.eye) * [-1, 1, 1])
    assert project(left, (-0.42, 0.62, 0.86))[0] == pytest.approx(-project(right, (0.42, 0.62, 0.86))[0])
