# shellcheck shell=bash disable=SC2034,SC2154  # the variables are install.sh's
# Part of install.sh: from sources, or from wheels, to a folder in /opt/rotator/versions that works.
#
# Knows Python, pip and what goes wrong with them, in a sentence each. Knows nothing of users, units and configuration.

check_python() {
    "$PYTHON" -c 'import sys; sys.exit(not (3, 11) <= sys.version_info < (3, 14))' 2>/dev/null ||
        die "$PYTHON is not Python 3.11, 3.12 or 3.13; Raspberry Pi OS has one from Bookworm on, or name another: PYTHON=python3.12"
}

find_extras() { # sets extras: what the configuration that is there, or else the profile, needs beside the rest
    extras=$("$PYTHON" -I - "$CONFIG" "$source_at" "rotator/config/profiles/$profile.toml" <<'END'
import sys, tomllib, zipfile
from pathlib import Path
config, source, profile = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3]
try:
    if config.exists():
        text = config.read_text(encoding="utf-8")
    elif source.is_dir():
        text = (source / profile).read_text(encoding="utf-8")
    else:
        text = zipfile.ZipFile(source).read(profile).decode("utf-8")
    file = tomllib.loads(text)
    rotor = file["rotor"]
    kind, is_pi = rotor.get("type"), rotor.get("hardware") == "pi"
    on_spi = is_pi and any(isinstance(table, dict) and table.get("spi") == "kernel" for table in file.values())
    has_broker = "broker" in file.get("mqtt", {})
except (OSError, KeyError, ValueError, AttributeError, TypeError, zipfile.BadZipFile):
    sys.exit()  # a profile there is not, or a file that is wrong: the program itself says so, in a moment
print(*["moteus"] * (kind == "moteus"), *["spidev"] * on_spi, *["paho"] * has_broker)
END
    )
}

find_source() { # sets source_at, what pip is given; version; and print: which sources, for which Python
    local sums
    if [ -n "$wheels" ]; then
        [ -d "$wheels" ] || die "there is no folder $wheels; where there is a network, make it: ./install.sh --fetch-wheels $wheels"
        wheels=$(readlink -f "$wheels")
        source_at=$(find "$wheels" -maxdepth 1 -name 'gs232_rotator-*.whl' | sort -V | tail -n 1)
        [ -n "$source_at" ] || die "$wheels holds no wheel of the rotator; where there is a network, fill it: ./install.sh --fetch-wheels $wheels"
        version=$(basename "$source_at" | cut -d- -f2)
        sums=$(cd "$wheels" && sha256sum -- *.whl; cd "$HERE" && sums_of install)
    else
        [ -f "$HERE/pyproject.toml" ] || die "this folder holds no sources; if it holds wheels: --wheels $HERE"
        source_at=$HERE
        version=$(sed -n 's/^__version__ = "\(.*\)"$/\1/p' "$HERE/rotator/__init__.py")
        sums=$(cd "$HERE" && sums_of pyproject.toml install rotator hw firmware_sim)
    fi
    # An upgrade of the system changes its Python, and an environment made for another one is dead.
    print="$("$PYTHON" -c 'import sys; print("python%d.%d" % sys.version_info[:2])') $(sha256sum <<<"$sums" | cut -c1-16)"
    find_extras
    # With another set of packages it is another version, built beside: going back to the one before stays possible.
    print+=${extras:+ $extras}
}

sums_of() { # FILE-OR-FOLDER...
    find "$@" -type f ! -path '*/__pycache__/*' -print0 | LC_ALL=C sort -z | xargs -0 sha256sum
}

find_version() { # sets version_at: the folder that has these sources already, or the one to build
    local file
    for file in "$APP"/versions/*/print; do
        if [ "$(cat "$file" 2>/dev/null)" = "$print" ]; then version_at=$(dirname "$file"); return; fi
    done
    version_at=$APP/versions/$version
    # The same number with other sources, as after `git pull`, or for another Python: it gets a name of its own.
    if [ -e "$version_at/print" ]; then version_at+=+$(sha256sum <<<"$print" | cut -c1-8); fi
}

build_version() { # The print goes in last and says that the folder is whole.
    local from=() log=$scratch/log name locked=()
    half_built=$version_at
    rm -rf "$version_at"
    mkdir -p "$version_at"
    if [ -n "$wheels" ]; then from=(--no-index --find-links "$wheels"); fi
    for name in base $extras; do locked+=("${LOCKED[@]}" "$HERE/install/lock/$name.txt"); done
    {
        make_environment "$version_at" && put_in "${from[@]}" "${locked[@]}" && put_in_program &&
            launcher "$version_at" >"$version_at/bin/rotator" &&
            cp -r "$HERE/install" "$version_at/install"
    } >"$log" 2>&1 || die "$(what_went_wrong "$log"); nothing has been changed"
    try_out "$version_at" || die "version $version does not work here, it says why above; nothing has been changed"
    echo "$print" >"$version_at/print"
    half_built=''
}

# Each package in the version of the list, each file with the hash of the list, and nothing that the list lacks: moteus
# declares scipy for a tool of its own, 200 MB of it.
LOCKED=(--no-deps --require-hashes --requirement)

put_in() { # into $version_at, by pip
    "$version_at/bin/pip" install --quiet --no-cache-dir --retries 1 --timeout 20 "$@"
}

put_in_program() { # the wheel; or from sources, by the build tools that are locked, which do not stay
    if [ -d "$source_at" ]; then
        put_in --target "$scratch/build" "${LOCKED[@]}" "$HERE/install/lock/build.txt" &&
            PYTHONPATH=$scratch/build put_in --no-build-isolation --no-deps "$source_at"
    else
        put_in --no-index --no-deps "$source_at"
    fi
}

launcher() { # FOLDER: in place of pip's, prints one in which Ctrl-C waits until Python has started, and ends it without a traceback
    cat <<END
#!/usr/bin/env -S --block-signal=INT $1/bin/python
import signal

if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
    signal.signal(signal.SIGINT, signal.SIG_DFL)
signal.pthread_sigmask(signal.SIG_UNBLOCK, (signal.SIGINT,))

from rotator.__main__ import main

main()
END
}

make_environment() { # FOLDER. In two steps: in one, venv would keep to itself why pip cannot be put in.
    "$PYTHON" -m venv --without-pip "$1" && "$1/bin/python" -m ensurepip --default-pip
}

fetch_wheels() { # into $fetch, for $arch and each Python that will do
    local log=$scratch/log machine platforms=() minor name
    arch=${arch:-$(dpkg --print-architecture)}
    case $arch in
        arm64) machine=aarch64 ;;
        armhf) machine=armv7l ;;
        amd64) machine=x86_64 ;;
        *) die "--arch $arch: must be arm64, armhf or amd64" ;;
    esac
    check_python
    [ -f "$HERE/pyproject.toml" ] || die "this folder holds no sources; run it where they are"
    # Every C library up to Bookworm's, which has 2.36.
    for minor in {5..36}; do platforms+=(--platform "manylinux_2_${minor}_$machine"); done
    platforms+=(--platform "manylinux2014_$machine")
    echo "  fetches for $arch, Python 3.11, 3.12 and 3.13, into $fetch"
    mkdir "$scratch/wheels"
    {
        version_at=$scratch/venv && make_environment "$version_at" &&
            put_in "${LOCKED[@]}" "$HERE/install/lock/build.txt" &&
            "$version_at/bin/pip" wheel --quiet --no-build-isolation --no-deps --wheel-dir "$scratch/wheels" "$HERE"
    } >"$log" 2>&1 || die "$(what_went_wrong "$log")"
    for minor in 11 12 13; do
        for name in base moteus paho; do fetch_for "$minor" "$HERE/install/lock/$name.txt"; done
    done
    mkdir -p "$fetch"
    rm -f "$fetch"/*.whl
    cp -r "$scratch"/wheels/*.whl "$HERE/install.sh" "$HERE/install" "$fetch/"
    echo "All is in $fetch. Carry it over; there: sudo ./install.sh --wheels ."
}

fetch_for() { # MINOR LIST: for Python 3.MINOR on $platforms
    "$scratch/venv/bin/pip" download --quiet --retries 1 --timeout 20 --dest "$scratch/wheels" --only-binary=:all: --implementation cp \
        --python-version "3.$1" --abi "cp3$1" --abi abi3 --abi none "${platforms[@]}" "${LOCKED[@]}" "$2" >"$log" 2>&1 ||
        die "$(what_went_wrong "$log")"
}

what_went_wrong() { # LOG
    local missing
    missing=$(sed -n 's/.*No matching distribution found for \([^ (;<>=]*\).*/\1/p' "$1" | tail -n 1)
    if grep -q 'No space left on device' "$1"; then
        echo "the disk is full: $ROOM_MB MB are needed in $APP"
    elif grep -q 'DO NOT MATCH THE HASHES' "$1"; then
        echo "a package is not the one that this version was tested with: on its way here it was damaged, or replaced"
    elif grep -qE 'ensurepip is not|No module named (venv|ensurepip)' "$1"; then
        echo "Python cannot make a virtual environment: sudo apt install python3-venv"
    elif grep -qE 'NewConnectionError|ConnectTimeout|ReadTimeout|NameResolution|ProxyError|SSLError' "$1"; then
        echo "the network cannot be reached; for a machine without one see --fetch-wheels and --wheels"
    elif grep -qE '(gcc|cc|cargo)[^ ]* failed|Python\.h|command .*(gcc|cc|cargo).* not found' "$1"; then
        echo "a package has to be compiled on this machine: sudo apt install gcc python3-dev, and again"
    elif [ -n "$missing" ] && [ -n "$fetch" ]; then
        echo "there is no ready-made $missing for $arch: such a machine needs the network to install"
    elif [ -n "$missing" ] && [ -n "$wheels" ]; then
        echo "$wheels lacks $missing for this Python and machine: fetch with --arch $(dpkg --print-architecture)"
    else
        echo "pip failed: $(grep -vE '^ *$|WARNING|notice' "$1" | tail -n 1)"
    fi
}
