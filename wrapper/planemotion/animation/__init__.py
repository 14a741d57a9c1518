"""A run that moves: one page of HTML with a player of its own, or frames as GIF and MP4.

`signs` notes what a picture is made of, `moving` finds with which body each sign goes and records the
motion, `page` writes both into the player (player.html, .css, .js; player_controls.js), `widget` gives it to
notebooks, `video` draws frames.
It uses `pictures` for what is drawn and `engine` for the history; the command line and Scene.animate use it.
"""
