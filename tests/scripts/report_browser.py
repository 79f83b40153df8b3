"""A report in headless Chromium, from disk and without a network: what the tests of it share."""

import os
import shutil
import sys

import pytest

pytest.importorskip("jinja2", reason="needs python3-jinja2")
pytest.importorskip("PIL", reason="needs python3-pil")
webdriver = pytest.importorskip("selenium.webdriver", reason="needs python3-selenium")

import fake_run  # noqa: E402
import report_page  # noqa: E402
from selenium.webdriver.chrome.service import Service  # noqa: E402
from selenium.webdriver.common.by import By  # noqa: E402

FRAMES = (3, 10, 20, 35)
LIBRARY = "/usr/share/javascript/dygraphs"
BROWSER, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")


@pytest.fixture(scope="module")
def browser():
    missing = [name for name, found in (("chromium", BROWSER), ("chromium-driver", DRIVER),
                                        ("libjs-dygraphs", os.path.isdir(LIBRARY))) if not found]
    if missing:
        message = f"the report was NOT tried in a browser: needs {', '.join(missing)}"
        print(message, file=sys.stderr)
        pytest.skip(message)
    options = webdriver.ChromeOptions()
    options.binary_location = BROWSER
    for argument in ("--headless=new", "--disable-gpu", "--window-size=1200,900",
                     "--force-device-scale-factor=1"):
        options.add_argument(argument)
    if os.geteuid() == 0:
        options.add_argument("--no-sandbox")  # Chromium refuses its sandbox to root
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service(DRIVER))
    driver.execute_cdp_cmd("Network.enable", {})
    driver.execute_cdp_cmd("Network.emulateNetworkConditions", {
        "offline": True, "latency": 0, "downloadThroughput": 0, "uploadThroughput": 0})
    yield driver
    driver.quit()


def plant(pictures):
    """Coh(B) shows a dark square in frame 10 that is in no other picture."""
    pictures["coh-b", 10] = pictures["coh-b", 10].copy()
    pictures["coh-b", 10][60:80, 150:180] = 0


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("report")
    size = (320, 240)
    runs = [fake_run.make_run(folder / "a", image_frames=FRAMES, size=size, scene="scene1",
                              edit=plant),
            fake_run.make_run(folder / "b", scene="no pictures", seed=5)]
    (folder / "a" / "images" / "simp-b.00020.png").unlink()
    return folder, runs


@pytest.fixture
def page(browser, made, run_script):
    """The page of both runs, freshly opened; at the end nothing may have been complained of."""
    folder, runs = made
    out = folder / "report.html"
    if not out.exists():
        program = report_page.add_program(folder / "program", [
            f"{r.folder},{r.data['scene']['name']},s,coh-b,Coh(B),2,0,70,1,109.6,0.1,1.4,29.4,30.5"
            ",,,,0.01,,,,,,," for r in runs])
        done = run_script("report.py", *[r.folder for r in runs], "--out", out, "--hlodbench",
                          program)
        assert done.returncode == 0, done.stderr
    browser.set_window_size(1200, 900)
    browser.get(out.as_uri())
    browser.execute_script("localStorage.clear(); delete document.documentElement.dataset.theme;")
    browser.refresh()
    yield browser
    assert [e for e in browser.get_log("browser") if e["level"] != "INFO"] == []


def find(page, name, scene=0):
    return page.find_element(By.CSS_SELECTOR, f'#scene-{scene} [data-part="{name}"]')


def cells(table):
    """{heading: texts} of a table."""
    rows = [[c.text for c in row.find_elements(By.CSS_SELECTOR, "th, td")]
            for row in table.find_elements(By.TAG_NAME, "tr")]
    return {row[0].strip(): row[1:] for row in rows}


def input_of(page, name, value=None, scene=0):
    chosen = f'[value="{value}"]' if value else ""
    return page.find_element(By.CSS_SELECTOR, f'#scene-{scene} input[name="{name}"]{chosen}')


def mean(run, strategy, counter, frame):
    return (run.frames[strategy, 0][counter][frame] + run.frames[strategy, 1][counter][frame]) / 2
