# SPDX-License-Identifier: BSD-3-Clause
"""What is in the Debian package that cpack makes of this build: everything that is of use, at places that
agree with each other, and nothing else. Needs neither root nor a network. Dependencies on libraries,
which need dpkg-dev, are left out here."""
import argparse
import glob
import gzip
import os
import re
import subprocess
import sys
import tarfile
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

PACKAGE = "rectifiedtransport"
MODULES = ("Common", "Densities", "Drawing", "Meshes")
OPTIONS = None


def pack(folder):
    """The path of the package, made below folder."""
    subprocess.run(
        [OPTIONS.cpack, "--config", os.path.join(OPTIONS.build, "CPackConfig.cmake"), "-G", "DEB", "-B", folder,
         "-D", "CPACK_DEBIAN_PACKAGE_SHLIBDEPS=OFF", "-D", "CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS=OFF"],
        cwd=folder, check=True, stdin=subprocess.DEVNULL)
    made, = glob.glob(os.path.join(folder, "*.deb"))
    return made


def read_tar(package, option):
    """The members of one of a package's two archives by their paths from /, with what files hold."""
    found = {}
    with tempfile.TemporaryFile() as stream:
        subprocess.run(["dpkg-deb", option, package], stdout=stream, check=True)
        stream.seek(0)
        with tarfile.open(fileobj=stream) as archive:
            for member in archive:
                file = archive.extractfile(member) if member.isfile() else None
                found[os.path.normpath(member.name)] = member, file.read() if file else b""
    return found


class Content(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            package = pack(folder)
            cls.members = read_tar(package, "--fsys-tarfile")
            cls.control = read_tar(package, "--ctrl-tarfile")
        cls.files = {path: data for path, (member, data) in cls.members.items() if not member.isdir()}
        cls.libraries = os.path.join("usr", OPTIONS.library_dir)
        cls.documents = os.path.join("usr/share/doc", PACKAGE)

    def text(self, *path):
        return self.files[os.path.join(*path)].decode()

    def fields(self):
        return dict(re.findall(r"^([\w-]+): (.*)", self.control["control"][1].decode(), re.MULTILINE))

    def test_places(self):
        """All of it is in folders that the package may use, by names that nobody else has."""
        allowed = ["usr/include/RectifiedTransport/", self.documents + "/",
                   os.path.join(self.libraries, "cmake/RectifiedTransport/"),
                   os.path.join(self.libraries, "vtk/hierarchy/RectifiedTransport/"),
                   *(os.path.join(self.libraries, "libRectifiedTransport%s." % name) for name in OPTIONS.libraries),
                   os.path.join(self.libraries, "libvtkRectifiedTransport")]
        if OPTIONS.python_dir:
            allowed.append(os.path.join("usr", OPTIONS.python_dir, "rectifiedtransport/"))
        if OPTIONS.plugin_dir:
            allowed += [os.path.join(self.libraries, OPTIONS.plugin_dir, name)
                        for name in ("RectifiedTransport/", "rectifiedtransport.plugins.xml")]
            allowed.append("usr/bin/paraview.conf")
        for path in self.files:
            self.assertTrue(path.startswith(tuple(allowed)), path)
        for path, (member, _) in self.members.items():
            self.assertEqual((member.uid, member.gid), (0, 0), path)
            self.assertFalse(member.mode & 0o022 and not member.issym(), path)
            self.assertTrue(path == "." or path.split(os.sep)[0] == "usr", path)

    def test_no_path_of_the_build(self):
        """Nothing leads to the folders that it was built in. (Messages of errors in binaries may name sources.)"""
        for path, data in self.files.items():
            if data.startswith(b"\x7fELF"):
                with tempfile.NamedTemporaryFile() as file:
                    file.write(data)
                    file.flush()
                    dynamic = subprocess.run(["readelf", "-d", file.name], stdout=subprocess.PIPE, check=True,
                                             universal_newlines=True).stdout
                for folders in re.findall(r"\(RU?N?PATH\).*\[(.*)\]", dynamic):
                    for folder in folders.split(":"):
                        self.assertRegex(folder, r"^(\$ORIGIN|/usr/lib)(/|$)", path)
            elif not data.startswith(b"!<arch>"):
                for folder in (OPTIONS.build, OPTIONS.source):
                    self.assertNotIn(folder.encode() + b"/", data, path)

    def test_links(self):
        links = {path: member for path, (member, _) in self.members.items() if member.issym()}
        self.assertTrue(links)
        for path, member in links.items():
            self.assertIn(os.path.join(os.path.dirname(path), member.linkname), self.files, path)

    def test_plugin(self):
        """paraview.conf leads to the list of plugins, and the list to the plugin."""
        if not OPTIONS.plugin_dir:
            self.assertNotIn("usr/bin/paraview.conf", self.files)
            return
        folder = os.path.join(self.libraries, OPTIONS.plugin_dir)
        plugins = os.path.join(folder, "rectifiedtransport.plugins.xml")
        plugin, = ElementTree.fromstring(self.text(plugins)).iter("Plugin")
        self.assertEqual(plugin.get("auto_load"), "1")
        name = plugin.get("name")
        self.assertGreater(len(self.files[os.path.join(folder, name, name + ".so")]), 10000)
        if "usr/bin/paraview.conf" in self.files:  # ParaView is Debian's
            self.assertEqual(self.text("usr/bin/paraview.conf"), "/" + plugins + "\n")
            readme = self.text(self.documents, "README.Debian")
            self.assertIn("/" + plugins, readme)
            self.assertIn("/" + os.path.join(folder, name, name + ".so"), readme)
            self.assertIn("preinst", self.control)
        self.assertIn("python3-paraview", self.fields()["Depends"])

    def test_python(self):
        if OPTIONS.python_dir:
            folder = os.path.join("usr", OPTIONS.python_dir, "rectifiedtransport")
            self.assertIn("vtkRectifiedTransport", self.text(folder, "__init__.py"))
            self.assertIn("Densities", self.text(folder, "vtkRectifiedTransport.py"))
            for path in glob.glob(os.path.join(OPTIONS.source, "Python", "arrays", "*.py")):
                with open(path, encoding="utf-8") as file:
                    self.assertEqual(self.text(folder, "arrays", os.path.basename(path)), file.read())
            self.assertRegex(self.fields()["Depends"], r"\bpython3-numpy\b")
            for module in MODULES:
                self.assertTrue([path for path in self.files if re.match(
                    re.escape(folder) + r"/vtkRectifiedTransport%s\.(.*\.)?so$" % module, path)])
            self.assertRegex(self.fields()["Depends"], r"\bpython3 \(>= 3\.\d+~\)")
            self.assertTrue({"postinst", "prerm"} <= set(self.control))

    def test_development(self):
        """Headers and libraries of the mathematics, and of the filters where they were built, and the CMake
        package."""
        cmake = os.path.join(self.libraries, "cmake/RectifiedTransport")
        self.assertIn('PACKAGE_VERSION "%s"' % OPTIONS.version,
                      self.text(cmake, "RectifiedTransportConfigVersion.cmake"))
        targets = [self.text(cmake, "RectifiedTransport%s-targets.cmake" % name) for name in OPTIONS.libraries]
        headers = {"Core": "Flow/RectifiedFlow.h", "Surfaces": "Mesh/DiskMesh.h", "Devices": "DeviceList.h"}
        expected = {os.path.join(name, headers[name]) for name in OPTIONS.libraries}
        if os.path.join(cmake, "RectifiedTransport-targets.cmake") in self.files:
            targets.append(self.text(cmake, "RectifiedTransport-targets.cmake"))
            expected |= {os.path.basename(path) for path in glob.glob(
                os.path.join(OPTIONS.source, "Filters", "*", "vtk*.h"))}
            for module in MODULES:
                self.assertIn(os.path.join(self.libraries, "libvtkRectifiedTransport%s.so" % module),
                              self.files)
        else:
            self.assertFalse(OPTIONS.plugin_dir or OPTIONS.python_dir)
        for header in expected:
            self.assertIn(os.path.join("usr/include/RectifiedTransport", header), self.files)
        for name in OPTIONS.libraries:
            self.assertIn("RectifiedTransport::" + name, "".join(targets))
            self.assertTrue([path for path in self.files if os.path.join(
                self.libraries, "libRectifiedTransport%s." % name) in path])

    def test_documents(self):
        """The licence's own words in Debian's form, and the changes of the project."""
        with open(os.path.join(OPTIONS.source, "LICENSE"), encoding="utf-8") as file:
            words = file.read().split("\n", 1)[1].split()
        packed = self.text(self.documents, "copyright")
        self.assertIn("License: BSD-3-Clause", packed)
        unfolded = [word for word in re.sub(r"^ \.$", "", packed, flags=re.MULTILINE).split()]
        holder = words.index("Redistribution")
        self.assertEqual(unfolded[-len(words[holder:]):], words[holder:])
        with open(os.path.join(OPTIONS.source, "CHANGELOG.md"), "rb") as file:
            self.assertEqual(gzip.decompress(self.files[os.path.join(self.documents, "changelog.gz")]),
                             file.read(), "configuring copies it: build first")
        debian = gzip.decompress(self.files[os.path.join(self.documents, "changelog.Debian.gz")]).decode()
        self.assertTrue(debian.startswith("%s (%s-1) " % (PACKAGE, OPTIONS.version)), debian)

    def test_control(self):
        fields = self.fields()
        with open(os.path.join(OPTIONS.source, "CMake/Conda/recipe.yaml"), encoding="utf-8") as file:
            self.assertIn('\n  version: "%s"\n' % OPTIONS.version, file.read())
        with open(os.path.join(OPTIONS.source, "CITATION.cff"), encoding="utf-8") as file:
            self.assertIn("\nversion: %s\n" % OPTIONS.version, file.read())
        self.assertEqual(fields["Package"], PACKAGE)
        self.assertEqual(fields["Version"], OPTIONS.version + "-1")
        self.assertTrue(fields["Maintainer"])
        for tool in re.findall("^ *apt install (.*)", self.text(self.documents, "README.Debian")
                               if os.path.join(self.documents, "README.Debian") in self.files else "",
                               re.MULTILINE):
            self.assertEqual(set(tool.split()), set(fields["Suggests"].split(", ")))
        for name in ("preinst", "postinst", "prerm"):
            if name in self.control:
                member, script = self.control[name]
                self.assertEqual(member.mode & 0o777, 0o755, name)
                subprocess.run(["sh", "-n"], input=script, check=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    for option in ("cpack", "source", "build", "version", "libraries", "library-dir", "python-dir", "plugin-dir"):
        parser.add_argument("--" + option, required=True)
    OPTIONS = parser.parse_args()
    OPTIONS.libraries = OPTIONS.libraries.split(",")
    unittest.main(argv=sys.argv[:1], verbosity=2)
