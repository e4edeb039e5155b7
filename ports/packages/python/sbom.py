# SPDX-License-Identifier: MIT
"""What the wheel has inside: an SBOM (CycloneDX 1.6) and the notice that the LGPL asks for.

    sbom.py <version of TinyLQG> <lqgen> <libraries> <folder>

<libraries> is what lqgen_libraries printed. Writes tinylqg.cdx.json and NOTICE into the folder; same input, same bytes.
"""

import datetime
import hashlib
import os
import sys
import uuid
from pathlib import Path

from cyclonedx.model import HashAlgorithm, HashType
from cyclonedx.model.bom import Bom
from cyclonedx.model.component import Component, ComponentType
from cyclonedx.model.license import LicenseExpression
from cyclonedx.output import make_outputter
from cyclonedx.schema import OutputFormat, SchemaVersion
from packageurl import PackageURL

# By the names that lqgen_libraries prints: how it is called, its licence, how it got into lqgen.
LIBRARIES = {
    "boost": ("Boost", "BSL-1.0", "headers, compiled in"),
    "chart-js": ("Chart.js", "MIT", "a text in lqgen, and in each page that it writes"),
    "cli11": ("CLI11", "BSD-3-Clause", "headers, compiled in"),
    "eigen": ("Eigen", "MPL-2.0", "headers, compiled in"),
    "fast-cpp-csv-parser": ("Fast C++ CSV Parser", "BSD-3-Clause", "headers, compiled in"),
    "gmp": ("GMP", "LGPL-3.0-or-later OR GPL-2.0-or-later", "linked statically"),
    "mbedtls": ("Mbed TLS", "Apache-2.0", "linked statically"),
    "mpfr": ("MPFR", "LGPL-3.0-or-later", "linked statically"),
    "nlohmann-json": ("JSON for Modern C++", "MIT", "headers, compiled in"),
    "tomlplusplus": ("toml++", "MIT", "headers, compiled in"),
}
NOTICE = """TinyLQG {version} is under the MIT licence, which stands in LICENSE.

The program lqgen in this package has these libraries inside:

{lines}

The licence of each stands beside this file in NAME.copyright, the texts that those name in LGPL-3, GPL-3, MPL-2.0 and
Apache-2.0.

lqgen uses the GNU MPFR Library and the GNU MP Library (GMP); both and their use are covered by the GNU Lesser General
Public License. You may change them and link lqgen with what you changed: its source is the source of TinyLQG {version},
and ports/packages/python/make.sh links it with the libmpfr.a and libgmp.a that it finds. You may debug such changes by
reverse engineering. The sources of MPFR are at https://www.mpfr.org, those of GMP at https://gmplib.org, those of Eigen
at https://eigen.tuxfamily.org, each in the version above. What lqgen writes is yours: no licence of these covers it.
"""


def versions(text):
    """By name; exactly the libraries above."""
    found = dict(line.split(" ", 1) for line in text.splitlines())
    if found.keys() != LIBRARIES.keys():
        sys.exit(f"sbom.py: expected the libraries {', '.join(LIBRARIES)}, found {', '.join(sorted(found))}")
    return found


def component_of(name, version):
    title, license, how = LIBRARIES[name]
    return Component(
        name=title,
        version=version,
        type=ComponentType.LIBRARY,
        bom_ref=name,
        description=how,
        licenses=[LicenseExpression(license)],
        purl=PackageURL("generic", name=name, version=version),
    )


def bom_of(version, lqgen, libraries):
    program = Component(
        name="lqgen",
        version=version,
        type=ComponentType.APPLICATION,
        bom_ref="lqgen",
        licenses=[LicenseExpression("MIT")],
        hashes=[HashType(alg=HashAlgorithm.SHA_256, content=hashlib.sha256(lqgen).hexdigest())],
    )
    wheel = Component(
        name="tinylqg",
        version=version,
        type=ComponentType.APPLICATION,
        bom_ref="tinylqg",
        licenses=[LicenseExpression("MIT")],
        purl=PackageURL("pypi", name="tinylqg", version=version),
    )
    parts = [component_of(name, libraries[name]) for name in sorted(libraries)]
    bom = Bom(components=[program, *parts])
    bom.metadata.component = wheel
    bom.register_dependency(wheel, [program])
    bom.register_dependency(program, parts)
    bom.metadata.timestamp = datetime.datetime.fromtimestamp(
        int(os.environ.get("SOURCE_DATE_EPOCH", 0)), datetime.timezone.utc
    )
    content = hashlib.sha256(lqgen + repr(sorted(libraries.items())).encode()).hexdigest()
    bom.serial_number = uuid.uuid5(uuid.NAMESPACE_URL, f"pkg:pypi/tinylqg@{version}#{content}")
    return bom


def main(version, lqgen, libraries, folder):
    found = versions(Path(libraries).read_text(encoding="utf-8"))
    bom = bom_of(version, Path(lqgen).read_bytes(), found)
    text = make_outputter(bom, OutputFormat.JSON, SchemaVersion.V1_6).output_as_string(indent=2) + "\n"
    Path(folder, "tinylqg.cdx.json").write_text(text, encoding="utf-8")
    lines = "\n".join(
        f"  {LIBRARIES[name][0]} {found[name]} ({name}): {LIBRARIES[name][1]}, {LIBRARIES[name][2]}"
        for name in sorted(found)
    )
    Path(folder, "NOTICE").write_text(NOTICE.format(version=version, lines=lines), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
