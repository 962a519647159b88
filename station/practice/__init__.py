"""The practice session as a state machine, and the virtual student."""
