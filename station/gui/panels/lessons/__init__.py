"""The parts of the lessons panel: who practises, the list with its courses, how the chosen lesson is played.

In: the state's `Selection`. Out: another one, and actions. `lessons_panel` beside this folder lays them out; read
`lesson_list` first.
"""
