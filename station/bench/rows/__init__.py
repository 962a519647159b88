"""(guide)"""
