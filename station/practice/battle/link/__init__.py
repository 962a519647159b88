"""Two stations, one battle, over the local network; each judges at its own kit, so that no delay ever counts.

In: datagrams, typed messages, the time. Out: datagrams, messages that fit, both drummers' turns, one record of rounds.
`datagram` is the bytes, `channel` makes them arrive in order, `handshake` opens a channel, `line` joins both with the
messages, `link_socket` is the port; `linked_battle` plays, `linked_play` carries both. Read docs/battle-network.md
first, then `linked_battle`.
"""
