"""The site in a browser: no errors, readable on a phone and in the dark, searchable."""

import time

import pytest
from built_site import build

# of each kind of text in the page its contrast with what lies behind it (WCAG 2.1)
CONTRASTS = """
const rgb = (text) => text.match(/[\\d.]+/g).map(Number);
const light = (c) => { c /= 255; return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4; };
const luminance = ([r, g, b]) => 0.2126 * light(r) + 0.7152 * light(g) + 0.0722 * light(b);
const found = {};
for (const element of document.querySelectorAll("article *, nav *, .sidebar-tree *")) {
  const text = [...element.childNodes].some((n) => n.nodeType === 3 && n.data.trim());
  if (!text || !element.offsetParent) continue;
  let behind = element, paper = [0, 0, 0, 0];
  while (behind && (paper[3] ?? 1) === 0) {
    paper = rgb(getComputedStyle(behind).backgroundColor);
    behind = behind.parentElement;
  }
  const pair = [luminance(rgb(getComputedStyle(element).color)), luminance(paper)].sort();
  const ratio = (Math.max(...pair) + 0.05) / (Math.min(...pair) + 0.05);
  found[`${element.tagName} ${element.className}: ${element.textContent.slice(0, 20)}`] = ratio;
}
return found;
"""


def faint(browser):
    return {text: ratio for text, ratio in browser.run(CONTRASTS).items() if ratio < 4.5}


def test_faint_text_is_seen(browser, tmp_path):
    page = tmp_path / "page.html"
    page.write_text(
        "<!doctype html><article style='background: #222'><p style='color: #fff'>clear</p>"
        "<div><p style='color: #777'>faint</p></div></article>",
        "utf-8",
    )
    browser.open(page)
    # luminances of #777 and #222: ((0x77/255 + 0.055)/1.055)^2.4 = 0.184 and 0.016
    assert faint(browser) == {"P : faint": pytest.approx(0.2346 / 0.0660, rel=0.01)}


def check_pages(site, browser):
    pages = sorted(site.rglob("*.html"))
    assert len(pages) > 10
    wrong = {}
    for page in pages:
        browser.show(390, 844, dark=True)
        browser.open(page)
        found = {
            "too wide by": browser.overflow(),
            "faint": faint(browser),
            "errors": browser.errors(),
        }
        if any(found.values()):
            wrong[str(page.relative_to(site))] = found
    assert wrong == {}


def test_every_page_on_a_phone_in_the_dark(site, browser):
    check_pages(site, browser)


@pytest.mark.slow
def test_every_page_of_the_whole_site(tmp_path, browser):
    check_pages(build(tmp_path, whole=True), browser)


def wait_for(browser, script, seconds=20):
    end = time.monotonic() + seconds
    while not (found := browser.run(script)) and time.monotonic() < end:
        time.sleep(0.05)
    return found


def test_search_finds_a_term(site, browser):
    browser.open(site / "index.html")
    box = browser.driver.find_element("css selector", "input[name=q]")
    box.send_keys("pinned-pinned\n")
    results = "[...document.querySelectorAll('#search-results li a')]"
    there = f"return {results}.some((a) => a.textContent === 'How it is checked')"
    assert wait_for(browser, there)
    assert browser.errors() == []
