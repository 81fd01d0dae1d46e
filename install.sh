#!/usr/bin/env bash
# Puts the rotator on a Raspberry Pi, or another Debian machine, as a service. Run again, it updates; it also takes back.
#
# Knows what goes where and in which order, so that a failure on the way leaves the machine as it was. Every change goes
# through `act`, which says it first; with --dry-run it only says it. The files that are put in place are in install/, the
# building of a version in install/version.sh. The program itself writes and checks the configuration.
set -euo pipefail

usage() {
    cat <<'END'
usage: sudo ./install.sh [--profile NAME] [--wheels DIR]    install, or update to what is in this folder
       sudo ./install.sh --rollback                         back to the version before
       sudo ./install.sh --remove [--keep]                  take everything away; --keep: all but configuration and state
       ./install.sh --fetch-wheels DIR [--arch ARCH]        fill DIR with all that a machine without network needs

It says what it would do, asks, and only then does it.

  --yes             do not ask; without a terminal it is needed
  --dry-run         say what would be done and change nothing; needs no sudo
  --profile NAME    which configuration to begin with: simulated (unless given), g5500, ...; one that is there stays
  --wheels DIR      take everything from DIR, nothing from the network
  --arch ARCH       for --fetch-wheels: arm64, armhf or amd64; this machine's unless given

A configuration of moteus controllers, of chips on the kernel's SPI, or of a broker brings the packages that these need.
Another Python than python3: sudo PYTHON=python3.12 ./install.sh
END
}

HERE=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
APP=/opt/rotator            # versions/NAME, a virtual environment each; current and previous point at two of them
MADE=$APP/made              # the groups and folders that were not there before: only those are taken away again
COMMAND=/usr/local/bin/rotator
CONFIG_AT=/etc/rotator
CONFIG=$CONFIG_AT/rotator.toml
STATE_AT=/var/lib/rotator
MEMORY_AT=/run/rotator     # the unit keeps it after a stop: what a full or read-only card has refused
UNIT=/etc/systemd/system/rotator.service
WATCHDOG=/etc/systemd/system.conf.d/50-rotator-watchdog.conf
RULES=/etc/udev/rules.d/60-rotator.rules
AVAHI=/etc/avahi/services/rotator.service
USB_SERIAL=/etc/systemd/system/rotator-usb-serial.service
DEVICE_GROUPS=(gpio i2c spi dialout)
ROOM_MB=150

PYTHON=${PYTHON:-python3}
export PYTHONDONTWRITEBYTECODE=1 PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_NO_INPUT=1 PIP_ROOT_USER_ACTION=ignore
task=install_it profile=simulated wheels='' fetch='' arch='' dry=no keep=no sure=no
changes=0 renewed=' ' extras='' half_built='' scratch=''

# --- Saying and doing -------------------------------------------------------------------------------------------------

die() { echo "install.sh: $*" >&2; exit 1; }

act() { # SENTENCE COMMAND...
    echo "  $1"
    changes=$((changes + 1))
    if [ $dry = no ]; then "${@:2}"; fi
}

finish() { # SENTENCE
    if [ $changes = 0 ]; then echo "Nothing to do: $1"
    elif [ $dry = yes ]; then echo "Nothing has been changed: this was --dry-run."
    else echo "Done: $1"; fi
}

tidy() { # at every end, good or bad
    if [ -n "$half_built" ]; then rm -rf "$half_built"; rmdir $APP/versions $APP 2>/dev/null || true; fi
    rm -rf "$scratch"
}

there() { [ -e "$1" ] || [ -L "$1" ]; }

put() { # SOURCE TARGET
    if cmp -s "$1" "$2"; then return; fi
    make_folder "$(dirname "$2")"
    act "writes $2" install -m 644 "$1" "$2"
    renewed+="$2 "
}

drop() { # TARGET; where a disk is mounted, what is in it
    if mountpoint -q "$1"; then act "empties $1" find "$1" -mindepth 1 -delete
    elif there "$1"; then act "removes $1" rm -rf "$1"; fi
}

point() { # LINK TARGET, at one stroke
    if [ "$(readlink "$1")" != "$2" ]; then act "points $1 at $2" point_now "$1" "$2"; renewed+="$1 "; fi
}
point_now() { ln -sfn "$2" "$1.new" && mv -T "$1.new" "$1"; }

make_folder() { # FOLDER, and those above it
    if [ -d "$1" ]; then return; fi
    make_folder "$(dirname "$1")"
    act "makes the folder $1" make_and_note "folder $1" mkdir -m 755 "$1"
}
make_and_note() { "${@:2}" && echo "$1" >>$MADE; }

# --- Install and update -----------------------------------------------------------------------------------------------

install_it() {
    check_python
    find_source
    find_version
    refuse_an_unknown_profile
    refuse_what_is_not_ours
    if [ -e "$version_at/print" ]; then
        try_out "$version_at" || die "version $version, which is here already, does not accept that; nothing has been changed"
    else
        refuse_a_full_disk
        act "builds version $version${extras:+ with $extras} in $version_at (minutes on a small Pi)" build_version
    fi
    make_user
    if [ ! -e $CONFIG ]; then act "writes $CONFIG, profile $profile" write_config; fi
    switch_to "$version_at" "$HERE/install"
    finish "rotator $version is installed. Configuration: $CONFIG. Log: journalctl -fu rotator"
}

refuse_an_unknown_profile() {
    local file known=simulated
    for file in $(if [ -d "$source_at" ]; then find "$source_at/rotator/config"; else "$PYTHON" -m zipfile -l "$source_at"; fi | sort); do
        case $file in */profiles/*.toml) known+=" $(basename "$file" .toml)" ;; esac
    done
    case " $known " in *" $profile "*) ;; *) die "there is no profile $profile; there are: $known" ;; esac
}

refuse_what_is_not_ours() {
    local home
    [ "$(dpkg-query --show --showformat '${db:Status-Status}' gs232-rotator 2>/dev/null)" != installed ] ||
        die "the Debian package is installed; first: sudo apt remove gs232-rotator (configuration and state stay)"
    home=$(getent passwd rotator | cut -d: -f6) || true
    [ -z "$home" ] || [ "$home" = $STATE_AT ] ||
        die "there is another user rotator already, with the home $home; the service needs that name: rename the other"
    ! there $COMMAND || [ "$(readlink $COMMAND)" = $APP/current/bin/rotator ] || die "there is another $COMMAND; remove it first"
}

refuse_a_full_disk() {
    local free_mb
    free_mb=$(df -Pm "$(dirname $APP)" | awk 'NR == 2 { print $4 }')
    [ "$free_mb" -ge $ROOM_MB ] || die "the disk is full: $ROOM_MB MB are needed in $APP, $free_mb are free; nothing has been changed"
}

try_out() { # FOLDER: it starts, has the profile, and accepts the configuration that is there, or else the profile
    local package
    "$1/bin/rotator" --version >/dev/null && "$1/bin/rotator" config "$profile" >"$scratch/profile.toml" || return 1
    for package in $extras; do "$1/bin/python" -I -c "import $package" || return 1; done
    if [ -e $CONFIG ]; then open_ports "$1" $CONFIG >/dev/null; else open_ports "$1" "$scratch/profile.toml" >/dev/null; fi
}

open_ports() { # FOLDER FILE: prints the port of each rotctld that is open to the network; fails on a wrong configuration
    "$1/bin/python" -I - "$2" <<'END'
import ipaddress, sys
from pathlib import Path
from rotator.config.load import ConfigError, load
try:
    links = load(Path(sys.argv[1])).link
except ConfigError as fault:
    sys.exit(str(fault))
for link in links:
    if link.protocol != "rotctld" or not link.tcp:
        continue
    host, _, port = link.tcp.rpartition(":")
    try:
        for_all = not ipaddress.ip_address(host.strip("[]")).is_loopback
    except ValueError:
        for_all = host != "localhost"
    if for_all:
        print(port)
END
}

make_user() {
    local group folder
    for group in "${DEVICE_GROUPS[@]}"; do
        if ! getent group "$group" >/dev/null; then
            act "makes the group $group" make_and_note "group $group" groupadd --system "$group"
        fi
    done
    if ! getent passwd rotator >/dev/null; then
        act "makes the user rotator, who cannot log in" \
            useradd --system --user-group --home-dir $STATE_AT --no-create-home --shell /usr/sbin/nologin rotator
    fi
    for group in "${DEVICE_GROUPS[@]}"; do
        if ! id -nG rotator 2>/dev/null | grep -qw "$group"; then
            act "adds rotator to the group $group" usermod --append --groups "$group" rotator
        fi
    done
    for folder in $CONFIG_AT $STATE_AT; do
        if [ "$(stat -c %U "$folder" 2>/dev/null)" != rotator ]; then act "gives $folder to rotator" own "$folder"; fi
    done
}
own() { mkdir -p "$1" && chmod 755 "$1" && chown -R rotator:rotator "$1"; }

write_config() {
    "$HERE/install/first-config.sh" "$version_at/bin/rotator" "$profile" >"$scratch/rotator.toml"
    # By the user whose folder it is: root would follow a link that lies there. It may come to hold a password.
    runuser -u rotator -- sh -c "umask 027; cat >$CONFIG" <"$scratch/rotator.toml"
}

switch_to() { # VERSION FILES: put the files in place, point current at the version, start it
    local first=no folder
    if [ ! -e $UNIT ]; then first=yes; fi
    put "$2/rotator.service" $UNIT
    put "$2/50-rotator-watchdog.conf" $WATCHDOG
    # Raspberry Pi's own rules give the devices to these groups already.
    if [ ! -e /usr/lib/udev/rules.d/99-com.rules ] && [ ! -e /etc/udev/rules.d/99-com.rules ]; then
        put "$2/60-rotator.rules" $RULES
    fi
    announce "$1" "$2"
    if [ -L $APP/current ] && [ "$(readlink $APP/current)" != "$1" ]; then point $APP/previous "$(readlink $APP/current)"; fi
    point $APP/current "$1"
    point $COMMAND $APP/current/bin/rotator
    for folder in "$APP"/versions/*/; do
        case ${folder%/} in "$1" | "$(readlink $APP/current)" | "$(readlink $APP/previous)") ;; *) drop "${folder%/}" ;; esac
    done
    if [ $first = yes ]; then
        make_folder /etc/systemd/system/multi-user.target.wants
        act "has the service start with the machine" systemctl --quiet enable rotator.service
    fi
    if [ -d /run/systemd/system ]; then tell_the_system $first; fi
}

announce() { # VERSION FILES: by Avahi, where it is installed, and only what the configuration opens to the network
    local port=''
    if [ -e $CONFIG ] && [ -x "$1/bin/python" ]; then port=$(open_ports "$1" $CONFIG | head -n 1); fi
    if [ -n "$port" ] && [ -d "$(dirname $AVAHI)" ]; then
        sed "s/@PORT@/$port/" "$2/avahi.service" >"$scratch/avahi.service"
        put "$scratch/avahi.service" $AVAHI
    else
        drop $AVAHI
    fi
}

tell_the_system() { # FIRST: of what has been renewed, those whom it concerns
    case $renewed in *" $UNIT "*) act "has systemd read the unit" systemctl daemon-reload ;; esac
    case $renewed in *" $WATCHDOG "*) act "has systemd start the watchdog" systemctl daemon-reexec ;; esac
    case $renewed in *" $RULES "*)
        act "has udev read the rules" udevadm control --reload
        act "has udev apply them" udevadm trigger --subsystem-match=gpio --subsystem-match=i2c-dev --subsystem-match=spidev ;;
    esac
    if [ "$1" = yes ]; then
        act "starts the service" start
    elif systemctl --quiet is-active rotator.service; then
        case $renewed in *" $UNIT "* | *" $APP/current "*) act "restarts the service" start ;; esac
    fi
}
start() { systemctl restart rotator.service || die "the service does not start: journalctl -eu rotator says why; --rollback goes back"; }

# --- Back, and away ---------------------------------------------------------------------------------------------------

roll_back() {
    local before
    before=$(readlink $APP/previous) || die "there is no version before this one"
    source_at=$HERE find_extras
    try_out "$before" || die "the version before does not accept $CONFIG; nothing has been changed"
    switch_to "$before" "$before/install"
    finish "$(basename "$before") is back; --rollback again returns to the newer one."
}

remove_it() {
    local file folder
    refuse_what_is_not_ours
    if [ -e $USB_SERIAL ]; then die "first let the Pi be no COM port any more: sudo rotator setup usb-serial --undo"; fi
    if [ $keep = no ] && { [ -e $CONFIG_AT ] || [ -e $STATE_AT ]; }; then
        echo "This deletes your configuration and calibrations in $CONFIG_AT, and what the box has learnt, in $STATE_AT; --keep keeps them."
    fi
    if [ -e $UNIT ]; then
        if [ -d /run/systemd/system ]; then act "stops the service" systemctl stop rotator.service; fi
        act "has it start no more" systemctl --quiet disable rotator.service
    fi
    for file in $UNIT $WATCHDOG $RULES $AVAHI $COMMAND; do drop "$file"; done
    for folder in $CONFIG_AT $STATE_AT $MEMORY_AT; do
        if [ $keep = no ]; then drop "$folder"
        elif [ "$(stat -c %U "$folder" 2>/dev/null)" = rotator ]; then act "keeps $folder, for root" chown -R root:root "$folder"; fi
    done
    if getent passwd rotator >/dev/null; then act "removes the user rotator" userdel rotator; fi
    if [ -e $MADE ]; then take_back_what_was_made; fi
    drop $APP
    if [ $changes != 0 ] && [ -d /run/systemd/system ]; then
        act "has systemd forget it" systemctl daemon-reexec
        act "has udev forget it" udevadm control --reload
    fi
    finish "rotator is not installed."
}

take_back_what_was_made() { # the latest first; what others use by now stays
    local kind name members
    tac $MADE >"$scratch/made"
    while read -r kind name; do
        members=$(getent group "$name" | cut -d: -f4) || true
        case $kind in
            group) if [ -z "$members" ] || [ "$members" = rotator ]; then act "removes the group $name" groupdel "$name"; fi ;;
            folder) act "removes the folder $name, if it is empty" rmdir --ignore-fail-on-non-empty "$name" ;;
        esac
    done <"$scratch/made"
}

# --- The command line -------------------------------------------------------------------------------------------------

# shellcheck source=install/version.sh
. "$HERE/install/version.sh"

ask_first() { # OPTION...: those of this run. A dry run says everything; where there is nothing to do, that is all.
    local plan answer
    plan=$(bash "$HERE/install.sh" "$@" --dry-run) || exit 1
    case $plan in "Nothing to do"*) echo "$plan"; exit 0 ;; esac
    echo "This is what it would do:"
    sed '$d' <<<"$plan" # without the line that says it was a dry run
    need_root "$@"
    [ -t 0 ] || die "without a terminal to ask at it needs --yes; nothing has been changed"
    read -r -p "Do this? [y/N] " answer
    case $answer in y | Y | yes) ;; *) die "nothing has been changed" ;; esac
}

need_root() { [ "$(id -u)" = 0 ] || die "only root may do that: sudo ./install.sh${*:+ $*}; nothing has been changed"; }

needs_value() { [ -n "${2:-}" ] || die "$1 needs a value; see ./install.sh --help"; }

given=("$@")
while [ $# -gt 0 ]; do
    case $1 in
        --profile) needs_value "$@"; profile=$2; shift ;;
        --wheels) needs_value "$@"; wheels=$2; shift ;;
        --fetch-wheels) needs_value "$@"; task=fetch_wheels fetch=$2; shift ;;
        --arch) needs_value "$@"; arch=$2; shift ;;
        --rollback) task=roll_back ;;
        --remove) task=remove_it ;;
        --keep) keep=yes ;;
        --yes) sure=yes ;;
        --dry-run) dry=yes ;;
        -h | --help) usage; exit 0 ;;
        *) die "there is no option $1; see ./install.sh --help" ;;
    esac
    shift
done

if [ $task != fetch_wheels ] && [ $dry = no ]; then
    if [ $sure = no ]; then ask_first "${given[@]}"; fi
    need_root "${given[@]}"
    exec 9<"$HERE/install.sh"
    flock --nonblock 9 || die "another install.sh is at work; wait for its end"
fi
scratch=$(mktemp -d)
trap tidy EXIT
trap 'exit 1' INT TERM HUP
$task
