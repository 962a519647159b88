"""The editor's part of the window: grid and notation side by side, all words, the text; what can be done with them.

In: `EditorView`, as the controller has it. Out: actions of `app.actions.editor_actions`; nothing here changes a lesson.
A part is a class with `gui(view)`, or a function; `editor_panel` puts them together. First read `editor_panel`.
"""
