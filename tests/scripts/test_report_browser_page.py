"""report.py: the page as a whole, in a real browser: copying, colours, width, no network."""

import pytest

pytest.importorskip("jinja2", reason="needs python3-jinja2")
np = pytest.importorskip("numpy")
pytest.importorskip("PIL", reason="needs python3-pil")
pytest.importorskip("selenium", reason="needs python3-selenium")

import report_page  # noqa: E402
from report_browser import browser, find, made, page  # noqa: E402, F401
from selenium.webdriver.common.by import By  # noqa: E402
from selenium.webdriver.common.keys import Keys  # noqa: E402
from selenium.webdriver.support.ui import WebDriverWait  # noqa: E402


def paste(page):
    """What the clipboard holds."""
    page.execute_script("document.body.prepend(Object.assign(document.createElement('textarea'), "
                        "{id: 'pasted'}))")
    area = page.find_element(By.ID, "pasted")
    area.click()
    area.send_keys(Keys.CONTROL, "v")
    text = area.get_property("value")
    page.execute_script("arguments[0].remove()", area)
    return text


@pytest.mark.parametrize("is_denied", [False, True])
def test_copy_gives_what_the_program_printed(page, is_denied):
    if is_denied:
        page.execute_script("navigator.clipboard.writeText = () => Promise.reject(new Error('no'))")
    page.find_element(By.CSS_SELECTOR, '[data-copy="markdown"]').click()
    page.find_element(By.CSS_SELECTOR, '[data-copy="latex"]').click()
    status = page.find_element(By.CSS_SELECTOR, '[data-part="copied"]')
    expected = f"Copied {len(report_page.LATEX)} characters."
    WebDriverWait(page, 10).until(lambda _: status.text == expected, status.text)
    assert paste(page) == report_page.LATEX


def test_copy_that_nothing_allows_offers_the_text(page):
    page.execute_script("navigator.clipboard.writeText = () => Promise.reject(new Error('no'));"
                        "document.execCommand = () => false")
    page.find_element(By.CSS_SELECTOR, '[data-copy="latex"]').click()
    area = WebDriverWait(page, 10).until(lambda _: page.find_element(By.CLASS_NAME, "by-hand"))
    assert area.get_property("value") == report_page.LATEX


def test_dark_and_light(page):
    def paper():
        return page.execute_script("return getComputedStyle(document.body).backgroundColor")

    button = page.find_element(By.CSS_SELECTOR, '[data-part="theme"]')
    assert paper() == "rgb(255, 255, 255)"
    button.click()
    assert paper() == "rgb(22, 24, 28)" and button.get_attribute("aria-pressed") == "true"
    page.refresh()
    assert paper() == "rgb(22, 24, 28)", "the choice is remembered"
    page.find_element(By.CSS_SELECTOR, '[data-part="theme"]').click()
    page.execute_cdp_cmd("Emulation.setEmulatedMedia", {
        "features": [{"name": "prefers-color-scheme", "value": "dark"}]})
    assert paper() == "rgb(255, 255, 255)", "and wins over the system's"
    page.execute_script("localStorage.clear()")
    page.refresh()
    assert paper() == "rgb(22, 24, 28)"
    page.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})


@pytest.mark.parametrize("width", [360, 768, 1920])
def test_page_is_as_wide_as_the_window(page, width):
    page.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
        "width": width, "height": 800, "deviceScaleFactor": 1, "mobile": width < 500})
    page.refresh()
    try:
        assert page.execute_script("return document.documentElement.scrollWidth <= "
                                   "document.documentElement.clientWidth")
        assert page.find_element(By.CSS_SELECTOR, ".plot").size["width"] > 0.6 * min(width, 1300)
    finally:
        page.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def test_nothing_is_fetched(page):
    for select in ("next", "next"):
        find(page, select).click()
    names = page.execute_script("return performance.getEntriesByType('resource').map(e => e.name)")
    assert [name for name in names if not name.startswith("data:")] == []


def test_every_control_has_a_name(page):
    unnamed = page.execute_script("""
      return [...document.querySelectorAll("button, input, select, [tabindex]")].filter((e) =>
        getComputedStyle(e).display !== "none" &&
        !(e.labels && e.labels.length && e.labels[0].textContent.trim()) &&
        !e.getAttribute("aria-label") && !e.textContent.trim()).map((e) => e.outerHTML)""")
    assert unnamed == []
    ids = page.execute_script("return [...document.querySelectorAll('[id]')].map((e) => e.id)")
    assert len(ids) == len(set(ids))
