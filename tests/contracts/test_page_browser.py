"""Pages in headless Chromium: they work by hand and by keyboard, move where they may, and are clean for axe-core.

Screenshots are compared with each other, not with stored ones: letters differ from machine to machine, what a picture means
does not.
"""

import io
import re
import shutil

import numpy as np
import pytest
from page_answers import NAMES, document, made

from mouse_cli.batch.outcome import Outcome
from mouse_cli.page.index import index

AXE = ("frequencies", "drawn", "one-of", "arrangements")
RING = {"light": (163, 57, 10), "dark": (255, 157, 102)}  # --place of page.css
MOVED = (11, 79, 158)  # --after


@pytest.fixture(scope="module")
def browser():
    """Headless Chromium, where there is one."""
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    system = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    with playwright.sync_playwright() as running:
        try:
            found = running.chromium.launch(executable_path=system, args=["--no-sandbox"])
        except playwright.Error as error:
            pytest.skip(f"no Chromium to open pages in: {error.message.splitlines()[0]}")
        yield found
        found.close()


@pytest.fixture
def opened(browser, tmp_path):
    """Opens an answer's page; what it says on the console and what it asks for is collected beside it."""
    contexts = []

    def open_page(name: str, unfolded: bool = True, text: str | None = None, **settings):
        path = tmp_path / f"{name}.html"
        path.write_text(made(name) if text is None else text, "utf-8")
        settings = {"reduced_motion": "reduce", **settings}
        contexts.append(browser.new_context(permissions=["clipboard-read", "clipboard-write"], **settings))
        found, said, asked = contexts[-1].new_page(), [], []
        found.on("console", lambda message: said.append(message.text))
        found.on("pageerror", lambda error: said.append(str(error)))
        found.on("request", lambda request: asked.append(request.url))
        found.goto(path.as_uri())
        if unfolded:
            found.evaluate("for (const each of document.querySelectorAll('details')) each.open = true")
        return found, said, asked

    yield open_page
    for context in contexts:
        context.close()


def picture(taken: bytes) -> np.ndarray:
    """Pixels (h, w, 3) of a screenshot, 0 to 255."""
    image = pytest.importorskip("matplotlib.image", reason="matplotlib reads the screenshots")
    return np.rint(255 * image.imread(io.BytesIO(taken), format="png")[..., :3])


def of_colour(pixels: np.ndarray, colour: tuple[int, int, int]) -> tuple[np.ndarray, np.ndarray]:
    """Rows and columns of the pixels of nearly that colour."""
    return np.nonzero(np.abs(pixels - colour).max(axis=2) < 40)


@pytest.mark.parametrize("name", NAMES)
def test_every_control_and_nothing_asked_for(opened, name):
    found, said, asked = opened(name)
    found.evaluate("for (const head of document.querySelectorAll('thead button, .copy')) head.click()")
    for slider in found.locator(".controls input").all():
        slider.press("ArrowRight")
    for mode in range(found.locator(".mode option").count()):
        found.locator(".mode").select_option(index=mode)
    for _ in range(2 * found.locator(".play").count()):
        found.locator(".play").press("Enter")
    assert said == [] and len(asked) == 1


@pytest.mark.parametrize(("width", "height"), [(1280, 900), (390, 844)])
@pytest.mark.parametrize("name", NAMES)
def test_folded_it_is_short_and_begins_with_the_answer(opened, name, width, height):
    """Verdict and, where there is a structure, its drawing begin on the first screen; a link opens what is folded."""
    found, said, _ = opened(name, unfolded=False, viewport={"width": width, "height": height})
    assert found.evaluate("document.documentElement.scrollHeight") <= 2.5 * height
    for part in (".verdict", ".ring:not(.rival)") if name in ("drawn",) else (".verdict",):
        box = found.locator(part).first.bounding_box()
        assert box["y"] + box["height"] <= height
    folded = found.locator("main > section > details").first
    if folded.count():
        key = folded.evaluate("each => each.parentElement.id")
        found.locator(f"nav a[href='#{key}']").click()
        found.wait_for_function("key => document.getElementById(key).querySelector('details').open", arg=key)
    assert said == []


def test_sorting(opened):
    found, _, _ = opened("shapes")
    truth = [mode["revised_hz"] for mode in document("shapes")["modes"]]
    table = found.locator("table", has_text="Natural frequencies of test and the model")
    head = table.locator("th", has_text="revised, Hz")
    for order, looks in ((sorted(truth), "ascending"), (sorted(truth, reverse=True), "descending")):
        head.locator("button").click()
        assert head.get_attribute("aria-sort") == looks
        column = table.locator("tbody tr td:nth-child(6)").evaluate_all(
            "cells => cells.map(c => Number(c.dataset.value))"
        )
        assert column == pytest.approx(order, rel=1e-11)


def test_copying(opened):
    found, _, _ = opened("shapes")
    found.locator("#parameters .copy").click()
    text = found.evaluate("navigator.clipboard.readText()")
    rows = [line.split("\t") for line in text.splitlines()]
    truth = document("shapes")["parameters"]
    assert [row[0] for row in rows[1:]] == [parameter["name"] for parameter in truth]
    assert [float(row[4]) for row in rows[1:]] == pytest.approx([p["posterior"] for p in truth], rel=1e-11)


def test_a_phone_and_paper(opened):
    """No page scrolls sideways at 360 px; on paper there are no controls, and colours are those of paper."""
    for name in NAMES:
        found, _, _ = opened(name, viewport={"width": 360, "height": 640}, color_scheme="dark")
        assert found.evaluate("document.documentElement.scrollWidth <= innerWidth"), name
        assert found.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(21, 24, 28)"
        found.emulate_media(media="print")
        assert found.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
        assert not found.locator(".copy").first.is_visible()
        assert not any(each.is_visible() for each in found.locator(".controls").all())
    assert found.pdf().startswith(b"%PDF")


def drawn(found) -> str:
    """The deformed structure, as it stands."""
    return found.locator(".stage path.moved").first.get_attribute("d")


def numbers(path: str) -> np.ndarray:
    return np.array([float(x) for x in re.findall(r"-?[0-9.]+", path)])


def moves(found) -> bool:
    """Whether it stands otherwise within a second."""
    before = drawn(found)
    try:
        found.wait_for_function(
            "before => document.querySelector('.stage path.moved').getAttribute('d') !== before",
            arg=before,
            timeout=1000,
        )
    except Exception as error:
        if type(error).__name__ != "TimeoutError":
            raise
        return False
    return True


def test_it_plays_and_pauses(opened):
    found, _, _ = opened("frequencies", reduced_motion="no-preference")
    found.locator(".stage").scroll_into_view_if_needed()
    assert moves(found)
    play = found.locator(".play")
    assert play.text_content() == "Pause"
    play.press("Enter")
    assert play.text_content() == "Play" and not moves(found)
    still = picture(found.locator(".stage").screenshot())
    play.press("Enter")
    assert moves(found)
    assert (picture(found.locator(".stage").screenshot()) != still).any()


def test_reduced_motion_stands_still_until_it_is_asked_to_play(opened):
    found, _, _ = opened("frequencies")
    found.locator(".stage").scroll_into_view_if_needed()
    before = picture(found.locator(".stage").screenshot())
    assert not moves(found)
    assert (picture(found.locator(".stage").screenshot()) == before).all()
    found.locator(".play").press("Space")
    assert moves(found)


def test_modes_and_views(opened):
    """Each mode has its own drawing and its title; a turned structure stands otherwise, at rest too."""
    found, _, _ = opened("frequencies")
    shapes = document("frequencies")["geometry"]["shapes"]
    seen = []
    for i, shape in enumerate(shapes):
        found.locator(".mode").select_option(index=i)
        assert found.locator(".now").text_content().startswith(f"Mode {shape['mode']}, ")
        seen.append(drawn(found))
    assert len(set(seen)) == len(shapes)
    before = found.locator(".stage path.still").first.get_attribute("d")
    found.locator(".turn").press("ArrowLeft")
    assert found.locator(".stage path.still").first.get_attribute("d") != before


def test_the_script_draws_what_python_drew(opened):
    """Where the view is as it was, both say the same to a tenth of a unit, up to the rounding of the data."""
    for name in ("beam", "frequencies"):
        found, _, _ = opened(name)
        before = numbers(drawn(found))
        found.evaluate("document.querySelector('.mode').dispatchEvent(new Event('change'))")
        assert np.abs(numbers(drawn(found)) - before).max() < 0.3


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_marked_place_is_where_it_should_be(opened, scheme):
    """The spring is at 3TX, 0.6 of the way along the chain of equal steps: the ring's pixels are about that point."""
    found, _, _ = opened("drawn", color_scheme=scheme)
    assert document("drawn")["verdict"]["site"]["position"][0] == pytest.approx(0.3)
    stage = found.locator(".stage")
    found.evaluate("for (const each of document.querySelectorAll('.names')) each.remove()")
    pixels = picture(stage.screenshot())
    rows, columns = of_colour(pixels, RING[scheme])
    middle = (columns.min() + columns.max()) / 2
    box = found.evaluate(
        "(() => { const b = document.querySelector('.stage path.moved').getBBox(); return [b.x, b.width]; })()"
    )
    scale = pixels.shape[1] / found.evaluate("document.querySelector('.stage').viewBox.baseVal.width")
    assert middle == pytest.approx((box[0] + 0.6 * box[1]) * scale, abs=2)
    assert np.ptp(rows) == pytest.approx(np.ptp(columns), abs=2)


def test_dark_is_dark(opened):
    bright = {}
    for scheme in ("light", "dark"):
        found, _, _ = opened("beam", color_scheme=scheme)
        bright[scheme] = picture(found.screenshot()).mean()
    assert bright["light"] > 200 and bright["dark"] < 60


@pytest.mark.parametrize("name", AXE)
def test_axe_is_clean(opened, name):
    """axe-core, all of its rules that are not experimental, in light; contrast again in the dark."""
    axe = pytest.importorskip("axe_playwright_python.sync_playwright", reason="axe-playwright-python is not installed")
    found, _, _ = opened(name)
    told = axe.Axe().run(found)
    assert [(each["id"], each["nodes"][0]["html"]) for each in told.response["violations"]] == []
    assert len(told.response["passes"]) > 10
    found.emulate_media(color_scheme="dark")
    again = axe.Axe().run(found, options={"runOnly": ["color-contrast"]})
    assert again.response["violations"] == []


def test_jobs_of_a_batch_are_filtered(opened):
    """By a word and by ending, together; what is hidden is said, and axe finds nothing."""
    axe = pytest.importorskip("axe_playwright_python.sync_playwright", reason="axe-playwright-python is not installed")
    ended = ["converged", "converged, model form rejected", "converged", "rejected MD201"]
    jobs = [
        Outcome(f"{name}.yaml", "run", code, end, (), 0, (), False, 0.1, False, f"{name}.json")
        for name, end, code in zip(("beam", "frame", "beam_2", "mast"), ended, (0, 1, 0, 4), strict=True)
    ]
    found, said, asked = opened("batch", text=index(jobs, {"beam.json": "beam.html"}, "."))
    shown = lambda: found.locator("tbody tr:visible th").all_inner_texts()
    assert len(shown()) == 4 and len(asked) == 1 and said == []
    assert axe.Axe().run(found).response["violations"] == []
    found.select_option("#ended", "converged")
    assert shown() == ["beam.yaml", "beam_2.yaml"]
    found.fill("#word", "BEAM_")
    assert shown() == ["beam_2.yaml"] and found.locator("#spoken").inner_text() == "1 of 4 jobs"


def test_without_scripts_it_is_a_drawing(browser, opened):
    found, _, _ = opened("drawn", java_script_enabled=False)
    assert found.locator(".stage").is_visible() and not found.locator(".controls").is_visible()
    rows, _ = of_colour(picture(found.locator(".stage").screenshot()), MOVED)
    assert len(rows) > 200
