"""Runs programs: where those of the project are, what a run has cost and said, and one error when it has failed."""
import dataclasses
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile
import threading
import time

from . import obj

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILT = ROOT / "build/release/bin"
DIVERGED = 5  # exit code of the project's programs for numbers that are of no use; what was computed before is kept
LAST_WORDS = 5  # lines of a program's messages that its failure is reported with


class Failed(Exception):
    """A program is missing (`code` None) or has ended with an exit code that the caller did not expect."""

    def __init__(self, message, code=None):
        super().__init__(message)
        self.code = code


@dataclasses.dataclass(frozen=True)
class Done:
    """A program that has ended: exit code (minus the signal that killed it), user and system time [CPU s], peak memory
    [bytes], stdout (empty if it went to a file) and stderr."""
    code: int
    cpu: float
    memory: int
    output: str
    messages: str

    def lines(self, kind):
        """The messages of a kind, "warning" or "error"."""
        return [line for line in self.messages.splitlines() if line.startswith(f"{kind}:")]


class Programs:
    """The programs in the folder `binaries` (those in PATH if it is empty), run in the folder `place` (the current one)
    with their messages collected in the file `log`, which the first run begins anew. With `echo` commands and messages
    are shown on stderr, too."""

    def __init__(self, binaries, log, place=None, echo=False):
        self.binaries, self.log = pathlib.Path(binaries), pathlib.Path(log)
        self.place, self.echo = place, echo
        self._log_mode, self._noting = "w", threading.Lock()

    def run(self, name, *arguments, allowed=(0,), output=None, environment=None):
        """Runs a program by its name or absolute path; returns a Done. stdout goes into the file `output` if one is given;
        `environment` has further variables. Raises Failed, but for the exit codes `allowed` (None: all of them)."""
        command = [str(self.binaries / name), *map(str, arguments)]
        text = shlex.join(command)
        if self.echo:
            print(text, file=sys.stderr, flush=True)
        with open(output, "w+b") if output else tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as messages:
            try:
                process = subprocess.Popen(command, cwd=self.place, stdout=out, stderr=messages,
                                           env={**os.environ, **(environment or {})})
            except OSError as error:
                raise Failed(f"cannot run {text}: {error.strerror}") from None
            try:
                code, cpu, memory = _finish(process, messages.fileno() if self.echo else None)
            finally:
                said = _content(messages)
                self._note(f"$ {text}\n{said}")
            done = Done(code, cpu, memory, "" if output else _content(out), said)
        if allowed is not None and code not in allowed:
            raise self._failure(text, done)
        return done

    def mesh(self, path, shape):
        """Writes an OBJ file: `shape` are arguments of bemshape, or a mesh (vertices [N, 3], triangles [M, 3])."""
        if isinstance(shape[0], str):
            self.run("bemshape", *shape, "-o", path)
        else:
            obj.write(path if self.place is None else self.place / path, *shape)

    def _note(self, text):
        """Adds to the log: all of a run at once, so that runs beside each other stay apart."""
        with self._noting, open(self.log, self._log_mode, encoding="utf-8") as file:
            file.write(text)
            self._log_mode = "a"

    def _failure(self, command, done):
        if not done.messages:
            self._note(done.output)
        words = (done.messages or done.output).strip().splitlines()[-LAST_WORDS:]
        end = f"exit code {done.code}" if done.code >= 0 else f"killed by signal {-done.code}"
        return Failed("\n  ".join([f"{command}: {end}; its messages are in {self.log}", *words]), done.code)


def _content(file):
    """Not by the file's position, which a program that is still writing would share."""
    return os.pread(file.fileno(), os.fstat(file.fileno()).st_size, 0).decode(errors="replace")


def _finish(process, shown):
    """Waits for a program and shows what it writes to the file descriptor `shown` (unless it is None); its exit code,
    CPU seconds and peak memory [bytes].

    ru_maxrss of wait4 is not the program's own: the kernel counts what this interpreter held in memory when it started the
    program (with fork, vfork and posix_spawn alike, until the exec that ends them). It is exact when it is larger than our
    own peak. Programs that take less are observed while they run: VmHWM of a program that Popen has started, which returns
    after exec, is its own and only grows, so that only what comes after the last look is missed."""
    start, seen, peak = time.monotonic(), 0, 0
    try:
        while True:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if shown is not None:
                new = os.pread(shown, os.fstat(shown).st_size - seen, seen)
                seen += len(new)
                sys.stderr.write(new.decode(errors="replace"))
                sys.stderr.flush()
            if pid:
                break
            peak = max(peak, _peak_memory(process.pid))
            time.sleep(min(max((time.monotonic() - start) / 20, 0.001), 0.2))
    except BaseException:
        process.kill()
        process.wait()
        raise
    process.returncode = os.waitstatus_to_exitcode(status)
    largest = 1024 * usage.ru_maxrss
    return process.returncode, usage.ru_utime + usage.ru_stime, largest if largest > _peak_memory("self") else peak


def _peak_memory(process):
    """VmHWM [bytes]; 0 for a process that has ended."""
    try:
        with open(f"/proc/{process}/status", encoding="ascii") as file:
            return next((1024 * int(line.split()[1]) for line in file if line.startswith("VmHWM:")), 0)
    except OSError:
        return 0


def folder(*names, given=None):
    """The folder of the programs: `given`, or that of BEM_BIN, or one in which the programs of these names are built."""
    if given or os.environ.get("BEM_BIN"):
        return pathlib.Path(given or os.environ["BEM_BIN"]).resolve()
    visible(ROOT / "scripts/setup.sh")
    visible("cmake", "--preset", "release")
    visible("cmake", "--build", "--preset", "release", "--parallel", os.cpu_count(), "--target", *names)
    return BUILT


def visible(*command):
    """Runs a command whose output stays on the terminal, in the folder of the project. Raises Failed."""
    command = [str(word) for word in command]
    code = subprocess.call(command, cwd=ROOT)
    if code != 0:
        raise Failed(f"{shlex.join(command)}: exit code {code}", code)


def exit_with(main):
    """Ends the script with the exit code of main(), or with 1 and one message if a program has failed."""
    try:
        sys.exit(main())
    except Failed as failure:
        print(f"error: {failure}", file=sys.stderr)
        sys.exit(1)
