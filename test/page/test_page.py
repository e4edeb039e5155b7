# SPDX-License-Identifier: MIT
"""test_page.py CHROMIUM PAGES PICTURES: opens the pages PAGES/*.html in a browser and does what people do with them:
looks, points, drags, presses keys, prints. Writes screenshots to PICTURES, for people to look at."""

import functools
import json
import math
import sys
import unittest
from pathlib import Path

from playwright.sync_api import sync_playwright

CHROMIUM, PAGES, PICTURES = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
NAMES = sorted(path.stem for path in PAGES.glob("*.html"))
MOST_BYTES = 1_500_000
SECONDS_TO_DRAW = 5  # it takes 0.3 s; machines that test are slow and busy
BODY_OF_PIXELS = "[document.documentElement.scrollWidth, window.innerWidth]"


def data_of(name):
    text = (PAGES / f"{name}.html").read_text(encoding="utf-8")
    begin = text.index('id="lqg-data">') + len('id="lqg-data">')
    return json.loads(text[begin : text.index("</script>", begin)])


def extremes(lists):
    values = [value for numbers in lists for value in numbers if value is not None]
    return min(values), max(values)


def on_each_page(test):
    """The test of one page, of all of them."""

    @functools.wraps(test)
    def run(self):
        for name in NAMES:
            with self.subTest(page=name):
                test(self, name)

    return run


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.driver = sync_playwright().start()
        cls.browser = cls.driver.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        PICTURES.mkdir(parents=True, exist_ok=True)

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.driver.stop()

    def open(self, name, width=1440, **options):
        """The page, and everything that it must not do."""
        context = self.browser.new_context(viewport={"width": width, "height": 900}, **options)
        self.addCleanup(context.close)
        page = context.new_page()
        page.complaints = []
        page.on("console", lambda message: page.complaints.append(message.text))
        page.on("pageerror", lambda error: page.complaints.append(str(error)))
        address = (PAGES / f"{name}.html").as_uri()
        page.on("request", lambda request: request.url == address or page.complaints.append(request.url))
        page.goto(address)
        return page

    def figure(self, page, chart):
        """Its canvas in the middle of the window, drawn; and the place of its plot there."""
        page.evaluate("id => lqgPage.chart(id)", chart)
        canvas = page.locator(f'[data-chart="{chart}"] canvas')
        canvas.evaluate("element => element.scrollIntoView({block: 'center'})")
        box = canvas.bounding_box()
        area = page.evaluate("id => { const a = lqgPage.chart(id).live.chartArea; return {...a} }", chart)
        return canvas, {
            "left": box["x"] + area["left"],
            "top": box["y"] + area["top"],
            "width": area["right"] - area["left"],
            "height": area["bottom"] - area["top"],
        }

    def window(self, page, chart):
        return page.evaluate(
            "id => { const s = lqgPage.chart(id).live.scales; return [s.x.min, s.x.max, s.y.min, s.y.max] }", chart
        )

    def shown(self, page):
        """The charts that can be seen without another choice."""
        return page.evaluate(
            "lqgPage.charts().filter(id => document.querySelector(`[data-chart='${id}']`).offsetWidth)"
        )

    def chart_over_time(self, page):
        return next(chart for chart in self.shown(page) if chart.startswith("run-"))

    def drag(self, page, place, from_x, to_x, y=0.5):
        at = lambda share: place["left"] + share * place["width"]
        page.mouse.move(at(from_x), place["top"] + y * place["height"])
        page.mouse.down()
        page.mouse.move(at((from_x + to_x) / 2), place["top"] + y * place["height"])
        page.mouse.move(at(to_x), place["top"] + y * place["height"])
        page.mouse.up()

    def test_there_are_pages(self):
        self.assertGreaterEqual(len(NAMES), 4)

    @on_each_page
    def test_nothing_is_complained_of_and_no_request_leaves_the_page(self, name):
        page = self.open(name)
        page.evaluate("lqgPage.drawAll()")
        for choice in page.locator(".choice button").all():
            choice.click()
        page.mouse.wheel(0, 5000)
        page.wait_for_timeout(100)
        self.assertEqual(page.complaints, [])

    def test_the_browser_forbids_what_the_page_does_not_need(self):
        page = self.open(NAMES[0])
        fetched = "fetch('data:text/plain,x').then(() => 'let through', () => 'forbidden')"
        self.assertEqual(page.evaluate(fetched), "forbidden")

    @on_each_page
    def test_a_page_is_small_and_drawn_at_once(self, name):
        self.assertLess((PAGES / f"{name}.html").stat().st_size, MOST_BYTES)
        page = self.open(name)
        took = page.evaluate("lqgPage.drawnIn + lqgPage.drawAll()")
        print(f"{name}: {(PAGES / f'{name}.html').stat().st_size} bytes, drawn in {took:.0f} ms", file=sys.stderr)
        self.assertLess(took, 1000 * SECONDS_TO_DRAW)

    @on_each_page
    def test_nothing_overflows_on_a_phone_or_a_large_screen(self, name):
        for width in (360, 900, 1440):
            page = self.open(name, width)
            page.evaluate("lqgPage.drawAll()")
            whole, visible = page.evaluate(BODY_OF_PIXELS)
            self.assertLessEqual(whole, visible, width)

    @on_each_page
    def test_a_chart_has_all_curves_with_the_extremes_of_the_data(self, name):
        page = self.open(name)
        data = data_of(name)
        self.assertEqual(page.evaluate("lqgPage.charts()"), [chart["id"] for chart in data["charts"]])
        found = page.evaluate(
            """lqgPage.charts().map(id => lqgPage.chart(id).live.data.datasets.map(set => {
                 const y = set.data.map(point => point.y).filter(Number.isFinite);
                 return [y.length, y.reduce((a, b) => Math.min(a, b), Infinity),
                         y.reduce((a, b) => Math.max(a, b), -Infinity)] }))"""
        )
        for chart, sets in zip(data["charts"], found):
            self.assertEqual(len(sets), len(chart["curves"]), chart["id"])
            for curve, (count, low, high) in zip(chart["curves"], sets):
                x, y = data["lists"][curve["x"]], data["lists"][curve["y"]]
                is_log = chart["x"]["log"], chart["y"]["log"]
                kept = [b for a, b in zip(x, y) if b is not None and not (is_log[1] and b <= 0)]
                self.assertEqual(count, len(kept), chart["id"])
                if kept:
                    self.assertEqual((low, high), extremes([kept]), chart["id"])

    def test_foresight_is_shown_beside_clipping_with_the_limits_as_lines(self):
        for name, chart, limit in (
            ("two_mass_limits", "foresight-u0", 0.3),
            ("slewing_servo", "foresight-u0-rate", 2000),
            ("slewing_servo", "foresight-x1", 20),
        ):
            data = data_of(name)
            spec = next(each for each in data["charts"] if each["id"] == chart)
            self.assertEqual([curve["label"] for curve in spec["curves"]], ["clipped", "foreseen"])
            self.assertEqual([guide["at"] for guide in spec["guides"]], [-limit, limit])
            clipped, foreseen = (data["lists"][curve["y"]] for curve in spec["curves"])
            self.assertLess(max(map(abs, foreseen)), 1.001 * limit)
            self.assertNotEqual(clipped, foreseen)
            page = self.open(name, 360, java_script_enabled=False)
            picture = page.locator(f'[data-chart="{chart}"] > svg')
            self.assertTrue(picture.is_visible())
            self.assertLessEqual(picture.bounding_box()["width"], 360)
            self.assertEqual(picture.locator(".guide").count(), 2)
            for word in ("clipped", "foreseen"):
                self.assertEqual(picture.get_by_text(word, exact=True).count(), 1)

    def test_what_is_drawn_has_the_colours_of_its_curves(self):
        """Reads pixels: a curve that Chart.js knows but does not draw would be missing."""
        page = self.open("servo")
        for chart in [chart for chart in self.shown(page) if not chart.startswith("root")]:
            missing = page.evaluate(
                """id => {
                     const {live, spec} = lqgPage.chart(id), {width, height} = live.canvas;
                     const pixels = live.ctx.getImageData(0, 0, width, height).data;
                     const seen = new Set();
                     for (let i = 0; i < pixels.length; i += 4)
                       if (pixels[i + 3] > 200) seen.add([pixels[i], pixels[i + 1], pixels[i + 2]].join());
                     const rgb = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16)).join();
                     const inside = (set) => set.data.some(({x, y}) => {
                       const {x: a, y: b} = live.scales;
                       return x >= a.min && x <= a.max && y >= b.min && y <= b.max; });
                     return live.data.datasets
                       .filter((set, i) => spec.curves[i].role === "data" && inside(set))
                       .map((set) => set.borderColor).filter((colour) => !seen.has(rgb(colour))); }""",
                chart,
            )
            self.assertEqual(missing, [], chart)

    @on_each_page
    def test_pointing_shows_the_values_of_all_charts_of_that_time(self, name):
        page = self.open(name)
        chart = self.chart_over_time(page)
        _, place = self.figure(page, chart)
        page.mouse.move(place["left"] + 0.6 * place["width"], place["top"] + 0.5 * place["height"])
        spec = next(c for c in data_of(name)["charts"] if c["id"] == chart)
        lists = data_of(name)["lists"]
        curves = [c for c in spec["curves"] if c["role"] == "data"]
        lines = [c for c in curves if c["mark"] not in ("dots", "rings")]
        sampled = lists[min(lines, key=lambda c: len(lists[c["x"]]))["x"]]
        low, high = self.window(page, chart)[:2]
        at = min(sampled, key=lambda x: abs(x - (low + 0.6 * (high - low))))
        values = page.locator(f'[data-chart="{chart}"] .value').all_inner_texts()
        self.assertGreaterEqual(len(values), len(curves))
        for curve, said in zip(curves, values):
            x, y = lists[curve["x"]], lists[curve["y"]]
            expected = y[min(range(len(x)), key=lambda i: abs(x[i] - at))]
            size = max(abs(v) for v in y if v is not None)
            self.assertAlmostEqual(float(said.replace("−", "-")), expected, delta=2e-3 * size, msg=curve["label"])
        crosses = page.locator(".cross:visible").count()
        group = [c["id"] for c in data_of(name)["charts"] if c["group"] == spec["group"]]
        drawn = [c for c in group if c in self.shown(page)]
        self.assertGreaterEqual(crosses, min(len(drawn), 2))

    @on_each_page
    def test_dragging_zooms_the_time_of_all_charts_and_a_double_click_goes_back(self, name):
        page = self.open(name)
        chart = self.chart_over_time(page)
        _, place = self.figure(page, chart)
        before = self.window(page, chart)
        self.drag(page, place, 0.25, 0.5)
        low, high = self.window(page, chart)[:2]
        size = before[1] - before[0]
        self.assertAlmostEqual(low, before[0] + 0.25 * size, delta=0.01 * size)
        self.assertAlmostEqual(high, before[0] + 0.5 * size, delta=0.01 * size)
        page.mouse.dblclick(place["left"] + 0.5 * place["width"], place["top"] + 0.5 * place["height"])
        self.assertEqual(self.window(page, chart), before)

    @on_each_page
    def test_a_square_chart_keeps_one_scale_for_both_axes(self, name):
        page = self.open(name)
        _, place = self.figure(page, "poles")
        for _ in range(2):
            x_low, x_high, y_low, y_high = self.window(page, "poles")
            self.assertAlmostEqual(
                (x_high - x_low) / place["width"] / ((y_high - y_low) / place["height"]), 1, delta=0.02
            )
            self.drag(page, place, 0.3, 0.6, 0.2)

    @on_each_page
    def test_a_click_in_the_legend_hides_a_curve_and_it_stays_hidden_when_the_page_is_drawn_anew(self, name):
        page = self.open(name)
        chart = "poles"
        self.figure(page, chart)
        hidden = "id => lqgPage.chart(id).live.data.datasets.filter(set => set.hidden).length"
        self.assertEqual(page.evaluate(hidden, chart), 0)
        entry = f'[data-chart="{chart}"] button.entry'
        page.locator(entry).first.click()
        self.assertEqual(page.evaluate(hidden, chart), 1)
        self.assertEqual(page.locator(entry).first.get_attribute("aria-pressed"), "false")
        page.evaluate("data => lqgPage.draw(data)", data_of(name))
        self.assertEqual(page.evaluate(hidden, chart), 1)
        page.locator(entry).first.click()
        self.assertEqual(page.evaluate(hidden, chart), 0)

    def test_the_zoom_stays_when_the_page_is_drawn_anew(self):
        page = self.open("servo")
        chart = self.chart_over_time(page)
        _, place = self.figure(page, chart)
        self.drag(page, place, 0.25, 0.5)
        zoomed = self.window(page, chart)
        page.evaluate("data => lqgPage.draw(data)", data_of("servo"))
        self.assertEqual(self.window(page, chart), zoomed)

    def test_ghosts_are_grey_curves_behind_those_of_the_same_chart(self):
        page = self.open("servo")
        chart = self.chart_over_time(page)
        count = "id => lqgPage.chart(id).live.data.datasets.length"
        curves = page.evaluate(count, chart)
        page.evaluate("([data, ghost]) => lqgPage.draw(data, {ghost})", [data_of("servo"), data_of("servo")])
        self.assertEqual(page.evaluate(count, chart), 2 * curves)
        colours = page.evaluate("id => lqgPage.chart(id).live.data.datasets.map(set => set.borderColor)", chart)
        self.assertEqual(len(set(colours[:curves])), 1)
        self.assertNotIn(colours[0], colours[curves:])

    @on_each_page
    def test_keys_move_the_cursor_zoom_and_go_back(self, name):
        page = self.open(name)
        chart = self.chart_over_time(page)
        canvas, _ = self.figure(page, chart)
        before = self.window(page, chart)
        canvas.focus()
        at = page.locator(f'[data-chart="{chart}"] .at')
        page.keyboard.press("ArrowRight")
        first = at.inner_text()
        page.keyboard.press("ArrowRight")
        self.assertNotEqual(at.inner_text(), first)
        page.keyboard.press("ArrowLeft")
        self.assertEqual(at.inner_text(), first)
        self.assertIn(first, page.locator("#lqg-said").inner_text())
        page.keyboard.press("+")
        low, high = self.window(page, chart)[:2]
        self.assertAlmostEqual(high - low, (before[1] - before[0]) / 2, delta=1e-6 * (before[1] - before[0]))
        page.keyboard.press("Escape")
        self.assertEqual(self.window(page, chart), before)

    def test_tab_reaches_every_chart_and_every_entry_of_a_legend(self):
        page = self.open("regulator")
        page.evaluate("lqgPage.drawAll()")
        wanted = page.locator("canvas:visible, button:visible, summary:visible").count()
        seen = set()
        for _ in range(wanted + 5):
            page.keyboard.press("Tab")
            seen.add(page.evaluate("[...document.querySelectorAll('*')].indexOf(document.activeElement)"))
        self.assertGreaterEqual(len(seen), wanted)

    def test_many_charts_are_small_until_one_is_made_large(self):
        page = self.open("quadrotor")
        page.get_by_role("button", name="noises").click()
        small = page.locator(".many:visible .chart")
        self.assertGreater(small.count(), 12)
        height = small.first.bounding_box()["height"]
        canvas = small.first.locator("canvas")
        canvas.click()
        self.assertGreater(small.first.bounding_box()["height"], 1.5 * height)
        canvas.press("Escape")
        self.assertEqual(small.first.bounding_box()["height"], height)
        canvas.press("Enter")
        self.assertGreater(small.first.bounding_box()["height"], 1.5 * height)

    def test_a_matrix_can_be_copied_to_other_programs(self):
        page = self.open("servo", permissions=["clipboard-read", "clipboard-write"])
        details = page.locator('details[data-name="K"]')
        details.locator("summary").click()
        row = [cell.inner_text() for cell in details.locator("td").all()]
        wanted = {
            "TOML": f"K = [[{', '.join(row)}]]\n",
            "MATLAB": f"K = [{' '.join(row)}];\n",
            "Python": f"K = np.array([[{', '.join(row)}]])\n",
            "C": "static const float K[1][3] = {{" + ", ".join(f"{number}f" for number in row) + "}};\n",
        }
        for format, text in wanted.items():
            details.get_by_role("button", name=format, exact=True).click()
            self.assertEqual(page.evaluate("navigator.clipboard.readText()"), text)

    @on_each_page
    def test_without_scripts_all_pictures_are_there(self, name):
        page = self.open(name, java_script_enabled=False)
        self.assertEqual(page.locator("figure > svg").count(), len(data_of(name)["charts"]))
        self.assertTrue(all(svg.is_visible() for svg in page.locator("figure > svg").all()))
        self.assertEqual(page.locator("canvas").count(), 0)
        self.picture(page, name, "without_scripts")

    @on_each_page
    def test_print_has_the_pictures_in_black_on_white_whatever_the_screen(self, name):
        page = self.open(name, color_scheme="dark")
        page.evaluate("lqgPage.drawAll()")
        page.emulate_media(media="print", color_scheme="dark")
        self.assertEqual(page.locator("canvas:visible").count(), 0)
        self.assertEqual(page.locator("figure > svg:visible").count(), len(data_of(name)["charts"]))
        colours = page.evaluate(
            "[getComputedStyle(document.body).color, getComputedStyle(document.body).backgroundColor]"
        )
        self.assertEqual(colours, ["rgb(0, 0, 0)", "rgb(255, 255, 255)"])
        page.pdf(path=PICTURES / f"{name}.pdf", format="A4")

    def test_dark_screens_have_light_curves(self):
        def brightness(scheme):
            page = self.open("servo", color_scheme=scheme)
            page.evaluate("lqgPage.drawAll()")
            colour = page.evaluate("lqgPage.chart('poles').live.data.datasets[0].borderColor")
            paper = page.evaluate("getComputedStyle(document.body).backgroundColor")
            weigh = lambda rgb: math.fsum(w * c for w, c in zip((0.2126, 0.7152, 0.0722), rgb))
            parts = [int(part) for part in paper[4:-1].split(",")]
            return weigh(int(colour[i : i + 2], 16) for i in (1, 3, 5)), weigh(parts)

        for scheme, is_dark in (("light", False), ("dark", True)):
            curve, paper = brightness(scheme)
            self.assertEqual(curve > paper, is_dark)
            self.assertGreater(abs(curve - paper), 60)

    def test_errors_stand_over_the_page_until_they_are_taken_away(self):
        page = self.open("servo")
        page.evaluate("lqgPage.errors(['servo.toml:3:1: <b>', 'second'])")
        self.assertEqual(page.locator("#lqg-errors").inner_text(), "servo.toml:3:1: <b>\nsecond")
        page.evaluate("lqgPage.errors([])")
        self.assertFalse(page.locator("#lqg-errors").is_visible())

    def picture(self, page, name, kind):
        page.screenshot(path=PICTURES / f"{name}_{kind}.png", full_page=True)

    @on_each_page
    def test_pictures_for_people(self, name):
        for kind, width, scheme in (("wide", 1440, "light"), ("narrow", 360, "light"), ("dark", 1440, "dark")):
            page = self.open(name, width, color_scheme=scheme)
            page.evaluate("lqgPage.drawAll()")
            page.wait_for_timeout(100)
            self.picture(page, name, kind)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:], verbosity=2)
