"""Where drafts come from and go: lessons of the catalog, journals that were left, files of the user's own."""

import os
from collections.abc import Callable
from concurrent.futures import Executor
from pathlib import Path

from station.app.catalog import Catalog
from station.app.editor.draft_journal import DRAFTS, DraftJournal, LeftDraft, drop_draft, left_drafts
from station.app.editor.open_draft import DraftFile, OpenDraft, text_bytes
from station.app.editor.read_draft import NEW_LESSON
from station.app.music_files.lesson_import import ENDING, place_in
from station.app.settings.settings_store import SettingsStore
from station.core.disk.file_names import folder_name
from station.core.errors import BadInput
from station.drills.editing.edit_history import EditHistory
from station.drills.library import lesson_names

_NEW = "new-lesson"


class DraftFiles:
    """The drafts of the `catalog`'s lessons; files of one's own lie where the settings of `store` say.

    `reader` reads long texts beside what goes on.
    """

    def __init__(
        self, catalog: Catalog, store: SettingsStore, notify: Callable[[str], None], reader: Executor | None = None
    ) -> None:
        self._catalog, self._store, self._notify, self._reader = catalog, store, notify, reader
        self._left: tuple[LeftDraft, ...] | None = None
        self.kept: Path | None = None
        """The file that was saved last, until somebody asks."""

    @property
    def _folder(self) -> Path:
        return self._store.now.own_lessons_dir

    @property
    def left(self) -> tuple[LeftDraft, ...]:
        """The drafts that were not saved, the newest first."""
        if self._left is None:
            self._left = tuple(left_drafts(self._folder / DRAFTS))
        return self._left

    # --- open --------------------------------------------------------------------------------------------------------

    def open(self, name: str) -> OpenDraft:
        """The lesson of that name: one's own in its file, any other as a copy. Raises `BadInput`."""
        lesson = self._catalog.lesson(name)
        if not lesson.text:
            raise BadInput(name, "", "this lesson has no text that could be edited")
        path = self._folder / f"{lesson.name}{ENDING}"
        is_own = lesson.name not in lesson_names() and path.is_file()
        if not is_own:
            self._notify(f"a copy of {lesson.title}: the lesson itself stays as it is")
        return self._draft(DraftFile(lesson.name, path if is_own else None), lesson.text)

    def new(self) -> OpenDraft:
        """A lesson that has nothing but lines."""
        return self._draft(DraftFile(_NEW), NEW_LESSON)

    def _draft(self, file: DraftFile, text: str) -> OpenDraft:
        self._left = None
        journal = DraftJournal(self._folder / DRAFTS, file.path, text)
        return OpenDraft(
            file, EditHistory(text), journal, self._notify, None if file.path is None else text, self._reader
        )

    def resume(self, path: Path) -> OpenDraft:
        """Go on with a draft that was left; raises `BadInput` where it is gone or another window has it."""
        self._left = None
        found = DraftJournal.resumed(path)
        if found is None:
            raise BadInput(path.stem, "", "this draft is gone, or open in another window")
        journal, draft = found
        file = self._own_file(draft.lesson)
        name = _NEW if file is None else file.stem
        history = EditHistory(draft.base).edited(draft.text, draft.name or "what was not saved")
        return OpenDraft(DraftFile(name, file), history, journal, self._notify, reader=self._reader)

    def _own_file(self, lesson: str) -> Path | None:
        """The file that a journal names; None where it is none of one's own lessons.

        A journal that came from elsewhere is saved as a new file and writes over nothing.
        """
        path = self._folder / Path(lesson.replace("\\", "/")).name
        return path if lesson.endswith(ENDING) and os.path.isfile(path) else None  # noqa: PTH113 - False of any name

    def drop(self, path: Path) -> None:
        """Throw a draft away that was left."""
        self._left = None
        drop_draft(path)

    # --- save --------------------------------------------------------------------------------------------------------

    def save(self, draft: OpenDraft, name: str) -> str:
        """Write a draft to its file, to another one where a `name` is given; returns a line for the user.

        Raises `StationError`.
        """
        file = draft.file
        if name or file.path is None:
            file = self._new_file(draft, name)
        draft.save(file)
        assert file.path is not None, "it has just been given one"
        self.kept = file.path
        faults = len(draft.now.faults)
        mend = f", with {faults} fault{'' if faults == 1 else 's'}: the list has it when they are mended"
        return f"saved as {file.path}{mend if faults else ''}"

    def _new_file(self, draft: OpenDraft, name: str) -> DraftFile:
        draft.read_on()
        wanted = name or (draft.lesson.title if draft.lesson is not None else draft.file.name)
        slug = "-".join(filter(None, folder_name(wanted.lower()).split("-")))
        path, _ = place_in(self._folder, slug, text_bytes(draft.history.text, slug))
        return DraftFile(path.stem, path)
