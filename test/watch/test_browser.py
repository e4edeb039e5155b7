# SPDX-License-Identifier: MIT
"""python3 test_browser.py LQGEN DESIGNS CHROMIUM PICTURES: the live page in a real browser.

Sliders move curves, numbers are written into the file, errors stand over the last good picture, the end of lqgen is
said; on a wide screen and on a phone. Pictures for people are put into the folder PICTURES.
"""

import pathlib
import sys
import unittest

try:
    from playwright.sync_api import expect, sync_playwright
except ImportError:
    print("Not found: playwright for Python (pip install playwright)")
    sys.exit(0)

from watched import Watched

LQGEN, DESIGNS, CHROMIUM, PICTURES = sys.argv[1], *map(pathlib.Path, sys.argv[2:5])
SERVO = DESIGNS / "servo.toml"
ANGLE = "lqr.bryson.states[0]"
PATIENCE = 30000  # ms

# The first curve of data, and the grey ones behind it, of the first chart that is shown.
FIRST_CHART = """() => {
  const chart = lqgPage.chart(lqgPage.charts()[0]).spec;
  const of = (role) => chart.curves.filter((curve) => curve.role === role).map((curve) => [...curve.y]);
  return { data: of("data"), ghost: of("ghost") };
}"""


class LivePage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.playwright = sync_playwright().start()
        cls.browser = cls.playwright.chromium.launch(executable_path=str(CHROMIUM), args=["--no-sandbox"])
        PICTURES.mkdir(parents=True, exist_ok=True)

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.playwright.stop()

    def setUp(self):
        self.problems = []
        self.allowed = []  # problems that the test makes itself

    def tearDown(self):
        unexpected = [text for text in self.problems if not any(word in text for word in self.allowed)]
        self.assertEqual(unexpected, [])

    def open(self, watched, width=1280, height=900, dark=False):
        page = self.browser.new_page(
            viewport={"width": width, "height": height}, color_scheme="dark" if dark else "light"
        )
        page.on("console", lambda message: message.type == "error" and self.problems.append(message.text))
        page.on("pageerror", lambda error: self.problems.append(str(error)))
        page.on("request", lambda request: self.check_request(request.url, watched))
        page.goto(watched.address)
        self.expect_status(page, "The design of the file")
        return page

    def check_request(self, url, watched):
        if not url.startswith(watched.address):
            self.problems.append(f"asks for {url}")

    def expect_status(self, page, words):
        expect(page.locator("#lqg-status")).to_contain_text(words, timeout=PATIENCE)

    def picture(self, page, name):
        page.screenshot(path=PICTURES / f"{name}.png")

    def test_a_slider_moves_the_curves_over_grey_ones(self):
        with Watched(LQGEN, SERVO) as watched:
            page = self.open(watched)
            before = page.evaluate(FIRST_CHART)
            self.assertEqual(before["ghost"], [])
            slider = page.locator(f'[data-key="{ANGLE}"]')
            slider.focus()
            for _ in range(20):
                page.keyboard.press("ArrowLeft")
            self.expect_status(page, "The design with these numbers")
            after = page.evaluate(FIRST_CHART)
            self.assertEqual(after["ghost"], before["data"])
            self.assertNotEqual(after["data"], before["data"])
            value = float(page.locator(f'.slider:has([data-key="{ANGLE}"]) .number').input_value())
            self.assertLess(value, 0.05)
            times = page.evaluate("lqgPanel.draggedIn()")
            print(f"slider to drawn page, servo: {sorted(times)[len(times) // 2]:.0f} ms (median of {len(times)})")
            self.picture(page, "watch-slider")
            page.locator("#lqg-back").click()
            self.expect_status(page, "The design of the file")
            self.assertEqual(page.evaluate(FIRST_CHART), before)
            page.close()

    def test_a_first_look_says_that_it_is_one(self):
        with Watched(LQGEN, DESIGNS / "quadrotor.toml") as watched:
            page = self.open(watched)
            page.evaluate("""() => {
              window.said = [];
              const status = document.getElementById("lqg-status");
              new MutationObserver(() => said.push(status.textContent)).observe(status, { childList: true });
            }""")
            slider = page.locator('[data-key="lqr.Q[0]"]')
            slider.focus()
            for _ in range(10):
                page.keyboard.press("ArrowRight")
            self.expect_status(page, "The design with these numbers")
            said = page.evaluate("said")
            self.assertTrue(any(text.startswith("First look") for text in said), said)
            times = page.evaluate("lqgPanel.draggedIn()")
            print(f"slider to drawn page, quadrotor: {sorted(times)[len(times) // 2]:.0f} ms (median of {len(times)})")
            self.picture(page, "watch-quadrotor")
            page.close()

    def test_a_typed_number_is_written_and_nothing_else(self):
        with Watched(LQGEN, SERVO) as watched:
            page = self.open(watched)
            before = watched.path.read_bytes()
            self.assertTrue(page.locator("#lqg-write").is_disabled())
            number = page.locator(f'.slider:has([data-key="{ANGLE}"]) .number')
            number.fill("nonsense")
            number.press("Enter")
            self.assertEqual(number.get_attribute("aria-invalid"), "true")
            number.fill("0.025")
            number.press("Enter")
            self.expect_status(page, "The design with these numbers")
            page.locator("#lqg-write").click()
            self.expect_status(page, "The design of the file")
            self.assertEqual(watched.path.read_bytes(), before.replace(b"[0.05, 30]", b"[0.025, 30]"))
            self.assertEqual(page.evaluate(FIRST_CHART)["ghost"], [])
            self.assertEqual(number.input_value(), "0.025")
            self.assertTrue(page.locator("#lqg-write").is_disabled())
            page.close()

    def test_another_file_lends_the_grey_curves(self):
        with Watched(LQGEN, SERVO) as watched:
            text = watched.path.read_text(encoding="utf-8")
            (watched.folder / "stiff.toml").write_text(text.replace("[0.05, 30]", "[0.02, 30]"), encoding="utf-8")
            (watched.folder / "broken.toml").write_text(text.replace("[[1, 0]]", "[[1]]"), encoding="utf-8")
            page = self.open(watched)
            before = page.evaluate(FIRST_CHART)
            choice = page.locator("#lqg-other")
            choice.select_option("stiff.toml")
            self.expect_status(page, "grey: stiff.toml")
            compared = page.evaluate(FIRST_CHART)
            self.assertEqual(compared["data"], before["data"])
            self.assertEqual(len(compared["ghost"]), len(before["data"]))
            self.assertNotEqual(compared["ghost"], before["data"])
            number = page.locator(f'.slider:has([data-key="{ANGLE}"]) .number')
            number.fill("0.02")
            number.press("Enter")
            self.expect_status(page, "The design with these numbers")
            tried = page.evaluate(FIRST_CHART)
            self.assertEqual(tried["ghost"], compared["ghost"])
            self.assertEqual(tried["data"], compared["ghost"])
            self.picture(page, "watch-other")
            choice.select_option("broken.toml")
            self.expect_status(page, "broken.toml makes no design")
            self.assertEqual(choice.input_value(), "stiff.toml")
            choice.select_option("")
            page.locator("#lqg-back").click()
            self.expect_status(page, "The design of the file")
            self.assertEqual(page.evaluate(FIRST_CHART), before)
            page.close()

    def test_an_error_stands_over_the_last_good_picture(self):
        with Watched(LQGEN, SERVO) as watched:
            page = self.open(watched)
            number = page.locator(f'.slider:has([data-key="{ANGLE}"]) .number')
            number.fill("0.025")
            number.press("Enter")
            self.expect_status(page, "The design with these numbers")
            good = page.evaluate(FIRST_CHART)["ghost"]
            text = watched.path.read_text(encoding="utf-8")
            watched.save(text.replace("[[1, 0]]", "[[1, 0, 0]]"))
            self.expect_status(page, "The file has an error at line")
            errors = page.locator("#lqg-errors")
            self.assertIn("servo.toml:", errors.text_content())
            self.assertIn("plant.C", errors.text_content())
            self.assertEqual(page.evaluate(FIRST_CHART)["data"], good)
            self.picture(page, "watch-error")
            watched.save(text)
            self.expect_status(page, "The design with these numbers")
            self.assertEqual(number.input_value(), "0.025")
            self.assertTrue(errors.is_hidden())
            page.close()

    def test_numbers_that_make_no_design_say_why(self):
        with Watched(LQGEN, SERVO) as watched:
            page = self.open(watched)
            good = page.evaluate(FIRST_CHART)
            number = page.locator('.slider:has([data-key="kalman.measurement_noise[0]"]) .number')
            number.fill("-1")
            number.press("Enter")
            self.expect_status(page, "These numbers make no design")
            self.assertIn("kalman.measurement_noise", page.locator("#lqg-errors").text_content())
            self.assertEqual(page.evaluate(FIRST_CHART), good)
            page.close()

    def test_moved_sliders_stay_when_the_file_is_saved(self):
        with Watched(LQGEN, SERVO) as watched:
            page = self.open(watched)
            number = page.locator(f'.slider:has([data-key="{ANGLE}"]) .number')
            number.fill("0.025")
            number.press("Enter")
            self.expect_status(page, "The design with these numbers")
            watched.save(watched.path.read_text(encoding="utf-8").replace("voltage = 0.073", "voltage = 0.125"))
            walk = page.locator('.slider:has([data-key="kalman.disturbance.voltage"]) .number')
            expect(walk).to_have_value("0.125", timeout=PATIENCE)
            self.assertEqual(number.input_value(), "0.025")
            self.expect_status(page, "The design with these numbers")
            page.close()

    def test_the_end_of_lqgen_is_said(self):
        with Watched(LQGEN, SERVO) as watched:
            self.allowed = ["ERR_", "Failed to load resource"]
            page = self.open(watched)
            watched.end()
            self.expect_status(page, "Connection lost")
            page.close()

    def test_a_phone_shows_the_panel_above_the_page_and_nothing_overflows(self):
        with Watched(LQGEN, SERVO) as watched:
            page = self.open(watched, 390, 844, dark=True)
            self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), 390)
            panel = page.locator("#lqg-panel").bounding_box()
            self.assertLess(panel["y"] + panel["height"], page.locator("#lqg-page").bounding_box()["y"] + 1)
            self.assertLess(panel["height"], 0.5 * 844)
            self.picture(page, "watch-phone")
            page.close()

    def test_the_keyboard_reaches_every_slider_and_button(self):
        with Watched(LQGEN, SERVO) as watched:
            page = self.open(watched)
            number = page.locator(f'.slider:has([data-key="{ANGLE}"]) .number')
            number.fill("0.025")
            number.press("Enter")
            self.expect_status(page, "The design with these numbers")
            controls = page.locator("#lqg-panel input, #lqg-panel button").count()
            page.locator("#lqg-back").focus()
            reached = set()
            for _ in range(controls):
                reached.add(
                    page.evaluate("""() => {
                  const all = [...document.querySelectorAll("#lqg-panel input, #lqg-panel button")];
                  return all.indexOf(document.activeElement);
                }""")
                )
                page.keyboard.press("Tab")
            self.assertEqual(reached, set(range(controls)))
            page.close()


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[5:]], verbosity=2)
