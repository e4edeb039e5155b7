# SPDX-License-Identifier: MIT
"""The two parts of a design's loop, as one linear system each."""

from .errors import DesignError


def final_plant(design):
    """The plant of the last stage, which the steady loop is made of."""
    return design.stages[-1].plant if design.get("stages") else design.plant


def state_names(design):
    """Those of the design file, disturbances and late outputs, and the inputs on their way where there is a delay: the
    oldest first."""
    table = design.plant
    named = list(table.states) + list(table.get("added_states", []))
    waiting = len(table.A) - len(named)
    return named + [f"late {table.inputs[i % len(table.inputs)]} {i}" for i in range(waiting)]


def senses_last_input(design, plant):
    """In the filter form y is taken while the last u acts."""
    return "kalman" in design and design.kalman.form == "filter" and bool(plant.D.any())


def plant(design):
    """x⁺ = A x + B u, y = C x + D u; the first one where there are stages."""
    import numpy

    table = design.plant
    names = {"states": state_names(design), "inputs": table.inputs, "outputs": table.outputs}
    if len(table.C) > 0:
        return (table.A, table.B, table.C, table.D), names
    names["outputs"] = names["states"]
    return (table.A, table.B, numpy.eye(len(table.A)), numpy.zeros(table.B.shape)), names


def sensed(design):
    """The plant as the controller sees it: y = x without a filter, y = C x + D u[k−1] in the filter form."""
    import numpy

    table = final_plant(design)
    nx, nu = table.B.shape
    names = {"states": state_names(design), "inputs": design.plant.inputs, "outputs": design.plant.outputs}
    if "kalman" not in design:
        return (table.A, table.B, numpy.eye(nx), numpy.zeros((nx, nu))), {**names, "outputs": names["states"]}
    if not senses_last_input(design, table):
        return (table.A, table.B, table.C, table.D), names
    A = numpy.block([[table.A, numpy.zeros((nx, nu))], [numpy.zeros((nu, nx + nu))]])
    B = numpy.vstack([table.B, numpy.eye(nu)])
    names["states"] = names["states"] + [f"last {name}" for name in names["inputs"]]
    return (A, B, numpy.hstack([table.C, table.D]), numpy.zeros((len(table.C), nu))), names


def controller(design, references):
    """s⁺ = A s + B y, u = C s + D y over s = [x̂⁻; ξ; u[k−1]], each where the design has it; with `references` the
    inputs are [y; r]. With stages it is the controller of the last one.

        e = y − C x̂ − D u,  u = −K [x̂ + L e; ξ; u[k−1]] + Nbar r  (a Δu with input_rate),
        x̂ ← A x̂ + B u + L_predictor e,  ξ ← ξ + T (r − y)

    In the predictor form u is made of x̂ alone and e of that u; in the filter form e is made of u[k−1]. Of a
    compensator of a given order s is the z that it keeps.
    """
    import numpy

    if "order" in design.get("compensator", {}):
        return of_given_order(design)
    if "lqr" not in design:
        raise DesignError(f"{design.name}: expected a design with a control law, found an estimator alone")
    if "kalman" in design and "L" not in design.kalman:
        raise DesignError(f"{design.name}: expected a filter with a constant gain, found one that never becomes steady")
    plant = final_plant(design)
    shape = Shape(numpy, design, plant, references)
    e, u = innovation_and_input(design, plant, shape)
    outputs = shape.y if shape.estimates else plant.C @ shape.y + plant.D @ u
    integral = shape.integral + design.plant.sample_time * (shape.r_of_integrals - outputs[shape.integrated])
    rows = [integral, u[: len(shape.last)]]
    if shape.estimates:
        rows.insert(0, plant.A @ shape.estimate + plant.B @ u + design.kalman.L_predictor @ e)
    return shape.system(numpy.vstack(rows), u), shape.names


def of_given_order(design):
    own, table = design.compensator, design.plant
    names = {
        "states": [f"z{i}" for i in range(len(own.A))],
        "inputs": list(table.outputs),
        "outputs": list(table.inputs),
    }
    return (own.A, own.B, own.C, own.D), names


class Shape:
    """The signals of a sample as matrices over [x̂⁻; ξ; u[k−1]; y; r]."""

    def __init__(self, numpy, design, plant, references):
        nx, nu = plant.B.shape
        self.estimates = "kalman" in design
        self.integrated = list(map(int, design.lqr.get("integral", [])))
        self.has_rate = design.lqr.K.shape[1] > nx + len(self.integrated)
        wanted = list(map(int, design.lqr.get("references", [])))
        sizes = [
            nx if self.estimates else 0,
            len(self.integrated),
            nu if self.has_rate or senses_last_input(design, plant) else 0,
            len(plant.C) if self.estimates else nx,
            len(wanted) if references else 0,
        ]
        ends = numpy.cumsum(sizes)
        self.estimate, self.integral, self.last, self.y, self.r = numpy.split(numpy.eye(ends[-1]), ends[:-1])
        self.states = ends[2]
        self.r_of_integrals = (
            self.r[[wanted.index(i) for i in self.integrated]]
            if references
            else numpy.zeros((len(self.integrated), ends[-1]))
        )
        self.names = self.named(design, plant, wanted if references else [])

    def named(self, design, plant, wanted):
        table = design.plant
        names = state_names(design)
        measured = table.outputs if self.estimates else names
        states = [f"estimate {name}" for name in names[: len(self.estimate)]]
        states += [f"integral {table.outputs[i]}" for i in self.integrated]
        states += [f"last {name}" for name in table.inputs[: len(self.last)]]
        inputs = list(measured) + [f"wanted {table.outputs[i]}" for i in wanted]
        return {"states": states, "inputs": inputs, "outputs": list(table.inputs)}

    def system(self, following, u):
        return following[:, : self.states], following[:, self.states :], u[:, : self.states], u[:, self.states :]


def innovation_and_input(design, plant, shape):
    """e and u over the signals."""
    if not shape.estimates:
        return None, law(design, shape, shape.y)
    e = shape.y - plant.C @ shape.estimate
    if design.kalman.form == "predictor":
        u = law(design, shape, shape.estimate)
        return e - plant.D @ u, u
    if len(shape.last) > 0:
        e = e - plant.D @ shape.last
    return e, law(design, shape, shape.estimate + design.kalman.L @ e)


def law(design, shape, state):
    import numpy

    z = [state, shape.integral] + ([shape.last] if shape.has_rate else [])
    u = -design.lqr.K @ numpy.vstack(z)
    if shape.has_rate:
        u = u + shape.last
    if len(shape.r) > 0 and "Nbar" in design.lqr:
        u = u + design.lqr.Nbar @ shape.r
    return u
