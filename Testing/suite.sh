#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs both commands in a bare Debian of another suite, kept in the folder that RT_SUITES names.
# Testing/run.sh --suite calls it, as root.
# usage: suite.sh SUITE SOURCE.tar COMMIT [ARGUMENT OF Testing/run.sh]...
source "$(dirname "${BASH_SOURCE[0]}")/../CMake/setup.sh"
suite="$1" source="$2" commit="$3"
shift 3
folder="$RT_SUITES/$suite"
log="$folder.log"
option=--suite needed=6
source "$(dirname "${BASH_SOURCE[0]}")/bare_system.sh"
in_namespaces "$0" "$suite" "$source" "$commit" "$@"

# The sources. Files that are as they were keep their times, others get this one: a second run builds
# what has changed, whenever that was.
copy_source()
{
  local new="$folder/src.new" old="$folder/src" file
  rm -rf "$new"
  mkdir -p "$new" "$old"
  tar -C "$new" --no-same-owner --touch -xf "$source"
  (cd "$new" && find . -type f) | while read -r file; do
    if cmp -s "$old/$file" "$new/$file"; then
      touch -r "$old/$file" "$new/$file"
    fi
  done
  find "$old" -mindepth 1 -maxdepth 1 -name 'build*' -exec mv -t "$new" {} +
  rm -rf "$old"
  mv "$new" "$old"
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
examples=--all
if [[ " $* " == *" --quick "* ]]; then
  examples=StippleImage
fi
run_command "$folder-examples.log" bash Examples/run.sh "$examples"
say "$suite, $commit"
versions
echo "$summary" | sed '/^$/d'
exit $failed
