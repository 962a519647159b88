"""The lesson that a command names: shipped, a file, or one of the user's own."""

from station.core.errors import BadInput
from station.drills.lesson import Lesson


def find_any_lesson(name_or_path: str) -> Lesson:
    """The lesson that `station lesson list` has under that name, or the one in the file at that path.

    Raises `BadInput` as `library.find_lesson` does.
    """
    from station.app.settings.settings_store import SettingsStore
    from station.drills.library import courses_in, find_lesson, lesson_names, own_lessons

    try:
        return find_lesson(name_or_path)
    except BadInput:
        settings = SettingsStore().now
        courses, _ = courses_in(settings.courses_dir)
        own = own_lessons(courses, settings.own_lessons_dir, lesson_names())
        if name_or_path not in own:
            raise
        return own[name_or_path]
