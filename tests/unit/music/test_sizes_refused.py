"""What is larger than music is refused for its size, before the work that the size would make."""

import pytest

from station.core.errors import BadInput
from station.music.formats.ascii_tab.tab_reader import read_tab
from station.music.formats.clone_hero.clone_hero_format import read_chart_part
from station.music.formats.smf.midi_part import read_midi_part
from tests.fakes.smf_bytes import event, file, header, tempo, track

_SNARE = event(0, 0x99, 38, 100)


def _chart(sync: str) -> bytes:
    return f"[Song]\n{{\n}}\n[SyncTrack]\n{{\n{sync}}}\n[ExpertDrums]\n{{\n0 = N 1 0\n}}\n".encode()


def test_a_chart_with_a_tempo_on_every_tick() -> None:
    with pytest.raises(BadInput, match="150000 changes of tempo"):
        read_chart_part(_chart("".join(f"{i} = B {100_000 + i}\n" for i in range(150_000))), "x.chart")


def test_a_chart_with_as_many_tempos_as_a_long_song_has_beats() -> None:
    part = read_chart_part(_chart("".join(f"{192 * i} = B {100_000 + i}\n" for i in range(1500))), "x.chart")
    assert len(part.score.tempo_map.tempos) == 1500


def test_a_midi_file_of_more_tracks_than_an_orchestra() -> None:
    with pytest.raises(BadInput, match="byte 10: 1001 tracks"):
        read_midi_part(header(1, 1001) + track(_SNARE) * 1001, "x.mid")


def test_a_midi_file_of_as_many_tracks_as_are_read() -> None:
    assert len(read_midi_part(header(1, 300) + track(_SNARE) + track() * 299, "x.mid").score) == 1


def test_a_midi_file_whose_tempo_never_rests() -> None:
    with pytest.raises(BadInput, match="60,000 changes of tempo"):
        read_midi_part(file(*(tempo(1, 300_000 + i) for i in range(60_000)), _SNARE), "x.mid")


def test_a_tab_of_more_lines_than_a_life_of_tabs() -> None:
    with pytest.raises(BadInput, match="60,000 lines"):
        read_tab(b"HH|x-x-|\n" * 60_000, "x.tab")


def test_program_changes_without_end_in_one_track_and_in_several() -> None:
    many = event(0, 0xC9, 1) * 250_000
    with pytest.raises(BadInput, match="more than 400,000 events that are no notes"):
        read_midi_part(header(1, 2) + track(many) + track(many, _SNARE), "x.mid")
    assert len(read_midi_part(header(1, 1) + track(many, _SNARE), "x.mid").score) == 1
