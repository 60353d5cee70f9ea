# Shared by the scripts of this folder: messages, builds and quiet runs. Sourced, not run.
# shellcheck shell=bash

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
script=$(basename "$0")
jobs=$(nproc 2>/dev/null || echo 2)

say() { printf '%s: %s\n' "$script" "$*" >&2; }
die() {
    say "$*"
    exit 1
}

# quietly LOG COMMAND...: output goes to the file LOG; its end is shown when the command fails.
quietly() {
    local log=$1 status=0
    shift
    mkdir -p "$(dirname "$log")"
    "$@" >"$log" 2>&1 </dev/null || status=$?
    if ((status != 0)); then
        tail -n 60 "$log" >&2
        say "failed ($status); all output is in $log"
    fi
    return "$status"
}

# Installs what is missing. Where that cannot be done the build is tried with what is there: CMake says
# what it lacks.
setup() {
    "$root/tools/setup" || say "going on with what is there"
}

# configure FOLDER ARGUMENTS...: Ninja where there is one, the generator that a folder has if it has one.
configure() {
    local folder=$root/$1 generator=()
    shift
    if [[ ! -f $folder/CMakeCache.txt ]] && command -v ninja >/dev/null; then generator=(-G Ninja); fi
    quietly "$folder/configure.log" cmake -S "$root" -B "$folder" "${generator[@]}" "$@" || return 1
    sed -n 's/^-- strandlab: /without: /p' "$folder/configure.log" | while read -r line; do say "$line"; done
}

# build FOLDER [TARGET]: everything, or one target.
build() {
    local folder=$1
    say "building $folder${2:+ ($2)}"
    quietly "$root/$folder/build.log" cmake --build "$root/$folder" --parallel "$jobs" ${2:+--target "$2"}
}
