# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's own window, driven by a recording: for TestGui and the README's picture of it."""
import os
import subprocess
import time
import xml.etree.ElementTree as ElementTree

from paraview.simple import GetParaViewSourceVersion

WINDOW = "pqClientMainWindow/"
PANEL = ("propertiesDock/propertiesPanel/scrollArea/qt_scrollarea_viewport/"
         "scrollAreaWidgetContents/PropertiesFrame/ProxyPanel/")
APPLY = ("propertiesDock/propertiesPanel/Accept", "activate", "")
ADVANCED = ("propertiesDock/propertiesPanel/SearchBox/AdvancedButton", "set_boolean", "true")

HELP = ("propertiesDock/propertiesPanel/Help", "activate", "")  # the ? of the panel
MANAGE_PLUGINS = ("menubar/menuTools", "activate", "actionManage_Plugins")
HELP_PAGE = "pqHelpWindow/1QTextBrowser0"


LOADED = ("--plugins=RectifiedTransport",)  # options: the plugin is loaded from PV_PLUGIN_PATH


def choose(menu, name):
    return "menubar/menu%s/Transport" % menu, "activate", name


def tick(name):
    return PANEL + name + "/CheckBox", "set_boolean", "true"


def open_state(path, files="Search files under specified directory"):
    """A state is opened, and its data found in the folder that ParaView proposes: the state's."""
    dialog = "/LoadStateOptionsDialog/"
    choice = ("scrollArea/qt_scrollarea_viewport/Container/ProxyWidget/LoadStateDataFileOptions/"
              "ComboBox")
    return (("menubar/menu_File", "activate", "actionFileLoadServerState"),
            ("FileLoadServerStateDialog", "filesSelected", path),
            (dialog + choice, "set_string", files),
            (dialog + "widget/OKButton", "activate", ""))


def first_stippling(photograph):
    """A photograph is opened, and the README's clicks follow, up to a picture."""
    return (("menubar/menu_File", "activate", "actionFileOpen"),
            ("FileOpenDialog", "filesSelected", photograph),
            ("pqSelectReaderDialog/listWidget", "currentChanged", "/1|0"),  # PNG Series Reader
            ("pqSelectReaderDialog/okButton", "activate", ""),
            APPLY,
            choose("Filters", "TransportSampler"),
            tick("InvertDensity"),
            APPLY,
            ("MainControlsToolbar/1QToolButton12", "activate", ""),  # palettes
            ("/LoadPaletteMenu", "activate", "White Background"),
            ("cameraToolbar/1QToolButton3", "activate", ""))  # Zoom Closest To Data


def connect(port):
    """A server is added to the list of servers, and connected."""
    pages = "pqServerConnectDialog/stackedWidget/"
    return (("menubar/menu_File", "activate", "actionServerConnect"),
            (pages + "page_choose/addServer", "activate", ""),
            (pages + "page_create/name", "set_string", "mine"),
            (pages + "page_create/port", "set_int", str(port)),
            (pages + "page_create/okButton", "activate", ""),
            (pages + "page_edit/editServer2ButtonBox/1QPushButton0", "activate", ""),
            (pages + "page_choose/connect", "activate", ""))


def manage_plugins(*steps):
    """Steps in the Plugin Manager, whose names are relative to it."""
    dialog = "PluginManagerDialog/"
    return (MANAGE_PLUGINS,
            *((dialog + target, command, arguments) for target, command, arguments in steps),
            (dialog + "buttonBox/1QPushButton0", "activate", ""))


def load_new(plugin, where):
    """Load New in the list of Local or Remote Plugins."""
    return (("splitter/%sGroup/load%s" % (where.lower(), where), "activate", ""),
            ("pqFileDialog", "filesSelected", plugin))


def write_events(path, steps):
    """A recording of (object, command, arguments); a name that begins with / is not in the window.
    The command "is PROPERTY" compares a property of the object with the arguments."""
    root = ElementTree.Element("pqevents")
    for target, command, arguments in steps:
        kind, what = "pqevent", {"command": command}
        if command.startswith("is "):
            kind, what = "pqcheck", {"property": command[3:]}
        ElementTree.SubElement(root, kind, arguments=arguments, **what,
                               object=target[1:] if target.startswith("/") else WINDOW + target)
    ElementTree.ElementTree(root).write(path)


def write_settings(home, size=None):
    """Settings of a user whom ParaView does not welcome; and the size of the window."""
    folder = os.path.join(home, ".config", "ParaView")
    os.makedirs(folder)
    version = str(GetParaViewSourceVersion()).split()[-1]
    with open(os.path.join(folder, "ParaView%s.ini" % version), "w", encoding="utf-8") as file:
        file.write("[General]\nGeneralSettings.ShowWelcomeDialog=false\n")
        if size:
            file.write("[MainWindow]\nPosition=@Point(0 0)\nSize=@Size(%d %d)\n" % size)


def play(home, steps, plugin, picture, options=LOADED, import_options=(), clicks=(), seconds=120,
         keys=(), until="is finished"):
    """Starts ParaView, plays the steps, clicks at places of the screen, presses keys, keeps a picture
    of it and ends ParaView. Returns its output: "Success = true" if it could play all. `plugin` is the
    plugin's file, or None if ParaView finds it or shall not load it. Steps that end in a dialog, or
    cannot be played, never end: they are given so many seconds, or until the output has another text."""
    recording, log_path = (os.path.join(home, name) for name in ("play.xml", "log"))
    write_events(recording, steps)
    environment = {**os.environ, "HOME": home}
    if plugin:
        environment["PV_PLUGIN_PATH"] = os.path.dirname(plugin)
    with open(log_path, "w", encoding="utf-8") as log:
        window = subprocess.Popen(
            ["paraview", *options, "--test-script=" + recording, "--test-directory=" + home],
            env=environment, stdout=log, stderr=subprocess.STDOUT)
    try:
        for _ in range(4 * seconds):
            time.sleep(0.25)
            with open(log_path, encoding="utf-8", errors="replace") as log:
                text = log.read()
            if until in text or window.poll() is not None:
                break
        time.sleep(2)  # the window draws what the last event changed
        for place in clicks:
            subprocess.run(["xdotool", "mousemove", *map(str, place), "click", "1"], check=True)
            time.sleep(1)
        for key in keys:
            subprocess.run(["xdotool", "key", key], check=True)
            time.sleep(0.3)
        subprocess.run(["import", "-window", "root", *import_options, picture], check=True)
    finally:
        window.kill()
        window.wait()
    return text
