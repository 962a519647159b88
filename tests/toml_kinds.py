"""A sound file of every kind, written by hand, and who reads it."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from station.core.measured_latency import load_calibration
from station.core.settings import load_settings
from station.core.toml.schema import read
from station.core.toml.toml_source import read_source
from station.devices.mapping.device_file import read_kit
from station.devices.mapping.stick_file import STICK
from station.drills.course import read_course
from station.drills.library import lessons_for, read_lesson
from station.drills.songs.song_file import read_song
from station.motion.kinematics.figure import load_figure
from station.motion.kit.kit import load_kit
from station.motion.style.style_file import Slots, load_style
from station.sound.samples.kit_folder import KIT_TABLE
from station.sync.air.air_file import read_air
from station.sync.phase.model_file import load_model


@dataclass(frozen=True, slots=True)
class Good:
    """A file's `text`; `line` is its line of a key and a number, as it is there; `needs` a key that it must have."""

    text: str
    line: str
    needs: str = ""

    def with_number(self, value: str) -> str:
        """The text with another value for the number."""
        key = self.line.partition("=")[0]
        return self.text.replace(self.line, f"{key}= {value}", 1)


GOOD = {
    "lesson": Good(
        'title = "T"\nlevel = 2\ntags = ["a", "b"]\ntempo_bpm = 90\nloop = [1, 2]\n[goals]\nmax_sd_ms = 25\n'
        '[[grid]]\nhihat = "xxxx (xxx) xxxx xxxx | %"\nright_hand.snare = "---- ---- o--- ---- | -"\n',
        "level = 2",
        needs="title",
    ),
    "course": Good('title = "C"\nlevel = 2\nlessons = ["rock-1", "rock-2"]\n', "level = 2", needs="lessons"),
    "song": Good(
        'title = "S"\npart = "s.mid"\nsound = ["bass.ogg", "guitar.ogg"]\nquarters_s = [0.5, 1.0]\n[[point]]\nbar = 2\n'
        'beat = 1.5\nat_s = 2.5\n[[section]]\nname = "verse"\nbar = 2\n',
        "at_s = 2.5",
        needs="title",
    ),
    "device kit": Good(
        'base = "roland-td-17"\nnotes.66 = { piece = "ride", zone = "edge" }\npads.kick = { curve = { bend = 0.3 } }\n'
        '[foot]\nleast_travel = 0.3\n[[crosstalk]]\nsource = "kick"\nvictim = "snare"\nshare = 0.3\n',
        "least_travel = 0.3",
        needs="source",
    ),
    "drummer's kit": Good(
        'title = "K"\nhanded = "right"\n[pedals.kick]\nheel_m = [0.2, 0.4, 0.0]\ntoe_m = [0.2, 0.7, 0.0]\n'
        "[pedals.hihat]\nheel_m = [-0.3, 0.4, 0.0]\ntoe_m = [-0.3, 0.7, 0.0]\nraised_deg = 10\n"
        '[kick]\nkind = "kick"\ncentre_m = [0.2, 0.8, 0.3]\nradius_m = 0.28\n'
        "[snare]\ncentre_m = [-0.07, 0.45, 0.66]\nradius_m = 0.18\nzones.rim = { right = 0.5, shoulder = true }\n",
        "raised_deg = 10",
        needs="radius_m",
    ),
    "figure": Good("stature_m = 1.8\n[segments]\nforearm_m = 0.3\n[limits]\nwrist_flexion = 50\n", "stature_m = 1.8"),
    "style": Good(
        'amplitude_gain = 40\nheld = "brush"\n[pieces]\nride = 20\n[automation]\nstand = [[1, 0], [4.5, 1]]\n',
        "amplitude_gain = 40",
    ),
    "slots of styles": Good('[slot_3]\ntitle = "mine"\namplitude_gain = 40\n', "amplitude_gain = 40"),
    "sounds": Good(
        'name = "Shed"\nloudness = "recorded"\n[sounds.snare]\npan = 0.1\n'
        'layers = [{ to_velocity = 60, takes = ["a.wav"] }, { takes = ["b.wav"], pitch = -1.0 }]\n',
        "pan = 0.1",
        needs="layers",
    ),
    "settings": Good(
        'student = "Ada"\nrate_hz = 44100\nown_sound = false\nthresholds = "snare=20"\n', "rate_hz = 44100"
    ),
    "calibration": Good(
        '[outputs."USB (hw:1,0)"]\nlatency_ms = -3\nhalf_ms = 0.1\nby = "loopback"\non = 2026-01-31\n'
        '[kits.TD-27]\nlatency_ms = 1\nhalf_ms = 1\nby = "strike"\non = 2026-01-31\n'
        '[kits.TD-27.pads.snare]\nlatency_ms = 2\nhalf_ms = 1\nby = "strike"\non = 2026-01-31\ndoubts = "few"\n',
        "latency_ms = -3",
        needs="on",
    ),
    "stick": Good(
        'limb = "left_hand"\nturn = [0.8, 0.0, 0.6, 0.0]\ntip_m = 0.3\nbutt_m = 0.1\nlearnt = true\n', "tip_m = 0.3"
    ),
    "periodic model": Good(
        'format = "drum-station/phase-model/1"\nperiod_s = 1.2\n[[channel]]\nname = "hip"\nmean = 0.5\n'
        "weights = [0.1, 0.2, 0.3, 0.4]\n",
        "period_s = 1.2",
        needs="name",
    ),
    "air kit": Good(
        'normal_speed_m_s = 3\n[[zones]]\nlimb = "left_hand"\npiece = "snare"\nheading_deg = 12\nelevation_deg = -8\n'
        'heading_sd_deg = 6\nelevation_sd_deg = 8\n[[zones]]\nlimb = "left_hand"\npiece = "tom_1"\nzone = "rim"\n'
        "heading_deg = -30\nelevation_deg = 5\nheading_sd_deg = 6.5\nelevation_sd_deg = 8\n",
        "elevation_deg = -8",
        needs="limb",
    ),
}

_READERS: dict[str, Callable[[Path], object]] = {
    "lesson": read_lesson,
    "course": lambda path: read_course(path, lessons_for(path.parent)),
    "song": read_song,
    "device kit": read_kit,
    "drummer's kit": load_kit,
    "figure": load_figure,
    "style": load_style,
    "slots of styles": Slots.load,
    "sounds": lambda path: read(read_source(path), KIT_TABLE),
    "settings": load_settings,
    "calibration": load_calibration,
    "stick": lambda path: read(read_source(path), STICK),
    "periodic model": load_model,
    "air kit": read_air,
}


def read_as(kind: str, path: Path) -> object:
    """What the file at `path` means as one of that kind; raises `BadInput`."""
    return _READERS[kind](path)
