# SPDX-License-Identifier: MIT
"""What other tools call what has another name here: the answer to a keyword that there is none of."""

import difflib

from .errors import DesignError

# By the word in lower case.
FOREIGN = {
    **dict.fromkeys(("ts", "dt", "period", "sampling_time", "sampling_period"), "sample_time=…, in s"),
    "f": "A=…",
    "phi": "A=…",
    "gamma": "B=…",
    **dict.fromkeys(("dead_time", "input_delay", "inputdelay", "iodelay"), "delay=…, in s"),
    "statename": "states=[…]",
    "inputname": "inputs=[…]",
    "outputname": "outputs=[…]",
    "qn": "W=…, process_noise in [kalman]",
    "rn": "V=…, measurement_noise in [kalman]",
    "nn": "Swv=…, cross_noise in [kalman]",
    "process_noise": "W=…",
    "measurement_noise": "V=…",
    "cross_noise": "Swv=…",
    "x0": "kalman={'initial_state': …}, or x0 in scenario={…}",
    "p0": "kalman={'initial_covariance': …}",
    "qi": "lqr={'integral': {'outputs': […], 'Q': …}}",
    "qf": "lqr={'Q_final': …}",
    "qy": "lqr={'Q_output': …}",
    "reference": "lqr={'track': […]}, or reference in scenario={…}",
    "umin": "limits={'u_min': …}",
    "umax": "limits={'u_max': …}",
    "slew_rate": "limits={'u_rate': …}",
    **dict.fromkeys(("gm", "gain_margin"), "require={'gain_margin_dB': …}"),
    **dict.fromkeys(("pm", "phase_margin"), "require={'phase_margin_deg': …}"),
    "precision": "code={'real': …}",
    "scenarios": "scenario=…",
    "stages": "stage=…",
}

# What lqgen computes is nothing to be given.
COMPUTED = {
    "K": "K is what lqgen computes: did you mean Q=… and R=…, or pole_placement={'poles': …}?",
    "L": "L is what lqgen computes: did you mean W=… and V=…, or observer={'poles': …}?",
}

# Keys of a section that are asked for by themselves.
HOMES = {
    **dict.fromkeys(("u_min", "u_max", "u_rate"), "limits"),
    **dict.fromkeys(("track", "integral", "bryson", "horizon", "cost", "decay", "settling_time", "Q_output"), "lqr"),
    **dict.fromkeys(("noise", "gain", "form", "gate", "spike", "initial_state", "initial_covariance"), "kalman"),
    **dict.fromkeys(("poles", "continuous_poles"), "pole_placement"),
    **dict.fromkeys(("gain_margin_dB", "phase_margin_deg", "disk_margin", "max_pole"), "require"),
    **dict.fromkeys(("real", "style", "arithmetic", "realisation", "flash"), "code"),
}

KNOWN = (
    *("name", "brief", "A", "B", "C", "D", "G", "H", "sample_time", "domain", "delay", "states", "inputs", "outputs"),
    *(
        "Q",
        "R",
        "N",
        "W",
        "V",
        "Swv",
        "parameters",
        "lqr",
        "pole_placement",
        "kalman",
        "observer",
        "limits",
        "stage",
        "require",
    ),
    *("code", "scenario"),
)


def unknown(word):
    """The error of a keyword that there is none of, with what may be meant."""
    if word in COMPUTED:
        return DesignError(COMPUTED[word])
    meant = FOREIGN.get(word.lower())
    if meant is None and word in HOMES:
        meant = f"{HOMES[word]}={{'{word}': …}}"
    if meant is None:
        near = difflib.get_close_matches(word, KNOWN, 1)
        meant = f"{near[0]}=…" if near else None
    if meant is None:
        return DesignError(f"{word}: unknown; known are {', '.join(KNOWN)}")
    return DesignError(f"{word}: unknown, did you mean {meant}?")
