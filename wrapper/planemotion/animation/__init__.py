"""A run that moves: one page of HTML with a player of its own, or frames as GIF and MP4.

`moving` records the motion; `signs` notes what a picture is made of, `carried` finds with which body each
sign goes; `beside` has what is shown beside the bodies, as `shows` asks for, and `timing` how fast it goes.
`document` tells a player all of it, `page` writes it into one (player.html, .css, player*.js), `widget` gives
it to notebooks.  `video` makes frames of the same (`drawn`, `margin`), and `film` writes them.
It uses `pictures` for what is drawn and `engine` for the history; commands and Scene.animate use it.
"""
