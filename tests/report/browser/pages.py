"""What the checks of the pages have in common: small data, the command, and what holds for every page."""

import json
import math
import os
import subprocess

from browser import PageError

NASTY = "<b>\"bed\" & 'x' \U0001FA91 \u05d1\u05d9\u05ea"  # quotes, angle brackets, an emoji, right-to-left letters
SMALL = ["--points", "200", "--spin-points", "32", "--copies", "1", "--image-width", "8", "--bin-size", "0.25", "--threads", "2"]
# How far parts of the page have been moved by others that came later (0 is not at all).
SHIFTS = ("new Promise((done) => { let sum = 0; new PerformanceObserver((list) => { for (const shift of list.getEntries()) sum += shift.value; })"
          ".observe({type: 'layout-shift', buffered: true}); setTimeout(() => done(sum), 100); })")


def check(right, what):
    if not right:
        raise PageError(what)


def write_off(path, points, faces):
    with open(path, "w", encoding="utf-8") as file:
        file.write("OFF\n%d %d 0\n" % (len(points), len(faces)))
        file.writelines("%g %g %g\n" % point for point in points)
        file.writelines("3 %d %d %d\n" % face for face in faces)


def box(x, y, z):
    points = [(x * i, y * j, z * k) for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return points, [face for a, b, c, d in quads for face in ((a, b, c), (a, c, d))]


def cone(radius, height, sides=16):
    ring = [(radius * math.cos(2 * math.pi * i / sides), radius * math.sin(2 * math.pi * i / sides), 0) for i in range(sides)]
    faces = [face for i in range(sides) for face in ((i, (i + 1) % sides, sides), ((i + 1) % sides, i, sides + 1))]
    return ring + [(0, 0, height), (0, 0, 0)], faces


def write_dataset(folder):
    """Three categories, two of which nobody can tell apart: mistakes are certain."""
    for name in (NASTY, "box", "cone"):
        os.makedirs(os.path.join(folder, name))
        for k in range(5):
            shape = cone(0.5, 1.5 + 0.1 * k) if name == "cone" else box(1, 1 + 0.05 * k, 1.2)
            write_off(os.path.join(folder, name, "%s %d.off" % (NASTY if k == 0 else "object", k)), *shape)


def spincat(program, *arguments, code=0):
    done = subprocess.run([program, *arguments], capture_output=True, text=True, encoding="utf-8", check=False)
    check(done.returncode == code, "%s: %s" % (" ".join(arguments), done.stderr))
    return done.stdout


def number(browser, selector):
    return float(text(browser, selector))


def text(browser, selector):
    return browser.run("document.querySelector(%s).textContent" % json.dumps(selector))


def check_theme(browser):
    colour = "getComputedStyle(document.body).backgroundColor"
    before = browser.run(colour)
    browser.run("document.getElementById('theme').click()")
    check(browser.run(colour) != before, "the theme does not change")
    browser.run("document.getElementById('theme').click()")
    check(browser.run(colour) == before, "the theme does not change back")
    browser.run("document.documentElement.dataset.theme = 'dark'")
    browser.call("Emulation.setEmulatedMedia", media="print")
    check(browser.run(colour) == "rgb(255, 255, 255)", "a dark page is printed dark")
    browser.call("Emulation.setEmulatedMedia", media="")


def check_widths(browser, path):
    """Nothing is wider than the window, on a phone either."""
    for width in (390, 1280):
        browser.open(path, width=width)
        check(browser.run(SHIFTS) < 0.02, path + ": its parts jump about while it is loaded")
        check(browser.run("document.documentElement.scrollWidth") <= width, "%s is wider than %d pixels" % (path, width))


def check_names(browser):
    """Names stay text: no element of theirs, and what is shown is what was given."""
    check(browser.run("document.querySelectorAll('main bdi b, main b b, main script').length") == 0, "a name became markup")
    check(browser.run("document.body.textContent.includes(%s)" % json.dumps(NASTY)), "the nasty name is not shown")


def check_turning(browser):
    """Mouse, finger and keys turn the object, and the theme recolours it."""
    picture = "document.querySelector('#viewer canvas').toDataURL()"
    view = "document.getElementById('viewer').dataset.view"
    seen = {browser.run(picture)}
    turns = [("the mouse", lambda: browser.drag("#viewer canvas", 90, 30)), ("a finger", lambda: browser.swipe("#viewer canvas", -60, 40)),
             ("a key", lambda: browser.run("document.getElementById('viewer').dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowLeft'}))"))]
    for name, turn in turns:
        before = browser.run(view)
        turn()
        check(browser.run(view) != before, name + " does not turn the object")
        after = browser.run(picture)
        check(after not in seen, name + " does not redraw the object")
        seen.add(after)
    browser.run("document.getElementById('theme').click()")
    check(browser.run(picture) not in seen, "the theme does not recolour the object")
    browser.run("document.getElementById('theme').click()")
