"""What the user has set, as this run holds it: the settings' file, and what of it is asked or shown in one place.

In: the file, this call's options, the user's changes. Out: all settings as one value, which `settings_store` writes;
`preferences` has how sessions go, `view_settings` how they look, `first_start` the three questions.
Read `settings_store` first.
"""
