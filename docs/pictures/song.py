"""Draws the pictures of the panel of songs anew, from the window itself: `python docs/pictures/song.py [FOLDER]`.

The band is the virtual one: half a minute of it, pinned at five beats, one of which is a beat off. Without a screen run
it under `xvfb-run -s "-screen 0 1920x1080x24 +extension GLX"`.
"""

import tempfile
from pathlib import Path

import soundfile
from imgui_bundle import imgui
from window_sizes import main, run, shot

from station.app.actions.song_actions import OpenSong, SetPoint
from station.gui.panels.song_panel import SONG
from station.music.drum_part import DrumPart
from station.music.formats.smf.midi_part import MIDI
from station.simulation.bands.band_sound import RATE_HZ
from station.simulation.bands.made_song import MadeSong, SongSpec, made_song
from tests.fakes.work_at_once import WorkAtOnce
from tests.gui.drive import Drive

PINNED, WRONG = (0, 16, 32, 44), 21
"""Beats, from 0; the last one is said to be where the next one is played."""
SETTLED = 60
"""Frames after which the drummer stands in the picture."""


def draw(folder: Path, size: tuple[int, int]) -> None:
    """The picture of one size."""
    song = made_song(SongSpec(7, 30.0))
    with tempfile.TemporaryDirectory() as home:
        part, sound = _written(song, Path(home))
        drive = Drive(Path(home), None, 1, size)

        def scenario(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
            drive.station.parts.song._start = WorkAtOnce
            drive.window.params.docking_params.dockable_window_of_name(SONG).is_visible = True
            drive.window.pages.song.part, drive.window.pages.song.sound = part.name, sound.name
            drive.station.dispatch(OpenSong(str(part), str(sound)))
            drive.wait_until(ctx, lambda state: state.song.opened is not None)
            for beat in PINNED:
                drive.station.dispatch(SetPoint(beat // 4 + 1, 1 + beat % 4, float(song.beat_s[beat])))
            drive.station.dispatch(SetPoint(WRONG // 4 + 1, 1 + WRONG % 4, float(song.beat_s[WRONG + 1])))
            drive.wait_until(ctx, lambda state: state.song.is_followed)
            ctx.yield_(SETTLED)
            shot(drive, ctx, folder / f"song-{size[0]}.png")

        run(drive, scenario)


def _written(song: MadeSong, home: Path) -> tuple[Path, Path]:
    part, sound = home / "our-song.mid", home / "our-song.wav"
    assert MIDI.write is not None
    part.write_bytes(MIDI.write(DrumPart(song.score)).data)
    soundfile.write(sound, song.mono, RATE_HZ)
    return part, sound


if __name__ == "__main__":
    main(__file__, draw)
