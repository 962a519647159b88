"""Captures as the user names them: whether a name means one, and what was played in it."""

from pathlib import Path

from station.music.performance import Performance

CAPTURE_ENDING = ".capture"


def is_capture(name: str) -> bool:
    """Whether `name` ends as captures do, or is a file that begins as they do: `devices record` takes any name."""
    return Path(name).suffix.lower() == CAPTURE_ENDING or begins_as_capture(Path(name))


def begins_as_capture(path: Path) -> bool:
    """Whether the file at `path` begins as captures do."""
    try:
        if not path.is_file():  # whoever looks into a pipe waits, and takes what is there
            return False
        with path.open("rb") as file:
            from station.devices.capture.capture import MAGIC

            return file.read(len(MAGIC)) == MAGIC
    except OSError:  # a name longer than the file system takes
        return False


def performance_of_capture(path: Path) -> Performance:
    """All strokes of the capture at `path`, from the first on; raises `BadInput`."""
    from station.core.events import Choke, Hit
    from station.devices.capture.capture import check_strokes, read_capture
    from station.devices.capture.replay import replay

    events = list(replay(read_capture(path)))
    hits = [event for event in events if isinstance(event, Hit)]
    start_ns = hits[0].at_ns if hits else 0
    check_strokes((event.at_ns for event in events if isinstance(event, Hit | Choke)), path)
    return Performance.from_hits(hits, [event for event in events if isinstance(event, Choke)]).shifted(-start_ns)
