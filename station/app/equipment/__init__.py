"""Kits and latency as the devices page has them: rules of pads, learning, measuring; what works on this computer.

In: what kits send, actions of the page. Out: a frozen view of them, and the user's own files.
`mapping_editor` changes what a kit means, `mapping_view` is what is shown of it, `calibration` measures latency in a
process of its own, `diagnostics` looks for what is missing.
Read `mapping_editor` first.
"""
