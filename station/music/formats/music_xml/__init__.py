"""MusicXML 3 and 4, plain (.musicxml, .xml) and compressed (.mxl): percussion parts, read and written.

`music_xml_format` has the format, `reading` and `writing` its two ways; what stands here is what both need. Source of
what elements mean: the MusicXML 4.0 reference of the W3C Music Notation Community Group.
"""
