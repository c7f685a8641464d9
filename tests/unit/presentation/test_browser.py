"""The browser of the tests sees what goes wrong in a page, and has no network."""

PAGE = """<!doctype html><title>A page</title>
<meta name="viewport" content="width=device-width, initial-scale=1">{}"""


def test_it_sees_errors_and_dark_mode(browser, tmp_path):
    page = tmp_path / "page.html"
    page.write_text(PAGE.format("<p>Well.</p>"), "utf-8")
    browser.open(page)
    assert browser.driver.title == "A page" and browser.errors() == []
    page.write_text(PAGE.format("<script>nothing.known()</script>"), "utf-8")
    browser.open(page)
    assert "nothing is not defined" in browser.errors()[0]
    page.write_text(PAGE.format('<img src="https://example.org/a.png">'), "utf-8")
    browser.open(page)
    assert "ERR_NAME_NOT_RESOLVED" in browser.errors()[0]
    browser.show(400, 800, dark=True)
    assert browser.run("return matchMedia('(prefers-color-scheme: dark)').matches")
    assert browser.run("return innerWidth") == 400


def test_it_sees_a_page_too_wide(browser, tmp_path):
    page = tmp_path / "page.html"
    page.write_text(PAGE.format('<div style="width: 900px">wide</div>'), "utf-8")
    browser.show(500, 800)
    browser.open(page)
    assert browser.overflow() > 300
    browser.show(1000, 800)
    assert browser.overflow() == 0
