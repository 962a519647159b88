"""What works on this computer: a look at each thing that the station needs or likes, and the remedy where it lacks."""

import os
import platform
import sys
from collections.abc import Callable
from dataclasses import dataclass

from station.core.errors import BadInput, DeviceError, StationError
from station.core.measured_latency import load_calibration
from station.core.settings import Settings, load_settings, settings_path

_RTMIDI_NEEDS = "g++ pkg-config python3-dev libasound2-dev libjack-jackd2-dev"
"""Debian's packages with which rtmidi is built where it has no wheel; tools/setup.sh installs the same."""
_MEGABYTE = 1e6


@dataclass(frozen=True, slots=True)
class Check:
    """What was found: `works`, the `finding` in words, and what to do (`remedy`, empty where all is well)."""

    name: str
    works: bool
    finding: str
    remedy: str = ""


def all_findings() -> list[Check]:
    """What every check finds, in the order in which a user meets what it checks."""
    return [_found(check) for check in _all_checks()]


def _all_checks() -> tuple[Callable[[], Check], ...]:
    return (
        check_python,
        check_midi_library,
        check_settings,
        check_history,
        check_midi,
        check_serial,
        check_hid,
        check_own_kits,
        check_sticks,
        check_sound,
        check_real_time,
        check_calibration,
        check_picture,
        check_video,
        check_screen,
    )


def _found(check: Callable[[], Check]) -> Check:
    try:
        return check()
    except ImportError as fault:
        name = check.__name__.removeprefix("check_").replace("_", " ")
        return Check(name, False, f"cannot be looked at: {fault}", "see to the library that cannot be loaded")


def check_python() -> Check:
    """The interpreter and the system."""
    return Check("Python", True, f"{platform.python_version()} on {platform.platform(terse=True)}")


def check_midi_library() -> Check:
    """The library behind every MIDI port: whether it loads, and has the drivers of this system."""
    try:
        from station.devices.midi.midi_clients import compiled_drivers, lacking_drivers
    except ImportError as fault:
        return Check("MIDI library", False, f"rtmidi cannot be loaded: {fault}", _rebuild_rtmidi())
    built, lacking = ", ".join(compiled_drivers()) or "no driver", ", ".join(lacking_drivers())
    if lacking:
        return Check("MIDI library", False, f"rtmidi was built with {built}, without {lacking}", _rebuild_rtmidi())
    return Check("MIDI library", True, f"rtmidi with {built}")


def _rebuild_rtmidi() -> str:
    install = f"{sys.executable} -m pip install --force-reinstall --no-cache-dir --no-deps python-rtmidi"
    return f"sudo apt install {_RTMIDI_NEEDS}; {install}" if sys.platform == "linux" else install


def check_settings() -> Check:
    """The settings file."""
    from station.app.sessions import session_checks

    path = settings_path()
    try:
        settings = load_settings()
        session_checks.check_settings(settings)
    except BadInput as fault:
        return Check("settings", False, str(fault), "mend the line, or delete the file to get the defaults")
    where = f"{path}{'' if path.exists() else ' (not there yet: defaults)'}; sessions in {settings.sessions_dir}"
    return Check("settings", True, where)


def check_history() -> Check:
    """Where what was practised is remembered, and whether it can be."""
    from station.store.health import health_of
    from station.store.opening import history_url

    remedy = "sessions stay in their folders until it is mended, and come in then"
    try:
        health = health_of(history_url(load_settings()))
    except BadInput as fault:
        return Check("history", False, str(fault), "mend the setting history, or leave it empty for a file of yours")
    if health.fault is not None:
        return Check("history", False, health.fault, remedy)
    if health.version is None or health.size is None:
        return Check("history", True, f"{health.name} (not there yet: the first session makes it)")
    size = f"{health.size / _MEGABYTE:.1f} MB"
    return Check("history", True, f"{health.name}: {size}, version {health.version}, can be read and written")


def check_midi() -> Check:
    """The MIDI driver and the kits behind it."""
    from station.devices.device_ports import midi_now

    with midi_now() as (midi, fault):
        if midi is None:
            return Check(
                "kit (MIDI)", False, f"{fault}", "or play on the computer's keyboard, or with --virtual-student"
            )
        driver, ports = midi.driver, midi.names()
    if not ports:
        return Check("kit (MIDI)", False, f"{driver} works, no kit is plugged in", "plug in a kit by USB")
    return Check("kit (MIDI)", True, f"{driver}: {', '.join(ports)}")


def check_own_kits() -> Check:
    """The kits that the user has taught the station."""
    from station.devices.mapping.device_file import kits_folder, read_kit

    files, faults = sorted(kits_folder().glob("*.toml")), list[str]()
    for path in files:
        try:
            read_kit(path)
        except BadInput as fault:
            faults.append(str(fault))
    if faults:
        return Check(
            "own kits", False, "; ".join(faults), "mend the line, or teach the kit anew: station devices learn"
        )
    if not files:
        return Check("own kits", True, f"none in {kits_folder()}; station devices learn makes them")
    return Check("own kits", True, f"{', '.join(path.stem for path in files)} in {kits_folder()}")


def check_sticks() -> Check:
    """The motion sensors that the settings name, and what the sticks' files know; opens no port."""
    from station.core.labels import limb_name
    from station.devices.imu.ble_ports import BLE, load_bleak
    from station.devices.mapping.stick_file import parse_stick, sticks_folder
    from station.devices.stick_ports import parse_sticks

    known = list[str]()
    try:
        said = load_settings().sticks
        if not said.strip():
            return Check("sticks", True, "no motion sensors: the settings name none (sticks)")
        if any(request.part.startswith(BLE) for request in parse_sticks(said)):
            load_bleak()
        for path in sorted(sticks_folder().glob("*.toml")):
            mounting = parse_stick(path.read_text(encoding="utf-8"), str(path))
            known.append(f"{path.stem} ({limb_name(mounting.limb)})")
    except (StationError, OSError, UnicodeDecodeError) as fault:
        return Check("sticks", False, str(fault), "docs/sensors.md has what is understood")
    files = f"known: {', '.join(known)}" if known else "no stick has a file: the mounting gesture makes it"
    return Check("sticks", True, f"{said}; {files}")


def check_serial() -> Check:
    """The serial ports, where a home-built module may be, and whether this user may open them."""
    from station.devices.serial.serial_ports import SerialDirectory, no_access

    addresses = SerialDirectory().addresses()
    if not addresses:
        return Check("kit (serial)", True, "no serial port; only home-built modules need one")
    denied = [(address.port, why) for address in addresses if (why := no_access(address.path)) is not None]
    if denied:
        finding, remedy = ("; ".join(sorted(set(texts))) for texts in zip(*denied, strict=True))
        return Check("kit (serial)", False, f"{finding} cannot be opened", remedy)
    return Check("kit (serial)", True, ", ".join(address.port for address in addresses))


def check_hid() -> Check:
    """Game drums and foot switches, and whether this user may open them."""
    from station.devices.hid.hid_ports import HidDirectory

    directory = HidDirectory()
    ports = directory.names()
    denied = [(port, why) for port in ports if (why := directory.no_access(port)) is not None]
    if denied:
        finding, remedy = ("; ".join(sorted(set(texts))) for texts in zip(*denied, strict=True))
        return Check("kit (games)", False, f"{finding} cannot be opened", remedy)
    return Check("kit (games)", True, ", ".join(ports) or "no game drums and no foot switch")


def check_sound() -> Check:
    """The sound library and its outputs."""
    from station.sound.output.sound_output import list_outputs

    try:
        outputs = list_outputs()
    except DeviceError as fault:
        return Check("sound", False, str(fault), "without it the station runs silent")
    if not outputs:
        return Check("sound", False, "no sound output", "connect one; until then the station runs silent")
    return Check("sound", True, ", ".join(output.name for output in outputs))


def check_real_time() -> Check:
    """Whether the engine may come before other programs, so that strokes are stamped and sound in time."""
    from station.engine.priority import real_time_is_granted

    granted = real_time_is_granted()
    if granted is None:
        return Check("real time", True, "left to the system")
    if granted:
        return Check("real time", True, "granted")
    remedy = (
        "echo '@audio - rtprio 95' | sudo tee /etc/security/limits.d/audio.conf; sudo usermod -aG audio $USER; "
        "then log in again"
    )
    return Check(
        "real time", False, "not granted: on a busy computer sound may drop out and strokes be heard late", remedy
    )


def check_calibration() -> Check:
    """Whether the latency of the kits and of the output that are in use was measured, and can be trusted."""
    try:
        settings, known = load_settings(), load_calibration()
    except BadInput as fault:
        return Check("latency", False, str(fault), "mend the line, or delete the file and measure again")
    output, kits = _output_in_use(settings), _kits_in_use(settings)
    if output is None and not kits:
        return Check("latency", True, "neither kit nor sound output is here to be measured")
    ways = dict.fromkeys(kits, "strike") | ({output: "loopback"} if output is not None else {})
    measured = {name: kit.kit for name, kit in known.kits.items() if name in kits}
    if output is not None and output in known.outputs:
        measured[output] = known.outputs[output]
    faults = [f"{name} is not measured" for name in ways if name not in measured]
    faults += [f"{name}: {each.doubts}" for name, each in measured.items() if each.doubts]
    if not faults:
        words = (f"{name} {each.latency_ms:+.1f} ms ({each.by}, {each.on})" for name, each in measured.items())
        return Check("latency", True, ", ".join(words))
    missing = dict.fromkeys(way for name, way in ways.items() if name not in measured or measured[name].doubts)
    remedy = " and ".join(f"station devices calibrate --by {way}" for way in missing)
    return Check("latency", False, "; ".join(faults), remedy)


def _output_in_use(settings: Settings) -> str | None:
    from station.sound.output.sound_output import choose_output, list_outputs

    try:
        return choose_output(list_outputs(), settings.output).name
    except DeviceError:
        return None


def _kits_in_use(settings: Settings) -> list[str]:
    from station.devices.device_ports import devices_there, parse_devices

    try:
        return devices_there(parse_devices(settings.kit))
    except StationError:
        return []


def check_picture() -> Check:
    """OpenGL without a window, as for pictures and reports."""
    from station.render.picture import renderer_name

    try:
        return Check("pictures", True, renderer_name())
    except DeviceError as fault:
        return Check("pictures", False, str(fault))


def check_video() -> Check:
    """What encodes videos."""
    from station.scenes.film import encoder

    try:
        return Check("videos", True, encoder())
    except DeviceError as fault:
        return Check("videos", False, str(fault))


def has_screen() -> bool:
    """Whether a window can be opened: Windows and macOS always have a screen, X11 and Wayland say so."""
    return sys.platform in ("win32", "darwin") or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def check_screen() -> Check:
    """A screen for the window."""
    if has_screen():
        return Check("screen", True, {"win32": "Windows", "darwin": "macOS"}.get(sys.platform, "X11 or Wayland"))
    return Check("screen", False, "none: practice runs in the terminal", "log in to a desktop to get the window")
