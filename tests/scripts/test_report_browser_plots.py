"""report.py: the plots of the page, in a real browser and on paper."""

import base64
import shutil
import subprocess

import pytest

pytest.importorskip("jinja2", reason="needs python3-jinja2")
np = pytest.importorskip("numpy")
pytest.importorskip("PIL", reason="needs python3-pil")
pytest.importorskip("selenium", reason="needs python3-selenium")

import fake_run  # noqa: E402
import report_page  # noqa: E402
from PIL import Image  # noqa: E402
from report_browser import browser, cells, find, input_of, made, mean, page  # noqa: E402, F401
from selenium.webdriver.common.action_chains import ActionChains  # noqa: E402
from selenium.webdriver.common.by import By  # noqa: E402
from selenium.webdriver.common.keys import Keys  # noqa: E402


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


def test_ticks_are_plain_numbers(page):
    input_of(page, "counter", "dn").click()
    for counter, allowed in (("triangles", {"0", "100k", "200k"}), ("rarn", {"0", "5", "10"})):
        input_of(page, "counter", counter).click()
        labels = page.find_elements(By.CSS_SELECTOR, "#scene-0 .plot .dygraph-axis-label-y")
        texts = {label.text for label in labels}
        assert texts & allowed and not any(text.endswith(("m", "K")) for text in texts)
        input_of(page, "counter", counter).click()


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


def count_color(page, color, scene=0):
    """Pixels of the first plot's curves that have just this colour."""
    return page.execute_script("""
      const [scene, color] = arguments;
      let found = 0;
      const plot = document.querySelector(`#scene-${scene} .plot`);
      for (const canvas of plot.querySelectorAll("canvas")) {
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
