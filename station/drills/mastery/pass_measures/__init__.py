"""What a pass came to, in numbers: the facts on which the policy decides.

In: a final alignment and what a lesson asks. Out: `PassFacts`, with the same measures for each limb or group of bars
that has goals of its own. Read `pass_facts` first.
"""
