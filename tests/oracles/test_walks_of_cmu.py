"""Walks and runs of the CMU database: two editions by others agree on the legs, and phases agree with the feet."""

import runpy
import sys
from pathlib import Path

import numpy as np
import pytest

from station.sync.phase.phase_tracker import PAPER, TrackerSettings
from station.sync.phase.whole_recording import track_recording
from station.sync.sonification.trigger_table import PRESETS
from station.sync.sonification.triggers import share_of
from station.sync.walking.trial import Trial, gait_model
from tests.oracles.folder import ORACLES, oracles

pytestmark = [pytest.mark.oracle]

LEG = ("femur", "tibia", "foot", "toes")
LEVEL = [each for each in oracles("the CMU motions") if each.id != "mocap/amc/03/03_04.amc"]
"""All but a walk over steps."""
CONVERGED = 0.75
"""Of a cycle: the paper's longest."""


def find(kind: str, trial: str) -> Path:
    """A trial's file; the test is left out where the folder lacks it."""
    path = ORACLES / "mocap" / kind / trial[:2] / f"{trial}.{kind}"
    if not path.is_file():
        pytest.skip(f"no {path}")
    return path


@pytest.mark.parametrize("trial", ["07_01", "02_03"])
def test_both_editions_put_the_legs_in_one_place(trial: str) -> None:
    amc, bvh = (Trial.read(find(kind, trial)) for kind in ("amc", "bvh"))
    joints = [side + bone for side in "rl" for bone in LEG]
    ours, theirs = (each.places[:, [each.skeleton.index(joint) for joint in joints]] for each in (amc, bvh))
    assert np.abs(ours - theirs).max() < 1e-4


@pytest.mark.parametrize("path", LEVEL)
def test_a_body_walks_upright_on_the_floor(path: Path) -> None:
    """Heels within 8 cm of the floor (a marker's shift, a sole) whenever they are lowest; the head a stature above."""
    trial = Trial.read(path)
    places = trial.places
    for side, foot in zip("rl", trial.steps, strict=True):
        rows = np.rint((foot.low_s - trial.signal.time_s[0]) * trial.signal.rate_hz).astype(int)
        assert np.abs(places[rows, trial.skeleton.index(f"{side}heel"), 1]).max(initial=0.0) < 0.08
    assert 1.3 < np.median(places[..., 1].max(axis=1)) < 2.0


@pytest.mark.parametrize("settings", [PAPER, None], ids=["paper", "adaptive"])
@pytest.mark.parametrize(
    ("exemplar", "trials", "preset"),
    [
        ("amc 07_01", "07_01 07_06 08_01 08_04 02_01 16_15 16_22 35_05 35_28 49_01", "walk"),
        ("bvh 09_01", "09_05 09_11 02_03", "run"),
    ],
)
def test_triggers_fall_with_the_heels(
    exemplar: str, trials: str, preset: str, settings: TrackerSettings | None
) -> None:
    """Within .05 of a cycle in the median, and within .1 in 95 % of steps."""
    kind = exemplar[:3]
    model = gait_model(Trial.read(find(*exemplar.split())).signal)
    errors = []
    for name in trials.split():
        trial = Trial.read(find(kind, name) if name != "02_03" else find("amc", name))
        phase = np.unwrap(track_recording(model, trial.signal, settings).phase_rad)
        assert model.period_s is not None
        for foot, trigger in zip(trial.steps, PRESETS[preset], strict=True):
            for at_s in foot.low_s[foot.contact_s > CONVERGED * model.period_s]:
                share = share_of(float(np.interp(at_s, trial.signal.time_s, phase)))
                errors.append(abs((share - trigger.threshold + 0.5) % 1.0 - 0.5))
    assert len(errors) >= 2 * len(trials.split())
    assert np.median(errors) < 0.05
    assert np.quantile(errors, 0.95) < 0.1


@pytest.mark.gl
def test_the_papers_figures_are_drawn(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    find("bvh", "09_12")
    monkeypatch.setattr(sys, "argv", ["paper_figures.py", str(ORACLES / "mocap"), "--out", str(tmp_path)])
    runpy.run_path(str(Path(__file__).parents[2] / "examples" / "paper_figures.py"), run_name="__main__")
    assert {path.name for path in tmp_path.iterdir()} == {"figure_2.png", "figure_5.png", "figure_6.png"}
