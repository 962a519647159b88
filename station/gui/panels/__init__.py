"""The window's panels, a module each; `panel` says how one is docked and when it is shown.

In: the view. Out: widgets, and actions that are dispatched. A panel keeps nothing but the state of its own widgets.
A `…_part` is a part of a panel, a `…_head` its top; a panel of several modules has a room.
Read `panel`, then `practice_panel` for a small one.
"""
