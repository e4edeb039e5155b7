# SPDX-License-Identifier: MIT
"""python3 test_server.py LQGEN DESIGNS: the server of `lqgen watch` answers this page at this machine, and nobody else.

It follows the file, designs with other numbers, and puts them into the file byte for byte.
"""

import json
import os
import pathlib
import shutil
import signal
import socket
import stat
import subprocess
import sys
import threading
import time
import unittest

from watched import Watched

LQGEN, DESIGNS = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
SERVO = DESIGNS / "servo.toml"
MOST_SECONDS = 3.0  # for what takes a quarter of a second; of a machine that does many other things


def listening(port):
    """The addresses at which the port is open, as the kernel writes them."""
    found = []
    for table in ("/proc/net/tcp", "/proc/net/tcp6"):
        if not os.path.exists(table):
            continue
        for line in pathlib.Path(table).read_text().splitlines()[1:]:
            fields = line.split()
            address, hexadecimal = fields[1].rsplit(":", 1)
            if int(hexadecimal, 16) == port and fields[3] == "0A":
                found.append(address)
    return found


class Refusals(unittest.TestCase):
    """One server for all questions that it has to refuse."""

    @classmethod
    def setUpClass(cls):
        cls.watched = Watched(LQGEN, SERVO)
        cls.watched.state()

    @classmethod
    def tearDownClass(cls):
        cls.watched.__exit__()

    def status(self, *arguments, **named):
        return self.watched.ask(*arguments, **named)[0]

    def test_the_page_has_the_headers_of_a_page_for_one_person(self):
        status, headers, body = self.watched.ask()
        self.assertEqual(status, 200)
        self.assertIn("lqg-panel", body)
        policy = headers["Content-Security-Policy"]
        self.assertIn("default-src 'none'", policy)
        self.assertIn("frame-ancestors 'none'", policy)
        self.assertNotIn("unsafe-inline", policy.split("script-src")[1].split(";")[0])
        self.assertEqual(headers["X-Frame-Options"], "DENY")
        self.assertEqual(headers["X-Content-Type-Options"], "nosniff")
        self.assertEqual(headers["Cache-Control"], "no-store")
        self.assertEqual(headers["Referrer-Policy"], "no-referrer")
        self.assertIsNone(headers["Access-Control-Allow-Origin"])

    def test_the_page_names_no_network(self):
        body = self.watched.ask()[2]
        for word in ("http://", "https://", 'src="', "@import"):
            self.assertNotIn(word, body)

    def test_a_wrong_token_is_refused(self):
        for token in ("", "x", self.watched.token[:-1], self.watched.token + "0", "0" * 32, self.watched.token.upper()):
            if token != self.watched.token:
                self.assertEqual(self.status("/", token=token), 403, token)
                self.assertEqual(self.status("/state", token=token), 403, token)
        body = json.dumps({"revision": 1, "changes": []})
        self.assertEqual(self.status("/write", "POST", body, token="0" * 32), 403)

    def test_dns_rebinding_is_refused(self):
        port = self.watched.port
        for host in (f"rebound.example:{port}", "127.0.0.1", f"127.0.0.1:{port + 1}", f"[::1]:{port}", "", None):
            self.assertEqual(self.status(headers={"Host": host}), 403, host)
        self.assertEqual(self.status(headers={"Host": f"localhost:{port}"}), 200)

    def test_other_origins_are_refused(self):
        own = f"http://127.0.0.1:{self.watched.port}"
        for origin in ("http://evil.example", "null", own + "0", "https://127.0.0.1:1", f"{own}/"):
            self.assertEqual(self.status(headers={"Origin": origin}), 403, origin)
        self.assertEqual(self.status(headers={"Origin": own}), 200)
        self.assertEqual(self.status(headers={"Sec-Fetch-Site": "cross-site"}), 403)

    def test_a_form_of_another_page_is_refused(self):
        for kind in ("text/plain", "application/x-www-form-urlencoded", None):
            self.assertEqual(self.status("/write", "POST", "{}", headers={"Content-Type": kind}), 415, kind)

    def test_other_methods_are_refused(self):
        for method in ("PUT", "DELETE", "OPTIONS", "HEAD", "PATCH"):
            self.assertEqual(self.status(method=method), 405, method)

    def test_a_large_body_is_refused_before_it_is_read(self):
        self.assertEqual(self.status("/solve", "POST", "x" * (1 << 20)), 413)
        announced = {"Content-Length": str(1 << 40)}
        self.assertEqual(self.status("/solve", "POST", "x", headers=announced), 413)
        self.assertEqual(self.status(headers={"X": "y" * (1 << 16)}), 431)

    def test_what_is_not_http_is_refused(self):
        with socket.create_connection(("127.0.0.1", self.watched.port), timeout=60) as raw:
            raw.sendall(b"\x16\x03\x01 hello\r\n\r\n")
            self.assertTrue(raw.recv(100).startswith(b"HTTP/1.1 400"))
        self.assertEqual(self.status(), 200)

    def test_questions_that_nobody_asks_are_refused(self):
        revision = self.watched.state()["revision"]
        for body in ("", "[]", "{", '{"revision": 1}', '{"revision": "1", "changes": []}', "null", "{" * 1000):
            self.assertEqual(self.status("/solve", "POST", body), 400, body)
        for change in ({"key": "lqr.nothing"}, {"key": 1, "value": 1}, {"key": "plant.A[0][1]", "value": "1"}):
            body = json.dumps({"revision": revision, "changes": [change]})
            self.assertEqual(self.status("/solve", "POST", body), 400, change)
        self.assertEqual(self.watched.post("/solve", revision, {"lqr.R[7]": 1})[0], 400)
        for path in ("/other", "/../state", "/solve"):
            self.assertEqual(self.status(path), 404, path)
        self.assertEqual(self.status("/state", "POST", "{}"), 404)

    def test_many_silent_connections_do_not_keep_it_from_answering(self):
        silent = [socket.create_connection(("127.0.0.1", self.watched.port), timeout=60) for _ in range(40)]
        self.assertEqual(self.status(), 200)
        for connection in silent:
            connection.close()

    def test_only_the_loopback_interface_is_open(self):
        if not os.path.exists("/proc/net/tcp"):
            self.skipTest("no /proc/net/tcp")
        self.assertEqual(listening(self.watched.port), ["0100007F"])


class Following(unittest.TestCase):
    def test_a_saved_file_is_seen_within_a_quarter_of_a_second(self):
        with Watched(LQGEN, SERVO) as watched:
            text = watched.path.read_text(encoding="utf-8")
            state = watched.state()
            times = []
            for i in range(6):
                changed = text.replace("[0.05, 30]", f"[0.0{i + 1}, 30]")
                began = time.monotonic()
                threading.Timer(0.05, watched.save if i % 2 else watched.path.write_text, [changed]).start()
                new = watched.state(state["revision"])
                times.append(time.monotonic() - began - 0.05)
                self.assertGreater(new["revision"], state["revision"])
                self.assertIsNotNone(new["page"])
                values = {slider["targets"][0]["key"]: slider["value"] for slider in new["tunables"]}
                self.assertEqual(values["lqr.bryson.states[0]"], (i + 1) / 100)
                state = new
            print(f"saved to drawn anew: {sorted(times)[3] * 1000:.0f} ms (median), {max(times) * 1000:.0f} ms (most)")
            self.assertLess(min(times), MOST_SECONDS)

    def test_an_error_stands_over_the_last_good_picture_with_its_line(self):
        with Watched(LQGEN, SERVO) as watched:
            good = watched.state()
            text = watched.path.read_text(encoding="utf-8")
            for broken in (text.replace("[[1, 0]]", "[[1, 0, 0]]"), text.replace("[lqr]", "[lqr"), "\x00"):
                watched.save(broken)
                bad = watched.state(good["revision"])
                self.assertTrue(bad["has_error"])
                self.assertEqual(bad["page"], good["page"])
                said = subprocess.run(
                    [LQGEN, "check", watched.path.name], cwd=watched.folder, capture_output=True, check=False
                )
                self.assertEqual(bad["lines"], said.stderr.decode().splitlines())
                self.assertIn(f":{bad['line']}:", bad["lines"][0])
                watched.save(text)
                good = watched.state(bad["revision"])
                self.assertFalse(good["has_error"])

    def test_a_design_that_misses_what_is_required_is_shown_with_its_sliders(self):
        with Watched(LQGEN, SERVO) as watched:
            text = watched.path.read_text(encoding="utf-8")
            revision = watched.state()["revision"]
            watched.save(text.replace("phase_margin_deg = 30", "phase_margin_deg = 89"))
            bad = watched.state(revision)
            self.assertTrue(bad["has_error"])
            self.assertIn("require.phase_margin_deg", bad["lines"][-1])
            self.assertGreater(bad["line"], 40)
            self.assertTrue(bad["tunables"])
            self.assertTrue(bad["has_page"])
            self.assertIn("is not met", bad["page"]["body"])
            watched.save(text.replace("[[0], [2121.79407756]]", "[[0], [0]]"))
            impossible = watched.state(bad["revision"])
            self.assertTrue(impossible["has_error"])
            self.assertFalse(impossible["has_page"])
            self.assertEqual(impossible["page"], bad["page"])

    def test_a_file_that_goes_and_comes_back(self):
        with Watched(LQGEN, SERVO) as watched:
            state = watched.state()
            text = watched.path.read_text(encoding="utf-8")
            watched.path.unlink()
            gone = watched.state(state["revision"])
            self.assertTrue(gone["has_error"])
            self.assertIn("not there", gone["lines"][0])
            self.assertEqual(watched.post("/write", gone["revision"], {"lqr.bryson.states[0]": 1})[0], 500)
            watched.path.write_text(text, encoding="utf-8")
            self.assertFalse(watched.state(gone["revision"])["has_error"])

    def test_a_file_with_an_error_from_the_beginning_is_served(self):
        with Watched(LQGEN, SERVO) as watched:
            text = watched.path.read_text(encoding="utf-8")
        folder = watched.folder
        folder.mkdir()
        (folder / "bad.toml").write_text(text.replace("[plant]", "[plont]"), encoding="utf-8")
        with Watched(LQGEN, folder / "bad.toml") as bad:
            state = bad.state()
            self.assertTrue(state["has_error"])
            self.assertIsNone(state["page"])
            self.assertEqual(bad.ask()[0], 200)
        (folder / "bad.toml").unlink()
        folder.rmdir()


class Others(unittest.TestCase):
    def other(self, watched, name):
        """The answer to /other; asked again, as the page does, where the file's own state came first."""
        while True:
            status, _, body = watched.ask("/other", "POST", json.dumps({"name": name}))
            answer = json.loads(body)
            self.assertEqual(status, 200)
            if "superseded" not in answer:
                return answer

    def test_another_file_of_the_folder_is_drawn_as_if_it_were_watched(self):
        with Watched(LQGEN, SERVO) as watched:
            text = watched.path.read_text(encoding="utf-8").replace("[0.05, 30]", "[0.02, 30]")
            (watched.folder / "stiff.toml").write_text(text, encoding="utf-8")
            (watched.folder / "notes.txt").write_text("no design", encoding="utf-8")
            (watched.folder / "folder.toml").mkdir()
            watched.save(watched.path.read_text(encoding="utf-8") + "\n")
            state = watched.state(1)
            self.assertEqual(state["others"], ["stiff.toml"])
            answer = self.other(watched, "stiff.toml")
            with Watched(LQGEN, watched.folder / "stiff.toml") as alone:
                self.assertEqual(answer["page"], alone.state()["page"])

    def test_only_the_files_of_the_list_are_read(self):
        with Watched(LQGEN, SERVO) as watched:
            outside = watched.folder.parent / f"{watched.folder.name}.toml"
            shutil.copy(SERVO, outside)
            try:
                for name in (f"../{outside.name}", str(outside), "servo.toml", "./servo.toml", "", ".", "nothing.toml"):
                    body = json.dumps({"name": name})
                    self.assertEqual(watched.ask("/other", "POST", body)[0], 400, name)
                for body in ("", "[]", '{"name": 1}', '{"other": "servo.toml"}'):
                    self.assertEqual(watched.ask("/other", "POST", body)[0], 400, body)
            finally:
                outside.unlink()

    def test_another_file_with_an_error_says_so(self):
        with Watched(LQGEN, SERVO) as watched:
            text = watched.path.read_text(encoding="utf-8").replace("[[1, 0]]", "[[1, 0, 0]]")
            (watched.folder / "broken.toml").write_text(text, encoding="utf-8")
            answer = self.other(watched, "broken.toml")
            self.assertEqual((answer["has_error"], answer["page"]), (True, None))
            self.assertIn("broken.toml:", answer["lines"][0])


class Trials(unittest.TestCase):
    def test_a_trial_is_the_design_of_a_file_with_these_numbers(self):
        with Watched(LQGEN, SERVO) as watched:
            state = watched.state()
            status, trial = watched.post("/solve", state["revision"], {"lqr.bryson.states[0]": 0.02})
            self.assertEqual(status, 200)
            self.assertNotEqual(trial["page"], state["page"])
            watched.save(watched.path.read_text(encoding="utf-8").replace("[0.05, 30]", "[0.02, 30]"))
            saved = watched.state(state["revision"])
            self.assertEqual(trial["page"], saved["page"])
            self.assertEqual(trial["lines"], saved["lines"])

    def test_a_trial_without_scenarios_moves_at_the_times_of_the_file(self):
        with Watched(LQGEN, DESIGNS / "double_integrator.toml") as watched:
            state = watched.state()
            key = next(t["targets"][0]["key"] for t in state["tunables"] if t["targets"][0]["key"].startswith("lqr."))
            status, trial = watched.post("/solve", state["revision"], {key: 1e-6})
            self.assertEqual(status, 200)
            runs = [
                {chart["id"]: chart["curves"][0]["x"] for chart in page["charts"] if chart["id"].startswith("run-load")}
                for page in (state["page"], trial["page"])
            ]
            self.assertTrue(runs[0])
            self.assertEqual(runs[0], runs[1])
            self.assertNotEqual(trial["page"], state["page"])

    def test_a_first_look_has_the_same_curves_in_six_digits(self):
        with Watched(LQGEN, SERVO) as watched:
            revision = watched.state()["revision"]
            change = {"lqr.bryson.states[0]": 0.02, "kalman.process_noise[0]": 1e-5}
            look, whole = (watched.post(path, revision, change)[1]["page"] for path in ("/look", "/solve"))
            charts = {chart["id"]: chart for chart in whole["charts"]}
            self.assertEqual([chart["id"] for chart in look["charts"]], list(charts))
            for chart in look["charts"]:
                other = charts[chart["id"]]
                self.assertEqual([curve["y"] for curve in chart["curves"]], [curve["y"] for curve in other["curves"]])

    def test_numbers_that_make_no_design_say_why(self):
        with Watched(LQGEN, SERVO) as watched:
            revision = watched.state()["revision"]
            status, trial = watched.post("/solve", revision, {"kalman.measurement_noise[0]": -1})
            self.assertEqual(status, 200)
            self.assertTrue(trial["has_error"])
            self.assertIsNone(trial["page"])
            self.assertIn("kalman.measurement_noise", trial["lines"][0])

    def test_only_the_newest_of_many_trials_is_computed(self):
        with Watched(LQGEN, DESIGNS / "quadrotor.toml") as watched:
            revision = watched.state()["revision"]
            answers = [None] * 12

            def ask(i):
                answers[i] = watched.post("/solve", revision, {"lqr.Q[0]": 20.0 + i})[1]

            threads = [threading.Thread(target=ask, args=[i]) for i in range(len(answers))]
            for thread in threads:
                thread.start()
                time.sleep(0.01)
            for thread in threads:
                thread.join()
            dropped = [answer.get("superseded", False) for answer in answers]
            self.assertGreater(sum(dropped), 6)
            self.assertFalse(dropped[-1])
            self.assertIsNotNone(answers[-1]["page"])

    def test_answers_have_a_page_and_their_times_are_told(self):
        for name, key in (("servo", "lqr.bryson.states[0]"), ("quadrotor", "lqr.Q[0]")):
            with Watched(LQGEN, DESIGNS / f"{name}.toml") as watched:
                state = watched.state()
                value = next(t["value"] for t in state["tunables"] if t["targets"][0]["key"] == key)
                for path in ("/look", "/solve"):
                    times = []
                    for i in range(5):
                        began = time.monotonic()
                        _, answer = watched.post(path, state["revision"], {key: value * (1.1 + 0.1 * i)})
                        times.append(time.monotonic() - began)
                        self.assertIsNotNone(answer["page"])
                        self.assertNotEqual(answer["page"], state["page"])
                    print(f"{name} {path}: {sorted(times)[2] * 1000:.0f} ms (median of 5)")


class Writing(unittest.TestCase):
    def test_numbers_are_written_and_every_other_byte_stays(self):
        with Watched(LQGEN, SERVO) as watched:
            before = watched.path.read_bytes()
            watched.path.chmod(0o640)
            revision = watched.state()["revision"]
            change = {
                "lqr.bryson.states[0]": 0.02,
                "kalman.process_noise[0]": 2.5e-6,
                "kalman.disturbance.voltage": 0.25,
                "limits.u_max[0]": 10.5,
            }
            status, answer = watched.post("/write", revision, change)
            self.assertEqual((status, answer), (200, {"written": True}))
            expected = before.replace(b"[0.05, 30]", b"[0.02, 30]").replace(b"= [1e-6]  ", b"= [2.5e-6]  ")
            expected = expected.replace(b"voltage = 0.073", b"voltage = 0.25").replace(
                b"u_max = [12]", b"u_max = [10.5]"
            )
            self.assertEqual(watched.path.read_bytes(), expected)
            self.assertEqual(stat.S_IMODE(watched.path.stat().st_mode), 0o640)
            self.assertEqual([path.name for path in watched.folder.iterdir()], [watched.path.name])
            self.assertFalse(watched.state(revision)["has_error"])

    def test_a_file_that_changed_meanwhile_is_not_written(self):
        with Watched(LQGEN, SERVO) as watched:
            revision = watched.state()["revision"]
            os.kill(watched.process.pid, signal.SIGSTOP)  # so that it cannot see the change before it is asked
            other = watched.path.read_bytes() + b"# mine\n"
            watched.path.write_bytes(other)
            answers = []
            thread = threading.Thread(
                target=lambda: answers.append(watched.post("/write", revision, {"lqr.bryson.states[0]": 0.02}))
            )
            thread.start()
            time.sleep(0.2)
            os.kill(watched.process.pid, signal.SIGCONT)
            thread.join()
            self.assertEqual(answers[0][0], 409)
            self.assertIn("changed", answers[0][1]["error"])
            self.assertEqual(watched.path.read_bytes(), other)

    def test_numbers_of_an_old_state_are_not_written(self):
        with Watched(LQGEN, SERVO) as watched:
            revision = watched.state()["revision"]
            watched.save(watched.path.read_text(encoding="utf-8") + "# mine\n")
            watched.state(revision)
            before = watched.path.read_bytes()
            self.assertEqual(watched.post("/write", revision, {"lqr.bryson.states[0]": 0.02})[0], 409)
            self.assertEqual(watched.path.read_bytes(), before)


class Ending(unittest.TestCase):
    def test_signals_of_a_terminal_end_it_with_success(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with Watched(LQGEN, SERVO) as watched:
                watched.state()
                status, seconds = watched.end(number)
                self.assertEqual(status, 0, number)
                self.assertLess(seconds, MOST_SECONDS)
                with self.assertRaises(ConnectionRefusedError):
                    socket.create_connection(("127.0.0.1", watched.port), timeout=5)
                self.assertEqual(watched.process.stderr.read(), "")

    def test_it_ends_while_a_page_waits_and_while_it_computes(self):
        with Watched(LQGEN, DESIGNS / "quadrotor.toml") as watched:
            revision = watched.state()["revision"]
            waiting = [
                threading.Thread(target=self.ignore_end, args=[watched.state, revision]),
                threading.Thread(target=self.ignore_end, args=[watched.post, "/solve", revision, {"lqr.Q[0]": 20}]),
            ]
            for thread in waiting:
                thread.start()
            time.sleep(0.1)
            status, seconds = watched.end()
            self.assertEqual(status, 0)
            self.assertLess(seconds, MOST_SECONDS)
            for thread in waiting:
                thread.join()

    @staticmethod
    def ignore_end(ask, *arguments):
        try:
            ask(*arguments)
        except (OSError, ValueError, AssertionError):
            pass
        except Exception as error:  # http.client has exceptions of its own for a connection that ends
            if not type(error).__module__.startswith("http"):
                raise

    def test_two_have_addresses_of_their_own(self):
        with Watched(LQGEN, SERVO) as one, Watched(LQGEN, SERVO) as other:
            self.assertNotEqual(one.token, other.token)
            self.assertNotEqual(one.port, other.port)
            self.assertEqual(one.ask(token=other.token)[0], 403)

    def test_a_port_can_be_chosen_and_one_that_is_taken_is_an_error(self):
        with Watched(LQGEN, SERVO) as watched:
            done = subprocess.run(
                [LQGEN, "watch", SERVO, "--port", str(watched.port)],
                capture_output=True,
                text=True,
                timeout=60,
                check=False,
            )
            self.assertEqual(done.returncode, 3)
            self.assertIn(f"127.0.0.1:{watched.port}: ", done.stderr)
            port = watched.port
        with Watched(LQGEN, SERVO, "--port", str(port)) as watched:
            self.assertEqual(watched.port, port)

    def test_what_cannot_be_followed_is_an_error(self):
        for arguments, status in (([], 2), (["-"], 2), (["nothing.toml"], 3), (["x.toml", "--port", "0"], 2)):
            done = subprocess.run([LQGEN, "watch", *arguments], capture_output=True, text=True, timeout=60, check=False)
            self.assertEqual(done.returncode, status, arguments)
            self.assertTrue(done.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
