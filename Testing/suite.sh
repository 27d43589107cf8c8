#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs both commands in a bare Debian of another suite. Testing/run.sh --suite calls it, as root.
# usage: suite.sh SUITE SOURCE.tar COMMIT [ARGUMENT OF Testing/run.sh]...
source "$(dirname "${BASH_SOURCE[0]}")/../CMake/setup.sh"
suite="$1" source="$2" commit="$3"
shift 3
folder="$root/build-suites/$suite"
log="$folder.log"

# Mounts and processes live in namespaces of their own: however this ends, none is left behind.
if [ $$ != 1 ]; then
  if ! unshare --mount --pid --fork true 2> /dev/null; then
    echo "--suite makes mounts, which this system does not let root do (in a container: run it" \
      "privileged)." >&2
    exit 1
  fi
  unshare --mount --pid --fork --kill-child bash "$0" "$suite" "$source" "$commit" "$@" &
  # shellcheck disable=SC2064
  trap "kill -KILL $!; echo 'Interrupted: $suite' >&2; exit 130" INT TERM HUP
  wait $!
  exit
fi

# Debian's mirror that this system has its packages from.
mirror()
{
  local found
  found="$(apt-get indextargets --format '$(ORIGIN) $(LABEL) $(REPO_URI)' |
    sed -n 's/^Debian Debian //p' | head -n 1)"
  echo "${found:-http://deb.debian.org/debian/}"
}

make_system()
{
  if [ -f "$folder.complete" ]; then
    return 0
  fi
  say "Making a bare $suite in $folder"
  echo "This fetches 50 MB and takes 1 min; with what is installed and built in it, it will need" \
    "up to 6 GB. The output of debootstrap is in $log"
  rm -rf "$folder" "$log"
  mkdir -p "$folder"
  logged "$log" debootstrap --variant=minbase "$suite" "$folder" "$(mirror)"
  # If the machine crashes the system is made anew: dpkg need not wait for the disk.
  echo force-unsafe-io > "$folder/etc/dpkg/dpkg.cfg.d/unsafe-io"
  touch "$folder.complete"
}

# The network as it is here, now: names, proxies, and what apt is told of servers.
join_network()
{
  cp --dereference /etc/resolv.conf "$folder/etc/resolv.conf"
  printf '127.0.0.1 localhost\n127.0.0.1 %s\n' "$(hostname)" > "$folder/etc/hosts"
  apt-config dump | grep -iE '^Acquire::(https?|ftp|Retries|Check-|ForceIP|Languages)' \
    > "$folder/etc/apt/apt.conf.d/90host" || true
  echo 'APT::Keep-Downloaded-Packages "false";' >> "$folder/etc/apt/apt.conf.d/90host"
  if [ -f /etc/ssl/certs/ca-certificates.crt ]; then # a proxy may have an authority of its own
    mkdir -p "$folder/etc/ssl/certs"
    cp --dereference /etc/ssl/certs/ca-certificates.crt "$folder/etc/ssl/certs"
  fi
}

mount_all()
{
  mount -t proc proc "$folder/proc"
  mount --rbind --read-only /sys "$folder/sys"
  mount --rbind /dev "$folder/dev"
  mount -t tmpfs tmpfs "$folder/tmp"
}

# The sources with the times of their files, so that a second run builds only what has changed.
copy_source()
{
  mkdir -p "$folder/src"
  find "$folder/src" -mindepth 1 -maxdepth 1 ! -name 'build*' -exec rm -rf {} +
  tar -C "$folder/src" --no-same-owner -xf "$source"
}

inside()
{
  # Where somebody has installed ccache, Debian's links to it come first.
  local name environment=(PATH=/usr/lib/ccache:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8)
  # Displays share their names with those outside, whose locks cannot be seen from here.
  environment+=("first_display=$((1000 + RANDOM))")
  for name in CI TERM OMP_WAIT_POLICY http_proxy https_proxy no_proxy HTTP_PROXY HTTPS_PROXY NO_PROXY; do
    if [ -n "${!name:-}" ]; then
      environment+=("$name=${!name}")
    fi
  done
  env -i "${environment[@]}" chroot "$folder" "$@"
}

# run_command LOG COMMAND...: its output, also in a log; a line for the summary.
run_command()
{
  local command_log="$1" start=$SECONDS result=passed
  shift
  say "$suite: $*"
  if ! inside bash -c 'cd /src && "$@"' - "$@" 2>&1 | tee "$command_log"; then
    result=FAILED
    failed=1
  fi
  summary+="$(printf '%-6s  %4d min  %s' $result $(((SECONDS - start + 30) / 60)) "$*")
$(sed -n 's/^[0-9]*% tests passed.*/                  &/p' "$command_log")
"
}

versions()
{
  inside bash -c 'for program in g++ cmake python3 pvpython; do $program --version | head -n 1; done
    grep -ho "RectifiedTransport: VTK .*" /src/build*/configure.log' 2> /dev/null || true
}

make_system
join_network
mount_all
copy_source
failed=0
summary=""
run_command "$folder-testing.log" bash Testing/run.sh "$@"
run_command "$folder-examples.log" bash Examples/run.sh
say "$suite, $commit"
versions
echo "$summary" | sed '/^$/d'
exit $failed
