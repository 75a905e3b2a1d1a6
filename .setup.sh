# Sourced by ./run and ./test: makes .venv and installs this project into it, once for each state of pyproject.toml.

inklined_python() {
    for candidate in "${PYTHON:-}" python3.11 python3.12 python3.13 python3; do
        if [ -n "$candidate" ] && "$candidate" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then
            echo "$candidate"
            return
        fi
    done
    echo "inklined needs Python 3.11 or newer on the PATH (or named by PYTHON); none was found" >&2
    return 1
}

# inklined_install EXTRAS: "[studio]" for the app, "[dev]" for every check. "[dev]" contains the app.
inklined_install() {
    venv=$home/.venv
    if [ ! -x "$venv/bin/python" ]; then
        python=$(inklined_python)
        echo "Making a virtual environment in .venv …" >&2
        "$python" -m venv "$venv"
    fi
    state=$(cksum < "$home/pyproject.toml")
    for done in "$venv/installed$1" "$venv/installed[dev]"; do
        if [ -f "$done" ] && [ "$(cat "$done")" = "$state" ]; then return; fi
    done
    echo "Installing inklined$1 into .venv (about a minute the first time) …" >&2
    "$venv/bin/python" -m pip install --quiet --disable-pip-version-check --editable "$home$1"
    "$venv/bin/inklined" compile
    printf '%s' "$state" > "$venv/installed$1"
    # The studio's front end; without npm's registry all but `./run studio` works, which tries again when it is started.
    (cd "$home" && "$venv/bin/python" -m studio.bundle) || echo "The studio's front end is not built; all else works." >&2
}
