# SPDX-License-Identifier: MIT
"""TinyLQG: LQR, Kalman filter and LQG from a plant and weights to C99, and the way from and to other control tools."""

from importlib.metadata import version

from .design import Design
from .design_file import design_text, write_design
from .errors import DesignError
from .findings import Finding
from .lqgen import generate, include_dir, lqgen_path, source_dir
from .mat import read_mat
from .result import Result, load

__version__ = version("tinylqg")

__all__ = [
    "Design",
    "DesignError",
    "Finding",
    "Result",
    "design_text",
    "generate",
    "include_dir",
    "load",
    "lqgen_path",
    "read_mat",
    "source_dir",
    "write_design",
]
