# SPDX-License-Identifier: MIT
"""A design in memory: from arrays, a system or a design file to gains, runs, plots and the controller itself."""

import re
import tempfile
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterable, Mapping, Optional, Sequence, Union

from . import toml
from .design_file import design_text
from .errors import DesignError, expected, refusing
from .findings import findings_in
from .lqgen import generate, run_lqgen
from .names import design_name, tomllib
from .paths import with_values
from .result import Result, Table, result_of

if TYPE_CHECKING:
    from .controller import Controller
    from .monte_carlo import MonteCarlo
    from .simulation import Run
    from .sweep import Sweep

Matrix = Any  # an array of NumPy, a list of rows, the list of a diagonal, or a number for 1 × 1
Words = Mapping[str, Any]

MARGINS = re.compile(r"gain_margin.*|phase_margin_deg|delay_margin.*|crossover|disk_margin")


class Design:
    """An LQR, a Kalman filter or both, for a plant that is sampled every T seconds:

        x⁺ = A x + B u + G w,   y = C x + D u + H w + v          (continuous: ẋ = A x + B u + G w)
        u = −K x̂,   x̂ ← x̂ + L (y − C x̂ − D u),   x̂ ← A x̂ + B u

        servo = tinylqg.Design(A=[[0, 1], [0, -59]], B=[[0], [2122]], C=[[1, 0]], domain="continuous",
                               sample_time=0.001, Q=[400, 1e-3], R=[0.007], G=[[0], [-3e5]], W=[1e-6], V=[8e-7],
                               limits={"u_min": [-12], "u_max": [12]})
        servo.K, servo.margins.phase_margin_deg

    A Design does not change and has nothing but the text of its design file, `text`: it can be compared, hashed and
    pickled. lqgen designs it when a result is asked for first, and keeps that.

    Parameters
    ----------
    plant : a StateSpace or TransferFunction of python-control, an lti or dlti of scipy.signal, a tuple of matrices
        (A, B), (A, B, C), (A, B, C, D) or (A, B, C, D, dt), or a dictionary with keys of [plant]. Or none, with A, B,
        C, D. The module `transfer` says which states a transfer function gets.
    name : a C identifier in lower case, the name of files and symbols; brief: one line about it.
    A : nx × nx.  B : nx × nu, none for an estimator alone.  C : ny × nx, none for a regulator alone of measured states.
    D : ny × nu, 0.  G : nx × nw, identity.  H : ny × nw, 0.
    domain : "continuous" or "discrete", of arrays.  sample_time : s, T; of a discrete system it may be the system's.
    delay : s, from sampling y until u takes effect.
    states, inputs, outputs : names, with units in brackets: ["angle [rad]"].
    Q : nx × nx.  R : nu × nu.  N : nx × nu.  The cost Σ xᵀQx + uᵀRu + 2xᵀNu, of a continuous plant ∫ … dt.
    W : nw × nw.  V : ny × ny.  Swv : nw × ny.  Of a continuous plant densities, unless kalman={"noise": "discrete"}.
        Q, R, W and V may be the list of their diagonal, and where 1 × 1 a number.
    parameters : names for numbers, {"m": 2, "k": {"value": 8, "unit": "N/m"}, "w": "sqrt(k/m)"}. Over them every number
        may be an expression: A=[[0, 1], ["-k/m", 0]].
    lqr, pole_placement, kalman, observer, compensator, limits, require, code : dictionaries with the keys of these
        sections of the design file: lqr={"track": ["angle"]}.
    uncertain, stage, scenario : a list of such dictionaries; one of uncertain or scenario may be a dictionary alone.

    Raises
    ------
    DesignError, a ValueError: at once where the text cannot be written (unknown words, contradictions), else with the
        first result (sizes, NaN, what cannot be stabilised), with all lines of lqgen.
    """

    def __init__(
        self,
        plant: Any = None,
        *,
        name: str = "design",
        brief: Optional[str] = None,
        A: Matrix = None,
        B: Matrix = None,
        C: Matrix = None,
        D: Matrix = None,
        sample_time: Optional[float] = None,
        domain: Optional[str] = None,
        G: Matrix = None,
        H: Matrix = None,
        delay: Optional[float] = None,
        states: Optional[Sequence[str]] = None,
        inputs: Optional[Sequence[str]] = None,
        outputs: Optional[Sequence[str]] = None,
        Q: Matrix = None,
        R: Matrix = None,
        N: Matrix = None,
        W: Matrix = None,
        V: Matrix = None,
        Swv: Matrix = None,
        parameters: Optional[Words] = None,
        lqr: Optional[Words] = None,
        pole_placement: Optional[Words] = None,
        kalman: Optional[Words] = None,
        observer: Optional[Words] = None,
        compensator: Optional[Words] = None,
        uncertain: Union[Words, Sequence[Words], None] = None,
        limits: Optional[Words] = None,
        stage: Optional[Sequence[Words]] = None,
        require: Optional[Words] = None,
        code: Optional[Words] = None,
        scenario: Union[Words, Sequence[Words], None] = None,
        **unknown: Any,
    ):
        matrices = {key: value for key, value in {"A": A, "B": B, "C": C, "D": D}.items() if value is not None}
        if plant is not None and matrices:
            raise DesignError(f"plant.{next(iter(matrices))}: given twice, in the plant, too")
        if plant is None:
            if A is None:
                raise DesignError("plant: expected a system or A=…, found none")
            plant = tuple(matrices.get(key) for key in "ABCD")
        self.keep(
            design_text(
                plant,
                name=name,
                brief=brief,
                sample_time=sample_time,
                domain=domain,
                G=G,
                H=H,
                delay=delay,
                states=states,
                inputs=inputs,
                outputs=outputs,
                Q=Q,
                R=R,
                N=N,
                W=W,
                V=V,
                Swv=Swv,
                parameters=parameters,
                lqr=lqr,
                pole_placement=pole_placement,
                kalman=kalman,
                observer=observer,
                compensator=compensator,
                uncertain=uncertain,
                limits=limits,
                stage=stage,
                require=require,
                code=code,
                scenario=scenario,
                **unknown,
            )
        )

    @classmethod
    def load(cls, path: Union[str, Path]) -> "Design":
        """The design in the file `path`, whose text is kept with its comments. CSV files of scenarios are looked for
        beside it. Raises DesignError where it is no TOML or has no name, OSError where it cannot be read."""
        data = Path(path).read_bytes()
        with refusing(path, "a design file"):
            text = data.decode("utf-8")
        return cls.from_text(text, folder=Path(path).resolve().parent, where=str(path))

    @classmethod
    def from_text(cls, text: str, *, folder: Union[str, Path, None] = None, where: str = "") -> "Design":
        """The design that the text of a design file says. `folder`: where CSV files of scenarios are looked for;
        `where`: what messages call the text."""
        with refusing(where or "design", "a design file"):
            tables = tomllib.loads(text.lstrip("\ufeff"))
        design_name(tables.get("name"), f"{where}: name" if where else "name")
        design = cls.__new__(cls)
        design.keep(text, None if folder is None else str(folder), where)
        return design

    def keep(self, text, folder=None, where=""):
        """All that a Design is."""
        self.__dict__.update(text=text, folder=folder, where=where)

    def __setattr__(self, key, value):
        raise AttributeError(f"a Design does not change: replace({key}=…) gives another one")

    def __getstate__(self):
        return {"text": self.text, "folder": self.folder, "where": self.where}

    def __setstate__(self, state):
        self.keep(**state)

    def __eq__(self, other):
        return self.text == other.text if isinstance(other, Design) else NotImplemented

    def __hash__(self):
        return hash(self.text)

    def __repr__(self):
        plant = self.tables.get("plant", {})
        sizes = [f"{len(plant.get(key, []))} {word}" for key, word in (("A", "states"), ("C", "outputs"))]
        return f"<Design {self.name}: {', '.join(sizes)}, T = {plant.get('sample_time')} s>"

    @cached_property
    def tables(self) -> dict:
        """The tables of the design file, as TOML has them; for reading only."""
        return tomllib.loads(self.text.lstrip("\ufeff"))

    @property
    def name(self) -> str:
        return self.tables["name"]

    @property
    def scenarios(self) -> list:
        """The names of the scenarios of the design file."""
        return [scenario.get("name") for scenario in self.tables.get("scenario", [])]

    def replace(self, values: Optional[Words] = None, **more: Any) -> "Design":
        """The same design with other values, by their places in the design file.

        design.replace(Q=[1, 2], rho=0.1), design.replace({"lqr.Q[1]": 3, "kalman.form": "predictor"}). A letter of the
        constructor or a key that only one section has needs no section; `rho` is the factor of R, or that of Bryson's
        rule. "parameters.m" keeps the parameter's unit. None takes a key away. Comments of a design file are not kept.
        """
        tables = with_values(self.tables, {**(values or {}), **more})
        return Design.from_text(toml.whole_document(tables), folder=self.folder)

    def lqgen(self, *arguments: str):
        """lqgen with this design as its standard input: what it printed on standard output and on standard error."""
        return run_lqgen(*arguments, text=self.text, folder=self.folder, where=self.where)

    @cached_property
    def solution(self):
        """The result, and what lqgen said."""
        with tempfile.TemporaryDirectory() as folder:
            _, said = self.lqgen("-o", folder, "--only", "json", "--", "-")
            data = Path(folder, self.name + ".json").read_bytes()
        return result_of(self.name, data), findings_in(said)

    def solve(self) -> Result:
        """All numbers of the design, with the keys of NAME.json: `design.solve().lqr.K`. Computed once.
        Raises DesignError with all lines of lqgen where the design is wrong or impossible."""
        return self.solution[0]

    @property
    def findings(self) -> list:
        """Notes of lqgen, which stop nothing: a list of Finding."""
        return self.solution[1]

    @property
    def K(self):
        """nu × (nx + integrals …): u = −K [x̂; ξ; …], of the sampled plant."""
        return self.solve().K

    @property
    def L(self):
        """nx × ny: x̂ ← x̂ + L (y − C x̂ − D u), steady. In predictor form A L is `solve().kalman.L_predictor`."""
        return self.solve().L

    @property
    def margins(self) -> Table:
        """gain_margin_dB, phase_margin_deg, delay_margin_s, crossover (rad/s), disk_margin …, of the loop opened at the
        plant's inputs, and `at_output`. An estimator alone has none."""
        loop = self.solve().loop
        return Table({key: value for key, value in loop.items() if MARGINS.fullmatch(key) or key == "at_output"})

    @property
    def poles(self):
        """Of the closed loop, or of the estimator alone, in the plane of z: complex, stable where |z| < 1."""
        return self.solve().loop.poles

    @property
    def rms(self) -> Table:
        """x, u and y in the steady state with the noise of the design, in their units."""
        return self.solve().loop.rms

    def write(self, folder: Union[str, Path] = ".", *options: str, force: bool = False) -> Result:
        """Writes NAME.toml, the design file, and what lqgen makes of it: NAME.h, NAME_test.c, NAME.json.

        `options` go to lqgen: "--style", "compact". A NAME.toml that is there with another text is kept, which is a
        DesignError, unless `force`."""
        path = Path(folder) / (self.name + ".toml")
        data = self.text.encode("utf-8")
        if not force and path.exists() and path.read_bytes() != data:
            raise expected(path, "no file or this design", "another one; force=True replaces it")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
        return generate(path, folder, *options)

    def simulate(self, scenario: Union[str, Words, None] = None, seed: int = 1) -> "Run":
        """The emitted controller, bit for bit, around the plant in a scenario.

        scenario : a name in the design file; a dictionary with the keys of [[scenario]]; or None, the first one of the
            design file. Without any that is a step of a reference or load that lqgen chooses.
        seed : of the noises; the same seed gives the same bits.

        The arrays of a `Run` have a row for each sample: t in s, x, estimate, sigma, y, outputs, u, r in their units.
        """
        from .simulation import simulate

        return simulate(self, scenario, seed)

    def monte_carlo(
        self,
        runs: int = 10000,
        seed: int = 1,
        scenario: Union[str, Words, None] = None,
        executor: Any = None,
        progress: Optional[bool] = None,
    ) -> "MonteCarlo":
        """Many runs of a scenario over its noises and its `spread`: percentiles of every number, the share that failed,
        NEES and NIS against their bounds.

        executor : what has `submit(function, *arguments)` whose result has `result()`: concurrent.futures, loky
            (joblib), a Client of Dask. Each task is a range of run numbers, so that the result is the same with every
            executor and without one, where lqgen uses all cores of this machine.
        progress : a bar of tqdm, if that is installed. None: on a terminal.
        """
        from .monte_carlo import monte_carlo

        return monte_carlo(self, runs, seed, scenario, executor, progress)

    def sweep(
        self,
        values: Optional[Mapping[str, Iterable]] = None,
        executor: Any = None,
        progress: Optional[bool] = None,
        **more: Iterable,
    ) -> "Sweep":
        """The design for each combination of values: design.sweep(rho=[0.1, 1, 10], **{"lqr.Q[1]": [1, 2]}).

        Keys are those of `replace`, values anything to go through. `executor` and `progress` are those of
        `monte_carlo`. A combination that cannot be designed has an `error` in place of a `result`.
        """
        from .sweep import sweep

        return sweep(self, {**(values or {}), **more}, executor, progress)

    def controller(self, compiled: Optional[bool] = None) -> "Controller":
        """The emitted controller, to be run sample by sample: `u = controller.step(y)`.

        compiled : True: the emitted header, compiled by this machine's C compiler (CC, else cc). False: `lqgen run`,
            which needs none; the numbers are the same. None: compiled where there is a compiler.
        """
        from .controller import controller

        return controller(self, compiled)

    def plot(self, kind: str = "response", **options: Any):
        """A Figure of Matplotlib: "response" (with scenario=…, seed=…), "bode", "nyquist" or "poles".

        bode and nyquist are of the loop opened at the plant's inputs, with several inputs one at a time; frequencies
        are in rad/s. Raises ImportError where Matplotlib is missing."""
        from .plots import plot

        return plot(self, kind, **options)

    def to_control(self, part: str = "plant", references: bool = False):
        """A discrete StateSpace of python-control; `part` and `references` as in `Result.state_space`."""
        return self.solve().to_control(part, references)

    def to_scipy(self, part: str = "plant", references: bool = False):
        """A discrete StateSpace of scipy.signal; `part` and `references` as in `Result.state_space`."""
        return self.solve().to_scipy(part, references)
