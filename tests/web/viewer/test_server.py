"""The server of `lambent view --web`, spoken to through bare sockets. It is given a page of its own, so
that this takes no npm."""

import os
import re
import select
import shutil
import signal
import socket
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

TOOL = Path(os.environ["LAMBENT_TOOL"])
SIZE = 3_000_000  # of data.bin: more than what sockets hold
PROMPT = 10  # seconds, on a busy machine; half of what 32 slow clients could take of 8 threads


PAUSE = 22  # seconds: a page that compiles its shaders hears nothing for as long
started = None


def setUpModule():
    """The pause goes by while the other tests run."""
    global started
    started = PausedClient()


def tearDownModule():
    started.end()


class PausedClient:
    """Has asked for data.bin and taken its first bytes in."""

    def __init__(self):
        self.began = time.monotonic()
        self.case = Server()
        self.case.large = True
        self.case.setUp()
        self.socket = self.case.connect()
        self.socket.sendall(
            f"GET /large.bin HTTP/1.1\r\nHost: 127.0.0.1:{self.case.port}\r\n"
            "Connection: close\r\n\r\n".encode())
        self.heard = self.socket.recv(1000)

    def rest(self):
        time.sleep(max(0, self.began + PAUSE - time.monotonic()))
        parts = [self.heard]
        while part := self.socket.recv(1 << 20):
            parts.append(part)
        return b"".join(parts)

    def end(self):
        self.case.doCleanups()


class Server(unittest.TestCase):
    large = False  # with a file that is more than any socket holds

    def setUp(self):
        self.dir = Path(tempfile.mkdtemp(prefix="lambent-server."))
        self.addCleanup(shutil.rmtree, self.dir, ignore_errors=True)
        # The page is looked for beside the executable.
        (self.dir / "bin").mkdir()
        shutil.copy(TOOL, self.dir / "bin/lambent")
        page = self.dir / "share/lambent/viewer"
        page.mkdir(parents=True)
        (page / "index.html").write_text("<!doctype html><title>page</title>\n")
        (page / "manifest.json").write_text(
            '{"lambent": "manifest", "version": 1, "assets": [], "environments": []}\n')
        (page / "empty.bin").write_bytes(b"")
        self.data = bytes((i * i >> 3) & 255 for i in range(SIZE))
        (page / "data.bin").write_bytes(self.data)
        if self.large:
            (page / "large.bin").write_bytes(10 * self.data)

        self.server = subprocess.Popen(
            [self.dir / "bin/lambent", "view", "--web", "--port", "0", "--no-browser", "--quiet"],
            stdout=subprocess.PIPE, text=True)
        self.addCleanup(self.server.stdout.close)
        self.addCleanup(self.server.wait)
        self.addCleanup(self.server.kill)
        self.port = int(re.fullmatch(r"http://127\.0\.0\.1:(\d+)/\n",
                                     self.server.stdout.readline()).group(1))

    def test_an_address_that_nobody_takes_is_no_server(self):
        with open("/dev/full", "w") as full:
            result = subprocess.run(
                [self.dir / "bin/lambent", "view", "--web", "--no-browser"], stdout=full,
                stderr=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(result.returncode, 1)
        self.assertIn("standard output", result.stderr)

    def connect(self):
        client = socket.create_connection(("127.0.0.1", self.port), timeout=PROMPT)
        self.addCleanup(client.close)
        return client

    def ask(self, path="/", method="GET", client=None, **headers):
        """Status, headers (their names in small letters) and body."""
        lines = [f"{method} {path} HTTP/1.1", f"Host: 127.0.0.1:{self.port}"]
        lines += [f"{name.replace('_', '-')}: {value}" for name, value in headers.items()]
        with_own = client or self.connect()
        with_own.sendall(("\r\n".join(lines) + "\r\n\r\n").encode())
        stream = with_own.makefile("rb")
        status = int(stream.readline().split()[1])
        found = {}
        while (line := stream.readline().strip()):
            name, value = line.decode().split(": ", 1)
            found[name.lower()] = value
        body = b"" if method == "HEAD" else stream.read(int(found.get("content-length", 0)))
        return status, found, body

    def assert_answers(self, times=1):
        for _ in range(times):
            began = time.monotonic()
            status, _, body = self.ask()
            self.assertEqual((status, body[:15]), (200, b"<!doctype html>"))
            self.assertLess(time.monotonic() - began, PROMPT)

    def assert_ends(self):
        began = time.monotonic()
        self.server.send_signal(signal.SIGINT)
        self.assertEqual(self.server.wait(timeout=30), 0)
        self.assertLess(time.monotonic() - began, PROMPT)

    def slow(self, count):
        """Clients that keep the server waiting, each in one of three ways."""
        clients = [socket.socket() for _ in range(count)]
        for client in clients:  # all at once
            self.addCleanup(client.close)
            client.setblocking(False)
            client.connect_ex(("127.0.0.1", self.port))
        for k, client in enumerate(clients):
            select.select([], [client], [], PROMPT)
            client.settimeout(PROMPT)
            client.sendall([b"", b"GET /", b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n"][k % 3])
        return clients

    def test_slow_clients_hold_nobody_up(self):
        self.slow(32)
        self.assert_answers(4)
        self.assert_ends()

    def test_more_clients_than_it_has_places_for(self):
        clients = self.slow(200)
        self.assert_answers(4)
        # Those that came first gave way.
        self.assertEqual(clients[0].recv(100), b"")
        self.assert_ends()

    def test_a_request_that_trickles_in_is_cut_off(self):
        client = self.connect()
        client.settimeout(0.25)
        began = time.monotonic()
        ended = False
        while not ended and time.monotonic() - began < 60:
            try:
                client.send(b"G")
                ended = client.recv(1000) == b""
            except TimeoutError:
                pass
            except (BrokenPipeError, ConnectionResetError):
                ended = True
        self.assertTrue(ended)
        self.assert_answers()

    def test_headers_without_end_are_cut_off(self):
        client = self.connect()
        client.sendall(b"GET / HTTP/1.1\r\n")
        with self.assertRaises((BrokenPipeError, ConnectionResetError)):
            for k in range(100_000):
                client.sendall(f"X-{k}: {'x' * 1000}\r\n".encode())
        self.assert_answers()

    def test_clients_that_do_not_listen_hold_nobody_up(self):
        for _ in range(32):
            self.connect().sendall(
                f"GET /data.bin HTTP/1.1\r\nHost: 127.0.0.1:{self.port}\r\n\r\n".encode())
        self.assert_answers(4)
        self.assert_ends()

    def test_who_pauses_hears_the_rest(self):
        answer = started.rest()
        self.assertEqual(len(answer.split(b"\r\n\r\n", 1)[1]), 10 * SIZE)

    def test_one_connection_serves_many_requests(self):
        client = self.connect()
        for _ in range(8):
            self.assertEqual(self.ask(client=client)[0], 200)
            self.assertEqual(self.ask("/none", client=client)[0], 404)
            self.assertEqual(self.ask("/data.bin", "HEAD", client=client)[0], 200)
            self.assertEqual(self.ask("/data.bin", client=client, Range="bytes=7-8")[0], 206)

    def test_ranges(self):
        for asked, first, end in [
                ("bytes=0-0", 0, 1), ("bytes=5-", 5, SIZE), (f"bytes={SIZE - 1}-", SIZE - 1, SIZE),
                ("bytes=10-1999999", 10, 2_000_000), ("bytes=-10", SIZE - 10, SIZE),
                (f"bytes=0-{SIZE + 5}", 0, SIZE), (f"bytes=-{SIZE + 5}", 0, SIZE)]:
            status, headers, body = self.ask("/data.bin", Range=asked)
            self.assertEqual(status, 206, asked)
            self.assertEqual(headers["content-range"], f"bytes {first}-{end - 1}/{SIZE}")
            self.assertEqual(headers["content-length"], str(end - first))
            self.assertTrue(body == self.data[first:end], asked)

    def test_ranges_beyond_the_end(self):
        for asked in (f"bytes={SIZE}-", f"bytes={SIZE}-{SIZE + 9}", "bytes=99999999999-", "bytes=-0"):
            status, headers, body = self.ask("/data.bin", Range=asked)
            self.assertEqual(status, 416, asked)
            self.assertEqual(headers["content-range"], f"bytes */{SIZE}")
            self.assertLess(len(body), 100)
        status, headers, _ = self.ask("/empty.bin", Range="bytes=0-")
        self.assertEqual((status, headers["content-range"]), (416, "bytes */0"))

    def test_ranges_that_make_no_sense(self):
        """Refused, or taken for no range."""
        for asked in ("bytes=", "bytes=-", "bytes=9-3", "bytes=a-b", "bytes=1", "lines=0-3",
                      "bytes=--1", "bytes=0-1,5-6", "bytes=0-1" + ",3-4" * 1500, "bytes=" + "9" * 5000,
                      "bytes=99999999999999999999999-", "bytes=0-99999999999999999999999",
                      "bytes=18446744073709551615-18446744073709551615"):
            status, headers, body = self.ask("/data.bin", Range=asked)
            self.assertIn(status, (200, 206, 400, 416), asked)
            if status < 300:
                self.assertEqual((headers["content-length"], len(body)), (str(SIZE), SIZE), asked)
            else:
                self.assertLess(len(body), 100, asked)
        self.assertEqual(self.ask("/data.bin", Range="bytes=0-9", If_Range='"x"')[0], 200)

    def test_head_says_what_get_sends(self):
        for path, size in [("/", 35), ("/data.bin", SIZE), ("/empty.bin", 0)]:
            status, headers, _ = self.ask(path, "HEAD")
            self.assertEqual((status, headers["content-length"]), (200, str(size)), path)
            self.assertEqual(len(self.ask(path)[2]), size, path)
        client = self.connect()
        client.sendall(f"HEAD /data.bin HTTP/1.1\r\nHost: 127.0.0.1:{self.port}\r\n"
                       "Connection: close\r\n\r\n".encode())
        answer = b"".join(iter(lambda: client.recv(65536), b""))
        self.assertTrue(answer.endswith(b"\r\n\r\n"), answer[-100:])

    def test_nonsense_is_refused(self):
        for sent in (b"\r\n\r\n", b"\0" * 100, b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n",
                     b"GET /" + b"a" * 20_000 + b" HTTP/1.1\r\n\r\n"):
            client = self.connect()
            client.settimeout(30)
            try:
                client.sendall(sent)
                client.shutdown(socket.SHUT_WR)
                answer = client.recv(1000)
            except (BrokenPipeError, ConnectionResetError):
                answer = b""
            self.assertTrue(answer == b"" or answer.split()[1].startswith(b"4"), (sent[:30], answer))
        self.assertIn(self.ask("/" + "a" * 8000)[0], (404, 414))
        self.assert_answers()


if __name__ == "__main__":
    unittest.main()
