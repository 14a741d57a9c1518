"""A scene as a model that programs in any language call over HTTP, with UM-Bridge."""

import umbridge

import planemotion


class SceneModel(umbridge.Model):
    """One vector of parameters in, one of answers out; units are those of the scene."""

    def __init__(self, scene, inputs, outputs, name="planemotion"):
        super().__init__(name)
        self._answer = scene.function(inputs, outputs, workers=1)

    def get_input_sizes(self, config):
        return [len(self._answer.inputs)]

    def get_output_sizes(self, config):
        return [len(self._answer.outputs)]

    def __call__(self, parameters, config):
        return [self._answer(parameters[0]).tolist()]

    def supports_evaluate(self):
        return True


if __name__ == "__main__":
    collar = planemotion.load("../rolling_collar.toml")
    umbridge.serve_models([SceneModel(collar, ["d", "mass_ratio"], ["omega_above"])], 4242)
