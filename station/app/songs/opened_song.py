"""A song read for its page: the part, the outline and the onsets of its sound. Seconds of work, strangers' files."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.app.songs.song_sync import new_song, onset_sound
from station.drills.songs.song import Song
from station.drills.songs.song_file import SONG_ENDING, read_song
from station.drills.songs.song_folder import sounds_beside
from station.drills.songs.song_lesson import read_written
from station.music.score import Score


@dataclass(frozen=True, slots=True, eq=False)
class OpenedSong:
    """A song as its page needs it: the part's `score`, the outline of its sound and its onsets.

    `peaks` (n,), 0 … 1, are spread evenly over `length_s`. `onsets_s` (m,) rises; of their `weights` (m,) 1 is usual.
    """

    song: Song
    score: Score
    peaks: NDArray[np.float32]
    length_s: float
    onsets_s: NDArray[np.float64]
    weights: NDArray[np.float32]

    def likely_onset(self, at_s: float, reach_s: float) -> float | None:
        """The onset that is meant by a rough time: strong and near; None where there is none within `reach_s`."""
        off = np.abs(self.onsets_s - at_s)
        likely = np.where(off < reach_s, self.weights * (1.0 - off / reach_s), 0.0)
        return float(self.onsets_s[likely.argmax()]) if likely.any() else None


def opened_song(part: str, sound: str, folder: Path) -> OpenedSong:
    """The song of a part and a sound, or of a song file; a new one will stand in `folder`. Raises `StationError`."""
    from station.sound.songs.song_onsets import song_onsets  # with libraries of sound, which no window loads
    from station.sound.songs.waveform import PEAKS_A_SECOND, outline

    if part.lower().endswith(SONG_ENDING):
        song = read_song(Path(part))
        if not song.others and not song.drums:
            others, drums = sounds_beside(song.part)
            song = replace(song, others=others, drums=drums)
    else:
        song = new_song(folder / f"new{SONG_ENDING}", part, (sound,) if sound else ())
        if song.title == song.name:  # the part has no title of its own
            song = replace(song, title=Path(part).stem)
    onsets = song_onsets(onset_sound(song))
    peaks = outline(song.others + song.drums)
    score = read_written(song.part).score
    return OpenedSong(song, score, peaks, len(peaks) / PEAKS_A_SECOND, onsets.at_s, onsets.weight)
