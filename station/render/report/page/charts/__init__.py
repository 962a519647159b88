"""Charts of a session, each drawn once as flat shapes for browser and paper alike.

In: facts of `session_page`. Out: a `Chart`, whose words say what it shows to those who do not see it.
Read `chart` first.
"""
