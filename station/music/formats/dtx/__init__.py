"""DTX, the charts of DTXMania and its kin: text lines of a bar and a channel, two characters a place.

In: bytes. Out: a `DrumPart`, and back. `dtx_lanes` is the table of channels, `dtx_reader` and `dtx_writer` are the
two ways.
Source: the DTX data format as the DTXMania manual and the wiki of DTXMania NX describe it.
"""
