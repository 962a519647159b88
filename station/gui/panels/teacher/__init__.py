"""The pages of teacher and student: what was given, what came back, and the notes on it.

In: `TeacherView` and `AssignedView` of the state. Out: actions of `app.actions.teacher_actions`.
`take_part` is a take that is opened, `give_part` makes an assignment, `save_row` says where a file goes.
Read `teacher_panel` first, then `assigned_panel`.
"""
