"""report.py: the heat-maps of sweeps, in a real browser."""

import pytest

pytest.importorskip("yaml", reason="needs python3-yaml")
pytest.importorskip("jinja2", reason="needs python3-jinja2")
pytest.importorskip("PIL", reason="needs python3-pil")
pytest.importorskip("selenium", reason="needs python3-selenium")

from report_browser import browser  # noqa: E402, F401
from selenium.webdriver.common.by import By  # noqa: E402
from selenium.webdriver.support.ui import Select  # noqa: E402
from sweep_table import write_sweep  # noqa: E402


@pytest.fixture
def page(browser, tmp_path, run_script):  # noqa: F811
    write_sweep(tmp_path / "mine")
    done = run_script("report.py", tmp_path / "mine")
    assert done.returncode == 0, done.stderr
    browser.get((tmp_path / "mine" / "report.html").as_uri())
    yield browser
    assert [e for e in browser.get_log("browser") if e["level"] != "INFO"] == []


def maps(page):
    """{(strategy, other parameters): the texts of the map}."""
    found = {}
    for row in page.find_elements(By.CSS_SELECTOR, "[data-part=maps] > div"):
        name = row.find_element(By.TAG_NAME, "h3").text
        for figure in row.find_elements(By.TAG_NAME, "figure"):
            other = figure.find_element(By.TAG_NAME, "figcaption").text
            found[name, other] = [t.text for t in figure.find_elements(By.TAG_NAME, "text")]
    return found


def choose(page, name, text):
    Select(page.find_element(By.CSS_SELECTOR, f"[data-part={name}]")).select_by_visible_text(text)


def test_maps_show_the_numbers_of_the_table(page):
    shown = maps(page)
    assert list(shown) == [(s, o) for s in ("Bool", "<Mine>") for o in ("simp last", "simp mean")]
    # across: s, down: latency; rows of the table count up by 10, s outermost
    assert shown["Bool", "simp last"] == [
        "s", "latency", "0.5", "1", "draws:5", "draws:20", "gl",
        "140", "260", "100", "220", "180", "–"]
    assert shown["<Mine>", "simp mean"][-6:] == ["170", "290", "130", "250", "210", "–"]
    scale = page.find_element(By.CSS_SELECTOR, "[data-part=scale]").text
    assert scale.split("\n")[0].startswith("DN: drawn nodes") and "100" in scale and "290" in scale
    colors = {rect.get_attribute("fill") for rect in page.find_elements(By.TAG_NAME, "rect")}
    assert {"rgb(68, 1, 84)", "rgb(253, 231, 37)"} <= colors  # least and most


def test_choices_change_the_maps(page):
    choose(page, "across", "simp")
    choose(page, "down", "s")
    choose(page, "counter", "FPS")
    page.find_element(By.CSS_SELECTOR, "section.sweep input[value=bool]").click()
    shown = maps(page)
    assert list(shown) == [("<Mine>", f"latency {v}") for v in ("draws:5", "draws:20", "gl")]
    assert shown["<Mine>", "latency draws:5"][2:] == ["last", "mean", "0.5", "1"] + ["80"] * 4
    assert set(shown["<Mine>", "latency gl"][-4:]) == {"–"}
    choose(page, "down", "simp")  # the same one twice: a single line
    assert all(len(texts) == 2 + 3 + 2 for texts in maps(page).values())
