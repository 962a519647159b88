"""The teacher's desk without the window: what students sent, judged again where that is asked for.

In: returns in their files. Out: lists, a session of a return judged again in a process with limits.
`judge_worker` judges, `incoming` keeps what is dropped; what lies where says `practice.exchange.teacher_store`.
Read `returns_desk` first.
"""
