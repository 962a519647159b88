"""Guitar Pro 3 to 5: PyGuitarPro writes the files, what they must mean is read off by hand."""

# ruff: noqa: ANN401  PyGuitarPro has no types

import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import guitarpro as gp
import pytest

from station.core.errors import BadInput
from station.core.pieces import Articulation, Dynamic, Ornament, Piece, Zone
from station.core.units import PPQ
from station.music.drum_part import DrumPart, PartSection
from station.music.formats.format_table import read_part
from station.music.formats.guitar_pro.guitar_pro_format import read_old_part
from station.music.swing import Swing

CHARTS = Path("../shared/data/charts/guitarpro")
_VERSIONS = {"gp3": (3, 0, 0), "gp4": (4, 0, 6), "gp5": (5, 1, 0)}


def _song(bars: int = 1) -> Any:
    song = gp.Song(title="Money Beat", artist="Ann")
    track = song.tracks[0]
    track.isPercussionTrack, track.name = True, "Drums"
    track.channel.channel = track.channel.effectChannel = 9
    while len(track.measures) < bars:
        song.newMeasure()
    return song


def _beat(song: Any, bar: int, *notes: int, value: int = 4, **note_effects: Any) -> Any:
    voice = song.tracks[0].measures[bar].voices[0]
    beat = gp.Beat(voice, status=gp.BeatStatus.normal if notes else gp.BeatStatus.rest, duration=gp.Duration(value))
    for string, number in enumerate(notes, 1):
        effect = gp.NoteEffect(**note_effects)
        beat.notes.append(gp.Note(beat, value=number, string=string, type=gp.NoteType.normal, effect=effect))
    voice.beats.append(beat)
    return beat


def _bytes(song: Any, version: str = "gp5") -> bytes:
    file = io.BytesIO()
    gp.write(song, file, version=_VERSIONS[version])
    return file.getvalue()


def _read(song: Any, version: str = "gp5") -> DrumPart:
    return read_old_part(_bytes(song, version), f"song.{version}")


@pytest.mark.parametrize("version", _VERSIONS)
def test_a_groove_comes_back_with_its_words(version: str) -> None:
    song = _song()
    song.tempo = 96
    for notes in ((42, 36), (42,), (42, 38), (46,)):
        _beat(song, 0, *notes, value=8)
    part = _read(song, version)
    assert (part.score.title, part.author) == ("Money Beat", "Ann")
    assert part.score.tempo_map.bpm_at(0) == pytest.approx(96)
    assert [(n.tick, n.piece) for n in part.score] == [
        (0, Piece.KICK),
        (0, Piece.HIHAT),
        (PPQ // 2, Piece.HIHAT),
        (PPQ, Piece.SNARE),
        (PPQ, Piece.HIHAT),
        (3 * PPQ // 2, Piece.HIHAT),
    ]
    assert [n.openness for n in part.score if n.piece is Piece.HIHAT] == [0, 0, 0, 1]
    assert part.score.end_tick == 4 * PPQ
    assert not part.lost


def test_marks_shade_the_velocity_of_the_file() -> None:
    song = _song()
    _beat(song, 0, 38)
    _beat(song, 0, 38, accentuatedNote=True)
    _beat(song, 0, 38, heavyAccentuatedNote=True)
    _beat(song, 0, 38, ghostNote=True)
    played = list(_read(song).score)
    assert [n.dynamic for n in played] == [Dynamic.NORMAL, Dynamic.ACCENT, Dynamic.ACCENT, Dynamic.GHOST]
    # forte is 95; 95 * 116 / 80 is beyond 127, 95 * 32 / 80 = 38
    assert [n.velocity for n in played] == [95, 127, 127, 38]


@pytest.mark.parametrize("version", _VERSIONS)
def test_a_grace_note_of_the_same_drum_is_a_flam(version: str) -> None:
    song = _song()
    _beat(song, 0, 38, grace=gp.GraceEffect(fret=38))
    grace, main = _read(song, version).score
    assert (grace.ornament, main.ornament) == (Ornament.FLAM, Ornament.FLAM)
    assert (grace.tick, main.tick, main.lead_ms, grace.dynamic) == (0, 0, 0, Dynamic.GHOST)
    assert grace.lead_ms > 0


def test_a_grace_note_of_another_drum_comes_a_32nd_earlier() -> None:
    song = _song()
    _beat(song, 0)
    _beat(song, 0, 38, grace=gp.GraceEffect(fret=50))
    tom, snare = _read(song).score
    assert (tom.piece, tom.tick, tom.dynamic) == (Piece.TOM_1, PPQ - PPQ // 8, Dynamic.GHOST)
    assert (snare.piece, snare.tick, snare.ornament) == (Piece.SNARE, PPQ, Ornament.NONE)


@pytest.mark.parametrize(
    ("speed", "number", "count", "ornament"),
    [
        (32, 38, 8, Ornament.ROLL),
        (16, 38, 4, Ornament.NONE),
        (8, 38, 2, Ornament.NONE),
        (32, 51, 8, Ornament.NONE),
    ],
)
def test_tremolo_is_strokes(speed: int, number: int, count: int, ornament: Ornament) -> None:
    song = _song()
    effect = gp.TremoloPickingEffect(duration=gp.Duration(speed))
    _beat(song, 0, number, tremoloPicking=effect, accentuatedNote=True)
    played = list(_read(song).score)
    assert [n.tick for n in played] == [i * 4 * PPQ // speed for i in range(count)]
    assert {n.ornament for n in played} == {ornament}
    assert [n.dynamic for n in played] == [Dynamic.ACCENT] + [Dynamic.NORMAL] * (count - 1)
    assert [n.velocity for n in played] == [127] + [95] * (count - 1)


def test_a_32nd_tremolo_on_a_sixteenth_is_a_diddle() -> None:
    song = _song()
    _beat(song, 0, 38, value=16, tremoloPicking=gp.TremoloPickingEffect(duration=gp.Duration(32)))
    assert [(n.tick, n.ornament) for n in _read(song).score] == [(0, Ornament.DIDDLE), (PPQ // 8, Ornament.DIDDLE)]


def test_dots_and_tuplets_last_exactly_as_long_as_they_say() -> None:
    song = _song()
    _beat(song, 0, 36).duration.isDotted = True
    _beat(song, 0, 38, value=8)
    for _ in range(3):
        _beat(song, 0, 38, value=8).duration.tuplet = gp.Tuplet(3, 2)
    for _ in range(5):
        _beat(song, 0, 38, value=16).duration.tuplet = gp.Tuplet(5, 4)
    thirds = [2 * PPQ + i * PPQ // 3 for i in range(3)]
    fifths = [3 * PPQ + i * PPQ // 5 for i in range(5)]
    assert [n.tick for n in _read(song).score] == [0, 3 * PPQ // 2, *thirds, *fifths]


@pytest.mark.parametrize("version", _VERSIONS)
def test_repeats_endings_meters_and_markers_are_written_out(version: str) -> None:
    song = _song(4)
    for bar, number in enumerate((36, 38, 50, 49)):
        _beat(song, bar, number)
    headers = song.measureHeaders
    headers[0].isRepeatOpen, headers[0].marker = True, gp.Marker("Verse")
    headers[1].repeatAlternative, headers[1].repeatClose = 1, 1
    headers[2].repeatAlternative = 2
    headers[3].marker = gp.Marker("Chorus")
    headers[3].timeSignature = gp.TimeSignature(3, gp.Duration(4), [1, 1, 1, 0])
    part = _read(song, version)
    assert [n.piece for n in part.score] == [Piece.KICK, Piece.SNARE, Piece.KICK, Piece.TOM_1, Piece.CRASH_1]
    assert part.score.bar.tolist() == [0, 1, 2, 3, 4]
    assert part.sections == (PartSection("Verse", 0, 3), PartSection("Chorus", 4, 4))
    assert part.score.end_tick == 19 * PPQ
    assert part.score.tempo_map.meter_at(16 * PPQ).beats == 3


def test_a_tempo_change_of_any_track_counts() -> None:
    song = _song(2)
    other = gp.Track(song, 2, name="Guitar", channel=gp.MidiChannel(channel=1, effectChannel=2))
    song.tracks.append(other)
    for bar in range(2):
        _beat(song, bar, 36)
        voice = other.measures[bar].voices[0]
        beat = gp.Beat(voice, status=gp.BeatStatus.rest)
        if bar:
            beat.effect.mixTableChange = gp.MixTableChange(tempo=gp.MixTableItem(150))
        voice.beats.append(beat)
    tempo_map = _read(song).score.tempo_map
    assert (tempo_map.bpm_at(0), tempo_map.bpm_at(4 * PPQ)) == (120, 150)


def test_triplet_feel_swings_the_offbeats_and_names_it() -> None:
    song = _song()
    song.measureHeaders[0].tripletFeel = gp.TripletFeel.eighth
    for _ in range(2):
        _beat(song, 0, 51, value=8)
    for _ in range(4):
        _beat(song, 0, 38, value=16)
    part = _read(song)
    assert part.swing == Swing(2.0, PPQ // 2)
    assert [n.tick for n in part.score] == [0, 2 * PPQ // 3, *(PPQ + i * PPQ // 4 for i in range(4))]
    assert [n.swing_ticks for n in part.score] == [0, 2 * PPQ // 3 - PPQ // 2, 0, 0, 0, 0]


def test_swing_of_one_bar_only_is_said() -> None:
    song = _song(2)
    song.measureHeaders[1].tripletFeel = gp.TripletFeel.eighth
    for bar in range(2):
        _beat(song, bar, 36, value=8)
        _beat(song, bar, 38, value=8)
    part = _read(song)
    assert part.swing == Swing()
    assert [(n.tick, n.swing_ticks) for n in part.score][1::2] == [(PPQ // 2, 0), (4 * PPQ + 2 * PPQ // 3, 0)]
    assert any("from bar 2" in line for line in part.lost)


def test_da_capo_al_fine_is_played() -> None:
    song = _song(3)
    for bar, number in enumerate((36, 38, 50)):
        _beat(song, bar, number)
    song.measureHeaders[1].direction = gp.DirectionSign("Fine")
    song.measureHeaders[2].fromDirection = gp.DirectionSign("Da Capo al Fine")
    assert [n.piece for n in _read(song).score] == [Piece.KICK, Piece.SNARE, Piece.TOM_1, Piece.KICK, Piece.SNARE]


def test_ties_and_second_voices_strike_nothing_twice() -> None:
    song = _song()
    _beat(song, 0, 38)
    tied = _beat(song, 0, 38)
    tied.notes[0].type = gp.NoteType.tie
    voice = song.tracks[0].measures[0].voices[1]
    double = gp.Beat(voice, status=gp.BeatStatus.normal)
    double.notes.append(gp.Note(double, value=38, string=2, type=gp.NoteType.normal))
    voice.beats.append(double)
    assert [(n.tick, n.piece) for n in _read(song).score] == [(0, Piece.SNARE)]


def test_guitar_pros_own_numbers() -> None:
    song = _song()
    for number in (91, 92, 95):
        _beat(song, 0, number)
    rim_shot, half_open, choked = _read(song).score
    assert (rim_shot.piece, rim_shot.zone, rim_shot.articulation) == (Piece.SNARE, Zone.RIM, Articulation.RIM_SHOT)
    assert (half_open.piece, half_open.openness) == (Piece.HIHAT, 0.5)
    assert (choked.piece, choked.choke_ticks) == (Piece.SPLASH, PPQ)


def test_a_song_without_drums_is_refused() -> None:
    song = _song()
    song.tracks[0].isPercussionTrack = False
    song.tracks[0].channel.channel = song.tracks[0].channel.effectChannel = 3
    with pytest.raises(BadInput, match="no drum track among its 1 tracks"):
        _read(song)


def _cut(data: bytes) -> bytes:
    return data[: len(data) * 3 // 4]


def test_a_count_beyond_all_music_is_refused_before_it_is_counted() -> None:
    song = _song()
    _beat(song, 0, 38)
    data = _bytes(song, "gp3")  # its bar is a count of 4 bytes and one beat
    beat = b"\0\0\x40\x20\x01\x26"  # flags, value, strings, then the note's flags, kind and fret
    at = data.rindex(b"\x01\0\0\0" + beat)
    with pytest.raises(BadInput, match=r"bar 1, byte \d+: 2147483647 beats in a bar"):
        read_old_part(data[:at] + b"\xff\xff\xff\x7f" + beat * 100_000, "song.gp3")


@pytest.mark.parametrize(
    ("spoil", "fault"),
    [(_cut, "byte [0-9]+"), (lambda _: b"", "byte 0"), (lambda d: b"x" + d[1:60], "byte")],
)
def test_a_broken_file_is_refused_with_its_place(spoil: Callable[[bytes], bytes], fault: str) -> None:
    song = _song()
    _beat(song, 0, 38)
    with pytest.raises(BadInput, match=f"song.gp5: (bar [0-9]+, )?{fault}"):
        read_old_part(spoil(_bytes(song)), "song.gp5")


def test_alphatabs_file_of_all_numbers_says_them_all() -> None:
    path = CHARTS / "guitarpro5/percussion-all.gp5"
    if not path.exists():
        pytest.skip(f"{path} is not here")
    part = read_part(path)
    assert [n.midi_note for n in part.score] == list(range(27, 88))
    assert part.score.notes["tick"].tolist() == [i * PPQ for i in range(61)]
