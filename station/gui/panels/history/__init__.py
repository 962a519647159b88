"""The panel of the history: a calendar, the list of sessions, trends of a lesson, weeks by limb and by piece.

In: `HistoryView`. Out: `HistoryAction`s. Read `history_panel` first.
"""
