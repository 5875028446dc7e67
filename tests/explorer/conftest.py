"""A browser for the explorer's tests: Debian's Chromium, driven by Playwright; and a page in it with carom's engine loaded."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

import carom
from carom.explorer.module import ASSETS

ROOT = Path(__file__).parents[2]
SITE = "http://carom.test"
# WebGL without a graphics card.
ARGUMENTS = [
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-gpu-compositing",
    # each program of the page as one pipeline: in parts, which are linked later, they take a third longer
    "--enable-angle-features=preferMonolithicPipelinesOverLibraries",
    "--disable-angle-features=supportsGraphicsPipelineLibrary",
]
TYPES = {".js": "text/javascript", ".json": "application/json", ".wasm": "application/wasm", ".html": "text/html"}


@pytest.fixture(scope="session")
def chromium() -> Iterator[Any]:
    """A headless Chromium. Where there is none the test is skipped; with CAROM_NEED_BROWSER set, as in CI, it fails."""
    path = os.environ.get("CAROM_CHROMIUM") or shutil.which("chromium") or shutil.which("chromium-browser")
    if path is None:
        if os.environ.get("CAROM_NEED_BROWSER"):
            pytest.fail("expected a chromium to run the explorer's tests in, got none; apt-get install chromium")
        pytest.skip("no chromium; apt-get install chromium, or name one in CAROM_CHROMIUM")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as player:
        browser = player.chromium.launch(executable_path=path, args=ARGUMENTS)
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def engine_page(chromium: Any) -> Iterator[Any]:
    """A page with the engine in ``window.engine``; the repository's files are at the site's root."""

    def serve(route: Any) -> None:
        place = route.request.url.removeprefix(SITE).split("?")[0].lstrip("/")
        file = ROOT / place
        if not place:
            route.fulfill(body="<!doctype html><title>engine</title>", content_type="text/html")
        elif file.is_file():
            route.fulfill(body=file.read_bytes(), content_type=TYPES.get(file.suffix, "application/octet-stream"))
        else:
            route.fulfill(status=404)

    page = chromium.new_page()
    page.route(f"{SITE}/**", serve)
    page.goto(f"{SITE}/")
    assets = ASSETS.relative_to(ROOT).as_posix() if ASSETS.is_relative_to(ROOT) else "src/carom/explorer/assets"
    page.evaluate(
        """async (assets) => {
            const { loadEngine } = await import("/web/engine/engine.js");
            const { recordsOf } = await import("/tests/explorer/engine_records.js");
            const wasm = new Uint8Array(await (await fetch(`/${assets}/engine.wasm`)).arrayBuffer());
            const layout = await (await fetch(`/${assets}/engine.json`)).json();
            Object.assign(window, { wasm, layout, recordsOf, loadEngine, engine: await loadEngine(wasm, layout) });
        }""",
        assets,
    )
    yield page
    page.close()


@pytest.fixture
def evaluate(engine_page: Any) -> Any:
    """A function that runs JavaScript in the page, given a value that JSON can hold, and returns what it returns."""

    def run(code: str, value: Any = None) -> Any:
        # (as text: Playwright's own way takes minutes for large arguments)
        text = engine_page.evaluate(
            f"async (text) => JSON.stringify(await ({code})(JSON.parse(text)))", json.dumps(value)
        )
        return None if text is None else json.loads(text)

    return run


# --- the page itself -----------------------------------------------------------------------------------------------


@pytest.fixture(scope="session")
def page_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The default page."""
    return carom.explore().save(tmp_path_factory.mktemp("explorer") / "page.html")


Opener = Callable[..., Any]


@pytest.fixture(scope="session")
def contexts() -> dict[str, Any]:
    """The browser's contexts, by their settings: a page keeps nothing that the next could find, and shares what is compiled."""
    return {}


@pytest.fixture(scope="session")
def idle_pages() -> dict[str, list[Any]]:
    """Empty pages for the next test, by the settings of their context; a new one is a process, a third of what opening takes."""
    return {}


@pytest.fixture
def open_page(
    chromium: Any, contexts: dict[str, Any], idle_pages: dict[str, list[Any]], page_file: Path
) -> Iterator[Opener]:
    """Open the page (``file``: another one) with the network off; at the end: no error in the console, nothing asked for."""
    opened: list[tuple[str, Any]] = []
    said: list[str] = []

    def log_message(message: Any) -> None:
        if message.type in ("error", "warning"):
            said.append(message.text)

    def log_error(error: Any) -> None:
        said.append(str(error))

    def log_request(request: Any) -> None:
        if not request.url.startswith(("file:", "blob:", "data:", "about:")):
            said.append(request.url)

    listeners = {"console": log_message, "pageerror": log_error, "request": log_request}

    def open_one(
        file: Path = page_file, after: str = "", script: str = "", size: tuple[int, int] = (1280, 720), **settings: Any
    ) -> Any:
        name = repr(settings)
        if name not in contexts:
            contexts[name] = chromium.new_context(offline=True, **settings)
        idle = idle_pages.setdefault(name, [])
        page = idle.pop() if idle and not script else contexts[name].new_page()
        # (a script stays with its page)
        opened.append(("" if script else name, page))
        page.bring_to_front()  # (a page behind another draws one frame a second, and a click waits for two)
        page.set_viewport_size({"width": size[0], "height": size[1]})
        for event, listener in listeners.items():
            page.on(event, listener)
        if script:
            page.add_init_script(script)
        page.goto(file.as_uri() + after)
        page.wait_for_function("() => document.documentElement.dataset.ready")
        return page

    yield open_one
    for name, page in opened:
        if not name:
            page.close()
            continue
        page.mouse.move(-1, -1)
        page.goto("about:blank")
        for event, listener in listeners.items():
            page.remove_listener(event, listener)
        idle_pages[name].append(page)
    # (Chromium says of software WebGL that reading pixels is slow: no fault of the page)
    assert [text for text in said if "GPU stall" not in text and "GL Driver Message" not in text] == []
