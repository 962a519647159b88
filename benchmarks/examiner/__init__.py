"""An examiner of the drummer that knows anatomy and drum kits, and nothing of how the motion is made.

`take` samples a performance through the fields that docs/motion.md publishes; `body` and `kit_solids` are its own
solids of people and drums; `checks_*` measure; `scores` invents music; `combinations` says what to examine. Metres,
seconds, degrees in what is reported; x to the drummer's right, y forward, z up.
"""
