"""What a session lets sound, as cues for the engine: the click, the strokes of a demonstration, what is heard again.

In: a score or a take, the tempo, the click that was asked for. Out: rows of cues in session time.
Read `click_pattern` first.
"""
