"""The report for the screen: one file, the report's text, figures that are zoomed and read."""

import base64
import html
import re
import time
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from contactstudy.figures import all_drawings
from contactstudy.plot.panels import panels_of
from contactstudy.plot.style import figure_style, new_figure, save
from contactstudy.report import write_report
from contactstudy.report.content import content
from contactstudy.report.screen import LARGEST, LARGEST_ANIMATION, screen_page

SHOWN = ("contact_force", "patch_pressure", "irregularity_spectrum", "passing_amplitudes")


@pytest.fixture(scope="module")
def made(shared_results, tmp_path_factory):
    """A study's page: some figures from their data, the others as one small picture."""
    study, out = shared_results, tmp_path_factory.mktemp("screen")
    shown = {}
    with figure_style():
        (tiny := new_figure(1.0)).add_subplot().plot([0, 1], [0, 1])
        files = save(tiny, out, "tiny")
        for each, folder in [(study, out), *((c, out / c.name) for c in study.companions)]:
            (folder / "figures").mkdir(parents=True)
            for one in all_drawings(each):
                for file in files:
                    (folder / "figures" / (one.name + file.suffix)).write_bytes(file.read_bytes())
                if one.name in SHOWN and (each is study or one.name == SHOWN[-1]):
                    figure = one.draw()
                    figure.draw_without_rendering()
                    shown[folder / "figures" / f"{one.name}.pdf"] = panels_of(figure)
    assert None not in shown.values()
    return study, write_report(study, out, shown=shown)[1], shown


def words(text):
    """Text of a page without markup and formulas."""
    body = re.sub(r"(?s)<(style|script|math)\b.*?</\1>", " ", text)
    return " ".join(html.unescape(re.sub(r"<[^>]+>", " ", body)).split())


def test_it_is_one_file_of_bounded_size(made):
    _, page, _ = made
    text = page.read_text("utf-8")
    assert page.stat().st_size < LARGEST < 5e6
    markup = re.sub(r"(?s)<script.*?</script>", "", text)
    assert set(re.findall(r'(?:src|href)="([^"]{0,5})', markup)) <= {
        "data:",
        "#eq-t",
        "#eq-e",
    } | set(re.findall(r'href="(#[^"]{0,4})', markup))
    assert "<link" not in markup and "@import" not in markup and "url(" not in markup


def test_a_page_of_long_runs_is_thinned_and_says_so(tmp_path):
    """A dozen figures of eight runs with 20,000 steps each would be 20 MB."""
    x = np.linspace(0.0, 100.0, 20_000)
    shown = {}
    with figure_style():
        for k in range(12):
            axes = (figure := new_figure(2.0)).add_subplot()
            for j in range(8):
                axes.plot(x, np.sin(3.0 * x + j) + k)
            figure.draw_without_rendering()
            shown[f"{k}.pdf"] = panels_of(figure)
    places = "".join(f'<div data-figure="{name}"></div>' for name in shown)
    page = screen_page(f"<html><head></head><body><h2>A</h2>{places}</body>", shown, tmp_path)
    assert 4e6 < len(page.encode()) < LARGEST
    points = int(re.search(r"Of a curve with more than (\d+) points", page)[1])
    assert 1000 < points < 20_000


def test_it_has_the_text_of_the_report(made):
    study, page, _ = made
    told = words(page.read_text("utf-8"))
    data = content(study, False)
    parts = [*data["results"], *(p for c in data["companions"] for p in c["parts"])]
    blocks = [b for p in parts for b in p["blocks"]] + data["provenance"] + data["parameters"]
    captions = [b["caption"] for b in blocks if "caption" in b]
    cells = [cell for b in blocks if b["kind"] == "table" for row in b["rows"] for cell in row]
    plain = [t for t in [data["title"], *captions, *cells] if "k_r" not in t and "'" not in t]
    assert len(plain) > 50
    assert [t for t in plain if " ".join(t.split()) not in told] == []
    for number, caption in enumerate((b["caption"] for b in blocks if b["kind"] == "figure"), 2):
        assert f"Figure {number}: {caption[:20]}" in told  # the model is Figure 1


def test_same_results_give_the_same_bytes(made):
    study, page, shown = made
    before = page.read_bytes()
    write_report(study, page.parent, shown=shown)
    assert page.read_bytes() == before


def test_texts_of_users_are_no_markup(made):
    _, page, _ = made
    text = page.read_text("utf-8")
    assert "&lt;b>" in text or "&lt;b&gt;" in text
    assert "with #special* _characters_ @x $5 <b> {c}." in words(text)


@pytest.fixture
def opened(made, browser):
    study, page, _ = made
    browser.open(page)
    yield study, browser
    assert browser.errors() == []


def drawn(browser, name):
    """Scroll to a figure, wait until it is drawn; script with its `box` and its panels' `views`."""
    find = f"const box = document.querySelector('[data-figure$=\"/{name}.pdf\"]');"
    browser.run(f"{find} box.scrollIntoView({{block: 'start'}})")
    deadline = time.monotonic() + 20
    while not browser.run(f"{find} return box.dataset.drawn"):
        assert time.monotonic() < deadline, browser.errors()
        time.sleep(0.05)
    return (
        f"{find} const top = (view) => view.el.getBoundingClientRect().top;"
        "const views = [...Bokeh.index.roots].filter((view) => view.model.type == 'Figure')"
        ".filter((view) => box.contains(view.el)).sort((a, b) => top(a) - top(b));"
        "const plot = views[0];"
    )


def moved(browser, script, x, y):
    """Point at a place in the coordinates of a figure's first panel; the same in pixels."""
    from selenium.webdriver import ActionChains

    at = browser.run(
        f"{script} const r = plot.canvas_view.el.getBoundingClientRect();"
        "return [r.left + plot.frame.x_scale.compute(arguments[0]) , "
        "r.top + plot.frame.y_scale.compute(arguments[1])]",
        x,
        y,
    )
    actions = ActionChains(browser.driver)
    actions.w3c_actions.pointer_action.move_to_location(*map(round, at))
    actions.perform()
    return at


def test_values_are_read_where_one_points(opened):
    study, browser = opened
    script = drawn(browser, "contact_force")
    run = study.runs["hertz_timoshenko"]
    x, force = run.position.values, run.contact_force.values / 1e3
    moved(browser, script, 12.5, 67.0)
    told = browser.run(f"{script} return box.querySelector('output').textContent")
    at = float(re.search(r"Position X of the wheel \(m\): ([\d.]+)", told)[1])
    value = float(re.search(r"hertz timoshenko: ([\d.]+)", told)[1])
    step = np.abs(np.diff(force)).max()
    assert at == pytest.approx(12.5, abs=0.05)
    assert value == pytest.approx(np.interp(at, x, force), abs=step)
    assert re.search(r"surface \(reference\): [\d.]+", told)


def test_a_map_tells_its_value(opened):
    """At the centre of the patch, the pressure of the node there."""
    study, browser = opened
    script = drawn(browser, "patch_pressure")
    moved(browser, script, 0.1, 0.1)
    told = browser.run(f"{script} return box.querySelector('output').textContent")
    value = float(re.search(r"Pressure \(MPa\): ([\d.]+)", told)[1])
    peak = study.runs["surface"].pressure.max("point").values / 1e6
    assert min(abs(value / peak - 1.0)) < 0.01


def test_bars_begin_below_what_is_seen_on_logarithmic_scales(browser, tmp_path):
    """Zero is nowhere there."""

    def draw(figure):
        lying, standing = figure.subplots(2, 1)
        lying.barh([1.0, 2.0], [0.1, 10.0], 0.5, color="#ff0000")
        lying.set(xscale="log", xlim=(0.01, 20.0))
        standing.bar([1.0, 2.0], [0.1, 10.0], 0.5, color="#ff0000")
        standing.set(yscale="log", ylim=(0.01, 20.0))

    with figure_style():
        draw(figure := new_figure(3.0))
        figure.draw_without_rendering()
        panels = panels_of(figure)
    place = '<html><head></head><body><h2>A</h2><div data-figure="f/bars.pdf"></div></body></html>'
    (tmp_path / "a.html").write_text(screen_page(place, {"f/bars.pdf": panels}, tmp_path), "utf-8")
    browser.open(tmp_path / "a.html")
    script = drawn(browser, "bars") + (
        "return views.map(({ model }) => model.renderers[0].data_source.data)"
        ".map(({ left, right, bottom, top }) => [left, right, bottom, top].map((v) => [...v]))"
    )
    lying, standing = browser.run(script)
    for (low, high), (other_low, other_high) in (
        (lying[:2], lying[2:]),
        (standing[2:], standing[:2]),
    ):
        assert max(low) < 0.01 and min(low) > 0.0 and high == pytest.approx([0.1, 10.0])
        assert other_low == pytest.approx([0.75, 1.75])
        assert other_high == pytest.approx([1.25, 2.25])
    assert browser.errors() == []


def test_a_drawn_box_zooms_both_panels(opened):
    from selenium.webdriver import ActionChains

    _, browser = opened
    script = drawn(browser, "contact_force")
    ranges = f"{script} return views.map(({{ model }}) => [model.x_range.start, model.x_range.end])"
    first = browser.run(ranges)
    start = moved(browser, script, 10.0, 66.0)
    ActionChains(browser.driver).click_and_hold().perform()
    end = moved(browser, script, 12.0, 68.0)
    ActionChains(browser.driver).release().perform()
    assert end[0] > start[0] + 20
    upper, middle, lower = browser.run(ranges)
    assert upper == middle == pytest.approx([10.0, 12.0], abs=0.1)
    assert lower == first[2]


def test_a_name_hides_its_curves(opened):
    _, browser = opened
    script = drawn(browser, "contact_force")
    hidden = (
        f"{script} return views.map(({{ model }}) => model.renderers.filter((r) => !r.visible))"
        ".map((hidden) => hidden.length)"
    )
    assert browser.run(hidden) == [0, 0, 0]
    buttons = f"{script} return [...box.querySelectorAll('button')]"
    (button,) = (b for b in browser.run(buttons) if b.text == "tangent")
    button.click()
    assert all(browser.run(hidden)) and button.get_attribute("aria-pressed") == "false"
    button.click()
    assert browser.run(hidden) == [0, 0, 0]


@pytest.mark.parametrize(("width", "dark"), [(390, True), (1200, False)])
def test_it_fits_a_phone_and_follows_the_systems_colours(made, browser, width, dark):
    _, page, _ = made
    browser.show(width, 800, dark)
    browser.open(page)
    for name in SHOWN:
        drawn(browser, name)
    assert browser.overflow() <= 0
    paper = browser.run("return getComputedStyle(document.body).backgroundColor")
    assert max(map(int, re.findall(r"\d+", paper)[:3])) < 40 if dark else paper.endswith("255)")
    assert browser.errors() == []


def touch(send, places):
    """Put a finger down, move it along, and take it off."""
    for k, (x, y) in enumerate(places):
        at = {"type": "touchMove" if k else "touchStart", "touchPoints": [{"x": x, "y": y}]}
        send("Input.dispatchTouchEvent", at)
        time.sleep(0.02)
    send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})


def test_a_finger_scrolls_the_page_and_a_tap_reads(made, browser):
    """Figures do not catch what moves the page on a phone."""
    _, page, _ = made
    send = browser.driver.execute_cdp_cmd
    browser.show(390, 800)
    send("Emulation.setTouchEmulationEnabled", {"enabled": True})
    try:
        browser.open(page)
        script = drawn(browser, "contact_force")
        x, y = browser.run(
            f"{script} const r = plot.canvas_view.el.getBoundingClientRect();"
            "return [r.left + r.width / 2, r.top + r.height / 2]"
        )
        touch(send, [(x, y)])
        told = f"{script} return box.querySelector('output').textContent"
        deadline = time.monotonic() + 5
        while "point: " not in browser.run(told) and time.monotonic() < deadline:
            time.sleep(0.05)
        assert re.search(r"point: [\d.]+", browser.run(told))
        before = browser.run("return scrollY")
        touch(send, [(x, y - 15 * k) for k in range(11)])
        while browser.run("return scrollY") < before + 100 and time.monotonic() < deadline:
            time.sleep(0.05)
        assert browser.run("return scrollY") > before + 100
    finally:
        send("Emulation.setTouchEmulationEnabled", {"enabled": False})


def test_every_picture_is_one(opened):
    _, browser = opened
    sizes = browser.run("return [...document.images].map((image) => image.naturalWidth)")
    assert len(sizes) > 5 and min(sizes) > 0


def test_an_animation_stands_in_its_pictures_place_unless_it_is_large(tmp_path):
    with figure_style():
        (one := new_figure(1.0)).add_subplot()
        save(one, tmp_path, "moving")
    frames = [Image.new("RGB", (80, 40), colour) for colour in ("red", "blue")]
    frames[0].save(tmp_path / "moving.gif", save_all=True, append_images=frames[1:])
    text = '<head></head><body><div data-figure="moving.pdf"></div></body>'
    page = screen_page(text, {}, tmp_path)
    content = base64.b64encode((tmp_path / "moving.gif").read_bytes()).decode()
    assert f"data:image/gif;base64,{content}" in page and "image/png" not in page
    with (tmp_path / "moving.gif").open("ab") as file:
        file.write(bytes(int(LARGEST_ANIMATION)))
    assert "data:image/png" in screen_page(text, {}, tmp_path)


def test_no_script_of_the_page_ends_early():
    page = Path(__file__).parents[3] / "reports" / "template" / "screen.js"
    assert "</script" not in page.read_text("utf-8")
