"""Maps of outcomes: which outcome a study has over two parameters, refined along the boundaries between them.

It uses `sweep` and what lies below.  The top makes maps with it, and `pictures` draws what it wrote.
"""
