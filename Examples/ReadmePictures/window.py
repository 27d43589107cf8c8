# SPDX-License-Identifier: BSD-3-Clause
"""Draws the README's picture of ParaView's window after the README's five clicks."""
import os
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import rectified_example as example

sys.path.insert(0, os.path.join(example.ROOT, "Testing", "Python"))
import rt_window

SIZE = 1100, 800
# The panel beside the view, wide and high enough for what is on it.
STYLE = """
#propertiesPanel { min-width: 370px; }
#pipelineBrowserDock { max-height: 125px; }
"""


def main():
    arguments = example.parser(__doc__, output=example.IMAGES).parse_args()
    picture = example.output(arguments, "window.png")
    if not os.environ.get("DISPLAY"):
        sys.exit('Needs a display: xvfb-run -a -s "-screen 0 1600x1200x24 -noreset" pvpython ...')
    steps = rt_window.first_stippling(example.PHOTOGRAPH)
    with tempfile.TemporaryDirectory() as home:
        style = os.path.join(home, "style.qss")
        with open(style, "w", encoding="utf-8") as file:
            file.write(STYLE)
        rt_window.write_settings(home, SIZE)
        said = rt_window.play(home, steps, example.plugin_path(), "PNG8:" + picture,
                              ["-stylesheet", style],
                              ["-crop", "%dx%d+0+0" % SIZE, "+repage", "+dither", "-colors", "256"])
    if "Success =  true" not in said:
        sys.exit(said)
    print("window: " + arguments.output)


if __name__ == "__main__":
    main()
