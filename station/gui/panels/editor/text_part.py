"""The lesson's text itself, as somebody types it: what the grid and the words write stands here, and the other way."""

from collections.abc import Callable

from imgui_bundle import imgui

from station.app.editor.editor_view import EditorView
from station.drills.editing.lesson_edits import SetText

TEXT = "##lesson-text"


class TextPart:
    """Keeps nothing; what is typed goes to `edit` as one text."""

    def __init__(self, edit: Callable[[SetText], None]) -> None:
        self._edit = edit

    def gui(self, view: EditorView, size: tuple[float, float]) -> None:
        """Draw it in so many pixels and take what is typed."""
        changed, text = imgui.input_text_multiline(TEXT, view.text, imgui.ImVec2(*size))
        if changed and text != view.text:
            self._edit(SetText(text))
