# SPDX-License-Identifier: MIT
"""Pictures of a design, by Matplotlib."""

from functools import partial

from .errors import DesignError, expected, needs
from .frequency import frequencies, loop_gain, one_at_a_time

RINGS = (0.2, 0.4, 0.6, 0.8)  # damping ratios


def plot(design, kind, **options):
    """A Figure."""
    if kind not in KINDS:
        raise expected("kind", " or ".join(f'"{name}"' for name in KINDS), repr(kind))
    try:
        from matplotlib.figure import Figure
    except ImportError:
        raise needs("Matplotlib", "plot()", "plot") from None
    if options and kind != "response":
        raise expected(f'plot("{kind}")', "no options", ", ".join(options))
    return KINDS[kind](figure_of(Figure), design, **options)


def figure_of(Figure):
    """One that notebooks and scripts show: by pyplot where that has a place to show it."""
    import matplotlib.pyplot

    return matplotlib.pyplot.figure(layout="constrained")


def response(figure, design, scenario=None, seed=1):
    """Outputs with their references, inputs with their limits, each state with its estimate within ±3σ."""
    run = design.simulate(scenario, seed)
    parts = [draw for draw, there in ((draw_outputs, run.outputs), (draw_inputs, run.u)) if has(there)]
    parts += [partial(draw_state, i) for i in range(len(run.names.states))]
    axes = figure.subplots(len(parts), 1, sharex=True, squeeze=False)[:, 0]
    figure.set_size_inches(8, max(4, 1.8 * len(parts)))
    figure.suptitle(f"{design.name}: {run.name}")
    for draw, place in zip(parts, axes):
        draw(place, run, design)
        place.grid(alpha=0.3)
        place.legend(loc="best", fontsize="small")
    axes[-1].set_xlabel("t [s]")
    return figure


def has(matrix):
    return matrix is not None and getattr(matrix, "size", 0) > 0


def draw_outputs(axes, run, design):
    wanted = {name.split(" [")[0]: j for j, name in enumerate(run.names.references)}
    for i, name in enumerate(run.names.outputs):
        (line,) = axes.plot(run.t, run.outputs[:, i], label=name)
        axes.plot(run.t, run.y[:, i], ".", markersize=2, alpha=0.4, color=line.get_color())
        j = wanted.get(name.split(" [")[0])
        if j is not None:
            axes.step(run.t, run.r[:, j], "--", where="post", color=line.get_color(), label=f"reference of {name}")
    axes.set_ylabel("outputs")


def number_at(design, key, value):
    """A number of the design file, or what the expression that stands there gives."""
    return design.solve().expressions[key].value if isinstance(value, str) else value


def draw_inputs(axes, run, design):
    limits = design.tables.get("limits", {})
    for i, name in enumerate(run.names.inputs):
        (line,) = axes.step(run.t, run.u[:, i], where="post", label=name)
        for key in ("u_min", "u_max"):
            if i < len(limits.get(key, [])):
                limit = number_at(design, f"limits.{key}[{i}]", limits[key][i])
                if abs(limit) < float("inf"):
                    axes.axhline(limit, linestyle=":", color=line.get_color())
    axes.set_ylabel("inputs")


def draw_state(i, axes, run, design):
    """The axis is for the state and its estimate: σ may begin far outside."""
    (line,) = axes.plot(run.t, run.x[:, i], label=run.names.states[i])
    axes.plot(run.t, run.estimate[:, i], "--", label="estimate ± 3σ")
    low, high = axes.get_ylim()
    if has(run.sigma):
        least, most = (run.estimate[:, i] + sign * 3 * run.sigma[:, i] for sign in (-1, 1))
        axes.fill_between(run.t, least, most, color=line.get_color(), alpha=0.2)
    axes.set_ylim(low, high)


def loops(design):
    """Frequencies, and for each input its name and its loop."""
    result = design.solve()
    if "lqr" not in result and "compensator" not in result:
        raise DesignError(f"{design.name}: expected a design with a control law, found an estimator alone")
    w = frequencies(result)
    return w, list(zip(result.plant.inputs, one_at_a_time(loop_gain(result, w)).T))


def others(named):
    return "" if len(named) == 1 else ", loop at a time"


def bode(figure, design):
    """Magnitude and phase, with the margins of the design in the title."""
    import numpy

    w, named = loops(design)
    figure.set_size_inches(8, 5.5)
    gain, phase = figure.subplots(2, 1, sharex=True)
    for name, L in named:
        gain.loglog(w, abs(L), label=name)
        turned = numpy.degrees(numpy.unwrap(numpy.angle(L)))
        phase.semilogx(w, turned - 360 * numpy.ceil(turned[0] / 360))
    gain.axhline(1, color="0.5", linewidth=0.8)
    phase.axhline(-180, color="0.5", linewidth=0.8)
    figure.suptitle(f"{design.name}: loop at the plant's inputs{others(named)}\n{margins_in_words(design.margins)}")
    gain.set_ylabel("|L|")
    phase.set_ylabel("∠L [°]")
    phase.set_xlabel("ω [rad/s]")
    gain.legend(fontsize="small")
    for axes in (gain, phase):
        axes.grid(alpha=0.3, which="both")
    return figure


def margins_in_words(margins):
    units = {"gain_margin_dB": "dB", "phase_margin_deg": "°", "delay_margin_s": "s"}
    known = [
        f"{key.split('_')[0]} {margins[key]:.3g} {unit}" for key, unit in units.items() if margins.get(key) is not None
    ]
    return "margins: " + (", ".join(known) or "none")


def nyquist(figure, design):
    """Around −1, with the circle that the disk margin keeps free for frequencies > 0 and < 0."""
    import numpy

    w, named = loops(design)
    figure.set_size_inches(6, 6)
    axes = figure.subplots()
    for name, L in named:
        (line,) = axes.plot(L.real, L.imag, label=name)
        axes.plot(L.real, -L.imag, linestyle="--", color=line.get_color(), linewidth=0.8)
    angle = numpy.linspace(0, 2 * numpy.pi, 400)
    axes.plot(numpy.cos(angle), numpy.sin(angle), color="0.7", linewidth=0.8)
    disk = design.margins.get("disk_margin")
    if disk and disk < 2:  # else it is a half-plane
        a, b = -(2 + disk) / (2 - disk), -(2 - disk) / (2 + disk)
        axes.fill((a + b) / 2 + (a - b) / 2 * numpy.cos(angle), (a - b) / 2 * numpy.sin(angle), color="0.85")
    axes.plot([-1], [0], "k+")
    axes.set_xlim(-3, 2)
    axes.set_ylim(-2.5, 2.5)
    axes.set_aspect("equal")
    axes.set_xlabel("Re L")
    axes.set_ylabel("Im L")
    axes.grid(alpha=0.3)
    axes.legend(fontsize="small")
    figure.suptitle(f"{design.name}: loop at the plant's inputs{others(named)}")
    return figure


def poles(figure, design):
    """In the plane of z, of the closed loop, the regulator and the filter, with lines of equal damping."""
    import numpy

    result = design.solve()
    figure.set_size_inches(6, 6)
    axes = figure.subplots()
    angle = numpy.linspace(0, 2 * numpy.pi, 400)
    axes.plot(numpy.cos(angle), numpy.sin(angle), color="0.5", linewidth=0.8)
    for zeta in RINGS:
        turn = numpy.linspace(0, numpy.pi, 200)
        z = numpy.exp((-zeta / numpy.sqrt(1 - zeta**2) + 1j) * turn)
        for side in (z, z.conj()):
            axes.plot(side.real, side.imag, color="0.85", linewidth=0.8)
    for owner, marker, size in (("loop", "x", 9), ("lqr", "s", 6), ("kalman", "o", 6)):
        found = result.get(owner, {}).get("poles")
        if found is not None and len(found) > 0:
            axes.plot(found.real, found.imag, marker, markersize=size, fillstyle="none", label=owner)
    axes.set_aspect("equal")
    axes.set_xlabel("Re z")
    axes.set_ylabel("Im z")
    axes.grid(alpha=0.3)
    axes.legend(fontsize="small")
    figure.suptitle(f"{design.name}: poles, damping {', '.join(map(str, RINGS))}")
    return figure


KINDS = {"response": response, "bode": bode, "nyquist": nyquist, "poles": poles}
