# SPDX-License-Identifier: MIT
"""What an emitted controller is like from outside."""


class Kind:
    """What a controller takes and gives."""

    def __init__(self, result):
        plant = result.plant
        self.has_filter = "kalman" in result
        self.is_estimator = "lqr" not in result and "compensator" not in result
        self.is_predictor = self.has_filter and result.kalman.form == "predictor"
        self.states = len(plant.A)
        self.inputs = len(plant.inputs)
        self.measured = "y" if self.has_filter else "x"
        self.measured_size = len(plant.C) if self.has_filter else self.states
        self.references = len(result.lqr.get("references", [])) if "lqr" in result else 0
