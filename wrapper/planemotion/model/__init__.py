"""What stands in a scene file, as written: the words of its tables, their readers, and frozen models of them.

It uses `language`.  `geometry` and `kinds` take their numbers from these models, and `reading` puts them
together to the scene as a whole.
"""
