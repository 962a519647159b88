"""What OpenGL is told: contexts, shaders, buffers, and pictures read back.

In: meshes, bones, tables of flat shapes. Out: drawn pixels. With `files` the only place that knows a graphics driver.
`scene_parts` uploads a scene, `pixel_shaders` and `corner_shaders` light it, `shape_renderer` draws flat shapes,
`cached_layer` keeps what does not move, `nv12` makes planes for video.
Read `gl` first.
"""
