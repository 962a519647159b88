"""`station sync sonify MODEL SIGNAL --out FILE`: drums at thresholds of a motion's phase, as sound, MIDI or film."""

from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from station.cli.console import Progress, print_json, say
from station.cli.options.option_fields import (
    Command,
    argument,
    choice,
    flag,
    number,
    option,
    repeated,
    required,
)
from station.core.errors import BadInput
from station.core.units import NS_PER_S
from station.sync.phase.model_file import load_model
from station.sync.phase.phase_tracker import PAPER
from station.sync.signals.signal import Signal
from station.sync.signals.signal_files import read_signal
from station.sync.sonification.channel_levels import parse_level
from station.sync.sonification.sonified import Sonified, sonified
from station.sync.sonification.trigger_table import PRESETS, parse_trigger
from station.sync.sonification.triggers import Trigger, share_of

if TYPE_CHECKING:
    from station.scenes.soundtrack import Sounds

MIDI, SOUND, FILM, PICTURE = ".mid", ".wav", ".mp4", ".png"
ENDINGS = ".mid, .wav, .mp4 or .png"
SCHEMA = "drum-station/sonify/1"
RATE_HZ = 48_000
FPS, SIZE = 60, (1280, 720)
"""Half the trials' rate, so that every picture is a sample of its own (our choice)."""
_LONGEST_S = 1_800.0
"""Of a recording that becomes sound (our choice): the whole of it is in memory, a gigabyte for a quarter of an hour."""
_USUAL_PRESET = "walk"


@dataclass(frozen=True, slots=True, kw_only=True)
class SonifyOptions:
    """What is tracked by which model, what it triggers, and what is made of it."""

    model: Path = argument("MODEL", "a periodic model (station sync fit)", Path)
    signal: Path = argument("SIGNAL", "the motion: .csv, .amc with its .asf, or .bvh", Path)
    out: Path = required("FILE", f"the file to write: {ENDINGS}; a film or a picture needs a skeleton", Path)
    preset: str | None = choice(
        {name: name for name in PRESETS}, f"footfalls: right a kick, left a snare ({_USUAL_PRESET})", None
    )
    trigger: tuple[str, ...] = repeated(
        "PHASE=WHAT",
        "a sound at a share of the cycle instead, such as 0.25=kick, 0.5=hihat@60 or 0.75=76 (a MIDI note)",
    )
    level: tuple[str, ...] = repeated(
        "CHANNEL=CONTROLLER", "of a .mid: a channel of the motion moves a MIDI controller too, such as rtibia_rx=74"
    )
    drums: str | None = option("--sounds KIT", "the drum kit that sounds (the settings')", str, None)
    time: float | None = option("S", "the second that a picture shows (the recording's middle)", number, None)
    paper: bool = flag("track as Boyd and Godbout 2012 do: a cadence that never changes")
    json: bool = flag("say what sounds as one JSON document")


def run(options: SonifyOptions) -> int:
    """Track it, trigger, and write the file."""
    ending = options.out.suffix.lower()
    if ending not in (MIDI, SOUND, FILM, PICTURE):
        raise BadInput(options.out, "", f"expected a name that ends in {ENDINGS}")
    if options.level and ending != MIDI:
        raise BadInput("--level", "", f"expected with a file that ends in {MIDI}")
    triggers = _triggers(options)
    model, signal = load_model(options.model), read_signal(options.signal)
    if ending in (SOUND, FILM):
        _check_length(signal)
    told = sonified(model, signal, triggers, PAPER if options.paper else None)
    _write(options, ending, triggers, told)
    if options.json:
        print_json(_document(told))
    else:
        locked = 100 * float(told.track.locked.mean())
        length_s = len(signal) / signal.rate_hz
        say(f"{len(told.hits)} sounds in {length_s:.1f} s, locked in {locked:.0f} % of it")
        say(f"{'film' if ending == FILM else ending[1:]}  {options.out}")
    return 0


def _check_length(signal: Signal) -> None:
    """Raises `BadInput` for a recording that is too long for sound."""
    length_s = float(np.ptp(signal.time_s)) if len(signal) else 0.0
    if length_s > _LONGEST_S:
        fault = f"lasts {length_s:g} s: expected at most {_LONGEST_S:g} for sound or a film"
        raise BadInput(signal.name, "", fault)


def _triggers(options: SonifyOptions) -> tuple[Trigger, ...]:
    """What the user wrote; raises `BadInput`."""
    if options.trigger and options.preset:
        raise BadInput("--preset, --trigger", "", "expected one of them, not both")
    if options.trigger:
        return tuple(parse_trigger(text, "--trigger") for text in options.trigger)
    return PRESETS[options.preset or _USUAL_PRESET]


def _write(options: SonifyOptions, ending: str, triggers: tuple[Trigger, ...], told: Sonified) -> None:
    if ending == MIDI:
        _write_midi(told, options)
    elif ending == SOUND:
        _write_sound(told, options)
    else:
        _write_scene(told, triggers, options, ending)


def _write_midi(told: Sonified, options: SonifyOptions) -> None:
    from station.music.formats.smf.track_writer import write_performance
    from station.music.performance import Performance

    moves = [move for text in options.level for move in told.moves(parse_level(text, told.signal, "--level"))]
    write_performance(Performance.from_hits(told.hits), options.out, moves)


def _write_sound(told: Sonified, options: SonifyOptions) -> None:
    from station.scenes.phase_film import sound_of
    from station.sound.wav_file import write_wav

    write_wav(sound_of(told.hits, _span_s(told.signal), _sounds(options)), RATE_HZ, options.out)


def _write_scene(told: Sonified, triggers: tuple[Trigger, ...], options: SonifyOptions, ending: str) -> None:
    from station.render.files.video_file import VideoFormat
    from station.scenes.phase_film import cues_of, write_phase_film, write_phase_picture
    from station.scenes.phase_view import WalkingScene, trace_of
    from station.scenes.soundtrack import Soundtrack
    from station.sync.walking.trial import Trial

    trial = Trial.read(options.signal)
    first_s, last_s = _span_s(told.signal)
    trace = trace_of(
        told, triggers, "Phase and E max", trial.steps, "discs: what sounds; triangles: the heel comes down"
    )
    scene, words = WalkingScene.of(trial, trace), options.signal.stem
    if ending == PICTURE:
        at_s = (first_s + last_s) / 2 if options.time is None else options.time
        if not first_s <= at_s <= last_s:
            raise BadInput("--time", f"{at_s:g}", f"the recording has seconds {first_s:g} to {last_s:.3f}")
        write_phase_picture(scene, words, at_s, SIZE, options.out)
        return
    soundtrack = Soundtrack(cues_of(told.hits, first_s), _sounds(options))
    video = VideoFormat(SIZE, Fraction(FPS), soundtrack.rate_hz)
    progress = Progress(round((last_s - first_s) * FPS))
    try:
        write_phase_film(scene, words, soundtrack, video, options.out, progress.show)
    finally:
        progress.close()


def _span_s(signal: Signal) -> tuple[float, float]:
    return float(signal.time_s[0]), float(signal.time_s[-1])


def _sounds(options: SonifyOptions) -> "Sounds":
    from station.core.settings import load_settings
    from station.scenes.soundtrack import Sounds
    from station.sound.samples.load_kit import load_kit

    return Sounds(load_kit(options.drums or load_settings().drums, RATE_HZ), None)


def _document(told: Sonified) -> dict[str, object]:
    return {
        "schema": SCHEMA,
        "sounds": [
            {"time_s": hit.at_ns / NS_PER_S, "piece": hit.piece.name.lower(), "velocity": hit.velocity}
            for hit in told.hits
        ],
        "time_s": told.signal.time_s.tolist(),
        "phase_rad": told.track.phase_rad.tolist(),
        "phase": [share_of(phase) for phase in told.track.phase_rad.tolist()],
        "quality": told.track.quality.tolist(),
        "locked": told.track.locked.tolist(),
    }


COMMAND = Command(SonifyOptions, run)
