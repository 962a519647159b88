"""Hydrogen's songs beside the MIDI that Hydrogen exports of them: time, drum, number and velocity of every note.

Its export of `test.h2song` is there with the song. Of its export with a timeline the song is not: it is made here after
what Hydrogen's repository has (midiExport_timelineAndTimeSignatures.h2song): two patterns, of which one sounds with the
other, a short one, an empty column, and a tempo a column.
"""

from pathlib import Path

import numpy as np
import pytest

from station.core.units import PPQ
from station.music.drum_part import DrumPart
from station.music.formats.format_table import read_part
from station.music.formats.hydrogen.hydrogen_formats import HYDROGEN_SONG
from tests.oracles.folder import ORACLES
from tests.unit.music.hydrogen_xml import note, pattern, song

FOLDER = ORACLES / "charts" / "hydrogen"
DATA = FOLDER / "src" / "tests" / "data"
pytestmark = [pytest.mark.oracle, pytest.mark.skipif(not DATA.exists(), reason=f"no {DATA}")]

ELECTRIC_SNARE = 40

COLUMNS = [["First"], ["Third"], ["First"], [], ["First"], ["Fourth"]]
TEMPOS = "".join(f"<newBPM><BAR>{bar}</BAR><BPM>{130 + 5 * bar}</BPM></newBPM>" for bar in range(1, 7))
TAGS = "".join(f"<newTAG><BAR>{bar}</BAR><TAG>Column {bar + 1}</TAG></newTAG>" for bar in range(5))
TIMELINE = song(
    [
        pattern("First", note(0, 0), note(96, 0), size=320, denominator=3),
        pattern("Second", note(48, 1), note(144, 1)),
        pattern("Third", size=32, denominator=6),
        pattern("Fourth", size=223),
    ],
    COLUMNS,
    "<virtualPatternList><pattern><name>First</name><virtual>Second</virtual></pattern></virtualPatternList>"
    f"<BPMTimeLine>{TEMPOS}</BPMTimeLine><timeLineTag>{TAGS}</timeLineTag>",
)


def check_same(ours: DrumPart, export: Path) -> None:
    theirs = read_part(export)
    assert len(ours.score) > 0
    mine, exported = ours.score.notes, theirs.score.notes
    for name in ("tick", "piece", "velocity", "openness", "midi_note"):
        np.testing.assert_array_equal(mine[name], exported[name], name)
    told = mine["midi_note"] != ELECTRIC_SNARE  # the song's is called Snare Rimshot; its export has the number alone
    for name in ("zone", "articulation"):
        np.testing.assert_array_equal(mine[name][told], exported[name][told], name)


@pytest.mark.parametrize("export", ["smf0.test.ref.mid", "smf1multi.test.ref.mid"])
def test_a_song_is_what_hydrogen_exports(export: str) -> None:
    check_same(read_part(DATA / "functional" / "test.h2song"), DATA / "functional" / export)


@pytest.mark.parametrize("export", ["timeline-smf0.test.ref.mid", "timeline-smf1single.test.ref.mid"])
def test_a_song_with_a_timeline_is_what_hydrogen_exports(export: str) -> None:
    ours = HYDROGEN_SONG.read(TIMELINE, "timeline.h2song")
    check_same(ours, DATA / "midi" / export)
    theirs = read_part(DATA / "midi" / export).score.tempo_map.tempos
    # the first is 120 in the file, whatever the song says: Hydrogen's test exports without the engine that knows it
    mine = ours.score.tempo_map.tempos[1:]
    assert [t.tick for t in mine] == [t.tick for t in theirs[1:]] == [c * PPQ // 48 for c in (320, 352, 672, 864, 1184)]
    for our, their in zip(mine, theirs[1:], strict=True):
        assert abs(our.us_per_quarter - their.us_per_quarter) <= 1


@pytest.mark.parametrize("path", sorted(FOLDER.rglob("*.h2*")), ids=lambda path: path.name)
def test_every_song_and_pattern_is_read(path: Path) -> None:
    part = read_part(path)
    assert len(part.score) >= 9
    assert part.score.title
    assert not any("percussion" in line for line in part.lost)
