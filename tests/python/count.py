"""Prints how many tests of a JUnit report passed, failed and were skipped; none of each if there is no report."""

import sys
from pathlib import Path
from xml.etree import ElementTree


def count(text):
    """(passed, failed, skipped) of pytest's report; an error in a fixture counts as a failure."""
    suite = ElementTree.fromstring(text).find("testsuite")
    tests, failures, errors, skipped = (int(suite.get(key)) for key in ("tests", "failures", "errors", "skipped"))
    return tests - failures - errors - skipped, failures + errors, skipped


if __name__ == "__main__":
    report = Path(sys.argv[1]).read_text()
    print(*(count(report) if report else (0, 0, 0)))
