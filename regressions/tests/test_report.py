"""The page of a regression in a browser, from the file system: it sorts, filters, leads from a hole to its
source line, and shows the record's numbers."""

import json
import shutil
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import pytest
from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.remote.webelement import WebElement
from selenium.webdriver.support.wait import WebDriverWait

from regressions.record import CodeKind, CodePoint, File, Record, Status
from regressions.report.page import page
from regressions.tests import synthetic
from verif.env.sources import ROOT

_BROWSER, _DRIVER = shutil.which("chromium"), shutil.which("chromedriver")

pytestmark = pytest.mark.skipif(
    not (_BROWSER and _DRIVER),
    reason="chromium or chromedriver is not installed (apt-get install chromium chromium-driver)",
)

_OPTIONS = (
    *("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync"),
    "--window-size=1280,900",
)

_VIEWS = ("summary", "plan", "functional", "closure", "code", "source", "mutation", "tests")


def _log(driver: webdriver.Chrome, kind: str) -> list[dict[str, str]]:
    """What a log of the browser got since it was read last."""
    found: list[dict[str, str]] = driver.get_log(kind)  # type: ignore[no-untyped-call]
    return found


class Browser:
    """A browser with the page of a record."""

    def __init__(self, driver: webdriver.Chrome, file: Path) -> None:
        self._driver, self._file = driver, file

    def open(self, fragment: str) -> None:
        """Loads the page anew at a fragment."""
        self._driver.get("about:blank")
        self._driver.get(f"{self._file.as_uri()}#{fragment}")

    def find(self, selector: str) -> WebElement:
        """The first element that matches, waited for."""
        wait = WebDriverWait(self._driver, 20)
        return wait.until(lambda driver: driver.find_element(By.CSS_SELECTOR, selector))

    def texts(self, selector: str) -> list[str]:
        """Texts of all elements that match."""
        script = "return [...document.querySelectorAll(arguments[0])].map((found) => found.textContent)"
        found: list[str] = self._driver.execute_script(script, selector)
        return found

    def run(self, script: str) -> object:
        """What a script returns."""
        return self._driver.execute_script(script)

    def press(self, keys: str) -> None:
        """Keys for what has the focus."""
        self._driver.switch_to.active_element.send_keys(keys)

    @property
    def fragment(self) -> str:
        """Of the address."""
        return self._driver.current_url.partition("#")[2]

    def complaints(self) -> list[str]:
        """What the console has said since it was asked last."""
        return [entry["message"] for entry in _log(self._driver, "browser")]

    def asked(self) -> set[str]:
        """Schemes of all requests since it was asked last."""
        events = [json.loads(entry["message"])["message"] for entry in _log(self._driver, "performance")]
        urls = [e["params"]["request"]["url"] for e in events if e["method"] == "Network.requestWillBeSent"]
        return {url.partition(":")[0] for url in urls}


@pytest.fixture(scope="module")
def some() -> Record:
    """A small record with everything in it."""
    return synthetic.record(1)


@pytest.fixture(scope="module")
def driver(tmp_path_factory: pytest.TempPathFactory) -> Iterator[webdriver.Chrome]:
    """One browser with a new profile, that never looks for another one in the network."""
    options = webdriver.ChromeOptions()
    options.binary_location = str(_BROWSER)
    for option in (*_OPTIONS, f"--user-data-dir={tmp_path_factory.mktemp('profile')}"):
        options.add_argument(option)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    made = webdriver.Chrome(options=options, service=Service(str(_DRIVER)))
    made.get("about:blank")
    # What the browser shows first is no request of the page.
    _log(made, "performance")
    yield made
    made.quit()


def _browser(driver: webdriver.Chrome, record: Record, folder: Path) -> Browser:
    file = folder / "report.html"
    file.write_text(page(record))
    return Browser(driver, file)


@pytest.fixture(scope="module")
def browser(driver: webdriver.Chrome, some: Record, tmp_path_factory: pytest.TempPathFactory) -> Browser:
    """The page of the small record."""
    return _browser(driver, some, tmp_path_factory.mktemp("page"))


@pytest.fixture(autouse=True)
def _quiet(request: pytest.FixtureRequest) -> Iterator[None]:
    """No test leaves an error on the console, and none asks anything of the network."""
    yield
    browser: Browser = request.getfixturevalue("browser")
    assert (browser.complaints(), browser.asked() - {"file", "data", "about"}) == ([], set())


def _percent(good: int, needed: int) -> str:
    return "100 %" if good == needed else f"{1000 * good // needed / 10:.1f} %"


def _cards(record: Record) -> dict[str, tuple[str, str]]:
    """Titles with percentages and numbers, counted here anew."""
    bins = [found for unit in record.coverage for point in unit.points for found in point.bins]
    code = [point for file in record.code for point in file.points]
    judged = sum(unit.mutants - unit.equivalent for unit in record.mutation)
    numbers = {
        "Runs passed": (record.counts()[Status.PASSED], len(record.results)),
        "Promises kept": (sum(p.standing == "passed" for p in record.plan), len(record.plan)),
        "Rules and faults fulfilled": (sum(r.standing == "passed" for r in record.rules), len(record.rules)),
        "Functional bins": (sum(b.hits > 0 for b in bins), sum(not b.excluded for b in bins)),
        **{f"Code: {kind}": _hit([p for p in code if p.kind is kind]) for kind in CodeKind},
        "Mutants killed": (sum(unit.killed for unit in record.mutation), judged),
    }
    return {title: (_percent(*of), f"{of[0]:,} of {of[1]:,}") for title, of in numbers.items()}


def _hit(points: Sequence[CodePoint]) -> tuple[int, int]:
    needed = [point for point in points if not point.excluded]
    return sum(point.hits > 0 for point in needed), len(needed)


def test_the_cards_show_the_records_numbers(browser: Browser, some: Record) -> None:
    browser.open("summary")
    titles, percentages = browser.texts(".card .title"), browser.texts(".card .big")
    numbers = [text.partition(", ")[0] for text in browser.texts(".card .quiet")]
    shown = zip(percentages, numbers, strict=True)
    assert dict(zip(titles, shown, strict=True)) == _cards(some)


def test_each_bucket_has_the_command_that_shows_it_again(browser: Browser, some: Record) -> None:
    browser.open("summary")
    assert browser.texts(".bucket .command code") == [bucket.command for bucket in some.buckets]


def test_the_copy_button_copies_the_command(browser: Browser, some: Record) -> None:
    browser.open("summary")
    clipboard = "{writeText: async (text) => { window.copied = text; }}"
    browser.run(f"Object.defineProperty(navigator, 'clipboard', {{value: {clipboard}}})")
    browser.find(".bucket .copy").click()
    assert browser.run("return window.copied") == some.buckets[0].command


def test_text_of_a_failure_stays_text(browser: Browser) -> None:
    browser.open("summary")
    assert any(synthetic.HOSTILE in text for text in browser.texts(".bucket"))
    assert browser.run("return document.images.length") == 0
    assert browser.run("return document.title") == "Summary: synthetic failed"


def test_a_click_on_a_header_sorts_and_another_one_turns(browser: Browser, some: Record) -> None:
    browser.open("tests")
    head = browser.find("#table-tests th:nth-child(4) button")
    column = "#table-tests tbody td:nth-child(4)"
    seconds = [f"{s:.1f}" for s in sorted(result.seconds for result in some.results)]
    head.click()
    up = browser.texts(column)
    head.click()
    assert (up, browser.texts(column)) == (seconds, seconds[::-1])
    assert browser.find("#table-tests th[aria-sort]").get_attribute("aria-sort") == "descending"


def test_a_filter_leaves_rows_with_all_its_words(browser: Browser, some: Record) -> None:
    browser.open("tests")
    browser.find("#table-tests input").send_keys("Block1 failed")
    expected = [r.id for r in some.results if "block1" in r.id and "failed" in (r.status, r.message[:6])]
    assert browser.texts("#table-tests tbody td:first-child") == expected
    assert browser.texts("#table-tests .count") == [f"{len(expected)} of {len(some.results)}"]


def test_a_chip_leaves_rows_of_its_status(browser: Browser, some: Record) -> None:
    browser.open("tests")
    browser.find("#table-tests .chip").click()
    failed = some.counts()[Status.FAILED]
    assert browser.texts("#table-tests tbody td:nth-child(2)") == ["failed"] * failed


def test_how_a_table_is_sorted_and_filtered_can_be_linked_to(browser: Browser) -> None:
    browser.open("tests")
    browser.find("#table-tests th:nth-child(4) button").click()
    browser.find("#table-tests input").send_keys("block1")
    ids = "#table-tests tbody td:first-child"
    before, fragment = browser.texts(ids), browser.fragment
    browser.open(fragment)
    assert browser.texts(ids) == before != []


def test_a_hole_leads_to_the_line_that_declares_it(browser: Browser) -> None:
    browser.open("functional")
    browser.find("#table-holes input").send_keys(synthetic.HOLE)
    browser.find("#table-holes a.place").click()
    line = browser.find("table.source tr.target")
    _, point, name = synthetic.HOLE.split(".")
    assert browser.find("h1").text == "verif/units/sqrt/coverage.py"
    assert f'"{name}"' in line.text or f'"{point}"' in line.text


def test_holes_are_those_of_the_record_with_their_recipes(browser: Browser, some: Record) -> None:
    browser.open("functional")
    holes = {
        f"{unit.name}.{point.name}.{found.name}": found.recipe
        for unit in some.coverage
        for point in unit.points
        for found in point.bins
        if not found.hits and not found.excluded
    }
    names, recipes = (browser.texts(f"#table-holes tbody td:nth-child({column})") for column in (1, 2))
    assert dict(zip(names, recipes, strict=True)) == holes


def test_a_unit_opens_to_its_points_and_bins(browser: Browser, some: Record) -> None:
    browser.open("functional/sqrt")
    bins = [found.name for point in some.coverage[0].points for found in point.bins]
    assert browser.texts("#table-units tr.detail .inner td:first-child") == bins


def test_a_line_shows_its_hits_and_opens_to_the_runs_that_hit_it(browser: Browser, some: Record) -> None:
    file = next(file for file in some.code if file.path == "hdl/raytracer.v")
    point = next(p for p in file.points if p.kind is CodeKind.BRANCH and p.hits)
    browser.open(f"source/{file.path}:{point.line}")
    marks = browser.find("tr.target .marks")
    shown = int(browser.find("tr.target .hits").text.replace(",", ""))
    marks.click()
    detail = browser.find("tr.target + tr.detail").text
    assert shown >= point.hits
    assert some.code_runs[point.by[0]] in detail


def _hits_of_lines(file: File) -> dict[int, int]:
    """Most hits of a line or branch point that is about a line."""
    found: dict[int, int] = {}
    for point in file.points:
        if point.kind in (CodeKind.LINE, CodeKind.BRANCH):
            for line in point.lines or (point.line,):
                found[line] = max(found.get(line, 0), point.hits)
    return found


def _missed_lines(file: File) -> set[int]:
    """Lines that nothing hits and nothing excludes."""
    excluded = {
        line
        for point in file.points
        if point.excluded and point.kind in (CodeKind.LINE, CodeKind.BRANCH)
        for line in point.lines or (point.line,)
    }
    return {line for line, hits in _hits_of_lines(file).items() if not hits} - excluded


def test_lines_that_nothing_hits_are_marked(browser: Browser, some: Record) -> None:
    file = next(
        file
        for file in some.code
        if set() != _missed_lines(file) != {line for line, hits in _hits_of_lines(file).items() if not hits}
    )
    browser.open(f"source/{file.path}")
    browser.find("table.source")
    marked = {int(text) for text in browser.texts("table.source tr.miss[data-line] > th")}
    assert marked == _missed_lines(file)


def test_each_line_has_its_hits(browser: Browser, some: Record) -> None:
    file = max(some.code, key=lambda file: len(file.points))
    browser.open(f"source/{file.path}")
    browser.find("table.source")
    texts = [text.strip("✗").replace(",", "") for text in browser.texts("table.source td.hits")]
    shown = {line: int(text) for line, text in enumerate(texts, 1) if text}
    assert shown == _hits_of_lines(file)


def test_a_line_opens_to_all_its_points(browser: Browser, some: Record) -> None:
    file = max(some.code, key=lambda file: len(file.points))
    line = next(point.line for point in file.points if point.kind is CodeKind.TOGGLE)
    browser.open(f"source/{file.path}:{line}")
    browser.find("tr.target .marks").click()
    cells = [browser.texts(f"tr.detail .inner td:nth-child({column})") for column in (1, 2, 3)]
    expected = [(p.kind, p.name, f"{p.hits:,}") for p in file.points if p.line == line]
    assert sorted(zip(*cells, strict=True)) == sorted(expected)


def test_an_excluded_line_says_why(browser: Browser, some: Record) -> None:
    file, line = next((f, p.line) for f in some.code for p in f.points if p.excluded)
    browser.open(f"source/{file.path}:{line}")
    assert "cannot be reached" in browser.find("tr.target .why").text


def test_a_source_is_shown_whole(browser: Browser) -> None:
    browser.open("source/hdl/arith/sqrt.v")
    browser.find("table.source")
    shown = "\n".join(browser.texts("table.source .code code"))
    assert shown == (ROOT / "hdl/arith/sqrt.v").read_text().rstrip("\n")


def test_keys_go_to_what_is_missing_and_to_the_filter(browser: Browser) -> None:
    browser.open("source/hdl/raytracer.v")
    browser.find("table.source")
    browser.press("n")
    first = browser.find("tr.target").get_attribute("data-line")
    browser.press("n")
    second = browser.find("tr.target").get_attribute("data-line")
    browser.open("tests")
    browser.press("/")
    browser.press("block2" + Keys.TAB)
    assert int(str(first)) < int(str(second))
    assert browser.find("#table-tests input").get_attribute("value") == "block2"


def test_a_survivor_leads_to_its_line(browser: Browser, some: Record) -> None:
    browser.open("mutation")
    browser.find("#table-survivors a.place").click()
    survivor = some.mutation[0].survivors[0]
    assert browser.find("h1").text == survivor.file
    assert browser.find("tr.target").get_attribute("data-line") == str(survivor.line)


def test_a_survivor_shows_clock_by_clock_what_would_have_shown_it(browser: Browser, some: Record) -> None:
    browser.open(f"mutation/{some.mutation[0].unit}.1")
    browser.find("table.witness")
    heads, cells = browser.texts("table.witness th"), browser.texts("table.witness td")
    assert (heads, cells) == (["clock", "radicand", "valid"], ["0", "7", "1", "1", "5", "0"])


def test_what_each_run_adds_to_the_lines_is_told(browser: Browser, some: Record) -> None:
    browser.open("tests")
    browser.find("#table-runs")
    more = sum(int(text.replace(",", "")) for text in browser.texts("#table-runs tbody td:nth-child(4)"))
    assert browser.texts("#table-runs tbody td:first-child") == list(some.code_runs)
    assert more == sum(len(_lines_hit(file)) for file in some.code)


def _lines_hit(file: File) -> set[int]:
    kinds = (CodeKind.LINE, CodeKind.BRANCH)
    return {
        line
        for point in file.points
        if point.kind in kinds and point.by
        for line in point.lines or (point.line,)
    }


def test_a_fragment_opens_one_run(browser: Browser, some: Record) -> None:
    browser.open(f"tests/{some.results[-1].id}")
    assert some.results[-1].command in browser.find("#table-tests tr.detail").text


def test_each_promise_is_there_with_its_standing(browser: Browser, some: Record) -> None:
    browser.open("plan")
    names, ends = (browser.texts(f"#table-plan tbody td:nth-child({column})") for column in (1, 2))
    expected = [(promise.name, str(promise.standing)) for promise in some.plan]
    assert list(zip(names, ends, strict=True)) == expected


def test_a_rule_leads_to_the_promises_that_fulfil_it(browser: Browser, some: Record) -> None:
    rule = some.rules[0]
    browser.open("plan")
    browser.find(f'#table-rules tr[data-key="{rule.name}"] .opener').click()
    assert browser.texts("#table-rules tr.detail a") == list(rule.promises)
    browser.find("#table-rules tr.detail a").click()
    assert some.plan[0].what in browser.find("#table-plan tr.detail").text


def test_both_curves_are_drawn_to_their_ends(browser: Browser, some: Record) -> None:
    browser.open("closure/sqrt")
    closure, random = some.curves[:2]
    legend = browser.find("figcaption").text
    assert len(browser.texts("svg path.curve")) == 2
    assert f"random {100 * len(random.steps) // random.bins}" in legend
    assert f"closure {100 * len(closure.steps) // closure.bins}" in legend


@pytest.mark.parametrize("view", _VIEWS)
def test_a_regression_that_measured_nothing_has_a_page(
    browser: Browser, driver: webdriver.Chrome, some: Record, tmp_path: Path, view: str
) -> None:
    nothing = {
        "coverage": (),
        "curves": (),
        "code": (),
        "code_runs": (),
        "mutation": (),
        "plan": (),
        "rules": (),
    }
    bare = _browser(driver, replace(some, **nothing), tmp_path)  # type: ignore[arg-type]
    bare.open(view)
    assert bare.find("h1").text


def test_a_large_table_is_drawn_as_far_as_it_is_looked_at(
    browser: Browser, driver: webdriver.Chrome, tmp_path: Path
) -> None:
    record = synthetic.record(2, synthetic.Size(results=1_500, bins=3_000))
    large = _browser(driver, record, tmp_path)
    large.open("tests")
    rows = "return document.querySelectorAll('#table-tests tbody tr').length"
    large.find("#table-tests tbody tr")
    first = large.run(rows)
    large.run("document.querySelector('#table-tests tbody tr:last-child').scrollIntoView()")
    WebDriverWait(driver, 20).until(lambda _: int(str(large.run(rows))) > int(str(first)))
    assert int(str(first)) < 300
    assert large.texts("#table-tests .count") == ["1,500"]


@pytest.mark.parametrize("width", [390, 1280])
@pytest.mark.parametrize("view", _VIEWS)
def test_nothing_is_wider_than_the_screen(
    browser: Browser, driver: webdriver.Chrome, view: str, width: int
) -> None:
    size = {"width": width, "height": 800, "deviceScaleFactor": 1, "mobile": False}
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    browser.open(view)
    browser.find("h1")
    wide = browser.run("return document.documentElement.scrollWidth")
    driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    assert int(str(wide)) <= width


def test_a_request_of_a_page_would_be_noticed(
    browser: Browser, driver: webdriver.Chrome, some: Record, tmp_path: Path
) -> None:
    (tmp_path / "page.html").write_text('<img src="http://127.0.0.1:9/missing.png">')
    other = Browser(driver, tmp_path / "page.html")
    other.open("summary")
    WebDriverWait(driver, 20).until(lambda _: other.complaints())
    assert "http" in other.asked()
