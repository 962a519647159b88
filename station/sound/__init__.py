"""Sound: drum kits, the mixer, the click, the sound card's output.

In: strokes, chokes, clicks, tracks. Out: stereo blocks, and when each is heard.
`mixer` mixes, `core.sound_names` says which sound a stroke asks for, `synth` makes the default kit, `samples` reads
recorded ones, `output` owns the card, `calibration` measures latency.
Read `mixer` first.
"""
