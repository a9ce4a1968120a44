#!/usr/bin/env python3
"""Open the course, or test it, with nothing but Python installed.

    python3 course.py open [--no-browser] [--port N]    JupyterLab with the course
    python3 course.py test [pytest options]             every test of the project

The first run makes a virtual environment in the folder .venv beside this file (set ENGDYN_VENV to put
it elsewhere) and installs the package with the exact versions of constraints.txt; that takes a few
minutes and needs the network. Later runs reuse it and start at once.
"""

import argparse
import hashlib
import importlib.util
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
NEEDED = (3, 11)
STAMP = "engdyn-installed.json"
NETWORK_SIGNS = (
    "name resolution",
    "getaddrinfo failed",
    "nodename nor servname",
    "failed to establish a new connection",
    "network is unreachable",
    "max retries exceeded",
    "connection timed out",
    "read timed out",
    "proxyerror",
)


class SetupError(Exception):
    """The environment could not be made; the message says what to do."""


def main(arguments=None):
    """Parse the command line and run it; return the exit code."""
    parser = argparse.ArgumentParser(
        prog="course.py", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    commands = parser.add_subparsers(dest="command", required=True)
    opening = commands.add_parser("open", help="open the course in JupyterLab")
    opening.add_argument("--no-browser", action="store_true", help="print the address, start no browser")
    opening.add_argument("--port", type=int, help="port to listen on (default: the first free one from 8888)")
    commands.add_parser("test", help="run the tests; further options go to pytest", add_help=False)
    options, rest = parser.parse_known_args(arguments)
    if rest and options.command != "test":
        parser.error("unknown option: " + " ".join(rest))
    try:
        check_python(sys.version_info)
        check_folder(HERE)
        extras = {"lab"} if options.command == "open" else {"lab", "test"}
        python = ensure_environment(environment_folder(os.environ), extras)
    except SetupError as error:
        print("\ncourse.py: " + str(error), file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("\nStopped. Run the same line again to go on.", file=sys.stderr)
        return 130
    if options.command == "test":
        return run([str(python), "-m", "pytest"] + rest)
    command = [str(python), "-m", "engdyn.cli", "lab"]
    command += ["--no-browser"] if options.no_browser else []
    command += ["--port", str(options.port)] if options.port is not None else []
    return run(command)


def check_python(version):
    """Refuse a Python that the package does not run on."""
    if tuple(version[:2]) < NEEDED:
        raise SetupError(
            "this is Python {}.{}, the course needs Python {}.{} or newer.\n".format(*version[:2], *NEEDED)
            + "Install a newer Python and start course.py with it, for example: "
            + "python{}.{} course.py open".format(*NEEDED)
        )


def check_folder(folder):
    """Refuse to run where the rest of the course is not beside this file."""
    missing = [name for name in ("pyproject.toml", "constraints.txt", "src") if not (folder / name).exists()]
    if missing:
        raise SetupError(
            "the folder {} holds no {}.\n".format(folder, " and no ".join(missing))
            + "course.py works only inside the complete folder of the course: get all of it, "
            + "and start course.py from there."
        )


def environment_folder(environ):
    """Where the virtual environment is or will be."""
    named = environ.get("ENGDYN_VENV", "").strip()
    return Path(named).expanduser().absolute() if named else HERE / ".venv"


def environment_python(folder):
    """The interpreter inside a virtual environment, on any platform."""
    return folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")


def ensure_environment(folder, extras):
    """Make or update the virtual environment where needed and return its Python."""
    python = environment_python(folder)
    installed = read_stamp(folder)
    if installed and works(python) and is_current(installed, extras):
        return python
    if folder.exists() and not folder.is_dir():
        raise SetupError(f"{folder} is a file, not a folder for a virtual environment.")
    if folder.is_dir() and any(folder.iterdir()) and not (folder / "pyvenv.cfg").is_file():
        raise SetupError(
            f"{folder} holds files that are no virtual environment; nothing was changed.\n"
            + "Move them away, or name another folder in the variable ENGDYN_VENV."
        )
    moved = bool(installed) and installed.get("folder") != str(HERE) and HERE in folder.parents
    if moved or not works(python):
        create(folder)
    extras = extras | (set() if moved else set(installed.get("extras", ())))
    if installed and not moved:
        (folder / STAMP).unlink()  # an installation that breaks off must not count as the old one
    install(python, extras)
    stamp = {"folder": str(HERE), "extras": sorted(extras), "fingerprint": fingerprint()}
    (folder / STAMP).write_text(json.dumps(stamp, indent=1) + "\n", encoding="utf-8")
    return python


def read_stamp(folder):
    """What an earlier run noted about the environment; empty when there is no valid note."""
    try:
        stamp = json.loads((folder / STAMP).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return stamp if isinstance(stamp, dict) else {}


def fingerprint():
    """Hash of everything that decides what gets installed."""
    digest = hashlib.sha256()
    for name in ("pyproject.toml", "constraints.txt"):
        digest.update((HERE / name).read_bytes() + b"\0")
    return digest.hexdigest()


def is_current(installed, extras):
    """Whether the noted installation is the one that is wanted now."""
    return (
        installed.get("folder") == str(HERE)
        and installed.get("fingerprint") == fingerprint()
        and extras <= set(installed.get("extras", ()))
    )


def works(python):
    """Whether an environment's interpreter is there, starts, and is new enough."""
    test = f"import sys, pip; sys.exit(sys.version_info[:2] < {NEEDED!r})"
    try:
        return python.exists() and subprocess.call([str(python), "-c", test], stderr=subprocess.DEVNULL) == 0
    except OSError:
        return False


def create(folder):
    """Make an empty virtual environment; a broken one in the same place is replaced."""
    for module in ("venv", "ensurepip"):
        if importlib.util.find_spec(module) is None:
            raise SetupError(
                f"this Python came without its module {module}, which makes virtual environments.\n"
                + "On Debian and Ubuntu install it with: sudo apt install python3-venv\n"
                + "Elsewhere install Python from python.org. Then run the same line again."
            )
    print(f"Making a virtual environment in {folder}", flush=True)
    clear = ["--clear"] if (folder / "pyvenv.cfg").is_file() else []
    if subprocess.call([sys.executable, "-m", "venv"] + clear + [str(folder)]) != 0:
        raise SetupError(
            f"the virtual environment in {folder} could not be made; the reason is above.\n"
            + "A full or read-only disk is the usual one; ENGDYN_VENV names another place. "
            + "On Debian and Ubuntu, sudo apt install python3-venv may help."
        )


def install(python, extras):
    """Install the package, editable, with the tested versions; pip's progress stays visible."""
    print("Installing the course and what it needs (first time: a few minutes)", flush=True)
    target = "{}[{}]".format(HERE, ",".join(sorted(extras)))
    command = [str(python), "-m", "pip", "install", "--disable-pip-version-check", "--no-input"]
    command += ["--retries", "2"]
    command += ["-c", str(HERE / "constraints.txt"), "-e", target]
    lines = []
    with subprocess.Popen(
        command, cwd=str(HERE), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace"
    ) as pip:
        for line in pip.stdout:
            lines.append(line)
            if line.strip().startswith(("Collecting", "Processing", "Building", "Installing")):
                print("  " + line.strip()[:100], flush=True)
    if pip.returncode != 0:
        print("".join([line for line in lines if not line.startswith("WARNING")][-20:]), flush=True)
        raise SetupError(installation_advice("".join(lines)))
    print(f"Installed into {python.parent.parent}", flush=True)


def installation_advice(output):
    """Say in plain words why pip failed, as far as its output tells."""
    text = output.lower()
    if any(sign in text for sign in NETWORK_SIGNS):
        return (
            "the packages could not be fetched: no network, or a firewall or proxy in between.\n"
            "Connect and run the same line again; what is already there is kept. "
            "Behind a proxy, set the variable HTTPS_PROXY first."
        )
    if "no space left" in text or "disk quota" in text:
        return (
            "the disk is full; the environment needs about 1 GB.\n"
            "Make room, or name a folder on another disk in the variable ENGDYN_VENV."
        )
    return (
        "pip could not install the course; its own words are above.\n"
        "If a package has no build for this Python, use one of the versions 3.11 to 3.14."
    )


def run(command):
    """Run a command in the course folder and return its exit code; Ctrl-C is left to the command."""
    with subprocess.Popen(command, cwd=str(HERE)) as process:
        previous = signal.signal(signal.SIGTERM, lambda *_: process.terminate())
        try:
            while True:
                try:
                    return process.wait()
                except KeyboardInterrupt:
                    continue
        finally:
            signal.signal(signal.SIGTERM, previous)


if __name__ == "__main__":
    sys.exit(main())
