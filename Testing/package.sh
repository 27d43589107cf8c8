#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Tries a Debian package in a bare system, with nothing in it that builds. Testing/run.sh --package calls
# it, as root.
# usage: package.sh SUITE PACKAGE.deb
source "$(dirname "${BASH_SOURCE[0]}")/../CMake/setup.sh"
suite="$1" package="$2"
name="$(dpkg-deb --field "$package" Package)"
folder="$root/build-suites/$suite-bare"
log="$folder.log"
option=--package needed=4
source "$(dirname "${BASH_SOURCE[0]}")/bare_system.sh"
in_namespaces "$0" "$@"

# run_step WHAT COMMAND...: inside the system; its output in the log, and also here if it fails.
run_step()
{
  local start=$SECONDS
  logged "$log" inside env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "${@:2}"
  printf 'passed  %4d s  %s\n' $((SECONDS - start)) "$1"
}

# What a path of the system must not be there for: the names of all that is ours.
find_ours()
{
  find "$folder" -xdev -path "$folder/try" -prune -o \
    \( -iname '*rectified*transport*' -o -name paraview.conf \) -print
}

fail()
{
  echo "FAILED  $*" >&2
  exit 1
}

make_system # stays bare: what follows is done to a copy
bare="$folder"
folder="$root/build-suites/$suite-package"
log="$folder.log"
rm -rf "$folder" "$log"
trap 'rm -rf --one-file-system "$folder" || true' EXIT
cp -a --reflink=auto "$bare" "$folder"
join_network
mount_all
mkdir "$folder/try"
cp -r "$package" "$root/Testing/Package/"*.py "$root/Examples/Downstream" "$folder/try"
deb="/try/$(basename "$package")"
apt=(apt-get -qy --no-install-recommends)

say "Trying $(basename "$package") in a bare $suite; the output is in $log"
[ -z "$(find_ours)" ] || fail "the bare system is not bare: $(find_ours)"
run_step "apt-get update" "${apt[@]}" update
# The administrator's own file is not overwritten.
run_step "fetching what it depends on" "${apt[@]}" --download-only install "$deb"
inside touch /usr/bin/paraview.conf
if refusal="$(inside dpkg --unpack --force-depends "$deb" 2>&1)"; then
  fail "a paraview.conf that is there already was not refused"
fi
[[ "$refusal" == *"belongs to no package"* ]] || fail "another refusal than that of paraview.conf: $refusal"
inside rm /usr/bin/paraview.conf
run_step "apt-get install $deb" "${apt[@]}" install "$deb"
for program in cc gcc g++ cmake ninja make; do
  ! inside sh -c "command -v $program" > /dev/null || fail "$program is there: the system is not bare"
done
plugin="$(inside dpkg -L "$name" | grep '/plugins/.*[.]so$')"
run_step "pvpython -c, as README.Debian has it" \
  pvpython -c "from paraview.simple import *; print(SampleDensity)"
run_step "pvpython" pvpython /try/in_paraview.py
run_step "pvbatch" pvbatch /try/in_paraview.py
port=$((20000 + RANDOM % 10000))
run_step "pvserver and pvpython" bash -c 'pvserver --server-port=$0 & sleep 5 && pvpython /try/in_paraview.py $0' \
  "$port"
run_step "python3, the plugin by its path" python3 /try/in_paraview.py "$plugin"
run_step "python3, the classes" python3 /try/in_python.py
run_step "pvpython, the classes" pvpython /try/in_python.py
run_step "as a user who may write nothing" setpriv --reuid=65534 --regid=65534 --clear-groups \
  env HOME=/nonexistent pvpython /try/in_paraview.py
# shellcheck disable=SC2046
run_step "fetching what README.Debian names for C++" "${apt[@]}" install $(
  sed -n 's/^ *apt install //p' "$folder/usr/share/doc/$name/README.Debian")
run_step "a C++ program: configuring" cmake -S /try/Downstream -B /try/build
run_step "a C++ program: building" cmake --build /try/build
run_step "a C++ program: running" /try/build/Downstream
run_step "apt-get purge $name" "${apt[@]}" purge "$name"
[ -z "$(find_ours)" ] || fail "left over: $(find_ours)"
inside pvpython -c "from paraview.simple import *; assert 'SampleDensity' not in globals()" ||
  fail "ParaView does not start as before"
printf 'passed          nothing is left over\n'
