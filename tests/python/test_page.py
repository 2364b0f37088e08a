"""The demo's page in a real browser, without a network: pictures, slider and numbers.

Looks for Chromium, Chrome or Edge on the path, or at FRETTING_BROWSER; without one the tests are
skipped and say so.
"""

import csv
import math
import os
import re
import shutil

import pytest
from conftest import ROOT

NAMES = (
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
    "chrome",
    "msedge",
    "microsoft-edge",
)
LIVES = tuple(f"life{k}" for k in range(4))
PICTURES = ("loops", "varying", "profile", "pressure", "volume", *LIVES, "map", "swing", "joint")
PHONE = {
    "viewport": {"width": 390, "height": 844},
    "is_mobile": True,
    "has_touch": True,
    "device_scale_factor": 2,
}

playwright = pytest.importorskip(
    "playwright.sync_api",
    reason="Playwright is not installed: see tests/python/browser-requirements.txt",
)


@pytest.fixture(scope="module")
def page_path(demo):
    pytest.importorskip(
        "vl_convert", reason="vl-convert is not installed: see examples/demo/page-requirements.txt"
    )
    return demo[0] / "index.html"


@pytest.fixture(scope="module")
def browser():
    path = os.environ.get("FRETTING_BROWSER") or next(filter(None, map(shutil.which, NAMES)), None)
    if path is None:
        pytest.skip("no browser was found: `apt install chromium`, or set FRETTING_BROWSER to one")
    with playwright.sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=path)
        yield browser
        browser.close()


@pytest.fixture(scope="module")
def opened(browser, page_path):
    """A function that opens the page without a network; no request and no error may occur."""
    contexts, said = [], []

    def open_page(**options):
        contexts.append(browser.new_context(offline=True, **options))
        page = contexts[-1].new_page()
        page.on("console", lambda message: said.append(f"{message.type}: {message.text}"))
        page.on("pageerror", lambda error: said.append(f"error: {error}"))
        page.on(
            "request",
            lambda request: said.append(request.url) if request.url != page_path.as_uri() else None,
        )
        page.goto(page_path.as_uri())
        page.wait_for_selector("body[data-drawn=yes]")
        return page

    yield open_page
    for context in contexts:
        context.close()
    assert said == []


@pytest.fixture(scope="module")
def page(opened):
    return opened()


def table(page_path, name):
    with open(page_path.with_name(name), encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def move_to(page, place):
    page.locator("#time").evaluate(
        "(slider, place) => { slider.value = place; slider.dispatchEvent(new Event('input')); }",
        place,
    )


def state(page):
    """The numbers under the slider, by their names."""
    parts = page.locator("#state > span").all_inner_texts()
    return {name: text for name, text in (re.split(r"\s*\n\s*", part) for part in parts)}


def same(value, text, scale=1.0, digits=4):
    """Whether a CSV's text is what is shown, rounded to some digits."""
    return math.isclose(
        value, float(text) * scale, rel_tol=0.51 * 10.0 ** (1 - digits), abs_tol=1e-12
    )


def agrees(shown, text, scale):
    """Whether a text of the page is the number of a CSV file; below a millionth it is 0."""
    return same(leading(shown), text if abs(float(text) * scale) >= 1e-6 else 0.0, scale)


def leading(text):
    return float(re.match(r"[-+\d.,e]+", text)[0].replace(",", ""))


def test_it_is_one_file_that_loads_no_other(page, page_path):
    assert page_path.stat().st_size < 2e6
    sources = "nodes => nodes.map((node) => node.getAttribute('src') || node.getAttribute('href'))"
    loaded = page.locator("[src], link[href]").evaluate_all(sources)
    assert all(source.startswith("data:") for source in loaded)
    rules = page.locator("meta[http-equiv=Content-Security-Policy]").get_attribute("content")
    assert "default-src 'none'" in rules  # the browser itself would refuse to fetch
    tables = page.locator("a[href$='.csv']").evaluate_all(sources)
    assert sorted(tables) == sorted(path.name for path in page_path.parent.glob("*.csv"))


def test_it_links_to_the_guide(page, page_path):
    links = page.locator("a[href$='.md']").evaluate_all(
        "nodes => nodes.map((node) => node.getAttribute('href'))"
    )
    guide = {path.name: path for path in (ROOT / "docs").glob("*.md")}
    assert {"README.md", "first_steps.md", "theory.md"} <= {
        link.rsplit("/", 1)[-1] for link in links
    }
    for link in links:
        assert (page_path.parent / link).resolve() == guide[link.rsplit("/", 1)[-1]], link
    for target in page.locator("a[href^='#']").evaluate_all(
        "nodes => nodes.map((node) => node.getAttribute('href'))"
    ):
        assert page.locator(target).count() == 1


@pytest.mark.parametrize("name", PICTURES)
def test_every_picture_is_drawn_with_axes_and_words_for_those_who_cannot_see_it(page, name):
    svg = page.locator(f"#{name} svg")
    assert svg.count() == 1
    box = svg.bounding_box()
    assert box["width"] > 300 and box["height"] > 200
    assert len(page.locator(f"#{name}").get_attribute("aria-label")) > 50
    titles = page.locator(f"#{name} svg .role-axis-title text").all_text_contents()
    assert len(titles) == 2
    for title in titles:
        assert "(" in title, title
    marks = page.locator(f"#{name} svg .role-mark path")
    assert marks.count() > 0
    assert page.locator(f"figure:has(#{name}) figcaption").inner_text().strip()


def test_the_slider_moves_the_film_and_its_numbers_are_those_of_the_table(page, page_path):
    history = table(page_path, "worn_tip_history.csv")
    fields = table(page_path, "worn_tip_film.csv")
    for number, life in enumerate(("Partial slip", "Gross slip")):
        page.locator("#lives input").nth(number).check()
        rows = [row for row in history if row["regime"] == life]
        page.wait_for_function(
            "count => film.life.name === DATA.film[count].name && element('time').value === '0'",
            arg=number,
        )
        assert page.locator("#time").get_attribute("max") == str(len(rows) - 1)
        seen = set()
        for place in (0, len(rows) // 2, len(rows) - 1):
            move_to(page, place)
            row, shown = rows[place], state(page)
            assert leading(shown["cycle"]) == round(float(row["cycles (1)"]))
            assert agrees(shown["worn volume"], row["wear_volume (m3)"], 1e15)
            assert agrees(shown["wear depth"], row["wear_depth (m)"], 1e6)
            assert agrees(shown["contact radius"], row["contact_radius (m)"], 1e6)
            assert agrees(shown["stick radius"], row["stick_radius (m)"], 1e6)
            # what is drawn: the data of the pictures, and pictures that differ
            drawn = page.evaluate("film.views[0].data('frame').filter((row) => row.r >= 0)")
            here = [r for r in fields if r["regime"] == life and r["cycles"] == row["cycles (1)"]]
            assert len(drawn) == len(here) == 64
            for point, known in zip(drawn, here):
                assert same(point["r"], known["radius (m)"], 1e6, 6)
                assert same(point["p"], known["pressure (Pa)"], 1e-9, 6)
                height = float(known["unworn_height (m)"]) + float(known["worn_depth (m)"])
                assert same(point["h"], height, 1e6, 6)
            seen.add(
                tuple(
                    page.locator(f"#{name} svg").inner_html()
                    for name in ("profile", "pressure", "volume")
                )
            )
        assert len(seen) == 3
        for pictures in zip(*seen):
            assert len(set(pictures)) == 3  # each of them moved each time


def test_the_slider_obeys_the_keyboard_and_says_where_it_stands(page):
    slider = page.locator("#time")
    move_to(page, 0)
    before = page.locator("#profile").screenshot()
    slider.focus()
    page.keyboard.press("End")
    assert page.evaluate("element('time').value === element('time').max")
    assert re.fullmatch(r"[\d,]+ cycles", slider.get_attribute("aria-valuetext"))
    assert page.locator("#profile").screenshot() != before
    page.keyboard.press("ArrowLeft")
    assert page.evaluate("Number(element('time').max) - Number(element('time').value)") == 1
    page.keyboard.press("Home")
    page.mouse.move(0, 0)
    assert page.locator("#profile").screenshot() == before


def test_play_runs_to_the_end_and_stops(page):
    move_to(page, page.evaluate("element('time').max - 3"))
    page.locator("#play").click()
    assert page.locator("#play").inner_text() == "Pause"
    page.wait_for_function("element('time').value === element('time').max")
    page.wait_for_function("element('play').textContent === 'Play'")


def test_the_other_pictures_show_the_tables(page, page_path):
    shown = page.evaluate("DATA")
    loops = table(page_path, "ball_loops.csv")
    assert len(shown["loops"]["lines"]) == len(loops)
    for line, row in list(zip(shown["loops"]["lines"], loops))[::50]:
        assert same(line["u"], row["displacement (m)"], 1e6, 6) and same(
            line["t"], row["tangential_force (N)"], 1, 6
        )
    swings = [
        row
        for row in table(page_path, "ball_varying_load.csv")
        if float(row["time (cycles)"]) > 2 - 1e-6
    ]
    assert len(shown["varying"]) == len(swings)
    for point, row in list(zip(shown["varying"], swings))[::50]:
        assert point["phase"] == row["load"]
        assert same(point["u"], row["displacement (m)"], 1e6, 6) and same(
            point["t"], row["tangential_force (N)"], 1, 6
        )
    lives = table(page_path, "lives.csv")
    points = [(life["name"], point) for life in shown["lives"] for point in life["curves"]]
    assert len(shown["lives"]) == len(LIVES) and len(points) == len(lives)
    for (name, point), row in list(zip(points, lives))[::50]:
        assert (name, float(point["stop"])) == (row["case"], float(row["life (N/N0)"]))
        assert same(
            point["h"], float(row["unworn_height (m)"]) + float(row["worn_depth (m)"]), 1e6, 6
        )
    for number, life in enumerate(shown["lives"]):
        assert page.locator(f"#life{number}-caption").inner_text() == life["name"]
        lines = page.locator(f"#life{number} svg .role-mark.mark-line path")
        assert lines.count() == len({point["stop"] for point in life["curves"]}) == 6
    fields = table(page_path, "running_map.csv")
    assert (
        page.locator("#map .role-mark.mark-rect path").count()
        == len(fields)
        == len(shown["map"]["fields"])
    )
    for field, row in zip(shown["map"]["fields"], fields):
        assert field["regime"] == row["regime"]
        assert same(field["v"], row["wear_volume (m3)"], 1e15, 6)
        assert field["n1"] < float(row["load (N)"]) < field["n2"]
        assert field["u1"] < float(row["amplitude (m)"]) * 1e6 < field["u2"]
    motion = table(page_path, "shaken_mass.csv")
    assert max(row["high"] for row in shown["mass"]["swing"]) == pytest.approx(
        max(float(row["displacement (m)"]) for row in motion) * 1e6, rel=1e-5
    )
    numbers = table(page_path, "headlines.csv")
    cells = page.locator("tbody tr:has(td)")
    assert cells.count() == len(numbers)
    for cell, row in zip(page.locator("tbody tr td:nth-child(2)").all_text_contents(), numbers):
        assert same(leading(cell), row["value"], 1, 5)


@pytest.mark.parametrize("mode", ["light", "dark"])
def test_it_fits_a_phone_in_light_and_dark(opened, mode):
    page = opened(color_scheme=mode, **PHONE)
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    for name in PICTURES:
        box = page.locator(f"#{name} svg").bounding_box()
        assert box["x"] >= 0 and box["x"] + box["width"] <= 390, name
    colour = "el => getComputedStyle(el).{}.match(/[0-9]+/g).slice(0, 3).map(Number)"
    ground = page.locator("body").evaluate(colour.format("backgroundColor"))
    label = page.locator("#loops svg .role-axis-label text").first.evaluate(colour.format("fill"))
    light, dark = (label, ground) if mode == "dark" else (ground, label)
    assert contrast(light, dark) > 7
    assert page.locator("#time").bounding_box()["height"] >= 24  # wide enough for a finger


def contrast(light, dark):
    """Of two colours, as WCAG 2 reckons it."""

    def luminance(colour):
        linear = [
            c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4
            for c in (v / 255 for v in colour)
        ]
        return sum(weight * c for weight, c in zip((0.2126, 0.7152, 0.0722), linear))

    return (luminance(light) + 0.05) / (luminance(dark) + 0.05)
