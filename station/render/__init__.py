"""Pictures: the drummer, the kit, the score and the report, drawn from immutable snapshots.

In: a `Snapshot`, or a result. Out: pixels in a window, a picture, a film or a page.
`snapshot` says what one picture shows, `painter` paints it, `scene` the 3D part, `hud` the words; `notation` engraves,
`figure` and `kit` are the solids, `gpu` what OpenGL is told, `files` what is written.
Read `snapshot`, then `painter`. Colours are in `palette`.
"""
