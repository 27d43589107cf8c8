# SPDX-License-Identifier: BSD-3-Clause
"""Draws the README's pictures of ParaView's window on the way to its first stippling."""
import os
import shutil
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import rectified_example as example

sys.path.insert(0, os.path.join(example.ROOT, "Testing", "Python", "Support"))
import rt_window

SIZE = 1100, 800
# The panel beside the view, wide and high enough for what is on it.
STYLE = """
#propertiesPanel { min-width: 370px; }
#pipelineBrowserDock { max-height: 125px; }
"""


# Where is on the screen what no recording reaches: menus that stay open, and rows of a list.
PLUGIN_ROW, AUTO_LOAD = (173, 173), (337, 276)
FILTERS, TRANSPORT = (217, 10), (260, 435)
DIALOG = 15  # seconds until one is there


def draw(picture, part, home, steps, played=True, colours=64, **options):
    """Keeps a part of the screen, given as "widthxheight+left+top", after steps."""
    style = os.path.join(home, "style.qss")
    with open(style, "w", encoding="utf-8") as file:
        file.write(STYLE)
    rt_window.write_settings(home, SIZE)
    said = rt_window.play(home, steps, options.pop("plugin"), "PNG8:" + picture,
                          [*rt_window.LOADED, "-stylesheet", style],
                          ["-crop", part, "+repage", "+dither", "-colors", str(colours)], **options)
    if played != ("Success =  true" in said):
        sys.exit(said)


def main():
    arguments = example.parser(__doc__, output=example.IMAGES).parse_args()
    if not os.environ.get("DISPLAY"):
        sys.exit('Needs a display: xvfb-run -a -s "-screen 0 1600x1200x24 -noreset" pvpython ...')
    # The dialogs show the paths of the plugin and of the photograph.
    place = os.path.join(tempfile.gettempdir(), "RectifiedTransport")
    os.makedirs(place, exist_ok=True)
    photograph = shutil.copy(example.PHOTOGRAPH, place)
    plugin = os.path.join(place, "RectifiedTransport.so")
    if os.path.lexists(plugin):
        os.remove(plugin)
    os.symlink(example.plugin_path(), plugin)

    steps = rt_window.first_stippling(photograph)
    whole = "%dx%d+0+0" % SIZE
    for name, *rest, options in (
            ("plugin", "640x330+140+66", (rt_window.MANAGE_PLUGINS,),
             {"clicks": (PLUGIN_ROW, AUTO_LOAD), "played": False, "seconds": DIALOG}),
            ("reader", "432x440+320+138", steps[:3], {"played": False, "seconds": DIALOG}),
            ("menu", whole, steps[:5], {"clicks": (FILTERS, TRANSPORT)}),
            ("", whole, steps, {"colours": 32})):
        picture = example.output(arguments, "window-%s.png" % name if name else "window.png")
        with tempfile.TemporaryDirectory() as home:
            part, events = rest
            draw(picture, part, home, events, plugin=plugin, **options)
    shutil.rmtree(place)
    print("window-plugin, window-reader, window-menu, window: " + arguments.output)


if __name__ == "__main__":
    main()
