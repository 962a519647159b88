"""What each stroke of a take is: ornament, dynamic, letter, limb, length."""
