"""What a battle leaves: a log in its capture, a folder with the capture, a document and a report in words.

In: a battle's rules, turns and result. Out: texts for the capture, files, and the battle judged again from its capture
alone. Read `battle_log`, then `judge_battle_again`.
"""
