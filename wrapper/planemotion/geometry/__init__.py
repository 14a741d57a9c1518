"""The drawn scene as expressions over the parameters (marks, poses, partners), and the tables they fill.

It uses `model` and `language`, and knows no kind of joint or force.  Kinds write their rows with what lives
here, and `compile` packs them.
"""
