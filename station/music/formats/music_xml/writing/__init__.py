"""MusicXML out: a `DrumPart` spelled as notes, its bars and directions as elements, and what is lost on the way.

Begin with `music_xml_writer`.
"""
