"""Contacts with friction at random, beside independent computations: `python -m tests.stress.contacts`.

`laws` restates the laws of contact on plain matrices, and `course` those of a blow that is followed;
`one_body` poses blows and starts from rest of one body on up to four contacts, and `verdict` says what
became of them; `throws` throws crates, rods, disks, stacks and dominoes, `thrown` runs them, `rest`
looks at where they came to, and `instants` counts the motions where the laws leave open how they go on.
"""
