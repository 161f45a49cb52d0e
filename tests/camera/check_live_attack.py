#!/usr/bin/env python3
"""Does to the live page of spincat camera what a bad client would, and runs it many times for a moment.

    check_live_attack.py SPINCAT SCRATCH-FOLDER [IDLE-CONNECTIONS [RUNS]]

Fails when a run does not end by itself, when a client keeps others from the page, stops the frames, costs 10 MB or keeps
the command from ending, or when somebody without the token is answered.
"""

import os
import re
import resource
import shutil
import signal
import socket
import subprocess
import sys
import threading

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../report/browser"))

from check_live import write_dataset, write_recording  # noqa: E402
from pages import check, spincat  # noqa: E402

LONGEST = 60  # seconds that nothing of this may take: then it hangs
MOST_MEMORY = 10_000  # kB that clients may cost
MOST_DESCRIPTORS = 64


class Camera:
    """The command with a live page, over a recording without an end unless told otherwise."""

    def __init__(self, program, folder, *more, view="0", loop=True):
        words = [program, "camera", "model.spincat", "recording", "--view", view, "--json", "--threads", "1", "--realtime"]
        self.process = subprocess.Popen(words + (["--loop"] if loop else []) + list(more), cwd=folder, text=True,
                                        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        line = self.process.stderr.readline()
        found = re.search(r"http://(\[[0-9a-f:]+\]|[^:/]+):(\d+)/(?:\?token=(\w+))?", line)
        check(found, "no address: " + line)
        self.host, self.port, self.token = found.group(1).strip("[]"), int(found.group(2)), found.group(3)
        if self.host == "0.0.0.0":
            self.host = "127.0.0.1"

    def connect(self):
        return socket.create_connection((self.host, self.port), LONGEST)

    def head(self, path="/", host=None, method="GET"):
        name = "[%s]" % self.host if ":" in self.host else self.host
        return ("%s %s HTTP/1.1\r\nHost: %s\r\n" % (method, path, host or "%s:%d" % (name, self.port))).encode()

    def ask(self, request):
        """Status and body of the answer to what is sent."""
        with self.connect() as client:
            try:
                client.sendall(request)
            except OSError:
                pass  # refused before all of it was sent
            answer = b""
            try:
                while more := client.recv(65536):
                    answer += more
            except OSError:
                pass
        return int(answer[9:12]) if answer.startswith(b"HTTP/1.1 ") else None, answer.partition(b"\r\n\r\n")[2]

    def get(self, path="/", host=None, more=b""):
        return self.ask(self.head(path, host) + more + b"Connection: close\r\n\r\n")

    def frame(self, after=0):
        status, body = self.get("/frame?after=%d" % after)
        check(status == 200, "no frame after %d: %s" % (after, status))
        return int.from_bytes(body[:4], "little")

    def memory(self):
        with open("/proc/%d/status" % self.process.pid, encoding="ascii") as file:
            return int(re.search(r"VmRSS:\s+(\d+)", file.read()).group(1))

    def descriptors(self):
        return len(os.listdir("/proc/%d/fd" % self.process.pid))

    def end(self, expected=130):
        if expected == 130:
            self.process.send_signal(signal.SIGINT)
        try:
            code = self.process.wait(LONGEST)
        except subprocess.TimeoutExpired:
            self.process.kill()
            check(False, "the command does not end")
        check(code == expected, "exit code %d: %s" % (code, self.process.stderr.read()))


def run(program, folder, *words, **more):
    try:
        return subprocess.run([program, "camera", "model.spincat", *words, "--json", "--threads", "1"], cwd=folder,
                              text=True, capture_output=True, stdin=subprocess.DEVNULL, timeout=LONGEST, check=False, **more)
    except subprocess.TimeoutExpired:
        return check(False, "does not end: %s" % " ".join(words))


def check_short_runs(program, folder, runs):
    """It is over before the page has been asked for, or even listens."""
    whole = os.path.join(folder, "recording")
    for name, count, expected in (("one", 1, 0), ("three", 3, 0), ("damaged", 2, 2)):
        copy = os.path.join(folder, name)
        os.makedirs(copy)
        shutil.copy(os.path.join(whole, "camera.txt"), copy)
        for k in range(count):
            shutil.copy(os.path.join(whole, "0.png"), os.path.join(copy, "%d.png" % k))
            if name == "damaged":
                os.truncate(os.path.join(copy, "%d.png" % k), 100)
        for _ in range(runs):
            code = run(program, folder, name, "--view", "0").returncode
            check(code == expected, "%s: exit code %d" % (name, code))


def check_answers(camera):
    other = "evil.example:%d" % camera.port
    close = b"Connection: close\r\n\r\n"
    for what, expected, answer in (
            ("the page", 200, camera.get()),
            ("another name", 403, camera.get("/frame", other)),
            ("no name", 403, camera.ask(b"GET /frame HTTP/1.0\r\n\r\n")),
            ("two names", 400, camera.ask(camera.head() + b"Host: " + other.encode() + b"\r\n" + close)),
            ("our name in upper case", 200, camera.get("/", "LOCALHOST:%d" % camera.port)),
            ("another site's page", 403, camera.get("/frame", more=b"Sec-Fetch-Site: cross-site\r\n")),
            ("a path out of the page", 404, camera.get("/../../etc/passwd")),
            ("no HTTP", 400, camera.ask(b"\x00\xff\xfe GARBAGE\r\n\r\n")),
            ("POST", 405, camera.ask(camera.head(method="POST") + b"Content-Length: 5\r\n\r\nabcde")),
            ("a body", 413, camera.ask(camera.head() + b"Content-Length: 5\r\n\r\nabcde")),
            ("a long address", 431, camera.ask(b"GET /" + b"a" * 100_000)),
            ("many headers", 431, camera.ask(camera.head() + b"X: y\r\n" * 50_000)),
            ("ranges", 200, camera.get(more=b"Range: bytes=" + b",".join([b"0-"] * 400) + b"\r\n"))):
        check(answer[0] == expected, "%s: status %s, not %d" % (what, answer[0], expected))
    with camera.connect() as client:  # one connection for several requests
        for _ in range(3):
            client.sendall(camera.head("/nothing?") + b"\r\n")
            if b" 404 " in client.recv(65536):
                break
        else:
            check(False, "no answer on a connection that stays open")


def check_floods(camera):
    megabyte = b"a" * (1 << 20)
    for what, head in (("a header", camera.head() + b"X: "), ("an address", b"GET /"),
                       ("a body", camera.head(method="POST") + b"Content-Length: 9000000000\r\n\r\n"),
                       ("chunks", camera.head(method="POST") + b"Transfer-Encoding: chunked\r\n\r\n100000\r\n"),
                       ("another name's body", camera.head(host="evil.example", method="POST") +
                        b"Content-Length: 9000000000\r\n\r\n")):
        sent = 0
        with camera.connect() as client:
            try:
                client.sendall(head)
                while sent < 1 << 30:
                    sent += client.send(megabyte)
            except OSError:
                pass
        check(sent < 1 << 30, "%s without an end is taken" % what)


class Drip:
    """A client that sends its request byte by byte, for ever."""

    def __init__(self, camera):
        self.stop = threading.Event()
        self.thread = threading.Thread(target=self.send, args=(camera,), daemon=True)
        self.thread.start()

    def send(self, camera):
        while not self.stop.is_set():
            try:
                with camera.connect() as client:
                    client.sendall(camera.head())
                    while not self.stop.wait(0.2):
                        client.sendall(b"X")
            except OSError:
                self.stop.wait(0.2)

    def end(self):
        self.stop.set()
        self.thread.join()


def check_attacks(program, folder, idle):
    camera = Camera(program, folder)
    check_answers(camera)
    before, seen = camera.memory(), camera.frame()
    drips = [Drip(camera) for _ in range(5)]
    clients = []
    for k in range(idle):
        client = camera.connect()
        if k % 4 == 1:
            client.sendall(camera.head()[:20])  # and no more
        elif k % 4 == 2:
            client.sendall(camera.head("/frame?after=0") + b"\r\n")  # and never takes the answer
        elif k % 4 == 3:
            client.sendall(camera.head("/frame?after=4000000000") + b"\r\n")  # for which there is none
        clients.append(client)
        if k % 50 == 0:
            check(camera.get()[0] == 200, "no page beside %d clients" % k)
    check_floods(camera)
    check(camera.get()[0] == 200, "no page beside %d clients" % idle)
    for _ in range(5):
        newer = camera.frame(seen)
        check(newer > seen, "the frames stand still")
        seen = newer
    check(camera.descriptors() <= MOST_DESCRIPTORS, "%d descriptors" % camera.descriptors())
    grown = camera.memory() - before
    check(grown < MOST_MEMORY, "clients cost %d kB" % grown)
    camera.end()  # whatever they do
    for each in drips:
        each.end()
    for client in clients:
        client.close()
    ending = Camera(program, folder, loop=False)
    drip = Drip(ending)
    ending.end(0)
    drip.end()


def check_places(program, folder):
    camera = Camera(program, folder)
    second = run(program, folder, "recording", "--view", str(camera.port))
    check((second.returncode, second.stderr) == (1, "spincat: the live page cannot be served on 127.0.0.1:%d: address "
                                                    "already in use\n" % camera.port), "in use: %s" % second.stderr)
    camera.end()
    try:
        socket.create_server(("::1", 0), family=socket.AF_INET6).close()
    except OSError:
        print("no IPv6 here")
    else:
        for view in ("[::1]:0", "::1:0"):
            camera = Camera(program, folder, view=view)
            check(camera.token is None and camera.get()[0] == 200, "%s is not answered" % view)
            check(camera.get(host="evil.example:%d" % camera.port)[0] == 403, "a foreign name is answered")
            camera.end()
    camera = Camera(program, folder, view="0.0.0.0:0")
    check(camera.get("/?token=" + camera.token)[0] == 200, "the right token is not answered")
    check(camera.get("/?token=" + "0" * 32)[0] == 403, "a wrong token is answered")
    check(camera.get("/frame")[0] == 403, "somebody without the token is answered")
    before = camera.memory()
    check_floods(camera)
    check(camera.memory() - before < MOST_MEMORY, "somebody without the token costs memory")
    camera.end()


def check_without_threads(program, folder):
    """Where the system has no more threads: one line, and exit code 1."""

    def alone():
        resource.setrlimit(resource.RLIMIT_NPROC, (1, 1))
        if os.geteuid() == 0:  # whom no limit holds
            nobody = 60_000 + os.getpid() % 5_000
            os.setgroups([])
            os.setgid(nobody)
            os.setuid(nobody)

    os.chmod(folder, 0o777)
    try:
        if run(program, folder, "recording", preexec_fn=alone).returncode != 0:
            print("another user may not run the command here")
            return
    except (OSError, subprocess.SubprocessError):
        print("no limit of threads here")
        return
    for words in (("--view", "0"), ("--realtime",), ("--record", "record")):
        ended = run(program, folder, "recording", *words, preexec_fn=alone)
        check((ended.returncode, ended.stderr.count("\n")) == (1, 1) and
              ended.stderr.startswith("spincat: a thread cannot be started: "), "%s: %d %s" % (words[0], ended.returncode, ended.stderr))


def main():
    program, scratch = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    idle, runs = int(sys.argv[3]) if len(sys.argv) > 3 else 1000, int(sys.argv[4]) if len(sys.argv) > 4 else 20
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (max(soft, min(hard, idle + 200)), hard))
    shutil.rmtree(scratch, ignore_errors=True)
    write_dataset(os.path.join(scratch, "shapes"))
    write_recording(os.path.join(scratch, "recording"))
    model = os.path.join(scratch, "model.spincat")
    spincat(program, "train", os.path.join(scratch, "shapes"), "-o", model, "--views", "4", "--points", "256",
            "--spin-points", "32", "--threads", "2")
    try:
        check_short_runs(program, scratch, runs)
        check_places(program, scratch)
        check_attacks(program, scratch, idle)
        check_without_threads(program, scratch)
    except Exception as error:  # whatever happens, in one line
        print("check_live_attack: %s: %s" % (type(error).__name__, error))
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
