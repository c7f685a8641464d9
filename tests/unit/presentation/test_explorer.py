"""The explorer, clicked through in a browser, beside the data that it shows."""

import json

import pytest
from built_site import DOCS
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.support.ui import Select, WebDriverWait

import contactstudy as cs

TRUST = json.loads((DOCS / "trust_map.json").read_text("utf-8"))
SCHEMES = list(TRUST["runs"])


def of_cell(scheme, speed, amplitude, wavelength):
    return TRUST["errors"][scheme][speed][amplitude][wavelength]


@pytest.fixture
def page(site, browser):
    browser.open(site / "explorer.html")
    ready = "return document.getElementById('explorer').dataset.ready"
    WebDriverWait(browser.driver, 20).until(lambda _: browser.run(ready))
    yield browser
    assert browser.errors() == []


def enter(browser, name, value):
    field = browser.driver.find_element("id", name)
    field.clear()
    field.send_keys(str(value))


def text(browser, name):
    return browser.driver.find_element("id", name).text


def find(browser, selector):
    """An element, scrolled to at once so that it can be clicked."""
    found = browser.driver.find_element("css selector", selector)
    browser.run("arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", found)
    return found


def percent(value):
    return "–" if value is None else f"{value:.{2 if value < 1 else 3}g} %"


def test_every_scheme_shows_its_error_at_what_is_entered(page):
    w, a, v = len(TRUST["wavelengths"]) - 1, 1, len(TRUST["speeds"]) - 1
    # a little off the last computed wave and speed, and amplitudes
    enter(page, "wavelength", 1e3 * TRUST["wavelengths"][w] * 0.97)
    enter(page, "amplitude", 1e6 * TRUST["amplitudes"][a] * 1.1)
    enter(page, "speed", 3.6 * TRUST["speeds"][v] - 1)
    for k, run in enumerate(SCHEMES):
        Select(find(page, "#scheme")).select_by_value(run)
        told = f"{TRUST['runs'][run]}: {percent(of_cell(k, v, a, w))} in the nearest"
        WebDriverWait(page.driver, 5).until(lambda _, told=told: told in text(page, "answer"))
        own = TRUST["own"] and TRUST["own"][v][w]
        assert own is None or f"own error there is about {percent(own)}" in text(page, "answer")
    rows = page.driver.find_elements("css selector", "#schemes tr[data-run]")
    shown = [row.text.rpartition("\n")[2].rpartition(" %")[0].split()[-1] for row in rows[1:]]
    assert [f"{s} %" for s in shown] == [percent(of_cell(k, v, a, w)) for k in range(len(SCHEMES))]


def test_a_click_on_the_map_chooses_a_cell(page):
    plot = find(page, "#map")
    before = text(page, "answer")
    ActionChains(page.driver).move_to_element_with_offset(plot, 150, -60).click().perform()
    wave = float(page.driver.find_element("id", "wavelength").get_attribute("value")) / 1e3
    size = float(page.driver.find_element("id", "amplitude").get_attribute("value")) / 1e6
    assert text(page, "answer") != before
    assert TRUST["edges"][0][0] < wave < TRUST["edges"][0][-1]
    assert TRUST["edges"][1][0] < size < TRUST["edges"][1][-1]
    assert "Your values lie outside" not in text(page, "answer")
    enter(page, "wavelength", 1e6)
    assert "Your values lie outside the map" in text(page, "answer")


def test_curves_are_those_of_the_cell_and_can_be_hidden(page):
    drawn = "return signals.lines.map((line) => line.visible)"
    assert page.run(drawn)[:2] == [True, True]
    find(page, f"tr[data-run={SCHEMES[0]}] input").click()
    assert page.run(drawn)[:2] == [True, False]
    v, a, w = page.run("const {v, a, w} = chosen(); return [v, a, w]")
    cell = TRUST["signals"][v][a][w]
    force = page.run(f"return [...sources['run {SCHEMES[0]}'].data.y]")
    wanted = [c * cell["count"] / 1e3 for c in cell["counts"][1]]
    assert force == pytest.approx(wanted, rel=1e-9)


def test_the_study_file_is_one_of_this_cell(page, tmp_path):
    v, a, w = page.run("const {v, a, w} = chosen(); return [v, a, w]")
    link = page.driver.find_element("id", "download")
    assert link.get_attribute("download") == "cell.toml"
    path = tmp_path / "cell.toml"
    path.write_text(text(page, "study"), "utf-8")
    study = cs.load(path)
    assert study.irregularity.wavelength == TRUST["wavelengths"][w]
    assert study.irregularity.amplitude == TRUST["amplitudes"][a]
    assert study.journey.speed == TRUST["speeds"][v]
    assert set(study.runs) == {*TRUST["reference"], *SCHEMES}


@pytest.mark.slow
def test_the_study_file_gives_the_error_of_the_map(tmp_path):
    w, a = len(TRUST["wavelengths"]) // 2, len(TRUST["amplitudes"]) // 2
    study = TRUST["study"].replace("WAVELENGTH", str(TRUST["wavelengths"][w]))
    study = study.replace("AMPLITUDE", str(TRUST["amplitudes"][a]))
    path = tmp_path / "cell.toml"
    path.write_text(study.replace("SPEED", str(TRUST["speeds"][0])), "utf-8")
    norms = cs.run(path).metrics["comparisons"]
    for k, run in enumerate(SCHEMES):
        found = 100 * norms[run]["contact_force"]["relative_l2_irregularity"]
        assert found == pytest.approx(of_cell(k, 0, a, w), rel=0.01)
