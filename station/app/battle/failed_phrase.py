"""A phrase of a battle as a lesson of the user's own, to be practised until it goes."""

from dataclasses import replace
from pathlib import Path

from station.app.music_files.lesson_import import place_in
from station.core.disk.files import write_whole
from station.drills.transcription.transcribe import transcribe
from station.music.drum_part import DrumPart
from station.practice.battle.phrase import Phrase

_ABOUT = "A phrase from a battle: play it until it goes, then ask for a return match."


def keep_phrase(phrase: Phrase, title: str, folder: Path) -> Path:
    """The lesson's file in `folder`, the same one where it is there already; raises `StationError`."""
    score = replace(phrase.score, title=title)
    text = transcribe(DrumPart(score, about=_ABOUT), title).lesson.text.encode()
    path, is_new = place_in(folder, "-".join(title.lower().replace(":", "").split()), text)
    if is_new:
        write_whole(path, text)
    return path
