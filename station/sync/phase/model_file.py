"""Periodic models as TOML files (docs/phase.md): a few facts, and a table for each channel."""

from pathlib import Path

import numpy as np

from station.core.disk.files import write_whole
from station.core.toml.schema import Field, Fields, list_of, needed, number, one_of, optional, read, record, title
from station.core.toml.toml_faults import wrong
from station.core.toml.toml_source import read_source
from station.core.toml.toml_write import toml_text
from station.sync.phase.periodic_model import FEWEST_CENTRES, MOST_CENTRES, PeriodicModel

FORMAT = "drum-station/phase-model/1"
_LARGEST, _SMALLEST = 1e12, 1e-12
_NUMBER = number(-_LARGEST, _LARGEST)


def save_model(model: PeriodicModel, path: Path) -> None:
    """Write a model; raises `DeviceError` where it cannot be written."""
    write_whole(path, model_text(model).encode())


def load_model(path: Path) -> PeriodicModel:
    """Read a model; raises `BadInput` with line and column of what is wrong."""
    return read(read_source(path), MODEL)


def model_text(model: PeriodicModel) -> str:
    """A model as TOML, its numbers to the last bit."""
    head = [f'format = "{FORMAT}"', *([] if model.period_s is None else [f"period_s = {model.period_s!r}"])]
    rows = zip(model.channels, model.mean.tolist(), model.scale.tolist(), model.weights.tolist(), strict=True)
    return "\n".join([*head, *(_channel_text(*row) for row in rows)])


def _channel_text(name: str, mean: float, scale: float, weights: list[float]) -> str:
    listed = "".join(f"    {weight!r},\n" for weight in weights)
    return f"\n[[channel]]\nname = {toml_text(name)}\nmean = {mean!r}\nscale = {scale!r}\nweights = [\n{listed}]\n"


Row = tuple[str, float, float, tuple[float, ...]]


def _channel(name: str | None, mean: float, scale: float, weights: tuple[float, ...] | None) -> Row:
    if name is None or weights is None:
        raise wrong("expected name and weights")
    if not FEWEST_CENTRES <= len(weights) <= MOST_CENTRES:
        raise wrong(f"expected {FEWEST_CENTRES} to {MOST_CENTRES} weights, found {len(weights)}", "weights")
    return name, mean, scale, weights


def _model(kind: str | None, period_s: float | None, rows: tuple[Row, ...] | None) -> PeriodicModel:
    assert kind == FORMAT or kind is None
    rows = rows or ()
    if not rows:
        raise wrong("expected at least one table [[channel]]")
    names = [name for name, *_ in rows]
    for at, (name, _, _, weights) in enumerate(rows):
        if name in names[:at]:
            raise wrong(f"{name} is here twice", "channel", at, "name")
        if len(weights) != len(rows[0][3]):
            raise wrong(f"expected {len(rows[0][3])} weights as the first has, found {len(weights)}", "channel", at)
    mean, scale, weight = (np.array([row[column] for row in rows], dtype=np.float64) for column in (1, 2, 3))
    return PeriodicModel(tuple(names), weight, mean, scale, period_s)


_read_channel = record(
    _channel,
    {
        "name": needed(title, '"rfemur_rx"'),
        "mean": Field(_NUMBER, 0.0),
        "scale": Field(number(_SMALLEST, _LARGEST), 1.0),
        "weights": needed(list_of(_NUMBER, "a list of numbers"), "[0.1, 0.2, 0.3]"),
    },
)
FIELDS: Fields = {
    "format": Field(one_of([FORMAT], "format"), None, f'"{FORMAT}"', "kind"),
    "period_s": optional(number(_SMALLEST, _LARGEST)),
    "channel": Field(list_of(_read_channel, "tables [[channel]]"), None, "[[channel]]", "rows"),
}
MODEL = record(_model, FIELDS)
"""How a model's file is read."""
