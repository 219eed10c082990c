# SPDX-License-Identifier: BSD-3-Clause
"""Programs that are loaded once and run many times, see prestart.cpp."""

import array
import atexit
import os
import selectors
import signal
import socket
import struct
import subprocess
import tempfile
import threading
import time


class Prestarted:
    """A program that waits, loaded, for its arguments."""

    def __init__(self, program, library):
        self.program = str(program)
        self.folder = tempfile.TemporaryDirectory(prefix="prestart")
        self.address = os.path.join(self.folder.name, "socket")
        environment = {**os.environ, "LD_PRELOAD": str(library), "PRESTART_SOCKET": self.address}
        self.server = subprocess.Popen([self.program], env=environment, stdin=subprocess.PIPE)
        end = time.monotonic() + 60
        while not self.listens():
            assert self.server.poll() is None and time.monotonic() < end, f"{program} does not wait"
            time.sleep(0.01)

    def listens(self):
        with socket.socket(socket.AF_UNIX) as probe:
            return probe.connect_ex(self.address) == 0

    def close(self):
        self.server.stdin.close()
        self.server.wait()
        self.folder.cleanup()

    def run(self, words, cwd, timeout, env=None):
        """What subprocess.run() of the program returns, its output as bytes; nothing to read."""
        environment = os.environ if env is None else env
        words = [self.program, *map(str, words)]
        parts = [str(cwd), *words, *(f"{key}={value}" for key, value in environment.items())]
        text = b"".join(os.fsencode(part) + b"\0" for part in parts)
        with socket.socket(socket.AF_UNIX) as connection, Streams() as streams:
            connection.connect(self.address)
            connection.sendmsg([struct.pack("=II", len(text), len(words))],
                               [(socket.SOL_SOCKET, socket.SCM_RIGHTS,
                                 array.array("i", streams.given))])
            connection.sendall(text)
            streams.close_given()
            process = number(connection)
            if not streams.read(timeout):
                os.kill(process, signal.SIGKILL)
                raise subprocess.TimeoutExpired(words, timeout)
            status = os.waitstatus_to_exitcode(number(connection))
            return subprocess.CompletedProcess(words, status, *map(bytes, streams.found))


WAITING = {}
LOCK = threading.Lock()


def prestarted(program):
    """The program, loaded, until this process ends; None where PRESTART names no library."""
    library = os.environ.get("PRESTART")
    if not library:
        return None
    with LOCK:
        if program not in WAITING:
            WAITING[program] = Prestarted(program, library)
            atexit.register(WAITING[program].close)
        return WAITING[program]


def run_bytes(program, words, cwd, timeout, env=None):
    """subprocess.run() with an empty input, of a prestarted program where there can be one."""
    waiting = prestarted(program)
    if waiting:
        return waiting.run(words, cwd, timeout, env)
    return subprocess.run([program, *map(str, words)], cwd=cwd, env=env, capture_output=True,
                          stdin=subprocess.DEVNULL, timeout=timeout, check=False)


def run_text(program, words, cwd, timeout, env=None):
    """The same with text for output."""
    done = run_bytes(program, words, cwd, timeout, env)
    done.stdout, done.stderr = done.stdout.decode(), done.stderr.decode()
    return done


def number(connection):
    return struct.unpack("=i", connection.recv(4, socket.MSG_WAITALL))[0]


class Streams:
    """Standard streams for a program, and what it writes to them."""

    def __enter__(self):
        pipes = [os.pipe(), os.pipe()]
        self.kept = [end for end, _ in pipes]
        self.given = [os.open(os.devnull, os.O_RDONLY), *(end for _, end in pipes)]
        self.found = [bytearray(), bytearray()]
        return self

    def close_given(self):
        while self.given:
            os.close(self.given.pop())

    def __exit__(self, *_):
        self.close_given()
        for end in self.kept:
            os.close(end)

    def read(self, timeout):
        """All that comes; False where the program is not done in time."""
        limit = time.monotonic() + timeout
        with selectors.DefaultSelector() as waiting:
            for end, found in zip(self.kept, self.found):
                waiting.register(end, selectors.EVENT_READ, found)
            while waiting.get_map():
                ready = waiting.select(max(0, limit - time.monotonic()))
                if not ready:
                    return False
                for key, _ in ready:
                    piece = os.read(key.fd, 1 << 16)
                    key.data.extend(piece)
                    if not piece:
                        waiting.unregister(key.fd)
        return True
