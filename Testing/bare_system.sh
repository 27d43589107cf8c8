# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash disable=SC2154
# Bare systems of Debian's suites, made by debootstrap. Sourced by suite.sh and package.sh, which run
# as root, after setup.sh. They set `suite`, `folder` and `log`, and for messages the `option` of
# Testing/run.sh and the GB `needed`.

# in_namespaces SCRIPT ARGUMENT...: runs the script again, once, with mounts and processes of its own:
# however it ends, none is left behind.
in_namespaces()
{
  if [ $$ = 1 ]; then
    return 0
  fi
  if ! unshare --mount --pid --fork true 2> /dev/null; then
    echo "$option makes mounts, which this system does not let root do (in a container: run it" \
      "privileged)." >&2
    exit 1
  fi
  unshare --mount --pid --fork --kill-child bash "$@" &
  # shellcheck disable=SC2064
  trap "kill -KILL $!; echo 'Interrupted: $suite' >&2; exit 130" INT TERM HUP
  wait $!
  exit
}

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
  echo "This fetches 50 MB and takes 1 min; with what is installed in it, it will need up to" \
    "$needed GB. The output of debootstrap is in $log"
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

unmount_all()
{
  local name
  for name in proc sys dev tmp; do
    umount --recursive --lazy "$folder/$name" 2> /dev/null || true
  done
}

inside()
{
  # Where somebody has installed ccache, Debian's links to it come first.
  local name environment=(PATH=/usr/lib/ccache:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8)
  # Displays share their names with those outside, whose locks cannot be seen from here.
  environment+=("first_display=$((1000 + RANDOM))")
  # Not CI, which makes errors of warnings: other compilers have others.
  for name in TERM OMP_WAIT_POLICY http_proxy https_proxy no_proxy HTTP_PROXY HTTPS_PROXY NO_PROXY; do
    if [ -n "${!name:-}" ]; then
      environment+=("$name=${!name}")
    fi
  done
  env -i "${environment[@]}" chroot "$folder" "$@"
}
