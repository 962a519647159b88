"""notes.mid of the games: mido writes the files by the documentation's numbers; what they mean is read off by hand."""

import io
from collections.abc import Sequence
from pathlib import Path

import mido
import pytest

from station.core.errors import BadInput
from station.core.pieces import Dynamic, Limb, Ornament, Piece
from station.core.units import PPQ
from station.music.drum_part import DrumPart, PartSection
from station.music.formats.clone_hero.clone_hero_format import read_notes_part
from station.music.formats.format_table import read_part

_Notes = Sequence[tuple[int, ...]]
"""Tick, number, and perhaps length and velocity of notes, 480 ticks a quarter."""


def _track(name: str, notes: _Notes = (), texts: Sequence[tuple[int, str]] = ()) -> mido.MidiTrack:
    timed: list[tuple[int, int, mido.Message | mido.MetaMessage]] = []
    for tick, number, length, velocity in ((*n, *(60, 100)[len(n) - 2 :]) for n in notes):
        timed.append((tick, 1, mido.Message("note_on", note=number, velocity=velocity)))
        timed.append((tick + length, 0, mido.Message("note_off", note=number)))
    timed += [(tick, 0, mido.MetaMessage("text", text=text)) for tick, text in texts]
    track, now = mido.MidiTrack([mido.MetaMessage("track_name", name=name)]), 0
    for tick, _, message in sorted(timed, key=lambda t: t[:2]):
        track.append(message.copy(time=tick - now))
        now = tick
    return track


def _file(notes: _Notes, texts: Sequence[tuple[int, str]] = (), name: str = "PART DRUMS") -> bytes:
    midi = mido.MidiFile(ticks_per_beat=480)
    tempo = mido.MidiTrack(
        [
            mido.MetaMessage("track_name", name="My Song"),
            mido.MetaMessage("set_tempo", tempo=600_000),
            mido.MetaMessage("time_signature", numerator=3, denominator=4),
        ]
    )
    events = _track("EVENTS", texts=[(0, "[section intro_1]"), (1440, "[prc_verse]"), (2880, "[end]")])
    midi.tracks += [tempo, _track(name, notes, texts), events]
    file = io.BytesIO()
    midi.save(file=file)
    return file.getvalue()


def _read(notes: _Notes, texts: Sequence[tuple[int, str]] = ()) -> DrumPart:
    return read_notes_part(_file(notes, texts), "notes.mid")


def _strokes(part: DrumPart) -> list[tuple[float, Piece]]:
    return [(n.tick / PPQ, n.piece) for n in part.score if not n.lead_ms]


def test_lanes_are_cymbals_unless_a_tom_marker_spans_them() -> None:
    notes = [(480 * i, 96 + i) for i in range(5)]
    toms = [(480 * (i + 3), 96 + i) for i in (2, 3, 4)]
    markers = [(2400, 110, 480), (2880, 111, 480), (3360, 112, 480)]
    kit = [Piece.KICK, Piece.SNARE, Piece.HIHAT, Piece.RIDE, Piece.CRASH_1, Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1]
    part = _read([*notes, *toms, *markers])
    assert _strokes(part) == [(float(i), piece) for i, piece in enumerate(kit)]
    assert part.score.title == "My Song"
    assert part.score.tempo_map.bpm_at(0) == 100
    assert [str(m) for m in part.score.tempo_map.meters] == ["3/4"]
    assert part.sections == (PartSection("intro 1", 0, 0), PartSection("verse", 1, 2))


def test_the_file_is_known_by_its_track_and_other_midi_is_not(tmp_path: Path) -> None:
    path = tmp_path / "song.mid"
    path.write_bytes(_file([(0, 97)]))
    assert _strokes(read_part(path)) == [(0, Piece.SNARE)]
    midi = mido.MidiFile(file=io.BytesIO(_file([(0, 38)], name="Drums")))
    for message in midi.tracks[1]:
        if not message.is_meta:
            message.channel = 9
    midi.save(path)
    assert _strokes(read_part(path)) == [(0, Piece.SNARE)]


@pytest.mark.parametrize("event", ["[ENABLE_CHART_DYNAMICS]", "ENABLE_CHART_DYNAMICS", ""])
def test_velocities_are_dynamics_only_where_the_chart_says_so(event: str) -> None:
    part = _read([(0, 97, 60, 127), (480, 97, 60, 1), (960, 97, 60, 100)], [(0, event)] if event else [])
    expected = [Dynamic.ACCENT, Dynamic.GHOST, Dynamic.NORMAL] if event else [Dynamic.NORMAL] * 3
    assert [n.dynamic for n in part.score] == expected


def test_a_flam_marker_makes_a_flam() -> None:
    part = _read([(0, 97), (0, 109, 240), (480, 97)])
    assert [(n.tick, n.ornament, n.lead_ms > 0) for n in part.score] == [
        (0, Ornament.FLAM, True),
        (0, Ornament.FLAM, False),
        (PPQ, Ornament.NONE, False),
    ]


def test_the_second_kick_is_the_left_foots() -> None:
    assert [(n.piece, n.limb) for n in _read([(0, 96), (60, 95)]).score] == [
        (Piece.KICK, Limb.UNKNOWN),
        (Piece.KICK, Limb.LEFT_FOOT),
    ]


def test_a_disco_flip_puts_snare_and_hi_hat_right() -> None:
    texts = [(0, "[mix 3 drums0d]"), (960, "[mix 3 drums0]")]
    part = _read([(0, 98), (480, 97), (960, 98), (1440, 98), (1440, 110, 60)], texts)
    assert _strokes(part) == [(0, Piece.SNARE), (1, Piece.HIHAT), (2, Piece.HIHAT), (3, Piece.TOM_1)]


def test_the_games_drummer_says_the_hands_and_the_hi_hat() -> None:
    motions = [(0, 31), (0, 26), (480, 30), (480, 25, 240), (960, 31)]
    part = _read([(0, 98), (0, 97), (480, 98), (960, 98), *motions])
    assert [(n.piece, n.limb, n.openness) for n in part.score] == [
        (Piece.SNARE, Limb.LEFT_HAND, None),
        (Piece.HIHAT, Limb.RIGHT_HAND, 0.0),
        (Piece.HIHAT, Limb.LEFT_HAND, 1.0),
        (Piece.HIHAT, Limb.RIGHT_HAND, 0.0),
    ]


def test_the_games_drummer_says_which_cymbal_and_which_tom() -> None:
    motions = [(0, 36), (480, 44), (960, 43), (1440, 49), (1920, 38)]
    markers = [(1440, 110, 60)]
    part = _read([(0, 100), (480, 100), (960, 100), (1440, 98), (1920, 99), *motions, *markers])
    assert [(n.piece, n.limb) for n in part.score] == [
        (Piece.CRASH_1, Limb.RIGHT_HAND),
        (Piece.CRASH_2, Limb.LEFT_HAND),
        (Piece.RIDE, Limb.LEFT_HAND),
        (Piece.TOM_2, Limb.RIGHT_HAND),
        (Piece.CRASH_2, Limb.RIGHT_HAND),
    ]


def test_two_cymbals_at_once_take_a_motion_each() -> None:
    part = _read([(0, 100), (0, 99), (0, 36), (0, 44)])
    assert sorted((n.piece, n.limb) for n in part.score) == [
        (Piece.CRASH_1, Limb.RIGHT_HAND),
        (Piece.CRASH_2, Limb.LEFT_HAND),
    ]


def test_a_choke_grabs_the_crash_before_it() -> None:
    part = _read([(0, 100), (0, 36), (240, 40)])
    assert [(n.piece, n.choke_ticks) for n in part.score] == [(Piece.CRASH_1, PPQ // 2)]


def test_an_easier_chart_is_read_where_there_is_no_other() -> None:
    part = _read([(0, 73), (480, 74)])
    assert _strokes(part) == [(0, Piece.SNARE), (1, Piece.HIHAT)]
    assert "no notes for Expert: this is Medium" in part.lost


def test_five_lanes_are_known_by_the_fifth() -> None:
    kit = [Piece.KICK, Piece.SNARE, Piece.HIHAT, Piece.TOM_2, Piece.CRASH_1, Piece.FLOOR_TOM_1]
    part = _read([(480 * i, 96 + i) for i in range(6)], [(0, "[mix 3 drums0d]")])  # a flip is for pro drums alone
    assert _strokes(part) == [(float(i), piece) for i, piece in enumerate(kit)]


@pytest.mark.parametrize(("notes", "fault"), [([], "no notes in a track"), ([(0, 30)], "no notes of any difficulty")])
def test_a_file_without_drum_notes_is_refused(notes: _Notes, fault: str) -> None:
    with pytest.raises(BadInput, match=f"notes.mid: .*{fault}"):
        _read(notes)
