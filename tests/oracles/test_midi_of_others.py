"""MIDI files of other programs and of many players beside mido's account of them."""

from pathlib import Path

import pytest

from tests.oracles.folder import oracles
from tests.recordings.beside_mido import check_drum_notes, check_file

pytestmark = pytest.mark.oracle


@pytest.mark.parametrize(
    "path", oracles("GrooveScribe's MIDI", "Hydrogen's MIDI", "OpenGameArt's songs", "the Groove MIDI Dataset")
)
def test_a_file_reads_as_mido_reads_it(path: Path) -> None:
    check_file(path)


@pytest.mark.parametrize("path", oracles("OpenGameArt's songs", "the Groove MIDI Dataset"))
def test_score_and_performance_hold_every_drum_note(path: Path) -> None:
    check_drum_notes(path)
