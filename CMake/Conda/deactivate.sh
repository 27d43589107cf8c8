# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=sh
# UNTRIED. Takes away what activate.sh has put in front.
for _rectifiedtransport in "$CONDA_PREFIX"/lib/paraview-*/plugins/RectifiedTransport; do
  case "${PV_PLUGIN_PATH:-}" in
    "$_rectifiedtransport") unset PV_PLUGIN_PATH ;;
    "$_rectifiedtransport":*) export PV_PLUGIN_PATH="${PV_PLUGIN_PATH#"$_rectifiedtransport":}" ;;
  esac
done
unset _rectifiedtransport
