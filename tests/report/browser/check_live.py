#!/usr/bin/env python3
"""Opens the live page of spincat camera in a headless Chromium.

    check_live.py SPINCAT SCRATCH-FOLDER [PICTURE.png]

Fails on console errors, exceptions and requests of anything but the page's own server, and when the page does not show
the names that are in the JSON. Also asks the server what others must not get. Without Chromium it says so and ends with
77, which CTest takes as skipped.
"""

import http.client
import json
import math
import os
import re
import shutil
import struct
import subprocess
import sys
import zlib

from browser import Browser, PageError, find_chromium
from pages import box, check, spincat, write_off

WIDTH, HEIGHT, FOCAL = 320, 240, 262.5
EYE, SIZE = (0.0, -0.75, 0.7), 0.2


def upright(shape):
    return [(x, z, y) for x, y, z in shape[0]], shape[1]  # y is up in models


def depth_at(u, v):
    """Of a table at z = 0 with two boxes, seen from EYE at 45 degrees, in metres."""
    x, y = (u - (WIDTH - 1) / 2) / FOCAL, (v - (HEIGHT - 1) / 2) / FOCAL
    s = math.sqrt(0.5)
    ray = (x, s - s * y, -s - s * y)
    nearest = -EYE[2] / ray[2]
    if abs(EYE[0] + nearest * ray[0]) > 0.6 or abs(EYE[1] + nearest * ray[1]) > 0.6:
        nearest = 0.0
    for left, wide, high in ((-0.3, 0.22, 0.2), (0.12, 0.06, 0.3)):
        low, top = (left, -0.1, 0.0), (left + wide, -0.1 + wide, high)
        enter, leave = 0.0, 1e9
        for axis in range(3):
            if abs(ray[axis]) > 1e-12:
                a, b = (low[axis] - EYE[axis]) / ray[axis], (top[axis] - EYE[axis]) / ray[axis]
                enter, leave = max(enter, min(a, b)), min(leave, max(a, b))
            elif not low[axis] <= EYE[axis] <= top[axis]:
                enter, leave = 1.0, 0.0
        if enter < leave and (nearest == 0.0 or enter < nearest):
            nearest = enter
    return nearest


def write_depth_png(path):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + struct.pack(">%dH" % WIDTH, *(round(1000 * depth_at(u, v)) for u in range(WIDTH)))
                    for v in range(HEIGHT))
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", WIDTH, HEIGHT, 16, 0, 0, 0, 0))
                   + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def write_recording(folder):
    os.makedirs(folder)
    write_depth_png(os.path.join(folder, "0.png"))
    shutil.copy(os.path.join(folder, "0.png"), os.path.join(folder, "1.png"))
    with open(os.path.join(folder, "camera.txt"), "w", encoding="ascii") as file:
        file.write("fx %g\nfy %g\ncx %g\ncy %g\n" % (FOCAL, FOCAL, (WIDTH - 1) / 2, (HEIGHT - 1) / 2))


def write_dataset(folder):
    for name in ("block & <b>", "pillar"):  # a name that must not become a tag
        os.makedirs(os.path.join(folder, name))
        for k in range(4):
            shape = box(1, 1 + 0.05 * k, 1) if name != "pillar" else box(0.2, 0.2, 1 + 0.1 * k)
            write_off(os.path.join(folder, name, "%d.off" % k), *upright(shape))


def answer_of(port, path, host=None):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=10)
    connection.request("GET", path, headers={"Host": host} if host else {})
    answer = connection.getresponse()
    return answer.status, answer.read()


def start(program, folder, *more):
    camera = subprocess.Popen([program, "camera", "model.spincat", "recording", "--loop", "--realtime", "--json", *more],
                              cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    url = re.search(r"http://\S+", camera.stderr.readline())
    check(url, "the command tells no address")
    return camera, url.group(0), int(url.group(0).split(":")[2].split("/")[0])


def names_of(line):
    return sorted(each["fused"]["category"] for each in json.loads(line)["objects"])


def check_page(program, folder, picture):
    camera, url, port = start(program, folder, "--view", "0")
    try:
        named = names_of(camera.stdout.readline())
        check(named == ["block & <b>", "pillar"], "the JSON names %s" % named)
        with Browser(allowed=(url, "data:", "about:")) as browser:
            browser.visit(url)
            browser.wait_for("Number(document.body.dataset.shown) > 2")
            shown = sorted(browser.run("[...document.querySelectorAll('.object b')].map(e => e.textContent)"))
            check(shown == named, "the page names %s" % shown)
            tags = sorted(browser.run("[...document.querySelectorAll('.tag')].map(e => e.textContent)"))
            check(tags == named, "the picture names %s" % tags)
            apart = browser.run("(() => { const at = (e) => e.getBoundingClientRect(); const tags = [...document."
                                "querySelectorAll('.tag')].map(at).map(b => b.x + b.width / 2); const c = at(document."
                                "getElementById('picture')); return Math.abs(tags[0] - tags[1]) / c.width; })()")
            check(apart > 0.2, "the names do not stand over their objects")
            colours = browser.run("(() => { const c = document.getElementById('picture'); const d = c.getContext('2d')"
                                  ".getImageData(0, 0, c.width, c.height).data; const s = new Set(); for (let i = 0; i < d.length;"
                                  "i += 4) if (d[i] !== d[i + 1] || d[i] !== d[i + 2]) s.add(d.slice(i, i + 3).join());"
                                  "return s.size; })()")
            check(colours > 2, "no object is outlined")
            check("ms" in browser.run("document.getElementById('time').textContent"), "no latency is shown")
            if picture:
                browser.picture(picture)
            check(not browser.complaints, "; ".join(browser.complaints))
        # Another site's page that was led here by its own name gets nothing.
        check(answer_of(port, "/frame", "evil.example:%d" % port)[0] == 403, "a foreign name is answered")
        check(answer_of(port, "/frame", "localhost:%d" % port)[0] == 200, "localhost is not answered")
        check(answer_of(port, "/nothing")[0] == 404, "what is not there is answered")
    finally:
        camera.kill()
        camera.communicate()


def check_token(program, folder):
    """On an address that others can reach, the token decides."""
    camera, url, port = start(program, folder, "--view", "0.0.0.0:0")
    try:
        token = url.split("?token=")[1]
        check(len(token) == 32, "no token in " + url)
        check(answer_of(port, "/")[0] == 403, "the page is answered without the token")
        check(answer_of(port, "/frame?token=" + "0" * 32)[0] == 403, "a wrong token is answered")
        check(answer_of(port, "/?token=" + token)[0] == 200, "the right token is not answered")
    finally:
        camera.kill()
        camera.communicate()


def main():
    program, scratch = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    if not find_chromium():
        print("no Chromium here (scripts/setup browser)")
        return 77
    shutil.rmtree(scratch, ignore_errors=True)
    write_dataset(os.path.join(scratch, "shapes"))
    write_recording(os.path.join(scratch, "recording"))
    model = os.path.join(scratch, "model.spincat")
    spincat(program, "train", os.path.join(scratch, "shapes"), "-o", model, "--views", "4", "--points", "256",
            "--spin-points", "32", "--threads", "2")
    try:
        check_page(program, scratch, sys.argv[3] if len(sys.argv) > 3 else None)
        check_token(program, scratch)
    except PageError as error:
        print("check_live: %s" % error)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
