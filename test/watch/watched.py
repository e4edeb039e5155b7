# SPDX-License-Identifier: MIT
"""`lqgen watch` as a process, and questions to it by the standard library's HTTP client."""

import http.client
import json
import pathlib
import select
import shutil
import signal
import subprocess
import tempfile
import time
import urllib.parse


class Watched:
    """A copy of a design file in a folder of its own, with lqgen watching it."""

    def __init__(self, lqgen, design, *options):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="lqgen-watch-"))
        self.path = self.folder / design.name
        shutil.copy(design, self.path)
        self.process = subprocess.Popen(
            [lqgen, "watch", self.path.name, *options],
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        if not select.select([self.process.stdout], [], [], 60)[0]:
            raise AssertionError("no address within a minute")
        line = self.process.stdout.readline()
        if not line:
            raise AssertionError(f"no address, but: {self.process.communicate()[1]}")
        name, self.address = line.rstrip("\n").split(": ", 1)
        assert name == self.path.name
        parts = urllib.parse.urlsplit(self.address)
        assert parts.scheme == "http" and parts.hostname == "127.0.0.1"
        self.port = parts.port
        self.token = parts.path.strip("/")

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        if self.process.poll() is None:
            self.end()
        self.process.stdout.close()
        self.process.stderr.close()
        shutil.rmtree(self.folder)

    def end(self, number=signal.SIGTERM):
        """Exit status, and the seconds that the end took."""
        began = time.monotonic()
        self.process.send_signal(number)
        return self.process.wait(timeout=60), time.monotonic() - began

    def ask(self, path="/", method="GET", body=None, token=None, headers=None, timeout=60):
        """Status, headers and body of an answer. `headers` replaces the usual ones, None leaves one out."""
        used = {"Host": f"127.0.0.1:{self.port}"}
        if body is not None:
            used["Content-Type"] = "application/json"
            used["Content-Length"] = str(len(body))
        used.update(headers or {})
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout)
        connection.putrequest(
            method, f"/{self.token if token is None else token}{path}", skip_host=True, skip_accept_encoding=True
        )
        for name, value in used.items():
            if value is not None:
                connection.putheader(name, value)
        connection.endheaders(None if body is None else body.encode())
        answer = connection.getresponse()
        content = answer.read().decode()
        connection.close()
        return answer.status, answer.headers, content

    def state(self, since=0):
        status, _, body = self.ask(f"/state?since={since}")
        assert status == 200, (status, body)
        return json.loads(body)

    def post(self, path, revision, changes):
        changes = [{"key": key, "value": value} for key, value in changes.items()]
        status, _, body = self.ask(path, "POST", json.dumps({"revision": revision, "changes": changes}))
        return status, json.loads(body)

    def save(self, text):
        """As editors do: a new file that takes the old one's place."""
        fresh = self.folder / "saved"
        fresh.write_text(text, encoding="utf-8")
        fresh.replace(self.path)
