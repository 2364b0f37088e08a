"""Python side of the fretting contact: `python -m fretting_contact.profile` makes a profile table from a line scan."""
