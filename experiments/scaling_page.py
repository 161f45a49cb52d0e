#!/usr/bin/env python3
"""Writes what experiments/scaling measured as a page of the same kind as spincat's reports (docs/guide/reports.md).

    experiments/scaling_page.py build/scaling.json build/scaling.html
"""

import json
import pathlib
import re
import sys

SCRIPTS = pathlib.Path(__file__).resolve().parent
PAGE = SCRIPTS.parent / "src/spincat/report/page"


def page(result):
    """The template of all reports, filled; "<" can only be inside a string of the JSON."""
    data = json.dumps({"kind": "scaling", "result": result}, ensure_ascii=False).replace("<", "\\u003c")
    values = {"style": (PAGE / "page.css").read_text(encoding="utf-8"), "data": data, "parts": "",
              "script": (PAGE / "common.js").read_text(encoding="utf-8") + (SCRIPTS / "scaling.js").read_text(encoding="utf-8")}
    template = (PAGE / "page.html").read_text(encoding="utf-8")
    return re.sub(r"\{\{(\w+)\}\}", lambda name: values[name.group(1)], template)


def write(source, target):
    result = json.loads(pathlib.Path(source).read_text(encoding="utf-8"))
    pathlib.Path(target).write_text(page(result), encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    write(*sys.argv[1:])
