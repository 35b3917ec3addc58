# SPDX-License-Identifier: BSD-3-Clause
"""Tests live views. Frames must arrive, buttons must pause and step the run, foreign requests must
be refused, and views must end. tests/browser/check_live.py uses the page."""

import contextlib
import gc
import http.client
import json
import signal
import socket
import threading
import time
import unittest
import unittest.mock
import urllib.parse

import numpy as np

import baum
from mechanisms import pendulum, slider_crank

PATIENCE = 20.0  # [s] after this time a test fails; it is long, because machines may be slow


def until(test):
    """Wait until test() is true, and return its value."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        found = test()
        if found:
            return found
        time.sleep(0.005)
    raise AssertionError("this has not happened in time")


def ask(view, what="", method="GET", **headers):
    """Make a request to the view, and return the status and the text of the answer."""
    url = urllib.parse.urlsplit(view.url)
    connection = http.client.HTTPConnection(url.hostname, url.port, timeout=PATIENCE)
    try:
        connection.request(method, url.path + what, headers=headers)
        answer = connection.getresponse()
        return answer.status, answer.read().decode()
    finally:
        connection.close()


def ask_for_events(view):
    url = urllib.parse.urlsplit(view.url)
    connection = socket.create_connection((url.hostname, url.port))
    connection.sendall(f"GET {url.path}events HTTP/1.1\r\nHost: {url.netloc}\r\n\r\n".encode())
    return connection


class Page:
    """Receives the events of a view in the same way as a page."""

    def __init__(self, view):
        self._socket = ask_for_events(view)
        self.head, self.frames, self.ended = [], [], False
        self._thread = threading.Thread(target=self._read)
        self._thread.start()

    def _read(self):
        with self._socket.makefile("r") as lines, contextlib.suppress(OSError):
            for line in lines:
                if line.startswith("data: {"):
                    self.frames.append(json.loads(line[6:]))
                elif line.startswith("event: end"):
                    self.ended = True
                elif not self.frames:
                    self.head.append(line.strip())

    @property
    def last(self):
        return self.frames[-1] if self.frames else {}

    def close(self):
        with contextlib.suppress(OSError):
            self._socket.shutdown(socket.SHUT_RDWR)
        self._thread.join(PATIENCE)
        self._socket.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def servers():
    return [thread for thread in threading.enumerate() if thread.name == "baum view"]


class Views(unittest.TestCase):
    def setUp(self):
        self.m = slider_crank()
        self.s = self.m.simulation("rk4", step=1e-4)

    def tearDown(self):
        self.s.close()
        until(lambda: not servers())

    def view(self, **options):
        return self.s.view(browser=False, **options)

    def in_background(self, work):
        """Start work in a thread that is joined at the end of the test."""
        thread = threading.Thread(target=work, daemon=True)
        thread.start()
        self.addCleanup(thread.join, PATIENCE)
        return thread

    # ---- frames

    def test_the_page_is_that_of_a_run_with_a_script(self):
        status, page = ask(self.view(title="<T>", traces=["rod.pose"]))
        self.assertEqual(status, 200)
        self.assertIn("new EventSource('events')", page)
        self.assertIn("script-src 'unsafe-inline'; connect-src 'self'\"", page)
        self.assertIn('"title":"\\u003cT>"', page)
        self.assertIn('"frames":1', page)
        with self.assertRaises(KeyError):
            self.view(traces=["nobody.pose"])

    def test_frames_of_a_loop_arrive(self):
        with Page(self.view()) as page:
            until(lambda: page.frames)
            self.assertIn("Content-Type: text/event-stream", page.head)
            while len(page.frames) < 10:
                self.s.step()
            until(lambda: page.last["t"] == self.s.time)  # the last state must also be shown
            np.testing.assert_allclose(page.last["q"], self.s.q, rtol=1e-6, atol=1e-12)
        times = [frame["t"] for frame in page.frames]
        self.assertEqual(times, sorted(times))

    def test_frames_of_one_long_call_arrive(self):
        with Page(self.view()) as page:
            until(lambda: page.frames)
            thread = self.in_background(lambda: self.s.advance_to(1e6))
            until(lambda: len(page.frames) > 10)
            self.s.cancel()
            thread.join(PATIENCE)
        times = [frame["t"] for frame in page.frames]
        self.assertEqual(times, sorted(set(times)))

    def test_a_state_that_is_set_is_shown(self):
        with Page(self.view()) as page:
            self.s.advance_to(0.1)
            saved, q = self.s.save(), self.s.q
            self.s.advance_to(0.2)
            until(lambda: page.last.get("t") == self.s.time)
            self.s.restore(saved)
            until(lambda: page.last["t"] == self.s.time)
            np.testing.assert_allclose(page.last["q"], q, rtol=1e-6, atol=1e-12)

    def test_a_call_waits_while_a_page_reads_the_state(self):
        begun = threading.Event()

        def read(address):
            begun.set()
            time.sleep(0.2)

        self.in_background(lambda: self.s._owner.glance(read))
        begun.wait(PATIENCE)
        self.assertEqual(self.s.step(), baum.Status.OK)

    def test_at_most_60_frames_a_second(self):
        with Page(self.view()) as page:
            until(lambda: page.frames)
            begin, count = time.monotonic(), len(page.frames)
            while time.monotonic() < begin + 0.5:
                self.s.step()
                time.sleep(0.001)
            passed = time.monotonic() - begin
            self.assertLessEqual(len(page.frames) - count, 60 * passed + 2)

    def test_two_pages_and_two_views_get_frames(self):
        one, other = self.view(), self.view()
        self.assertNotEqual(one.url, other.url)
        with Page(one) as a, Page(one) as b, Page(other) as c:
            self.s.advance_to(0.5)
            for page in (a, b, c):
                until(lambda: page.last.get("t") == self.s.time)
            one.close()
            until(lambda: a.ended and b.ended)
            self.assertTrue(one.closed and not other.closed)
            self.s.advance_to(1)
            until(lambda: c.last["t"] == self.s.time)

    def test_a_page_that_does_not_read_holds_up_nothing(self):
        view = self.view()
        self.addCleanup(ask_for_events(view).close)
        with Page(view) as page:
            self.s.advance_to(2)
            until(lambda: page.last.get("t") == self.s.time)

    def test_progress_functions_are_called_as_without_a_view(self):
        seen = []
        s = self.m.simulation("rk4", step=1e-4, progress=seen.append, progress_interval=0.1)
        with s, s.view(browser=False):
            begin = time.monotonic()
            while time.monotonic() < begin + 0.5:
                s.advance_to(s.time + 1)
            self.assertLessEqual(len(seen), 8)
            s.advance_to(s.time + 20)
        self.assertTrue(seen)
        stop = self.m.simulation("rk4", step=1e-4, progress=lambda t: t > 0.5, progress_interval=0)
        with stop, stop.view(browser=False):
            self.assertEqual(stop.advance_to(1), baum.Status.STOP_CANCELLED)

    def test_motion_is_the_same_with_a_view(self):
        other = self.m.simulation("rk4", step=1e-4)
        with Page(self.view()):
            self.s.advance_to(0.3)
        other.advance_to(0.3)
        np.testing.assert_array_equal(self.s.q, other.q)

    # ---- buttons

    def test_pause_holds_a_loop_of_calls(self):
        view, count = self.view(), [0]

        def loop():
            while count[0] >= 0:
                self.s.step()
                count[0] += 1

        with Page(view) as page:
            thread = self.in_background(loop)
            until(lambda: count[0] > 10)
            self.assertEqual(ask(view, "pause", "POST")[0], 204)
            until(lambda: page.last.get("paused"))
            before = self.until_still(lambda: count[0])
            for k in range(3):
                ask(view, "step", "POST")
                until(lambda: count[0] == before + k + 1)
                until(lambda: page.last["t"] == self.s.time)
            self.assertEqual(self.until_still(lambda: count[0]), before + 3)
            ask(view, "resume", "POST")
            until(lambda: count[0] > before + 10)
            count[0] = -10**9
            thread.join(PATIENCE)

    def test_pause_holds_one_call_and_a_step_is_one_of_the_integrator(self):
        view = self.view()
        with Page(view) as page:
            thread = self.in_background(lambda: self.s.advance_to(1e6))
            until(lambda: len(page.frames) > 3)
            ask(view, "pause", "POST")
            before = self.until_still(lambda: page.last["t"])
            for count in (1, 4):  # steps must also work if they follow each other immediately
                for _ in range(count):
                    ask(view, "step", "POST")
                until(lambda: page.last["t"] > before)
                after = self.until_still(lambda: page.last["t"])
                self.assertAlmostEqual(after, before + 1e-4 * count, delta=1e-9)
                before = after
            self.s.cancel()  # this ends the wait
            thread.join(PATIENCE)
            self.assertFalse(thread.is_alive())

    def test_a_run_that_begins_paused_waits_for_a_page(self):
        view = self.view(paused=True)
        thread = self.in_background(lambda: self.s.advance_to(0.01))
        time.sleep(0.2)
        self.assertTrue(thread.is_alive())
        with Page(view):
            ask(view, "resume", "POST")
            thread.join(PATIENCE)
        self.assertFalse(thread.is_alive())
        self.assertEqual(self.s.time, 0.01)

    def test_a_paused_run_goes_on_when_its_pages_are_closed(self):
        view = self.view()
        with Page(view) as page:
            ask(view, "pause", "POST")
            until(lambda: page.last.get("paused"))
            thread = self.in_background(lambda: self.s.advance_to(0.01))
            time.sleep(0.2)
            self.assertTrue(thread.is_alive())
            self.assertEqual(self.s.time, 0)  # the run waits before its first step
        thread.join(PATIENCE)
        self.assertFalse(thread.is_alive())
        self.assertEqual(self.s.time, 0.01)

    def test_a_paused_run_goes_on_when_the_view_is_closed(self):
        view = self.view(paused=True)
        thread = self.in_background(lambda: self.s.advance_to(0.01))
        time.sleep(0.1)
        view.close()
        thread.join(PATIENCE)
        self.assertFalse(thread.is_alive())
        self.assertEqual(self.s.time, 0.01)

    def test_ctrl_c_ends_the_waiting(self):
        # Programs that a shell starts in the background ignore SIGINT, and this test may be one of
        # them.
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGINT, before)
        self.view(paused=True)
        for work in (lambda: self.s.advance_to(1), lambda: self.s.step(3)):
            timer = threading.Timer(0.3, signal.pthread_kill, [threading.get_ident(), signal.SIGINT])
            timer.start()
            with self.assertRaises(KeyboardInterrupt):
                work()
            timer.join()
        self.s._live.resume()
        self.assertEqual(self.s.advance_to(0.1), baum.Status.OK)

    def until_still(self, read):
        """Wait until a value no longer changes, and return it."""
        value = read()
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            time.sleep(0.25)
            before, value = value, read()
            if value == before:
                return value
        raise AssertionError("the run is not held")

    # ---- foreign requests

    def test_foreign_pages_are_refused(self):
        view = self.view()
        port = urllib.parse.urlsplit(view.url).port
        self.assertEqual(ask(view, Host="evil.example")[0], 403)
        self.assertEqual(ask(view, Host=f"evil.example:{port}")[0], 403)
        self.assertEqual(ask(view, "events", Host=f"127.0.0.1:{port + 1}")[0], 403)
        self.assertEqual(ask(view, "pause", "POST", Origin="http://evil.example")[0], 403)
        self.assertEqual(ask(view, Host=f"localhost:{port}")[0], 200)
        self.assertEqual(ask(view, "resume", "POST", Origin=f"http://127.0.0.1:{port}")[0], 204)

    def test_the_secret_is_needed(self):
        view = self.view()
        url = urllib.parse.urlsplit(view.url)
        secret = url.path.strip("/")
        self.assertGreaterEqual(len(secret), 20)
        for path in ("/", "/events", f"/{secret}", f"/{secret[:-1]}/", f"/x{secret}/", "//", "/%C3%A9/"):
            for method in ("GET", "POST"):
                connection = http.client.HTTPConnection(url.hostname, url.port, timeout=PATIENCE)
                connection.request(method, path)
                self.assertEqual(connection.getresponse().status, 404, path)
                connection.close()
        self.assertEqual(ask(view, "other")[0], 404)
        self.assertEqual(ask(view, "pause")[0], 404)  # requests of buttons must use POST
        self.assertEqual(ask(view, "frame", "POST")[0], 404)
        self.assertNotIn(secret, ask(view)[1])

    def test_only_this_computer_is_served(self):
        view = self.view()
        self.assertEqual(view._server.socket.getsockname()[0], "127.0.0.1")

    # ---- the end

    def test_close_ends_threads_and_port(self):
        with self.view() as view:
            page = Page(view)
            self.assertEqual(len(servers()), 1)
        until(lambda: page.ended)
        page.close()
        self.assertTrue(view.closed)
        self.assertEqual(servers(), [])
        with self.assertRaises(OSError):
            ask(view)
        view.close()
        self.s.advance_to(0.1)

    def test_a_simulation_that_is_collected_ends_its_views(self):
        s = self.m.simulation("rk4", step=1e-3)
        with Page(s.view(browser=False)) as page:
            s.advance_to(0.1)
            until(lambda: page.last.get("t") == 0.1)
            del s
            gc.collect()
            until(lambda: page.ended)
        until(lambda: not servers())

    def test_a_closed_simulation_has_no_views(self):
        view = self.view()
        self.s.close()
        self.assertTrue(view.closed)
        with self.assertRaises(baum.Error):
            self.view()

    def test_python_functions_and_failures_leave_the_view_alone(self):
        def law(t, q):
            if t > 0.05:
                raise RuntimeError("law")
            return q @ q - 1

        s = pendulum(law).simulation("rk4", step=1e-3)
        with s, Page(s.view(browser=False)) as page:
            with self.assertRaisesRegex(RuntimeError, "law"):
                s.advance_to(0.2)
            until(lambda: page.last.get("t") == s.time)

    def test_notebooks_show_it_in_a_frame(self):
        view = self.view()
        self.assertTrue(view._repr_html_().startswith(f'<iframe src="{view.url}"'))
        view.close()
        self.assertIn("closed", view._repr_html_())

    def test_the_browser_is_opened(self):
        with unittest.mock.patch("webbrowser.open") as opened:
            view = self.s.view()
        opened.assert_called_once_with(view.url)


if __name__ == "__main__":
    unittest.main()
