"""What two spellings of a student's name share: case, Unicode form, blanks or hyphens; they are one student."""

from station.core.disk.file_names import alike, telling_name


def student_key(name: str) -> str:
    """What a student is known by, however their name is written; names that differ in more have keys that differ."""
    return alike(telling_name(name))
