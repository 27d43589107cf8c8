#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Tries a Debian package in a bare system, where nothing is but what the package depends on.
# Testing/run.sh --package calls it, as root.
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
trap 'unmount_all; rm -rf --one-file-system "$folder" || true' EXIT
cp -a --reflink=auto "$bare" "$folder"
join_network
mount_all
mkdir "$folder/try"
cp -r "$package" "$root/Testing/Package/"*.py "$root/Testing/Python/Support/rt_filters.py" \
  "$root/Testing/Data/raccoon.png" "$root/Examples/Downstream" "$folder/try"
deb="/try/$(basename "$package")"
apt=(apt-get -qy --no-install-recommends)
conf=/usr/bin/paraview.conf
photograph=/try/raccoon.png

# refused WHAT MESSAGE COMMAND...: the command fails with the message.
refused()
{
  local what="$1" message="$2" said
  if said="$(inside env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "${@:3}" 2>&1)"; then
    fail "$what was not refused"
  fi
  echo "$said" >> "$log"
  [[ "$said" == *"$message"* ]] || fail "$what was not refused with \"$message\" but: $said"
  printf 'passed          %s is refused: %s\n' "$what" "$(grep -F -m 1 "$message" <<< "$said")"
}

# Packages to try it against: the next version of it, and another one that has paraview.conf.
make_others()
{
  local work="$folder/try/work" version
  version="$(dpkg-deb --field "$package" Version)"
  dpkg-deb --raw-extract "$package" "$work"
  sed -i "s/^Version: .*/Version: $version.1/" "$work/DEBIAN/control"
  logged "$log" dpkg-deb --root-owner-group --build "$work" "$folder/try/next.deb"
  rm -rf "$work"
  mkdir -p "$work/DEBIAN" "$work/usr/bin"
  echo /elsewhere/other.plugins.xml > "$work$conf"
  printf '%s\n' 'Package: other' 'Version: 1' 'Architecture: all' 'Maintainer: nobody' \
    'Description: another package with a paraview.conf' > "$work/DEBIAN/control"
  logged "$log" dpkg-deb --root-owner-group --build "$work" "$folder/try/other.deb"
  rm -rf "$work"
}

starts_with_plugin()
{
  run_step "pvpython loads the plugin by itself $1" \
    pvpython -c "from paraview.simple import *; print(SampleDensity)"
}

starts_without_plugin()
{
  run_step "pvpython starts as before $1" \
    pvpython -c "from paraview.simple import *; assert 'SampleDensity' not in globals()"
}

say "Trying $(basename "$package") in a bare $suite; the output is in $log"
[ -z "$(find_ours)" ] || fail "the bare system is not bare: $(find_ours)"
make_others
run_step "apt-get update" "${apt[@]}" update
# The administrator's own file is not overwritten.
echo /elsewhere/own.plugins.xml > "$folder$conf"
refused "a $conf of no package" "belongs to no package" "${apt[@]}" install "$deb"
[ "$(cat "$folder$conf")" = /elsewhere/own.plugins.xml ] || fail "the $conf that was there has changed"
rm "$folder$conf"
run_step "apt-get install $deb" "${apt[@]}" install "$deb"
# ParaView's own dependencies bring a compiler; what C++ programs need besides must not be there yet.
for tool in cmake ninja-build libeigen3-dev paraview-dev; do
  [[ "$(inside dpkg-query -W -f '${db:Status-Status}' "$tool" 2> /dev/null || true)" != installed ]] ||
    fail "$tool is there: the system is not bare"
done
plugin="$(inside dpkg -L "$name" | grep '/plugins/.*[.]so$')"
starts_with_plugin "as README.Debian has it"
run_step "pvpython" pvpython /try/in_paraview.py "$photograph"
run_step "pvbatch" pvbatch /try/in_paraview.py "$photograph"
# shellcheck disable=SC2016
run_step "pvserver and pvpython" bash -c 'pvserver --server-port=$0 &
  listening="$(printf ":%04X 0+:0000 0A" $0)"
  for ((i = 0; i < 120; ++i)); do
    ! grep -qE "$listening" /proc/net/tcp* || break
    sleep .5
  done
  pvpython /try/in_paraview.py "$1" $0 && wait' $((20000 + RANDOM % 10000)) "$photograph"
run_step "python3, the plugin by its path" python3 /try/in_paraview.py "$photograph" "$plugin"
run_step "python3, the classes" python3 /try/in_python.py "$photograph"
run_step "pvpython, the classes" pvpython /try/in_python.py "$photograph"
run_step "as a user who may write nothing" setpriv --reuid=65534 --regid=65534 --clear-groups \
  env HOME=/nonexistent pvpython /try/in_paraview.py "$photograph"
refused "another package's $conf" "trying to overwrite" dpkg --install /try/other.deb

run_step "installing the same version again" "${apt[@]}" install --reinstall "$deb"
run_step "apt-get install of the next version" "${apt[@]}" install /try/next.deb
starts_with_plugin "after the upgrade"
run_step "apt-get remove $name" "${apt[@]}" remove "$name"
[ -z "$(find_ours | grep -v "^$folder/var/lib/dpkg/info/" || true)" ] || fail "left over: $(find_ours)"
starts_without_plugin "after remove"
inside dpkg --install /try/other.deb > /dev/null
refused "installing where another package has $conf" "trying to overwrite" "${apt[@]}" install "$deb"
inside dpkg --purge other > /dev/null
run_step "installing it after it was removed" "${apt[@]}" install "$deb"
starts_with_plugin "again"

# shellcheck disable=SC2046
run_step "what README.Debian names for C++" "${apt[@]}" install $(
  sed -n 's/^ *apt install //p' "$folder/usr/share/doc/$name/README.Debian")
run_step "a C++ program: configuring" cmake -S /try/Downstream -B /try/build
run_step "a C++ program: building" cmake --build /try/build
run_step "a C++ program: running" /try/build/Downstream
run_step "apt-get purge $name" "${apt[@]}" purge "$name"
[ -z "$(find_ours)" ] || fail "left over: $(find_ours)"
starts_without_plugin "after purge"
printf 'passed          nothing is left over\n'
