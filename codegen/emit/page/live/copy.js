// SPDX-License-Identifier: MIT
// Matrices to other programs.

const lists = (rows, [open, close], row) => open + rows.map(row).join(", ") + close;
const ofC = (isDouble) => (text) => (/[.e]/.test(text) ? text : `${text}.0`) + (isDouble ? "" : "f");

const formats = {
  TOML: (name, rows) => `${name} = ${lists(rows, "[]", (row) => `[${row.join(", ")}]`)}\n`,
  MATLAB: (name, rows) => `${name} = [${rows.map((row) => row.join(" ")).join("; ")}];\n`,
  Python: (name, rows) => `${name} = np.array(${lists(rows, "[]", (row) => `[${row.join(", ")}]`)})\n`,
  C: (name, rows, isDouble) =>
    `static const ${isDouble ? "double" : "float"} ${name}[${rows.length}][${rows[0].length}] = ` +
    `${lists(rows, "{}", (row) => `{${row.map(ofC(isDouble)).join(", ")}}`)};\n`,
};

// Pages that were opened as a file may have no clipboard of their own.
function copyText(text) {
  if (navigator.clipboard) return navigator.clipboard.writeText(text);
  const area = document.body.appendChild(element("textarea"));
  area.value = text;
  area.select();
  const isDone = document.execCommand("copy");
  area.remove();
  return isDone ? Promise.resolve() : Promise.reject(new Error("no clipboard"));
}

function textOfMatrix(root, format) {
  const rows = [...root.querySelectorAll("tbody tr")].map((row) =>
    [...row.querySelectorAll("td")].map((cell) => cell.textContent),
  );
  return formats[format](root.dataset.matrix, rows, root.dataset.real === "double");
}

function addCopying(root) {
  const row = element("div", "copy");
  row.append("copy as ");
  for (const format of Object.keys(formats)) {
    const button = row.appendChild(element("button", "plain", format));
    button.addEventListener("click", () => {
      copyText(textOfMatrix(root, format)).then(
        () => say(`${root.dataset.matrix} is copied as ${format}`),
        () => say("The browser does not let this page copy"),
      );
      button.classList.add("done");
      setTimeout(() => button.classList.remove("done"), 1500);
    });
  }
  root.prepend(row);
}
