"""The editor behind the window: a lesson that is being written, where one is in it, and what is heard of it. No window.

In: `actions.editor_actions`, the engine's events, a lesson of the catalog. Out: `EditorView`, a lesson file among the
user's own, and the lesson as it stands for the demonstration's player. First read `lesson_editor`, then
`editor_position`.
"""
