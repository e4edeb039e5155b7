# SPDX-License-Identifier: MIT
"""The notebook runs from its first cell to its last, with pictures, and is committed without what it prints."""

import unittest

import nbclient
import nbformat

from designs import SOURCE, InFolder

NOTEBOOK = SOURCE / "ports" / "packages" / "python" / "servo.ipynb"


class Notebook(InFolder):
    def test_it_runs(self):
        notebook = nbformat.read(NOTEBOOK, as_version=4)
        nbclient.NotebookClient(notebook, timeout=250, resources={"metadata": {"path": str(self.folder)}}).execute()
        outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
        pictures = [output for output in outputs if "image/png" in output.get("data", {})]
        self.assertEqual(len(pictures), 5)
        said = "".join(output.get("text", "") for output in outputs)
        self.assertIn("as it is:", said)
        self.assertIn("failed: 0.0%", said)
        self.assertFalse([output for output in outputs if output.get("name") == "stderr"])

    def test_no_outputs_are_committed(self):
        for cell in nbformat.read(NOTEBOOK, as_version=4).cells:
            if cell.cell_type == "code":
                self.assertEqual((cell.outputs, cell.execution_count), ([], None))


if __name__ == "__main__":
    unittest.main()
