#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What contrib/run.sh says and does, with programs that only pretend to build.

usage: run_script.py ROOT FOLDER
"""
import os
import pathlib
import pty
import shutil
import subprocess
import sys

ROOT, FOLDER = (pathlib.Path(a).absolute() for a in sys.argv[1:3])
BUILD = FOLDER / "tree" / "build"

# configures a tree of four files, builds those that are not there
CMAKE = r"""
echo "$*" >>"$LOG"
[ "$1" != -S ] || {
  mkdir -p "$4"; touch "$4/CMakeCache.txt"
  echo '"file": 1
"file": 2
"file": 3
"file": 4' >"$4/compile_commands.json"
  exit 0
}
for n in 1 2 3 4; do
  [ -e "$2/$n.o" ] || {
    echo "[ ${n}0%] Building CXX object $n.o"; touch "$2/$n.o"
    [ "$n" != 3 ] || printf '%s\n' "3.cc:1: warning: $WARNING" >&2
    [ "$n" != "${FAIL:-}" ] || { rm "$2/$n.o"; echo "$n.cc:2: error"; exit 2; }
  }
done
echo "[100%] Built target keyblock"
printf '#!/bin/sh\necho "$@"\nexit 7\n' >"$2/keyblock"
chmod +x "$2/keyblock"
"""
PROGRAMS = {
    "cmake": CMAKE,
    "dpkg-query": '[ -n "${LACKS_ALL:-}" ] || echo "install ok installed"',
    "make": "exit 2",
    "apt-get": 'echo "apt-get $*" >>"$LOG"',
    "sudo": '"$@"',
    "mpirun": 'echo "mpirun $*"'}


def prepare():
    """A tree with the scripts, and the programs before all others."""
    shutil.rmtree(FOLDER, ignore_errors=True)
    (FOLDER / "tree" / "contrib").mkdir(parents=True)
    for name in ("run.sh", "setup.sh", "build_progress.sh"):
        shutil.copy(ROOT / "contrib" / name, FOLDER / "tree" / "contrib")
    (FOLDER / "bin").mkdir()
    for name, text in PROGRAMS.items():
        path = FOLDER / "bin" / name
        path.write_text("#!/bin/sh\n" + text + "\n", encoding="utf-8")
        path.chmod(0o755)


def run(*arguments, errors=subprocess.PIPE, **environment):
    """Exit code, output, what was said, and how programs were called."""
    log = FOLDER / "log"
    log.write_text("", encoding="utf-8")
    kept = {name: os.environ[name] for name in ("HOME", "TMPDIR")
            if name in os.environ}
    done = subprocess.run(
        [str(FOLDER / "tree" / "contrib" / "run.sh"), *arguments],
        stdout=subprocess.PIPE, stderr=errors, text=True, check=False,
        env={**kept, "PATH": f"{FOLDER / 'bin'}:{os.environ['PATH']}",
             "LOG": str(log), "WARNING": "a%d\\n", **environment})
    return (done.returncode, done.stdout, done.stderr,
            log.read_text(encoding="utf-8"))


def expect(found, expected):
    """The two are the same."""
    assert found == expected, f"{found!r}, not {expected!r}"


def builds():
    """All is said once, the warning as it is, and the scene's code is kept."""
    code, output, said, log = run("a scene.prm", "--validate")
    expect((code, output), (7, "a scene.prm --validate\n"))
    said = said.replace("1 s", "0 s")
    expect(said.splitlines(), [
        "Configuring", "Building 1 of 4, 0 s", "Building 2 of 4, 0 s",
        "Building 3 of 4, 0 s", "3.cc:1: warning: a%d\\n",
        "Building 4 of 4, 0 s", "Built in 0 s",
        f"Running {BUILD}/keyblock a scene.prm --validate"])
    assert f"-S {FOLDER}/tree -B {BUILD} -DCMAKE_BUILD_TYPE=Release" in log
    assert f"--build {BUILD} -j " in log and "apt-get" not in log


def runs_again():
    """Nothing is left to build, and little is said; on several ranks."""
    code, output, said, _ = run("scene.prm", RANKS="2", JOBS="3")
    expect((code, output),
           (0, "mpirun --allow-run-as-root --oversubscribe -n 2 "
               f"{BUILD}/keyblock scene.prm\n"))
    expect(said.count("\n"), 1)
    assert said.startswith("Running mpirun "), said


def takes_its_environment():
    """Another folder, kind of build and number of jobs."""
    other = str(FOLDER / "other")
    log = run("scene.prm", BUILD=other, JOBS="3", BUILD_TYPE="Debug",
              SANITIZE="ON")[3]
    assert f"-B {other} -DCMAKE_BUILD_TYPE=Debug" in log, log
    assert "-DSANITIZE=ON" in log and f"--build {other} -j 3" in log, log


def installs():
    """Packages that are not there are named and asked for."""
    _, _, said, log = run("scene.prm", LACKS_ALL="yes")
    assert said.startswith("Installing packages: libdeal.ii-dev "), said
    assert "python3-jsonschema" in said.splitlines()[0]
    assert "apt-get update -qq\n" in log and "apt-get install -y" in log, log


def fails():
    """What does not compile is not run, and the compiler's words are there."""
    (BUILD / "2.o").unlink()
    code, output, said, _ = run("scene.prm", FAIL="2")
    expect((code, output), (2, ""))
    expect([line.replace("1 s", "0 s") for line in said.splitlines()],
           ["Building 1 of 1, 0 s", "2.cc:2: error"])


def on_a_terminal():
    """One line changes, and is gone at the end."""
    for path in BUILD.glob("*.o"):
        path.unlink()
    ours, theirs = pty.openpty()
    code, _, _, _ = run("scene.prm", errors=theirs)
    os.close(theirs)
    said = b""
    try:
        while True:
            said += os.read(ours, 1000)
    except OSError:  # all is read
        os.close(ours)
    said = said.decode().replace("1 s", "0 s")
    expect(code, 7)
    clear = "\r\033[K"
    assert f"{clear}Building 1 of 4, 0 s{clear}Building 2 of 4, 0 s" in said
    assert f"{clear}Built in 0 s\r\nRunning " in said, said


def breaks_off():
    """A build that ends without a word has failed."""
    expect(subprocess.run([str(ROOT / "contrib" / "build_progress.sh"), "4"],
                          input="[ 1%] Building CXX object 1.o\n", text=True,
                          capture_output=True, check=False).returncode, 1)


def main():
    """Exit with 1 at the first case that is not as it should be."""
    prepare()
    for case in (builds, runs_again, takes_its_environment, installs, fails,
                 on_a_terminal, breaks_off):
        case()
        print(f"{case.__name__}: as it should be")


if __name__ == "__main__":
    main()
