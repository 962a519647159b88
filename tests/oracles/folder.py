"""The folder of files that may not be passed on: `ORACLES` in the environment, as `make oracles` sets it."""

import os
from pathlib import Path

from _pytest.mark import ParameterSet

from tests.real_data import files_in

ORACLES = Path(os.environ.get("ORACLES", "no-folder-of-oracles"))
KINDS = {
    "GrooveScribe's MIDI": "charts/groovescribe/**/*.mid",
    "Hydrogen's MIDI": "charts/hydrogen/**/*.mid",
    "Hydrogen's kit": "charts/hydrogen/**/GMRockKit/drumkit.xml",
    "OpenGameArt's songs": "midi/opengameart/**/*.mid",
    "the Groove MIDI Dataset": "gmd/**/*.mid",
    "a WitMotion's packets": "imu/witmotion_hazer/*.txt",
    "the CMU motions": "mocap/**/*.[ab][mv][ch]",
    "air drums": "imu/airdrums/1_sensor?.txt",
}
"""What is compared with, and the pattern of its files."""


def oracles(*kinds: str) -> list[ParameterSet]:
    """A test parameter for every file of these kinds that is there."""
    return files_in(ORACLES, *(KINDS[kind] for kind in kinds))


def lacking() -> list[str]:
    """The kinds of which no file is there."""
    return [kind for kind in KINDS if not oracles(kind)]
