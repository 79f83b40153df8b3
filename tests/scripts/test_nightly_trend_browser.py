"""scripts/nightly.sh trend: the page in a real browser, from disk and without a network."""

import subprocess
import sys

import pytest

pytest.importorskip("jinja2", reason="needs python3-jinja2")
np = pytest.importorskip("numpy", reason="needs python3-numpy")
pytest.importorskip("PIL", reason="needs python3-pil")
pytest.importorskip("selenium", reason="needs python3-selenium")

import made_up_trend  # noqa: E402
from made_up_trend import DN_FROM, SLOWER_FROM  # noqa: E402
from report_browser import browser, cells  # noqa: E402, F401
from selenium.webdriver.common.action_chains import ActionChains  # noqa: E402
from selenium.webdriver.common.by import By  # noqa: E402
from selenium.webdriver.common.keys import Keys  # noqa: E402
from selenium.webdriver.support.ui import Select  # noqa: E402

HOVERED = "Night {} of 60:"


@pytest.fixture(scope="module")
def made(tmp_path_factory, root):
    """A function: the page of so many nights."""
    pages = {}

    def make(nights):
        if nights not in pages:
            folder = tmp_path_factory.mktemp(f"trend{nights}")
            made_up_trend.write_history(folder / "history", nights)
            pages[nights] = folder / "trend.html"
            done = subprocess.run([sys.executable, root / "scripts/nightly.py", "trend",
                                   "--history", folder / "history", "--out", pages[nights]],
                                  capture_output=True, text=True, check=False)
            assert done.returncode == 0, done.stderr
        return pages[nights]
    return make


@pytest.fixture
def open_page(browser, made):  # noqa: F811
    """A function that opens it; at the end nothing may have been fetched or complained of."""

    def open_it(nights=60):
        browser.set_window_size(1200, 900)
        browser.get(made(nights).as_uri())
        browser.execute_script("localStorage.clear()")
        browser.refresh()
        return browser

    yield open_it
    names = browser.execute_script(
        "return performance.getEntriesByType('resource').map(e => e.name)")
    assert names == []
    assert [e for e in browser.get_log("browser") if e["level"] != "INFO"] == []


def find(page, name, machine=0):
    return page.find_element(By.CSS_SELECTOR, f'#machine-{machine} [data-part="{name}"]')


def choose(page, counter):
    Select(page.find_element(By.CSS_SELECTOR, '[data-part="counter"]')).select_by_value(counter)


def box(page, name, value):
    return page.find_element(By.CSS_SELECTOR, f'input[name="{name}"][value="{value}"]')


def pixels(page, at_top=False):
    """How many pixels of the first plot have the colour of coh-b, or how many at its top."""
    return page.execute_script("""
      let count = 0;
      for (const canvas of document.querySelectorAll("#machine-0 .plot canvas")) {
        const copy = document.createElement("canvas");
        Object.assign(copy, { width: canvas.width, height: canvas.height });
        const context = copy.getContext("2d", { willReadFrequently: true });
        context.drawImage(canvas, 0, 0);
        const { data } = context.getImageData(0, 0, copy.width, arguments[0] ? 5 : copy.height);
        for (let i = 0; i < data.length; i += 4)
          if (data[i] === 0 && data[i + 1] === 0x72 && data[i + 2] === 0xb2 && data[i + 3] === 255)
            ++count;
      }
      return count;""", at_top)


def test_a_chosen_series_is_drawn_with_its_change_point(open_page):
    page = open_page()
    for counter, night, before in (("dn", DN_FROM, "125.50"), ("time.ms", SLOWER_FROM, None)):
        choose(page, counter)
        plot = page.find_element(By.CSS_SELECTOR, "#machine-0 .plot")
        assert plot.get_attribute("data-counter") == counter
        rows = find(page, "changes").find_elements(By.CSS_SELECTOR, "tbody tr")
        assert len(rows) == 1 and "coh-b" in rows[0].text
        assert before is None or before in rows[0].text
        assert pixels(page) > 100 and pixels(page, at_top=True) > 10
        rows[0].find_element(By.TAG_NAME, "button").click()
        assert find(page, "night-title").text.startswith(HOVERED.format(night + 1))
        assert "regression" in find(page, "night-about").text
    choose(page, "triangles")
    choose(page, "crack_pixels")
    assert find(page, "no-changes").is_displayed() and not find(page, "changes").is_displayed()
    assert pixels(page, at_top=True) == 0


def test_a_strategy_that_is_left_out_takes_its_change_points_along(open_page):
    page = open_page()
    assert find(page, "changes").is_displayed() and pixels(page) > 100
    box(page, "strategy", "coh-b").click()
    assert find(page, "no-changes").is_displayed() and pixels(page) == 0
    assert list(cells(find(page, "night"))) == ["strategy", "bool", "sw-b"]


def test_machines_are_filtered(open_page):
    page = open_page()
    sections = page.find_elements(By.CSS_SELECTOR, "section.machine")
    assert [section.is_displayed() for section in sections] == [True, True]
    box(page, "machine", "machine-0").click()
    assert [section.is_displayed() for section in sections] == [False, True]
    assert page.find_elements(By.CSS_SELECTOR, "#machine-0 .plot") == []
    box(page, "machine", "machine-0").click()
    assert page.find_element(By.CSS_SELECTOR, "#machine-0 .plot").size["width"] > 500
    assert find(page, "night-title", 1).text.startswith("Night 40 of 40")


def test_the_pointer_and_the_keys_go_through_the_nights(open_page):
    page = open_page()
    choose(page, "time.ratio")
    plot = page.find_element(By.CSS_SELECTOR, "#machine-0 .plot")
    page.execute_script("arguments[0].scrollIntoView({block: 'center'})", plot)
    title = find(page, "night-title")
    ActionChains(page).move_to_element_with_offset(plot, 0, 0).perform()
    assert int(title.text.split()[1]) in range(25, 36)
    shown = cells(find(page, "night"))["coh-b"]
    low, high = map(float, shown[1].split(" to "))
    assert low < float(shown[0]) < high and 1.05 < low < high < 1.2
    ActionChains(page).click().perform()
    chosen = int(title.text.split()[1])
    ActionChains(page).send_keys(Keys.ARROW_RIGHT).perform()
    assert title.text.startswith(HOVERED.format(chosen + 1))
    find(page, "previous").click()
    find(page, "previous").click()
    assert title.text.startswith(HOVERED.format(chosen - 1))


def test_who_accepted_a_night_and_why_is_text(open_page):
    page = open_page()
    find(page, "changes").find_element(By.TAG_NAME, "button").click()
    about = find(page, "night-about")
    assert f"accepted by A. Nother, 2026-06-01T04:00:00Z: {made_up_trend.WHY}" in about.text
    assert about.find_elements(By.TAG_NAME, "b") == []


def test_dark_and_light(open_page):
    page = open_page()
    assert pixels(page) > 100
    page.find_element(By.CSS_SELECTOR, '[data-part="theme"]').click()
    assert page.execute_script("return getComputedStyle(document.body).backgroundColor") == (
        "rgb(22, 24, 28)")
    assert pixels(page) == 0, "lines have the colours of the dark page"
    page.execute_script("localStorage.clear()")


@pytest.mark.parametrize("nights", [1, 2, 400])
@pytest.mark.parametrize("width", [360, 1200])
def test_few_and_many_nights_fit_the_window(open_page, nights, width):
    page = open_page(nights)
    page.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
        "width": width, "height": 800, "deviceScaleFactor": 1, "mobile": width < 500})
    page.refresh()
    try:
        for counter in ("dn", "time.ms"):
            choose(page, counter)
            labels = page.find_elements(By.CSS_SELECTOR, "#machine-0 .dygraph-axis-label-x")
            assert labels and labels[0].text.split("\n")[0] == "2026-01-01"
            assert pixels(page) > 5
        assert page.execute_script("return document.documentElement.scrollWidth <= "
                                   "document.documentElement.clientWidth")
    finally:
        page.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})


def test_every_control_has_a_name(open_page):
    unnamed = open_page().execute_script("""
      return [...document.querySelectorAll("button, input, select, [tabindex]")].filter((e) =>
        getComputedStyle(e).display !== "none" &&
        !(e.labels && e.labels.length && e.labels[0].textContent.trim()) &&
        !e.getAttribute("aria-label") && !e.textContent.trim()).map((e) => e.outerHTML)""")
    assert unnamed == []
