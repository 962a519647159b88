"""The editor's words: a field for everything that a lesson can say, each with its sentence and its fault.

A field that is emptied leaves its key out. What is typed is written when the field is left, or with Enter.
"""

from collections.abc import Callable

from imgui_bundle import imgui

from station.app.actions.editor_actions import Edit, EditorAction
from station.app.editor.editor_view import EditorView
from station.core.errors import BadInput
from station.core.toml.toml_faults import Fault
from station.core.toml.toml_places import KeyPath
from station.drills.editing.lesson_edits import SetKey
from station.drills.editing.words.word_fields import (
    NEW_ENTRIES,
    FieldKind,
    WordField,
    WordList,
    WordTable,
    label_of,
    words_form,
)
from station.drills.editing.words.word_values import shown_value, typed_value
from station.gui import theme

_LABELS, _FIELDS, _LEAST_BESIDE = 210.0, 330.0, 780.0
"""Design pixels of the two columns, and from which width the sentences stand beside the fields, not in tooltips."""
_LONG_ROWS = 4
_NOTHING = "(nothing)"


class WordsPart:
    """Keeps what is being typed, and what was asked to be shown though it says nothing yet."""

    def __init__(self, dispatch: Callable[[EditorAction], None]) -> None:
        self._dispatch = dispatch
        self._typed: dict[KeyPath, str] = {}
        self._refused: dict[KeyPath, str] = {}
        self._opened: set[KeyPath] = set()
        self._form: tuple[str, tuple[Fault, ...], WordTable] | None = None
        self._is_wide = False

    def gui(self, view: EditorView, size: tuple[float, float]) -> None:
        """Draw it in so many pixels and do what the user does in it."""
        imgui.begin_child("##words-part", imgui.ImVec2(*size))
        self._is_wide = size[0] >= theme.points(_LEAST_BESIDE)
        self._table(self._form_of(view))
        imgui.end_child()

    def _form_of(self, view: EditorView) -> WordTable:
        if self._form is None or self._form[:2] != (view.text, view.faults):
            self._form = view.text, view.faults, words_form(view.text, view.faults)
            self._refused.clear()
        return self._form[2]

    # --- tables ------------------------------------------------------------------------------------------------------

    def _table(self, table: WordTable) -> None:
        """The fields of a table, then the tables in it."""
        _fault(table.fault)
        shown = [part for part in table.parts if part.is_said or not part.is_rare or part.path in self._opened]
        for part in shown:
            if isinstance(part, WordField):
                self._field(part)
        self._offer(table)
        for part in shown:
            if isinstance(part, WordTable):
                self._titled(part, label_of(part.path), imgui.TreeNodeFlags_.none)
            elif isinstance(part, WordList):
                self._list(part)

    def _titled(self, table: WordTable, title: str, flags: int) -> None:
        """A table under a title that opens and closes it; one that says something is bright."""
        if not _header(title, table, flags):
            return
        imgui.indent(theme.points(12))
        self._table(table)
        imgui.unindent(theme.points(12))

    def _list(self, entries: WordList) -> None:
        """Each entry under a title of its own, and a button for one more."""
        name = label_of(entries.path)
        _fault(entries.fault)
        for entry in entries.entries:
            flags = imgui.TreeNodeFlags_.default_open if entries.path == ("grid",) else imgui.TreeNodeFlags_.none
            self._titled(entry, f"{name} {_entry_name(entry)}", flags)
        if entries.path == ("grid",):
            return  # the page's bar makes grids: as variations, or of rests
        if imgui.button(f"Add: {name.lower()}##{_id(entries.path)}"):
            self._set(entries.blank.path, dict(NEW_ENTRIES[str(entries.path[-1])]))
        theme.tooltip(entries.says)
        if entries.entries:
            imgui.same_line()
            if imgui.button(f"Take the last away##{_id(entries.path)}"):
                self._set(entries.entries[-1].path, None)

    def _offer(self, table: WordTable) -> None:
        """A list of what is not shown because it is one of many."""
        offered = [part for part in table.offered if part.path not in self._opened]
        if not offered:
            return
        imgui.set_next_item_width(theme.points(_LABELS))
        if imgui.begin_combo(f"##offer-{_id(table.path)}", f"More: {label_of(offered[0].path).lower()} …"):
            for part in offered:
                if imgui.selectable(f"{label_of(part.path)}##{_id(part.path)}", False)[0]:
                    self._opened.add(part.path)
            imgui.end_combo()

    # --- fields ------------------------------------------------------------------------------------------------------

    def _field(self, field: WordField) -> None:
        """The name, the field, what it says beside it or in a tooltip, and what is wrong with it below."""
        imgui.align_text_to_frame_padding()
        label = theme.one_line(label_of(field.path), theme.points(_LABELS) - imgui.get_style().item_spacing.x)
        imgui.text(label) if field.is_said else imgui.text_disabled(label)
        theme.tooltip(_told(field))
        imgui.same_line(imgui.get_cursor_pos_x() + theme.points(_LABELS))
        imgui.set_next_item_width(self._field_width(field))
        if field.kind is FieldKind.CHOICE:
            self._choice(field)
        else:
            self._text(field)
        theme.tooltip(_told(field))
        if self._is_wide and field.kind is not FieldKind.CELLS:
            imgui.same_line()
            theme.soft(_sentence(field))
        _fault(self._refused.get(field.path, field.fault))

    def _field_width(self, field: WordField) -> float:
        room = float(imgui.get_content_region_avail().x)
        return room if field.kind is FieldKind.CELLS or not self._is_wide else min(theme.points(_FIELDS), room)

    def _choice(self, field: WordField) -> None:
        if imgui.begin_combo(f"##{_id(field.path)}", shown_value(field) or _NOTHING):
            for word in (None, *field.choices):
                if imgui.selectable(word or _NOTHING, word == field.value)[0] and word != field.value:
                    self._set(field.path, word)
            imgui.end_combo()

    def _text(self, field: WordField) -> None:
        name, stands = f"##{_id(field.path)}", shown_value(field)
        text = self._typed.get(field.path, stands)
        if field.kind is FieldKind.TEXT or "\n" in stands:
            high = imgui.get_text_line_height() * _LONG_ROWS + 2 * imgui.get_style().frame_padding.y
            width = imgui.calc_item_width()
            changed, text = imgui.input_text_multiline(name, text, imgui.ImVec2(width, high), _WRAPPED)
        else:
            changed, text = imgui.input_text_with_hint(name, _hint(field), text)
        if changed:
            self._typed[field.path] = text
        if imgui.is_item_deactivated_after_edit():
            self._leave(field, text)
        elif not imgui.is_item_active():
            self._typed.pop(field.path, None)

    def _leave(self, field: WordField, text: str) -> None:
        """What was typed goes into the text."""
        self._typed.pop(field.path, None)
        self._refused.pop(field.path, None)
        try:
            value = typed_value(field, text)
        except BadInput as fault:
            self._refused[field.path] = fault.fault
            return
        if value != field.value:
            self._set(field.path, value)

    def _set(self, path: KeyPath, value: object) -> None:
        self._dispatch(Edit(SetKey(path, value)))


_WRAPPED = imgui.InputTextFlags_.word_wrap


def _header(title: str, table: WordTable, flags: int) -> bool:
    """A line that opens and closes a table."""
    words = title if table.is_said else f"{title}: nothing said"
    is_open = bool(imgui.collapsing_header(f"{words}###{_id(table.path)}", flags))
    theme.tooltip(table.says)
    return is_open


def _entry_name(table: WordTable) -> str:
    """The number of an entry of a list, and what it is called or where it is."""
    named = {part.path[-1]: shown_value(part) for part in table.parts if isinstance(part, WordField) and part.is_said}
    words = next((named[key] for key in ("name", "bars", "bar", "meter") if key in named), "")
    return f"{label_of(table.path)}: {words}" if words else label_of(table.path)


def _hint(field: WordField) -> str:
    """What may be typed, in an empty field."""
    if field.kind in _EXAMPLES:
        return f"such as {_EXAMPLES[field.kind]}"
    return "" if field.low is None or field.high is None else f"{field.low:g} to {field.high:g}"


_EXAMPLES = {FieldKind.WHOLES: "1, 4", FieldKind.WORDS: "rock, fill", FieldKind.WHOLE_OR_WHOLES: "1, or 1, 2"}


def _sentence(field: WordField) -> str:
    says = field.says.replace("`", "")
    return f"{says[:1].upper()}{says[1:]}."


def _told(field: WordField) -> str:
    """What a field says, and its key in the text."""
    return f"{_sentence(field)}\nIn the text: {field.path[-1]}. Empty leaves it out."


def _fault(words: str) -> None:
    if words:
        theme.warning(words)


def _id(path: KeyPath) -> str:
    return ".".join(map(str, path))
