# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=sh
# UNTRIED. ParaView loads the plugin when it starts from an activated environment. Its own list of
# plugins, paraview.conf, belongs to the package paraview.
for _rectifiedtransport in "$CONDA_PREFIX"/lib/paraview-*/plugins/RectifiedTransport; do
  if [ -d "$_rectifiedtransport" ]; then
    export PV_PLUGIN_PATH="$_rectifiedtransport${PV_PLUGIN_PATH:+:$PV_PLUGIN_PATH}"
  fi
done
unset _rectifiedtransport
