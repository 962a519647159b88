"""Files that come in and go out: lessons, songs and their sound, parcels, exports."""

from pathlib import Path

from station.app.actions.file_actions import FileAction, Import, ImportAction
from station.app.actions.song_actions import BringSound, SaveSong
from station.app.importer import lessons_of, told
from station.app.station_parts import StationParts
from station.drills.songs.song_file import is_song
from station.drills.songs.song_folder import SOUND_ENDINGS


def bring_in(parts: StationParts, action: ImportAction) -> str:
    """Choose a song, make a sound a song's, a lesson of anything else; returns a line for the user."""
    path = Path(action.source) if isinstance(action, Import) else Path()
    if is_song(path):
        parts.chooser.open(path)
        return ""
    if path.suffix.lower() in SOUND_ENDINGS:
        parts.song.act(BringSound(str(path)))
        return f"{path.name} is the sound of a song: choose its part on the page Song"
    return parts.imports.act(action)


def take_imported(parts: StationParts) -> None:
    """Choose what was imported since the last call; raises `StationError`."""
    kept = parts.imports.advance()
    if kept is not None:
        parts.toasts.notify(told(kept))
        parts.teacher.look_again()
        parts.assigned.look_again()
        if lessons := lessons_of(kept):
            parts.chooser.open(*lessons)


def write_file(parts: StationParts, action: FileAction) -> str:
    """Write or film what is on the player, or a take; returns a line for the user."""
    lesson, bars = parts.sessions.player.lesson, parts.chooser.bars
    return parts.export.act(action, lesson, bars, parts.store.now, parts.view_settings)


def keep_song(parts: StationParts, action: SaveSong) -> str:
    """Keep the song that is pinned, and choose it; returns a line for the user."""
    path = parts.song.save(action.title)
    parts.chooser.open(path)
    return f"kept in {path}: it is among your lessons"
