"""From a table as TOML gives it to the validated scene: keys first, then types, then what no type says.

It uses `kinds` and `model`.  `compile` takes the scene from here, and whoever runs or shows one (`sweep`,
`pictures`, `report`) knows it by the protocols beside it.
"""
