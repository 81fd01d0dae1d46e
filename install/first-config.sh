#!/bin/sh
# Prints the configuration that a service begins with: a shipped profile, with the places that a service has.
# Of install.sh and of the Debian package. Usage: first-config.sh ROTATOR PROFILE; ROTATOR is the program.
set -e
"$1" config "$2" >/dev/null # a profile there is not: the program says so, and this ends
text=$("$1" config "$2" | sed 's|^pty = "run/|pty = "/run/rotator/|')
printf '%s\n' "$text"
case $text in
    *'[state]'*) ;;
    *) printf '\n[state]\npath = "/var/lib/rotator/state.json"\n' ;;
esac
case $text in
    *'[page]'*) ;;
    *) printf '\n[page]  # on private networks anyone may look and STOP; to move the antenna a browser is paired: rotator pair\nlisten = "0.0.0.0:8232"\n' ;;
esac
