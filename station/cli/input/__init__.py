"""What commands read: scores, performances and takes that a user names; answers and taps at the terminal.

In: a word of the command line, or a line typed. Out: a `Score`, a `Performance`, hits of a kit.
Read `read_scores` first.
"""
