"""What two spellings of a student's name share: they are one student, as they have one folder."""

from station.core.disk.file_names import alike, folder_name


def student_key(name: str) -> str:
    """What a student is known by, however their name is written."""
    return alike(folder_name(name))
