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

# The app by uv, which takes a sixth of pip's time. Where uv cannot be had or cannot reach the registry that pip is set
# up for, pip does it alone; it always does the rest ("[dev]"): which build of torch is taken is a matter of its settings.
inklined_packages() {
    bin=$venv/bin
    pip() { "$bin/python" -m pip "$@" --disable-pip-version-check; }
    index=$(pip config get global.index-url 2>/dev/null || true)
    if ! { pip install --quiet uv && "$bin/uv" pip install --quiet --system-certs --python "$bin/python" \
        ${index:+--index-url "$index"} --editable "$home[studio]"; } 2>/dev/null; then
        echo "uv cannot reach the packages: pip takes a minute or two instead …" >&2
        pip install --quiet --editable "$home[studio]"
    fi
    if [ "$1" != "[studio]" ]; then pip install --quiet --editable "$home$1"; fi
}

# inklined_install EXTRAS [--studio]: "[studio]" for the app, "[dev]" for every check; "[dev]" contains the app. With
# --studio, what a first drawing in the studio does not need is compiled while the user draws it.
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
    echo "Installing inklined$1 into .venv …" >&2
    inklined_packages "$1"
    # The studio's front end; without npm's registry all but `./run studio` works, which tries again when it is started.
    (cd "$home" && "$venv/bin/python" -m studio.bundle) || echo "The studio's front end is not built; all else works." >&2
    "$venv/bin/inklined" compile ${2:-}
    if [ -n "${2:-}" ]; then (nice -n 19 "$venv/bin/inklined" compile >/dev/null 2>&1 &); fi
    printf '%s' "$state" > "$venv/installed$1"
}
