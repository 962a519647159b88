"""Damaged files of Guitar Pro and of the drum games are read or refused, never anything else.

A million such inputs over all formats are the fuzzer's work; these few keep the promise from one commit to the next.
"""

import io
from collections.abc import Callable
from functools import cache

import guitarpro as gp
import mido
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from station.core.errors import BadInput
from station.music.drum_part import DrumPart
from station.music.formats.clone_hero.clone_hero_format import read_chart_part, read_notes_part
from station.music.formats.guitar_pro.guitar_pro_format import read_old_part
from station.music.formats.guitar_pro.score_gpif import read_gpif
from station.music.formats.guitar_pro.tab_part import part_of_song

_CHART = (
    b'[Song]\n{\nName = "a"\nResolution = 192\n}\n[SyncTrack]\n{\n0 = TS 6 3\n0 = B 120000\n}\n[Events]\n{\n'
    b'0 = E "section a"\n900 = E "end"\n}\n[ExpertDrums]\n{\n0 = N 1 0\n0 = N 34 0\n96 = N 2 0\n96 = N 66 0\n'
    b'192 = E "mix 3 drums0d"\n288 = S 65 96\n288 = N 1 0\n400 = N 109 0\n400 = N 3 0\n}\n'
)
_GPIF = (
    b"<GPIF><MasterTrack><Automations><Automation><Type>Tempo</Type><Bar>0</Bar><Value>90 2</Value></Automation>"
    b'</Automations></MasterTrack><Tracks><Track id="0"><InstrumentSet><Type>drumKit</Type></InstrumentSet></Track>'
    b'</Tracks><MasterBars><MasterBar><Time>4/4</Time><Repeat start="true" end="true" count="3"/><Bars>0</Bars>'
    b'</MasterBar></MasterBars><Bars><Bar id="0"><Voices>0 -1</Voices></Bar></Bars><Voices><Voice id="0">'
    b'<Beats>0 0</Beats></Voice></Voices><Beats><Beat id="0"><Rhythm ref="0"/><Notes>0</Notes></Beat></Beats><Notes>'
    b'<Note id="0"><InstrumentArticulation>38</InstrumentArticulation><Accent>8</Accent></Note></Notes><Rhythms>'
    b'<Rhythm id="0"><NoteValue>Eighth</NoteValue><PrimaryTuplet num="3" den="2"/></Rhythm></Rhythms></GPIF>'
)


@cache
def _tab() -> bytes:
    song = gp.Song()
    track = song.tracks[0]
    track.isPercussionTrack = True
    voice = track.measures[0].voices[0]
    for value in (4, 8, 16):
        beat = gp.Beat(voice, status=gp.BeatStatus.normal, duration=gp.Duration(value))
        effect = gp.NoteEffect(grace=gp.GraceEffect(fret=38), accentuatedNote=True)
        beat.notes.append(gp.Note(beat, value=38, string=1, type=gp.NoteType.normal, effect=effect))
        beat.effect.mixTableChange = gp.MixTableChange(tempo=gp.MixTableItem(90))
        voice.beats.append(beat)
    file = io.BytesIO()
    gp.write(song, file, version=(5, 1, 0))
    return file.getvalue()


@cache
def _notes() -> bytes:
    track = mido.MidiTrack([mido.MetaMessage("track_name", name="PART DRUMS")])
    for number in (96, 97, 109, 98, 110, 25, 31, 36, 40, 126, 95):
        track.append(mido.Message("note_on", note=number, velocity=100, time=60))
        track.append(mido.Message("note_off", note=number, time=30))
    file = io.BytesIO()
    mido.MidiFile(ticks_per_beat=480, tracks=[track]).save(file=file)
    return file.getvalue()


def _read_gpif(data: bytes, source: str) -> DrumPart:
    return part_of_song(read_gpif(data, source), source)


_READERS: dict[str, tuple[Callable[[bytes, str], DrumPart], Callable[[], bytes]]] = {
    "gp5": (read_old_part, _tab),
    "gpif": (_read_gpif, lambda: _GPIF),
    "chart": (read_chart_part, lambda: _CHART),
    "notes.mid": (read_notes_part, _notes),
}
_PATCH = st.one_of(
    st.binary(max_size=4), st.sampled_from([b"-1", b"0", b"999999", b"nan", b"\xff\xff\xff\x7f", b"\x00\x00\x00\x80"])
)


@pytest.mark.parametrize("kind", _READERS)
def test_the_files_are_sound_before_they_are_damaged(kind: str) -> None:
    read, make = _READERS[kind]
    assert len(read(make(), "file").score) >= 3


@pytest.mark.parametrize("kind", _READERS)
@given(patches=st.lists(st.tuples(st.integers(0, 1 << 16), st.integers(0, 8), _PATCH), min_size=1, max_size=4))
@settings(max_examples=60)
def test_damaged_files_are_read_or_refused(kind: str, patches: list[tuple[int, int, bytes]]) -> None:
    read, make = _READERS[kind]
    data = make()
    for place, gone, new in patches:
        at = place % (len(data) + 1)
        data = data[:at] + new + data[at + gone :]
    fault = None
    try:
        read(data, "file")
    except BadInput as refused:
        fault = refused
    assert fault is None or fault.source == "file"
