# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's own window with a pvserver, of one process and of two: the plugin is loaded on both sides as
Documentation/Server.md says, and the picture is that of the window alone."""
import os
import sys

from rt_gui import GuiTest, PHOTOGRAPH
from rt_server import MPIRUN, PVSERVER, started
from rt_testing import SKIPPED, main, need_display
from rt_window import connect, first_stippling, load_new, manage_plugins

PLUGIN = os.environ["RT_PLUGIN"]


class GuiServer(GuiTest):
    def played_on(self, server, picture, *steps, **options):
        self.played(picture, *connect(server.port), *steps, *first_stippling(PHOTOGRAPH), **options)
        self.assert_stippled(picture)

    def test_both_lists(self):
        with started() as server:
            self.played_on(server, "gui-server.png",
                           *manage_plugins(*load_new(PLUGIN, "Local"), *load_new(PLUGIN, "Remote")),
                           plugin=None, options=())

    def test_variable_on_both_sides(self):
        """PV_PLUGIN_PATH, with a server of two processes."""
        with started(2, {"PV_PLUGIN_PATH": os.path.dirname(PLUGIN)}) as server:
            self.played_on(server, "gui-server-2.png")


if __name__ == "__main__":
    if not MPIRUN or not os.path.exists(PVSERVER):
        print("Needs mpirun and pvserver")
        sys.exit(SKIPPED)
    need_display()
    main()
