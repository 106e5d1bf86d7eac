"""Documents lead where they say, and the guide's table of contents holds every page."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
LINK = re.compile(r"\]\(([^)\s]+)\)")
PAGES = [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md"), *ROOT.glob("fmu-*/*.md"), *ROOT.glob("examples/**/*.md")]
PAGES = [page for page in PAGES if "book" not in page.relative_to(ROOT).parts]


def anchors(page):
    """Headings as anchors, as GitHub and mdBook make them."""
    text = re.sub(r"```.*?```", "", page.read_text(), flags=re.DOTALL)
    headings = re.findall(r"^#+ (.+)$", text, flags=re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_link_leads_to_a_file_and_its_heading(page):
    """Links to other sites are not tried: tests need no network."""
    text = re.sub(r"```.*?```", "", page.read_text(), flags=re.DOTALL)
    broken = []
    for link in LINK.findall(text):
        if re.match(r"[a-z]+:", link):
            continue
        path, _, anchor = link.partition("#")
        target = (page.parent / path) if path else page
        if not target.exists() or (anchor and target.suffix == ".md" and anchor not in anchors(target)):
            broken.append(link)
    assert broken == []


def test_the_table_of_contents_holds_every_page_of_the_guide():
    """docs/SUMMARY.md is what mdBook builds the site from."""
    listed = set(LINK.findall((ROOT / "docs/SUMMARY.md").read_text()))
    assert {f"guide/{page.name}" for page in (ROOT / "docs/guide").glob("*.md")} <= listed
