"""report.py: the page in a real browser, from disk and without a network."""

import base64
import io
import os
import shutil
import subprocess
import sys

import pytest

pytest.importorskip("jinja2", reason="needs python3-jinja2")
np = pytest.importorskip("numpy")
pytest.importorskip("PIL", reason="needs python3-pil")
webdriver = pytest.importorskip("selenium.webdriver", reason="needs python3-selenium")

import fake_run  # noqa: E402
import report_page  # noqa: E402
from PIL import Image  # noqa: E402
from selenium.webdriver.chrome.service import Service  # noqa: E402
from selenium.webdriver.common.action_chains import ActionChains  # noqa: E402
from selenium.webdriver.common.by import By  # noqa: E402
from selenium.webdriver.common.keys import Keys  # noqa: E402
from selenium.webdriver.support.ui import Select, WebDriverWait  # noqa: E402

FRAMES = (3, 10, 20, 35)
LIBRARY = "/usr/share/javascript/dygraphs"
BROWSER, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")


def plant(pictures):
    """Coh(B) shows a dark square in frame 10 that is in no other picture."""
    pictures["coh-b", 10] = pictures["coh-b", 10].copy()
    pictures["coh-b", 10][60:80, 150:180] = 0


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


def place_of(page, frame, scene=0, frames=40):
    """Offsets of a frame in the plot from its middle, for ActionChains."""
    plot = page.find_element(By.CSS_SELECTOR, f"#scene-{scene} .plot")
    page.execute_script("arguments[0].scrollIntoView({block: 'center'})", plot)
    # dygraphs: 50 px for the y axis by default, the rest less its padding is that of the frames.
    width, pad, axis = plot.size["width"], 6, 56
    inside = width - axis
    x = axis + pad + (inside - 2 * pad) * frame / (frames - 1)
    return plot, int(round(x - width / 2)), -20


def hover(page, frame, scene=0):
    plot, x, y = place_of(page, frame, scene)
    ActionChains(page).move_to_element_with_offset(plot, x, y).perform()
    return plot


def mean(run, strategy, counter, frame):
    return (run.frames[strategy, 0][counter][frame] + run.frames[strategy, 1][counter][frame]) / 2


def test_hover_shows_the_frame_logs(page, made):
    input_of(page, "counter", "frame_ms").click()
    assert len(page.find_elements(By.CSS_SELECTOR, "#scene-0 .plot")) == 2
    for frame in (0, 17, 39):
        hover(page, frame)
        shown = cells(find(page, "readout"))
        assert f"frame {frame}" in shown
        for strategy in fake_run.STRATEGIES:
            dn, ms = shown[fake_run.label(strategy)]
            assert float(dn) == mean(made[1][0], strategy, "dn", frame)
            expected = mean(made[1][0], strategy, "frame_ms", frame)
            assert float(ms) == pytest.approx(expected, abs=0.00051) and len(ms.split(".")[1]) == 3
    # Away from the plot it is the frame that the viewer shows.
    ActionChains(page).move_to_element(find(page, "values")).perform()
    assert "frame 3" in cells(find(page, "readout"))


def test_click_shows_the_nearest_frame_with_pictures(page, made):
    plot, x, y = place_of(page, 12)
    ActionChains(page).move_to_element_with_offset(plot, x, y).click().perform()
    assert find(page, "frame-title").text == "Frame 10"
    assert "Frame 12 has no pictures" in find(page, "frame-note").text
    values = cells(find(page, "values"))
    entry = made[1][0].images["strategies"][3]["frames"][1]
    assert entry["frame"] == 10
    assert values["PSNR Y against Bool (dB)"][3] == f"{entry['vs_reference']['y']:.2f}"
    assert values["PSNR Y against Bool (dB)"][1] == "identical"
    assert values["PSNR Cr against the full model (dB)"][2] == (
        f"{made[1][0].images['strategies'][2]['frames'][1]['vs_full']['cr']:.2f}")
    assert values["wrong pixels"] == ["1"] * 4
    assert float(values["DN: drawn nodes"][3]) == mean(made[1][0], "coh-b", "dn", 10)
    # Exactly a frame with pictures: nothing to remark.
    plot, x, y = place_of(page, 35)
    ActionChains(page).move_to_element_with_offset(plot, x, y).click().perform()
    assert find(page, "frame-title").text == "Frame 35" and find(page, "frame-note").text == ""


def test_click_without_pictures_shows_the_numbers(page, made):
    plot, x, y = place_of(page, 25, scene=1)
    ActionChains(page).move_to_element_with_offset(plot, x, y).click().perform()
    assert find(page, "frame-title", 1).text == "Frame 25"
    values = cells(find(page, "values", 1))
    assert float(values["queries issued"][0]) == mean(made[1][1], "bool", "queries", 25)


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
    for percent in (40, 60):
        slide_to(page, percent)
        picture = seen(page, stack)
        # The planted square is at 52 %: black if right of the edge, else as in the reference.
        y, x = int(70 / 240 * picture.shape[0]), int(165 / 320 * picture.shape[1])
        shown[percent] = picture[y, x]
    pictures = made[1][0].pictures
    assert np.abs(shown[40] - pictures["coh-b", 10][70, 165]).max() < 12
    assert np.abs(shown[60] - pictures["bool", 10][70, 165]).max() < 12
    find(page, "slider").send_keys(Keys.ARROW_LEFT)
    assert "59%" in find(page, "right").get_attribute("style")
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


def count_color(page, color, scene=0):
    """Pixels of the first plot's curves that have just this colour."""
    return page.execute_script("""
      const [scene, color] = arguments;
      let found = 0;
      for (const canvas of document.querySelector(`#scene-${scene} .plot`).querySelectorAll("canvas")) {
        const copy = Object.assign(document.createElement("canvas"),
                                   {width: canvas.width, height: canvas.height});
        const context = copy.getContext("2d", {willReadFrequently: true});
        context.drawImage(canvas, 0, 0);
        const data = context.getImageData(0, 0, copy.width, copy.height).data;
        for (let i = 0; i < data.length; i += 4)
          if (data[i + 3] > 200 && Math.abs(data[i] - color[0]) < 9 &&
              Math.abs(data[i + 1] - color[1]) < 9 && Math.abs(data[i + 2] - color[2]) < 9) found++;
      }
      return found;""", scene, color)


def test_strategy_is_hidden_and_comes_back(page, made):
    data = report_page.Page(made[0] / "report.html").json["scene-0-data"]
    color = data["strategies"][3]["color"]
    rgb = [int(color[i : i + 2], 16) for i in (1, 3, 5)]
    ActionChains(page).move_to_element(find(page, "values")).perform()
    assert count_color(page, rgb) > 200
    input_of(page, "strategy", "coh-b").click()
    assert count_color(page, rgb) == 0
    input_of(page, "strategy", "coh-b").click()
    assert count_color(page, rgb) > 200


def shown_range(page):
    return [int(input_of(page, name).get_property("value")) for name in ("from", "to")]


def test_zoom_and_back(page):
    input_of(page, "counter", "queries").click()
    assert shown_range(page) == [0, 39]
    plot, x, y = place_of(page, 10)
    _, end, _ = place_of(page, 30)
    ActionChains(page).move_to_element_with_offset(plot, x, y).click_and_hold().move_by_offset(
        end - x, 3).release().perform()
    first, last = shown_range(page)
    assert abs(first - 10) <= 1 and abs(last - 30) <= 1
    ActionChains(page).double_click(plot).perform()
    assert shown_range(page) == [0, 39]
    for name, value in (("from", "5"), ("to", "15")):
        field = input_of(page, name)
        field.send_keys(Keys.CONTROL, "a")
        field.send_keys(value, Keys.TAB)
    assert shown_range(page) == [5, 15]
    find(page, "reset").click()
    assert shown_range(page) == [0, 39]


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


def test_plots_fit_on_paper_with_their_labels(page):
    def measure():
        """Widths of canvas and plot, and where in them frame 30 is labelled, a share."""
        return page.execute_script("""
          const plot = document.querySelector(".plot"), box = plot.getBoundingClientRect();
          const label = [...plot.querySelectorAll(".dygraph-axis-label-x")].find(
            (element) => element.textContent === "30").getBoundingClientRect();
          return [plot.querySelector("canvas").getBoundingClientRect().width, box.width,
                  ((label.left + label.right) / 2 - box.left) / box.width];""")

    before = measure()
    assert before[0] == before[1] > 1000
    page.execute_script("window.dispatchEvent(new Event('beforeprint'))")
    canvas, width, place = measure()
    assert canvas == pytest.approx(680) and width == pytest.approx(680)
    assert place == pytest.approx(before[2], abs=0.001), "the label stays at its frame"
    page.execute_script("window.dispatchEvent(new Event('afterprint'))")
    assert measure() == before


def test_print_shows_the_curves_in_light_colours(page, made, tmp_path):
    pdftoppm = shutil.which("pdftoppm")
    if not pdftoppm:
        pytest.skip("needs poppler-utils")
    page.find_element(By.CSS_SELECTOR, '[data-part="theme"]').click()
    pdf = page.execute_cdp_cmd("Page.printToPDF", {"preferCSSPageSize": True})["data"]
    (tmp_path / "page.pdf").write_bytes(base64.b64decode(pdf))
    subprocess.run([pdftoppm, "-r", "96", tmp_path / "page.pdf", tmp_path / "p"], check=True)
    data = report_page.Page(made[0] / "report.html").json["scene-0-data"]
    color = [int(data["strategies"][3]["color"][i : i + 2], 16) for i in (1, 3, 5)]
    found = 0
    for path in tmp_path.glob("p-*.ppm"):
        picture = np.asarray(Image.open(path)).astype(int)
        found += (np.abs(picture - color).max(axis=2) < 40).sum()
        assert picture[:20, :20].min() == 255, "paper is white"
    assert found > 300, "Coh(B)'s curve is on paper"


def test_nothing_is_fetched(page):
    for select in ("next", "next"):
        find(page, select).click()
    names = page.execute_script("return performance.getEntriesByType('resource').map(e => e.name)")
    assert [name for name in names if not name.startswith("data:")] == []


def test_every_control_has_a_name(page):
    unnamed = page.execute_script("""
      return [...document.querySelectorAll("button, input, select, [tabindex]")].filter((e) =>
        getComputedStyle(e).display !== "none" && !(e.labels && e.labels.length && e.labels[0].textContent.trim()) &&
        !e.getAttribute("aria-label") && !e.textContent.trim()).map((e) => e.outerHTML)""")
    assert unnamed == []
    ids = page.execute_script("return [...document.querySelectorAll('[id]')].map((e) => e.id)")
    assert len(ids) == len(set(ids))
