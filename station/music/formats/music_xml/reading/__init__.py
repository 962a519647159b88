"""MusicXML in: which part is the drummer's, then its bars, directions, notes and strokes as a `DrumPart`.

Begin with `music_xml_reader`.
"""
