"""What benchmarks work with: kits that play by themselves, a JACK server, fuzzers, scores and tutors to compare.

In: what a row asks for. Out: bytes on a line, hits with a known truth, other programs' answers to the same work.
`devices` play and send, `journeys` and `planted` are takes with a known truth. Nothing here measures; tests use the
same rigs. Read `devices.playing_kit` and `scoring_work` first.
"""
