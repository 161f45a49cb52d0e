#!/usr/bin/env python3
"""Writes every report with the command and looks at it in a headless Chromium.

    check_pages.py SPINCAT SCRATCH-FOLDER [PICTURES-FOLDER]

Fails on console errors, exceptions and network requests, and when what is on a page is not what is in the JSON. Without
Chromium it says so and ends with 77, which CTest takes as skipped.
"""

import json
import os
import shutil
import subprocess
import sys

from browser import Browser, PageError, find_chromium
from object_pages import check_classification, check_object
from pages import NASTY, SMALL, check, check_names, check_theme, check_widths, spincat, text, write_dataset


def check_evaluation(browser, program, data, scratch):
    page = os.path.join(scratch, "evaluation.html")
    found = json.loads(spincat(program, "evaluate", data, "--splits", "6", "--json", "--report", page, *SMALL))
    check_widths(browser, page)
    for key, element in (("mean_class_rate", "#mean-class-rate"), ("overall_rate", "#overall-rate")):
        check(text(browser, element + " .rate") == "%.3f" % found[key], key)
        check(text(browser, element + " .spread") == "%.3f" % found[key + "_std"], key + "_std")
        check(text(browser, element + " .interval") == "%.3f to %.3f" % tuple(found[key + "_interval"]), key + "_interval")
    cells = browser.run("[...document.querySelectorAll('#matrix td')].map((cell) => Number(cell.textContent))")
    check(cells == [count for row in found["confusion"] for count in row], "the confusion matrix differs")
    heads = browser.run("[...document.querySelectorAll('#matrix th.above')].map((head) => head.textContent)")
    check(heads == found["categories"] and NASTY in heads, "the categories differ")
    rates = browser.run("[...document.querySelectorAll('#category-rates .number')].map((rate) => rate.textContent)")
    check(rates == ["%.3f" % found["category_rates"][name]["rate"] for name in found["categories"]], "rates differ")
    check(text(browser, "tr[data-key=list_checksum] .name") == found["run"]["list_checksum"], "checksum")
    mistakes = browser.run("document.querySelectorAll('#matrix td.wrong button').length")
    check(mistakes > 0, "no mistake to look at")
    browser.run("document.querySelector('#matrix td.wrong button').click()")
    times = browser.run("[...document.querySelectorAll('#cell tbody .number')].map((cell) => parseInt(cell.textContent))")
    check(sum(times) == browser.run("Number(document.querySelector('#matrix td.wrong').textContent)"),
          "the objects of a cell do not add up to its count")
    check_names(browser)
    check_theme(browser)
    return page


def check_sweep(browser, program, data, scratch):
    page = os.path.join(scratch, "sweep.html")
    found = json.loads(spincat(program, "sweep", data, "--vary", "spin_points=8,16,32", "--splits", "3", "--json",
                               "--report", page, *SMALL))
    check_widths(browser, page)
    shown = browser.run("[...document.querySelectorAll('#points tbody tr')].map((row) => [...row.cells].map((cell) => cell.textContent))")
    check([[row[0], row[1]] for row in shown] ==
          [[point["values"]["spin_points"], "%.3f ± %.3f" % (point["mean_class_rate"], point["mean_class_rate_std"])]
           for point in found["points"]], "the points differ")
    check(browser.run("document.querySelectorAll('svg.chart circle').length") == 3 * (2 + 5), "dots are missing")
    check_theme(browser)
    page_of_two = os.path.join(scratch, "sweep-of-two.html")
    found = json.loads(spincat(program, "sweep", data, "--vary", "spin_points=8,16", "--vary", "c=1,10,100", "--splits", "3",
                               "--json", "--report", page_of_two, *SMALL))
    check_widths(browser, page_of_two)
    cells = browser.run("[...document.querySelectorAll('td.right')].map((cell) => cell.textContent)")
    check(cells == ["%.3f" % point["mean_class_rate"] for point in found["points"]], "the heat map differs")
    return page


def check_scaling(browser, _program, _data, scratch):
    """The page of experiments/scaling, which no command writes."""
    samples = [[1000, 1, 1, 8.0], [1000, 1, 2, 4.2], [1000, 2, 1, 4.4], [2000, 1, 1, 32.0], [2000, 1, 2, 16.5], [2000, 2, 1, 16.0]]
    model = {"constant": 0.1, "per_unit": 0.0, "per_work": 7.97e-6, "launch": 0.25, "per_byte": 0.0, "largest_error": 0.04}
    predicted = [[2 ** k, max(1, 2 ** k // 16), 0.1 + 32 / 2 ** k] for k in range(11)]
    found = {"mpi": NASTY, "rounds": 3, "load": [0.1, 0.2, 0.3], "divisions": [[NASTY, "2.00 s", "1.00 s", "2.00"]],
             "studies": [{"name": NASTY, "samples": samples, "model": model, "problem": 2000, "predicted": predicted}]}
    source, page = os.path.join(scratch, "scaling.json"), os.path.join(scratch, "scaling.html")
    with open(source, "w", encoding="utf-8") as file:
        json.dump(found, file)
    experiments = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../experiments")
    subprocess.run([sys.executable, "-B", os.path.join(experiments, "scaling_page.py"), source, page], check=True)
    check_widths(browser, page)
    check(text(browser, ".formula") == "T = 0.1 s + 0.00000797 s W / p + 0.25 s [R > 1]", "the formula differs: " + text(browser, ".formula"))
    check(browser.run("document.querySelectorAll('svg.chart circle').length") == 3, "measured points are missing")
    gains = browser.run("[...document.querySelectorAll('.measured tbody tr')].map((row) => row.cells[4].textContent)")
    check(gains == ["1.00", "1.90", "1.82", "1.00", "1.94", "2.00"], "the measured gains differ")
    gains = browser.run("[...document.querySelectorAll('.predicted tbody tr')].map((row) => row.cells[3].textContent)")
    check(gains == ["%.1f" % (predicted[0][2] / seconds) for _, _, seconds in predicted], "the predicted gains differ")
    check_names(browser)
    check_theme(browser)
    return page


CHECKS = (check_evaluation, check_sweep, check_classification, check_object, check_scaling)


def take_pictures(browser, pages, folder):
    os.makedirs(folder, exist_ok=True)
    for page in pages:
        for width in (1280, 390):
            for dark in (False, True):
                browser.open(page, width=width, dark=dark)
                name = os.path.splitext(os.path.basename(page))[0]
                browser.picture(os.path.join(folder, "%s-%d-%s.png" % (name, width, "dark" if dark else "light")), whole=True)


def main():
    program, scratch = sys.argv[1:3]
    if find_chromium() is None:
        print("skipped: no chromium on this machine (scripts/packages.sh: packages_browser)")
        return 77
    shutil.rmtree(scratch, ignore_errors=True)
    data = os.path.join(scratch, "data")
    write_dataset(data)
    with Browser() as browser:
        pages = [check_page(browser, program, data, scratch) for check_page in CHECKS]
        if len(sys.argv) > 3:
            take_pictures(browser, pages, sys.argv[3])
        check(not browser.complaints, "\n".join(browser.complaints))
    print("%d pages are as they should be" % len(pages))
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except PageError as error:
        print("check_pages: %s" % error)
        sys.exit(1)
