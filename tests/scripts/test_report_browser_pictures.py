"""report.py: the viewer of pictures, in a real browser."""

import io

import pytest

pytest.importorskip("jinja2", reason="needs python3-jinja2")
np = pytest.importorskip("numpy")
pytest.importorskip("PIL", reason="needs python3-pil")
pytest.importorskip("selenium", reason="needs python3-selenium")

from PIL import Image  # noqa: E402
from report_browser import browser, find, input_of, made, page  # noqa: E402, F401
from selenium.webdriver.common.action_chains import ActionChains  # noqa: E402
from selenium.webdriver.common.by import By  # noqa: E402
from selenium.webdriver.common.keys import Keys  # noqa: E402
from selenium.webdriver.support.ui import Select  # noqa: E402


def seen(page, element):
    """(h, w, 3) of what is seen of an element."""
    page.execute_script("arguments[0].scrollIntoView({block: 'center'})", element)
    return np.asarray(Image.open(io.BytesIO(element.screenshot_as_png)).convert("RGB")).astype(int)


def slide_to(page, percent):
    slider = find(page, "slider")
    page.execute_script(
        "arguments[0].value = arguments[1]; arguments[0].dispatchEvent(new Event('input'))",
        slider, percent)


def test_slider_changes_what_is_seen(page, made):
    find(page, "next").click()
    stack = find(page, "stack")
    page.execute_script("for (const e of document.querySelectorAll('.region')) e.remove()")
    shown = {}
    for percent in (50, 54):
        slide_to(page, percent)
        picture = seen(page, stack)
        # The planted square is at 52 %: black if right of the edge, else as in the reference.
        y, x = int(70 / 240 * picture.shape[0]), int(165 / 320 * picture.shape[1])
        shown[percent] = picture[y, x]
    pictures = made[1][0].pictures
    assert np.abs(shown[50] - pictures["coh-b", 10][70, 165]).max() < 12
    assert np.abs(shown[54] - pictures["bool", 10][70, 165]).max() < 12
    find(page, "slider").send_keys(Keys.ARROW_LEFT)
    assert "53%" in find(page, "right").get_attribute("style")
    # A drag over the picture does the same.
    ActionChains(page).move_to_element(stack).click_and_hold().move_by_offset(
        -int(stack.size["width"] / 4), 0).release().perform()
    assert abs(int(find(page, "slider").get_property("value")) - 25) <= 1


def test_worst_region_is_marked_and_magnified(page):
    find(page, "next").click()
    assert len(find(page, "crops").find_elements(By.TAG_NAME, "img")) == 3
    caption = find(page, "worst-caption").text
    left, top = map(int, caption.split("at (")[1].split(")")[0].split(", "))
    assert left <= 150 and left + 80 >= 180 and top <= 60 and top + 60 >= 80
    box, rectangle = find(page, "stack").rect, find(page, "region").rect
    assert rectangle["x"] - box["x"] == pytest.approx(left / 320 * box["width"], abs=2)
    assert rectangle["width"] == pytest.approx(80 / 320 * box["width"], abs=2)
    assert "×8" in find(page, "difference-caption").text
    black = seen(page, find(page, "difference-picture"))
    assert black[:20, :20].max() <= 40 and black.max() > 200


def test_choice_of_strategy_and_reference(page):
    Select(find(page, "strategy")).select_by_value("sw-b")
    assert "identical" in find(page, "difference-caption").text
    assert not find(page, "worst").is_displayed() and not find(page, "region").is_displayed()
    Select(find(page, "reference")).select_by_value("full")
    Select(find(page, "strategy")).select_by_value("coh-b")
    assert "the full model" in find(page, "compare-caption").text
    assert find(page, "worst").is_displayed()
    assert "bias" in find(page, "overlay-caption").text
    assert all(image.get_attribute("alt") for image in page.find_elements(By.TAG_NAME, "img")
               if image.is_displayed())


def test_missing_picture_is_said_so(page):
    Select(find(page, "frame")).select_by_value("20")
    Select(find(page, "strategy")).select_by_value("simp-b")
    assert find(page, "compare-caption").text == (
        "There is no usable picture of Simp*(B) in this frame.")
    assert not find(page, "slider").is_enabled() and find(page, "left").is_displayed()
    assert not find(page, "difference").is_displayed()
    assert "simp-b.00020.png" in page.find_element(By.CSS_SELECTOR, ".problem").text


def test_arrow_keys(page):
    body = page.find_element(By.TAG_NAME, "body")
    titles = []
    for key in (Keys.ARROW_RIGHT, Keys.ARROW_RIGHT, Keys.ARROW_LEFT, *[Keys.ARROW_LEFT] * 3):
        body.send_keys(key)
        titles.append(find(page, "frame-title").text)
    assert titles == [f"Frame {f}" for f in (10, 20, 10, 3, 3, 3)]
    # In a field they keep their own meaning.
    input_of(page, "from").send_keys(Keys.ARROW_RIGHT)
    assert find(page, "frame-title").text == "Frame 3"
    assert not find(page, "previous").is_enabled() and find(page, "next").is_enabled()
