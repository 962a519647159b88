"""A battle as pictures: both drummers on one stage, who moves how, what the camera shows, replays and films.

In: `practice.battle`'s view of a battle, its strokes, a time. Out: `Snapshot`s, videos.
`motion_chain` lets one phrase's motion run into the next one's, `live_figure` moves a player to strokes that nobody
wrote, `pose_mix` is between two poses, `camera_plan` and `stage_light` say who is seen. Read `battle_scene`.
"""
