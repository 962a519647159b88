"""`station sync`: fit a periodic model to a motion, and tell where in its cycle another one is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from math import pi
from pathlib import Path
from typing import TYPE_CHECKING

from station.cli.console import print_json, say, write
from station.cli.options.option_fields import (
    Command,
    Verbs,
    argument,
    arguments,
    choice,
    flag,
    number,
    option,
    required,
    unread,
    whole_number,
)
from station.cli.sync_sonify import COMMAND as SONIFY
from station.core.errors import BadInput

if TYPE_CHECKING:
    from station.sync.phase.periodic_model import Exemplar, PeriodicModel
    from station.sync.phase.phase_tracker import PhaseTrack, TrackerSettings
    from station.sync.signals.signal import FloatArray, Signal

SCHEMA = "drum-station/sync-track/1"
_CENTRES = 16
"""`station.sync.phase.periodic_model.CENTRES`."""
_OWN, _MODEL, _HIGH_PASS = "signal", "model", "high-pass"
_CUTOFF_HZ = 0.05
"""Far below the slowest cycle that people repeat, so that its phase stays (our choice: 3° at 1 Hz)."""
_SAMPLES = "a motion: .csv, .amc with its .asf beside it, or .bvh"


# --- what the options say ---------------------------------------------------------------------------------------------


def _seconds(text: str) -> tuple[float, float]:
    """Begin and end of a period."""
    start, _, end = text.partition(":")
    try:
        found = float(start), float(end)
    except ValueError:
        raise unread("seconds such as 0.25:1.35", text) from None
    if not 0 < found[1] - found[0] < float("inf"):
        raise unread("a period that ends after it begins", text)
    return found


def _ages(text: str) -> tuple[int, ...]:
    """Ages of samples, the newest first."""
    try:
        found = tuple(int(word) for word in text.split(","))
    except ValueError:
        raise unread("samples such as 0,12,24", text) from None
    if found[0] != 0 or min(found) < 0 or len(set(found)) < len(found) or max(found) > 100_000:
        raise unread("ages of samples, each once, the first 0", text)
    return found


def _at_least_0(below: float) -> Callable[[str], float]:
    """What reads a number from 0 to just below a limit."""

    def read(text: str) -> float:
        value = number(text)
        if not 0 <= value < below:
            raise unread(f"a number from 0 to less than {below:g}", text)
        return value

    return read


def _above_0(text: str) -> float:
    value = _at_least_0(pi)(text)
    if not value:
        raise unread("a number above 0", text)
    return value


@dataclass(frozen=True, slots=True, kw_only=True)
class FitOptions:
    """What a model is fitted to, and where it goes."""

    exemplars: tuple[str, ...] = arguments("EXEMPLAR", _SAMPLES)
    out: Path = required("MODEL.toml", "the model to write", Path)
    channels: str | None = option(
        "NAMES", "walk, or names divided by commas (walk where it is there, else all)", str, None
    )
    centres: int = option("N", f"Gaussians over the cycle ({_CENTRES})", whole_number, _CENTRES)
    reference: str | None = option(
        "CHANNEL", "a cycle begins where it rises through its mean (the first channel)", str, None, rivals="cycle"
    )
    period: tuple[float, float] | None = option(
        "START:END", "the one cycle that is taken, in seconds", _seconds, None, rivals="cycle"
    )
    all_cycles: bool = flag("take every cycle, and not the first alone")
    mixed_units: bool = flag("the channels have no common unit: each counts by its SD")
    zero_mean: str = choice(
        {_OWN: _OWN, _HIGH_PASS: _HIGH_PASS}, f"what is taken from every channel ({_OWN}: each cycle's mean)", _OWN
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class TrackOptions:
    """Which signal is tracked, and how."""

    model: Path = argument("MODEL", "a model that `station sync fit` wrote", Path)
    signal: Path = argument("SIGNAL", _SAMPLES, Path)
    paper: bool = flag("as Boyd and Godbout 2012: no feedback, cadence 0.05, from phase 0 on")
    smoothing: float | None = option(
        "--lambda L", "how much steady cadence counts beside the signal (100)", _at_least_0(1e9), None
    )
    cadence: float | None = option("RAD", "phase expected from sample to sample (the model's)", _above_0, None)
    feedback: float | None = option("PART", "of each surprise that changes the cadence (0.02)", _at_least_0(1), None)
    ages: tuple[int, ...] = option("N,N", "compare samples of these ages together (0)", _ages, (0,))
    zero_mean: str = choice(
        {each: each for each in (_OWN, _MODEL, _HIGH_PASS)}, f"what is taken from every channel ({_OWN}'s mean)", _OWN
    )
    json: bool = flag("print one JSON document")


# --- fit --------------------------------------------------------------------------------------------------------------


def _fit(options: FitOptions) -> int:
    """Fit a model, write it, say how well it fits."""
    from station.sync.phase.model_file import save_model
    from station.sync.phase.periodic_model import FEWEST_CENTRES, MOST_CENTRES, fitted
    from station.sync.signals.signal_files import read_signal

    if not FEWEST_CENTRES <= options.centres <= MOST_CENTRES:
        fault = f"expected {FEWEST_CENTRES} to {MOST_CENTRES}, found {options.centres}"
        raise BadInput("--centres", "", fault)
    if options.period is not None and len(options.exemplars) > 1:
        raise BadInput("--period", "", "expected one EXEMPLAR beside it")
    signals = [read_signal(Path(name)) for name in options.exemplars]
    names = _channels(options.channels, signals[0])
    exemplars = [each for signal in signals for each in _cycles(options, signal, names)]
    model = fitted(names, exemplars, options.centres, one_unit=not options.mixed_units)
    save_model(model, options.out)
    channels = "1 channel" if len(names) == 1 else f"{len(names)} channels"
    cycles = "1 cycle" if len(exemplars) == 1 else f"{len(exemplars)} cycles"
    period = "" if model.period_s is None else f", period {model.period_s:.3f} s"
    say(f"model    {options.out}: {channels}, {options.centres} centres, {cycles}{period}")
    return 0


def _channels(said: str | None, signal: Signal) -> tuple[str, ...]:
    from station.sync.signals.signal import CHANNEL_SETS

    if said is None:
        walk = CHANNEL_SETS["walk"]
        return walk if set(walk) <= set(signal.names) else signal.names
    names = CHANNEL_SETS.get(said) or tuple(name.strip() for name in said.split(","))
    if len(set(names)) < len(names):
        raise BadInput("--channels", "", f"expected each channel once, found {said}")
    return names


def _cycles(options: FitOptions, signal: Signal, names: tuple[str, ...]) -> list[Exemplar]:
    from station.sync.phase.exemplars import cycle, cycles

    if options.zero_mean == _HIGH_PASS:
        signal = replace(signal, values=_high_passed(signal))
    if options.period is not None:
        return [cycle(signal.only(names), *options.period)]
    return cycles(signal, options.reference or names[0], None if options.all_cycles else 1, names)


def _high_passed(signal: Signal) -> FloatArray:
    from station.sync.signals.running_mean import high_passed

    return high_passed(signal.values, _CUTOFF_HZ, signal.rate_hz)


# --- track ------------------------------------------------------------------------------------------------------------


def _track(options: TrackOptions) -> int:
    """Track a signal and print what is known after each of its samples."""
    from station.sync.phase.model_file import load_model
    from station.sync.phase.phase_tracker import tracked
    from station.sync.signals.signal_files import read_signal

    model = load_model(options.model)
    signal = read_signal(options.signal).only(model.channels)
    settings = _settings(options, model, signal)
    track = tracked(model, _in_units_of(model, signal, options.zero_mean), settings)
    if options.json:
        print_json(_document(options, settings, signal, track))
    else:
        _print(signal, track)
    return 0


def _settings(options: TrackOptions, model: PeriodicModel, signal: Signal) -> TrackerSettings:
    """The settings that were said; the model's own period tells the cadence where nothing else does."""
    from station.sync.phase.phase_tracker import ADAPTIVE, PAPER
    from station.sync.phase.whole_recording import own_cadence

    settings = PAPER if options.paper else ADAPTIVE
    cadence = options.cadence
    if cadence is None and not options.paper:
        cadence = own_cadence(model, signal)
    said = {"cadence_rad": cadence, "smoothing": options.smoothing, "feedback": options.feedback}
    return replace(settings, lags=options.ages, **{name: value for name, value in said.items() if value is not None})


def _in_units_of(model: PeriodicModel, signal: Signal, taken: str) -> FloatArray:
    """The signal about the model's own mean."""
    from station.sync.phase.whole_recording import zero_mean

    if taken == _MODEL:
        return signal.values
    if taken == _HIGH_PASS and len(signal):
        return _high_passed(signal) + model.mean
    return zero_mean(model, signal).values


def _document(options: TrackOptions, settings: TrackerSettings, signal: Signal, track: PhaseTrack) -> dict[str, object]:
    return {
        "schema": SCHEMA,
        "model": str(options.model),
        "signal": signal.name,
        "channels": list(signal.names),
        "settings": asdict(settings),
        "time_s": signal.time_s.tolist(),
        "phase_rad": track.phase_rad.tolist(),
        "quality": track.quality.tolist(),
        "confidence": track.confidence.tolist(),
        "cadence_rad": track.cadence_rad.tolist(),
        "locked": track.locked.tolist(),
    }


def _print(signal: Signal, track: PhaseTrack) -> None:
    """A line a sample."""
    write("   time_s  phase_rad  quality  confidence  cadence_rad  locked")
    columns = signal.time_s, track.phase_rad, track.quality, track.confidence, track.cadence_rad, track.locked
    rows = zip(*(column.tolist() for column in columns), strict=True)
    for time_s, phase_rad, quality, confidence, cadence_rad, locked in rows:
        numbers = f"{time_s:9.4f} {phase_rad:10.4f} {quality:8.3f} {confidence:11.2f} {cadence_rad:12.4f}"
        write(f"{numbers}  {'yes' if locked else 'no'}")


COMMAND = Verbs(
    (
        ("fit", "fit a periodic model to one or more motions", Command(FitOptions, _fit)),
        ("track", "tell the phase of a signal against a model, sample by sample", Command(TrackOptions, _track)),
        ("sonify", "let a motion's phase trigger drums: as sound, MIDI, a film or a picture", SONIFY),
    )
)
