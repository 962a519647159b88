"""The charts of Clone Hero and YARG: `.chart` (both ways) and `notes.mid` (read).

In: bytes of a file. Out: a `DrumPart`. Both readers give a `DrumChart`, notes in lanes, of which `chart_part` makes
strokes by `drum_lanes`; `chart_writer` writes a part as a `.chart`. Read `drum_chart` first.

Source: the GuitarGame_ChartFormats documentation (TheNathannator), .chart and .mid, Drums; PEERS § Formats.
"""
