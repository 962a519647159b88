"""Draw the figures of Boyd and Godbout (ICAD 2012) anew, from the same data by the same formulas.

    python examples/paper_figures.py MOCAP [--out FOLDER]

MOCAP is a folder with trials of the CMU Motion Capture Database (mocap.cs.cmu.edu; free to use, not to be sold on, and
not part of the station): `amc/07/07_01.amc` with `amc/07/07.asf` beside it, or `bvh/09/09_01.bvh`. Needed are 07_01,
49_01, 09_12 for figures 2 and 5, and 09_01, 09_05, 02_03 for figure 6. Writes `figure_2.png`, `figure_5.png` and
`figure_6.png`. In the plots discs are where a drum would sound, triangles where the skeleton's heel comes down.
"""

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from station.core.errors import BadInput
from station.render.files.png_file import write_png
from station.render.flat_picture import FlatPictures, flat_pictures
from station.render.palette import BRAND, EARLY, GOOD, INK, INK_FAINT, INK_SOFT, WRONG
from station.render.phase.phase_plot import draw_phase_plot
from station.render.report.report_cards import paper
from station.render.report.report_layout import ReportBox
from station.render.text.draw_list import Colour, DrawList, TypeStyle
from station.render.text.fonts import Face
from station.scenes.phase_view import trace_of
from station.sync.phase.periodic_model import PeriodicModel, gaussians
from station.sync.phase.phase_tracker import TrackerSettings
from station.sync.sonification.sonified import sonified
from station.sync.sonification.trigger_table import PRESETS
from station.sync.walking.trial import GAIT_CHANNELS, Trial, gait_model

WALK_MODEL, RUN_MODEL = "07_01", "09_01"
SIZE = (1600, 1000)
_EDGE, _HEAD, _GAP = 20.0, 76.0, 14.0
_COLOURS = (BRAND, WRONG, EARLY, GOOD)
_NAMES = {"rfemur_rx": "right femur", "lfemur_rx": "left femur", "rtibia_rx": "right tibia", "ltibia_rx": "left tibia"}


@dataclass(frozen=True, slots=True)
class Panel:
    """A plot of a figure: its title, what the paper says of it in short, the trial and which seconds of it."""

    title: str
    remark: str
    trial: str
    span_s: tuple[float, float] = (0.0, np.inf)
    smoothing: float = 100.0


FIGURE_5 = (
    Panel("(a) the model's own sequence", "07_01: converges in less than half a cycle", "07_01"),
    Panel("(b) a slower walk, another person", "49_01: 1.4 s a cycle, and yet it locks", "49_01"),
    Panel("(c) walks and turns", "09_12: a U-turn on the way at 4-5 s; stops and turns at 7.3 s", "09_12", (0.0, 8.0)),
    Panel("(d) walks backwards", "09_12: the phase is driven to and fro, E max is often low", "09_12", (12.4, 15.9)),
    Panel("(d) the same with λ = 0", "09_12: the phase runs downwards, in leaps", "09_12", (12.4, 15.9), 0.0),
)
FIGURE_6 = (
    Panel("(a) the model's own sequence", "09_01: 0.72 s a cycle", "09_01"),
    Panel("(a) the model's person, another trial", "09_05: 0.73 s a cycle", "09_05"),
    Panel("(b) another person", "02_03: 0.77 s a cycle", "02_03"),
)
ABSENT = (
    "The paper's (c), a run that stops and turns with a hop, and (d), a run around a square: no such trial is among the"
    " data that this was made for."
)


class Trials:
    """The trials of a folder, read once."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._read: dict[str, Trial] = {}

    def trial(self, name: str) -> Trial:
        """A trial by its name; raises `BadInput` that says what to get where it is not there."""
        if name not in self._read:
            subject = name.split("_", maxsplit=1)[0]
            paths = [self._folder / kind / subject / f"{name}.{kind}" for kind in ("amc", "bvh")]
            path = next((path for path in paths if path.is_file()), None)
            if path is None:
                raise BadInput(paths[0], "", f"no such file: get trial {name} from mocap.cs.cmu.edu, with its .asf")
            self._read[name] = Trial.read(path)
        return self._read[name]


def tracked_figure(
    maker: FlatPictures, heading: str, trials: Trials, model: PeriodicModel, panels: Sequence[Panel], preset: str
) -> DrawList:
    """A figure of tracked phases, three plots a row."""
    draw_list = DrawList(maker.atlas)
    _heading(draw_list, heading)
    absent = (ABSENT,) if preset == "run" else ()
    boxes = _boxes(len(panels) + len(absent))
    for panel, box in zip(panels, boxes, strict=False):
        trial = trials.trial(panel.trial).between(*panel.span_s)
        settings = TrackerSettings(smoothing=panel.smoothing)
        told = sonified(model, trial.signal, PRESETS[preset], settings)
        trace = trace_of(told, PRESETS[preset], panel.title, trial.steps, panel.remark)
        draw_phase_plot(draw_list, trace, box)
    for words, box in zip(absent, boxes[len(panels) :], strict=True):
        paper(draw_list, box)
        draw_list.paragraph(
            words, (box.left + 40, box.top + box.height / 2 - 10), TypeStyle(16, INK_SOFT), box.width - 80
        )
    return draw_list


def model_figure(maker: FlatPictures, exemplar: Trial, model: PeriodicModel) -> DrawList:
    """Figure 2: the exemplar's angles, the model of them, its Gaussians, and these in polar coordinates."""
    draw_list = DrawList(maker.atlas)
    _heading(draw_list, "Figure 2: from an exemplar to a periodic model (07_01, 4 channels, 16 Gaussians)")
    signal = exemplar.signal.only(GAIT_CHANNELS)
    phase = np.linspace(-np.pi, np.pi, 361)
    basis = gaussians(phase, model.centre_count)
    a, b, c, d = _boxes(4)
    values = signal.values - signal.values.mean(axis=0)
    _curves(
        draw_list,
        a,
        "(a) rotations about x, zero-mean, degrees",
        signal.time_s,
        values,
        ("0 s", f"{signal.time_s[-1]:.1f} s"),
    )
    _curves(draw_list, b, "(b) the model over one cycle", phase, model.at(phase), ("−π", "π"))
    _curves(draw_list, c, "(c) the basis functions", phase, basis, ("−π", "π"))
    _polar(draw_list, d, "(d) the same, polar", phase, basis)
    for k, name in enumerate(GAIT_CHANNELS):
        left = a.left + 60 + k * 150
        draw_list.box((left, a.bottom - 24), (18, 3), _COLOURS[k])
        draw_list.text(_NAMES[name], (left + 24, a.bottom - 17), TypeStyle(14, INK_SOFT))
    return draw_list


def _heading(draw_list: DrawList, words: str) -> None:
    draw_list.text(words, (_EDGE, 36), TypeStyle(24, INK, Face.BOLD))
    about = (
        "After Boyd and Godbout, ICAD 2012. Data: mocap.cs.cmu.edu, created with funding from NSF EIA-0196217."
        "   Pale: not locked. Discs: what sounds. Triangles: a heel comes down, right orange, left pink."
    )
    draw_list.text(about, (_EDGE, 60), TypeStyle(14, INK_SOFT))


def _boxes(count: int) -> list[ReportBox]:
    """Places for `count` plots in two rows, each as wide as there is room for."""
    height = (SIZE[1] - _HEAD - _EDGE - _GAP) / 2
    found = []
    for row, columns in enumerate((-(-count // 2), count // 2)):
        width = (SIZE[0] - 2 * _EDGE - (columns - 1) * _GAP) / columns
        top = _HEAD + row * (height + _GAP)
        found += [ReportBox(_EDGE + column * (width + _GAP), top, width, height) for column in range(columns)]
    return found


def _curves(
    draw_list: DrawList, box: ReportBox, title: str, x: np.ndarray, y: np.ndarray, ends: tuple[str, str]
) -> None:
    paper(draw_list, box)
    draw_list.text(title, (box.left + 54, box.top + 26), TypeStyle(16, INK, Face.BOLD))
    left, right, top, low = box.left + 54, box.right - 16, box.top + 44, box.bottom - 56
    least, most = min(float(y.min()), 0.0), float(y.max())
    across = left + (right - left) * (x - x[0]) / (x[-1] - x[0])
    for value in {0.0, least, most}:
        height = low - (low - top) * (value - least) / (most - least)
        draw_list.box((left, height - 0.5), (right - left, 1.0), INK_FAINT)
        words = f"{value:.2g}" if most < 10 else f"{value:.0f}"
        draw_list.text(words.replace("-", "−"), (left - 8, height + 5), TypeStyle(13, INK_SOFT, Face.REGULAR, 1.0))
    for k in range(y.shape[1]):
        heights = low - (low - top) * (y[:, k] - least) / (most - least)
        _line(draw_list, across, heights, _COLOURS[k % len(_COLOURS)])
    for at, words, align in ((left, ends[0], 0.0), (right, ends[1], 1.0)):
        draw_list.text(words, (at, low + 20), TypeStyle(13, INK_SOFT, Face.REGULAR, align))


def _polar(draw_list: DrawList, box: ReportBox, title: str, phase: np.ndarray, basis: np.ndarray) -> None:
    paper(draw_list, box)
    draw_list.text(title, (box.left + 54, box.top + 26), TypeStyle(16, INK, Face.BOLD))
    x, y, reach = box.left + box.width / 2, box.top + box.height / 2 + 12, 0.41 * box.height
    draw_list.ellipse((x, y), (reach, reach), INK_FAINT, 0.0, (0.0, 1.0, 0.0))
    for words, way in (("0", (1, 0)), ("π/2", (0, -1)), ("π", (-1, 0)), ("−π/2", (0, 1))):
        draw_list.text(
            words,
            (x + (reach + 20) * way[0], y + (reach + 12) * way[1] + 5),
            TypeStyle(13, INK_SOFT, Face.REGULAR, 0.5),
        )
    for k in range(basis.shape[1]):
        radius = reach * basis[:, k] / basis.max()
        _line(draw_list, x + radius * np.cos(phase), y - radius * np.sin(phase), _COLOURS[k % len(_COLOURS)])


def _line(draw_list: DrawList, x: np.ndarray, y: np.ndarray, colour: Colour) -> None:
    for k in range(len(x) - 1):
        draw_list.line((float(x[k]), float(y[k])), (float(x[k + 1]), float(y[k + 1])), 1.8, colour)


def main() -> None:
    """Draw them."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mocap", type=Path, metavar="MOCAP")
    parser.add_argument("--out", type=Path, default=Path(), metavar="FOLDER")
    options = parser.parse_args()
    trials = Trials(options.mocap)
    try:
        walk, run = (gait_model(trials.trial(name).signal) for name in (WALK_MODEL, RUN_MODEL))
        with flat_pictures(SIZE) as maker:
            figures = {
                "figure_2": model_figure(maker, trials.trial(WALK_MODEL), walk),
                "figure_5": tracked_figure(
                    maker, "Figure 5: walking, model from 07_01", trials, walk, FIGURE_5, "walk"
                ),
                "figure_6": tracked_figure(maker, "Figure 6: running, model from 09_01", trials, run, FIGURE_6, "run"),
            }
            for name, draw_list in figures.items():
                path = options.out / f"{name}.png"
                write_png(maker.picture(draw_list.shapes()), path)
                print(path)
    except BadInput as fault:
        parser.error(str(fault))


if __name__ == "__main__":
    main()
