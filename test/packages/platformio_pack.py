# SPDX-License-Identifier: MIT
"""platformio_pack.py FOLDER ARCHIVE: PlatformIO's own packer, with its check of library.json. It would fetch the list
of licences from the network; here the list has MIT."""

import sys
import tarfile
from pathlib import Path

from platformio.package.manifest import schema
from platformio.package.pack import PackagePacker

schema.ManifestSchema.load_spdx_licenses = staticmethod(lambda: {"licenses": [{"licenseId": "MIT"}]})
Path(sys.argv[2]).parent.mkdir(parents=True, exist_ok=True)
PackagePacker(sys.argv[1]).pack(sys.argv[2])

with tarfile.open(sys.argv[2]) as archive:
    names = set(archive.getnames())
missing = {"library.json", "include/lqg/lqg.h", "src/loop.c", "src/kernel.h", "examples/mass/src/main.c"} - names
sys.exit(f"not in the archive: {sorted(missing)}" if missing else None)
