#!/bin/sh
# Sets the station up on a computer that has only git, make and Python 3.11 to 3.13.
#
#   tools/setup.sh DIR              system packages the station needs, a virtual environment in DIR, the station in it
#   tools/setup.sh --test-packages  the system packages that only the tests need
#
# On Debian and Ubuntu missing packages come through apt (with sudo when not root); elsewhere a line says what to install.
# A compiler comes only where a library has no ready-made wheel for this Python and computer (docs/decisions/0039).
set -eu

RUN_PACKAGES='libportaudio2 libegl1 libgl1 libgl1-mesa-dri libxrandr2 libxinerama1 libxcursor1 libxi6 libxkbcommon0'
BUILD_PACKAGES='g++ pkg-config libasound2-dev libjack-jackd2-dev'
TEST_PACKAGES='xvfb jackd2 postgresql chromium chromium-driver'

missing_of() {
    for package in $1; do
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed' || printf '%s ' "$package"
    done
}

as_root() {
    if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

# The tests start a server of their own; the package would start another now and at every boot.
without_main_cluster() {
    [ ! -d /etc/postgresql-common ] || return 0  # somebody's own PostgreSQL stays as it is
    as_root mkdir -p /etc/postgresql-common/createcluster.d
    echo 'create_main_cluster = false' | as_root tee /etc/postgresql-common/createcluster.d/drum-station.conf >/dev/null
}

install_system() {
    [ "$(uname -s)" = Linux ] || return 0
    if ! command -v apt-get >/dev/null 2>&1; then
        echo "setup: not a Debian or Ubuntu; please see that what these bring is installed: $1" >&2
        return 0
    fi
    missing=$(missing_of "$1")
    [ -n "$missing" ] || return 0
    if [ "$(id -u)" != 0 ] && ! command -v sudo >/dev/null 2>&1; then
        echo "setup: not root and no sudo; please have these installed: $missing" >&2
        return 0
    fi
    echo "setup: installing system packages: $missing"
    case " $missing " in *' postgresql '*) without_main_cluster ;; esac
    as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq update
    # shellcheck disable=SC2086 # a list of words
    as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends $missing >/dev/null
}

find_python() {
    for python in "${PYTHON:-}" python3 python3.13 python3.12 python3.11; do
        [ -n "$python" ] && command -v "$python" >/dev/null 2>&1 || continue
        if "$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then
            echo "$python"
            return 0
        fi
    done
    echo "setup: Python 3.11 or newer is needed and was not found; set PYTHON to it" >&2
    return 2
}

python_package() {
    "$python" -c 'import sys; print("python%d.%d-%s" % (*sys.version_info[:2], sys.argv[1]))' "$1"
}

install_station() {
    "$venv/bin/python" -m pip install --quiet --disable-pip-version-check -c constraints.txt "$@" -e '.[dev]'
}

install_compiler() {
    if ! "$python" -c 'import os, sysconfig; os.stat(sysconfig.get_path("include") + "/Python.h")' 2>/dev/null; then
        BUILD_PACKAGES="$BUILD_PACKAGES $(python_package dev)"
    fi
    install_system "$BUILD_PACKAGES"
}

if [ "${1:-}" = --test-packages ]; then
    install_system "$TEST_PACKAGES"
    exit 0
fi

venv=${1:?usage: tools/setup.sh DIR}
python=$(find_python)
if [ "$(uname -s)" = Linux ] && ! "$python" -c 'import ensurepip' >/dev/null 2>&1; then
    RUN_PACKAGES="$RUN_PACKAGES $(python_package venv)"
fi
install_system "$RUN_PACKAGES"
[ -x "$venv/bin/python" ] || "$python" -m venv "$venv"
echo "setup: installing the station into $venv"
if ! install_station --only-binary=:all: 2>/dev/null; then
    echo "setup: not every library comes ready-made for this Python; building what does not"
    install_compiler
    install_station
fi
