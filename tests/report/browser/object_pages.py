"""The pages with objects in 3D: classify and info."""

import json
import os

from pages import NASTY, SMALL, check, check_names, check_theme, check_turning, check_widths, number, spincat, text, write_off

SHARES = ("(() => { const part = readPart(objects[current].part); let sum = 0; for (const each of part.evidence.parts)"
          " for (const share of sharesOf(each.values)) sum += share * each.strongest; return sum; })()")


def near(a, b, allowed):
    return abs(a - b) <= allowed


def check_named(browser, index, found):
    """What the page says of one object is what --json says."""
    browser.run("showObject(%d)" % index)
    check(text(browser, "#name") == found["category"], "the name differs")
    check(near(number(browser, "#confidence"), found["confidence"], 0.005 + 1e-9), "the confidence differs")
    categories = browser.run("categories")
    check(text(browser, "#votes") == "%d of %d" % (found["votes"][found["category"]], len(categories) - 1), "the votes differ")
    votes = {int(c): int(n) for c, n in browser.run("[...document.querySelectorAll('[data-votes]')].map((cell) => [cell.dataset.votes, cell.textContent])")}
    check(votes == {c: found["votes"][name] for c, name in enumerate(categories)}, "the table's votes differ")
    for judge in found["judges"]:
        a, b = categories.index(judge["a"]), categories.index(judge["b"])
        cell = "#judges td[data-a='%d'][data-b='%d']" % (a, b)
        check(near(number(browser, cell), judge["margin"], 0.0055), "a margin differs")
        check(near(number(browser, "#judges td[data-a='%d'][data-b='%d']" % (b, a)), -judge["margin"], 0.0055), "a margin differs")
        browser.run("document.querySelector(%s).click()" % json.dumps(cell + " button"))
        check(near(number(browser, "#judge .margin"), abs(judge["margin"]), 0.0005 + 1e-6), "the chosen judge's margin differs")
        if abs(judge["margin"]) > 0.0005:
            check(text(browser, "#judge bdi:last-of-type") == judge["vote"], "the chosen judge's vote differs")


def check_evidence(browser, found, exact):
    check(text(browser, "#evidence-kind").startswith("Exact" if exact else "By leaving out"), "the kind of evidence is not told")
    winner, runner_up = browser.run("(({winner, runner_up}) => [categories[winner], categories[runner_up]])(readPart(objects[current].part).evidence)")
    check(winner == found["category"], "the winner differs")
    margin = next(judge["margin"] * (1 if judge["a"] == winner else -1) for judge in found["judges"] if {judge["a"], judge["b"]} == {winner, runner_up})
    check(near(browser.run("Number(document.getElementById('margin').dataset.margin)"), margin, 1e-6), "the margin differs")
    check(near(number(browser, "#margin"), abs(margin), 0.0005 + 1e-6), "the margin shown differs")
    if exact:
        check(near(browser.run(SHARES), margin, 0.002), "the shares do not add up to the margin")
    picture = "document.querySelector('#viewer canvas').toDataURL()"
    if browser.run("readPart(objects[current].part).evidence.images.length") == 0:
        check(exact and abs(margin) < 1e-3, "there is no evidence")  # but for two categories of the same shapes
        check("No spin point speaks" in text(browser, "#evidence"), "that there is no evidence is not told")
        return
    before = browser.run(picture)
    browser.run("document.querySelector('#evidence .pictures button').click()")
    check(browser.run(picture) != before, "a chosen spin image's point is not shown")
    check(browser.run("[...document.querySelectorAll('#evidence .pictures canvas')].every((image) => image.width > 0 && "
                      "new Set(image.getContext('2d').getImageData(0, 0, image.width, image.height).data).size > 3)"), "a spin image is empty")


def check_classification(browser, program, data, scratch):
    files = [data, os.path.join(scratch, "missing.off")]
    for kernel in ("rbf", "linear"):
        model = os.path.join(scratch, kernel + ".spincat")
        page = os.path.join(scratch, "classification.html")
        spincat(program, "train", data, "-o", model, "--kernel", kernel, *SMALL)
        lines = spincat(program, "classify", model, *files, "--votes", "--json", "--report", page, code=2)
        found = [json.loads(line) for line in lines.splitlines()]
        check_widths(browser, page)
        check(browser.run("objects.length") == len(found) == 16, "objects are missing")
        for index in (0, 7, 14):
            check_named(browser, index, found[index])
            check_evidence(browser, found[index], kernel == "linear")
        browser.run("showObject(15)")
        check(text(browser, "#error") == found[15]["error"], "the error differs")
        browser.run("document.querySelector('#objects .choice').click()")
        check(text(browser, "#name") == found[0]["category"], "the list does not choose")
    check_names(browser)
    check_turning(browser)
    check_theme(browser)
    return page


def check_object(browser, program, data, scratch):
    file = os.path.join(scratch, NASTY + ".off")
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (5, 5, 5)]
    faces = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 2, 3), (0, 0, 1), (2, 1, 0)]  # the fourth is flipped, then a flat and a repeated one
    write_off(file, points, faces)
    page = os.path.join(scratch, "object.html")
    found = json.loads(spincat(program, "info", file, "--json", "--report", page))
    check([found["defects"][key] for key in ("flipped_triangles", "flat_triangles", "repeated_triangles")] == [1, 1, 1], "defects")
    check_widths(browser, page)
    facts = dict(browser.run("[...document.querySelectorAll('#facts tr')].map((row) => [row.dataset.key, row.cells[1].textContent])"))
    check(facts["kind"] == found["kind"] and int(facts["vertices"]) == found["points"] and int(facts["triangles"]) == found["triangles"], "facts")
    for key in ("area", "resolution"):
        check(near(float(facts[key]), found[key], 1e-5 * found[key]), key)
    check([float(each) for each in facts["size"].split(" × ")] == found["size"], "the size differs")
    defects = dict(browser.run("[...document.querySelectorAll('#defects tr')].map((row) => [row.dataset.key, Number(row.cells[1].textContent)])"))
    of_meshes = {key: count for key, count in found["defects"].items() if key != "lone_points"}
    check(defects == of_meshes, "the defects differ")
    picture = "document.querySelector('#viewer canvas').toDataURL()"
    for layer in ("surface", "normals", "spin", "flipped_triangles"):
        before = browser.run(picture)
        browser.run("document.getElementById('show-%s').click()" % layer)
        check(browser.run(picture) != before, layer + " cannot be shown or hidden")
    check_names(browser)
    check_turning(browser)
    check_theme(browser)
    return page
