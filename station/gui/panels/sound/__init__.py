"""The page of sounds: click, levels, drums, output, track; and how much is heard of it all.

In: `SoundView` and the settings. Out: actions of `app.actions.sound_actions`. Read `sound_panel` first.
"""
