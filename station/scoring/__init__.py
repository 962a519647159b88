"""Align, judge, summarise, advise: hits and notes in, judgements and figures out."""
