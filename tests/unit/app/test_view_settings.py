"""Where the user looks from, as the settings hold it."""

from dataclasses import replace
from pathlib import Path

import pytest

from station.app.settings.view_settings import SLOTS, ViewSettings, view_settings_of, with_view_settings
from station.core.errors import BadInput
from station.core.named_view import NamedView
from station.core.settings import Settings, load_settings, save_settings
from station.motion.kinematics.figure import figure_of
from station.motion.kit.kit import load_kit
from station.render.framing import Stage, named
from station.render.gpu.moving_parts import DoublePlace
from station.render.painter import inset_area
from station.render.palette import Theme


def test_a_look_comes_back_from_the_settings_file(tmp_path: Path) -> None:
    camera = replace(named(NamedView.FEET).orbited(0.3, 0.1), mirrored=True)
    look = (
        ViewSettings(NamedView.TOP, True, NamedView.HANDS).keeping(0, named(NamedView.FRONT)).keeping(SLOTS - 1, camera)
    )
    path = save_settings(with_view_settings(Settings(), look), tmp_path / "settings.toml")
    found = view_settings_of(load_settings(path))
    assert (found.view, found.mirrored, found.inset) == (NamedView.TOP, True, NamedView.HANDS)
    assert [kept is not None for kept in found.viewpoints] == [True, *[False] * (SLOTS - 2), True]
    last = found.viewpoints[-1]
    assert last is not None
    assert last.eye == pytest.approx(camera.eye, abs=1e-3)
    assert not last.mirrored, "the mirror is a switch of its own"


@pytest.mark.parametrize("place", DoublePlace)
def test_colours_size_and_the_double_come_back_too(place: DoublePlace, tmp_path: Path) -> None:
    look = replace(ViewSettings(), theme=Theme.APART, double=place).scaled(3)
    path = save_settings(with_view_settings(Settings(), look), tmp_path / "settings.toml")
    found = view_settings_of(load_settings(path))
    assert (found.theme, found.scale, found.double) == (Theme.APART, 1.75, place)


def test_panels_grow_and_shrink_by_quarters_and_have_their_limits() -> None:
    assert ViewSettings().scaled(-1).scale == 0.75
    assert ViewSettings().scaled(-5).scale == 0.75
    assert ViewSettings().scaled(9).scale == 2.5
    assert replace(ViewSettings(), scale=1.1).scaled(1).scale == 1.25, "from a size of one's own to the next quarter"


def test_the_double_goes_round() -> None:
    looks = [ViewSettings()]
    for _ in range(3):
        looks.append(looks[-1].next_double())
    assert [look.double.name for look in looks] == ["NOWHERE", "OVER", "BESIDE", "NOWHERE"]


def test_the_second_picture_goes_round() -> None:
    looks = [ViewSettings()]
    for _ in range(3):
        looks.append(looks[-1].next_inset())
    assert [look.inset for look in looks] == [None, NamedView.HANDS, NamedView.FEET, None]


@pytest.mark.parametrize(
    ("settings", "fault"),
    [
        (Settings(view="moon"), "view: expected one of front, shoulder"),
        (Settings(theme="pink"), "theme: expected one of night, day, contrast, apart"),
        (Settings(inset="top"), "inset: expected one of hands, feet"),
        (Settings(viewpoints="9=0,0,1,0,0,1,40"), "viewpoints: expected 1…8="),
        (Settings(viewpoints="1=0,0,1,0,0,1"), "found '1=0,0,1,0,0,1'"),
        (Settings(viewpoints="1=0,0,nan,0,0,1,40"), "viewpoints"),
        (Settings(viewpoints="1=0,0,1,0,0,-1,40"), "viewpoints"),
    ],
)
def test_what_is_no_look_is_named(settings: Settings, fault: str) -> None:
    with pytest.raises(BadInput, match=fault):
        view_settings_of(settings)


def test_on_a_left_handed_kit_the_hands_close_ups_change_sides() -> None:
    """A left-handed kit is the right-handed one mirrored in x = 0: what was the right hand's is the left's."""
    right, left = named(NamedView.RIGHT_HAND), named(NamedView.LEFT_HAND, Stage(load_kit().mirrored, figure_of()))
    assert left.eye == pytest.approx((-right.eye[0], *right.eye[1:]))


def test_the_second_picture_lies_in_the_corner_of_the_scene() -> None:
    """Sixteen to nine, within the scene, at its lower right; narrow scenes get a narrower one."""
    for scene in ((200, 300, 1000, 500), (0, 0, 300, 900)):
        left, low, width, height = inset_area(scene)
        assert scene[0] < left
        assert left + width < scene[0] + scene[2]
        assert scene[1] < low < scene[1] + scene[3] / 2
        assert width / height == pytest.approx(16 / 9, rel=0.02)
