"""Takes with faults planted in them, for the advice to be measured on; nothing is shared with what judges.

In: a written score and a sheet of faults. Out: hits, and how small an effect an oracle would find.
`planted_faults` are the words, `planted_player` plays, `planted_oracle` sets the sizes, `planted_table` counts.
Read `planted_stage`, then `planted_trials`.
"""
