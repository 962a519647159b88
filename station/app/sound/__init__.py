"""The page of sounds: the click, levels, drums, the output, a track.

In: what the user sets (`actions.sound_actions`) and what the engine says. Out: settings, commands for the engine, and
`SoundView`. Read `sound_page` first.
"""
