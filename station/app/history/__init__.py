"""The history in the window: its pages, and a session of another day opened from it.

In: the history of the user's settings. Out: `HistoryView`, one frozen value; a kept session judged again, to be shown.
Nothing here makes a frame wait: an executor reads, a process of its own judges. Read `history_page` first.
"""
