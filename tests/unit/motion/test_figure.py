import math
from pathlib import Path

import pytest

from station.core.errors import BadInput
from station.motion.figure import PARENT, Joint, figure_of, load_figure


def test_segments_are_the_published_shares_of_the_stature() -> None:
    figure = figure_of(2.0)  # HUMANS, Body
    assert figure.upper_arm_m == pytest.approx(0.372)
    assert figure.forearm_m == pytest.approx(0.292)
    assert figure.thigh_m == pytest.approx(0.490)
    assert figure.shank_m == pytest.approx(0.492)
    assert figure.trunk_m == pytest.approx(0.576)
    assert figure_of(1.70).shoulder_breadth_m == pytest.approx(0.34)  # Rajagopal 2016, a man of 1.70 m


def test_limits_are_the_published_ones() -> None:
    limits = figure_of().limits
    assert math.degrees(limits.elbow_flexion) == pytest.approx(150)
    assert math.degrees(limits.wrist_extension) == pytest.approx(70)
    assert math.degrees(limits.wrist_radial) == pytest.approx(20)


@pytest.mark.parametrize("name", ["median", "tall", "small"])
def test_shipped_figures_load(name: str) -> None:
    assert 1.5 < load_figure(name).stature_m < 2.0


def test_a_file_sets_segments_and_limits(tmp_path: Path) -> None:
    path = tmp_path / "me.toml"
    path.write_text("stature_m = 1.8\n[segments]\nforearm_m = 0.3\n[limits]\nwrist_extension = 50\n")
    figure = load_figure(path)
    assert figure.forearm_m == 0.3
    assert figure.upper_arm_m == pytest.approx(0.186 * 1.8)
    assert math.degrees(figure.limits.wrist_extension) == pytest.approx(50)


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("stature_m = 5", "stature_m"),
        ("title = 'x'", "stature_m"),
        ("stature_m = 1.8\n[limits]\nwrist = 3", "limits.wrist"),
        ("stature_m = 1.8\n[segments]\nforearm_m = 'long'", "segments.forearm_m"),
    ],
)
def test_a_faulty_figure_names_the_place(tmp_path: Path, text: str, place: str) -> None:
    path = tmp_path / "me.toml"
    path.write_text(text)
    with pytest.raises(BadInput) as caught:
        load_figure(path)
    assert caught.value.place.endswith(place)


def test_every_joint_hangs_from_the_pelvis_in_the_end() -> None:
    for joint in Joint:
        seen = joint
        while (above := PARENT[seen]) is not None:
            seen = above
        assert seen is Joint.PELVIS
