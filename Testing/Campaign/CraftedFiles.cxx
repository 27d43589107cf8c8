// SPDX-License-Identifier: BSD-3-Clause
// Files of every type that the filters' inputs come in, and what can be wrong with them.
#include "Crafted.h"

#include "vtkDataObjectReader.h"
#include "vtkGenericDataObjectReader.h"
#include "vtkGenericDataObjectWriter.h"
#include "vtkImageData.h"
#include "vtkMetaImageReader.h"
#include "vtkMetaImageWriter.h"
#include "vtkNew.h"
#include "vtkNrrdReader.h"
#include "vtkOBJReader.h"
#include "vtkOBJWriter.h"
#include "vtkPLYReader.h"
#include "vtkPLYWriter.h"
#include "vtkPNGReader.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSTLReader.h"
#include "vtkSTLWriter.h"
#include "vtkTIFFReader.h"
#include "vtkTIFFWriter.h"
#include "vtkXMLDataObjectWriter.h"
#include "vtkXMLGenericDataObjectReader.h"
#include "vtkXMLHyperTreeGridReader.h"
#include "vtkXMLMultiBlockDataWriter.h"
#include "vtkXMLUniformGridAMRReader.h"
#include "vtkXMLUniformGridAMRWriter.h"
#include "vtkXMLWriter.h"
#include "vtkXMLWriterBase.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace Campaign
{

namespace
{

std::string contentOf(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
}

void replaceContent(const std::string& path, const std::string& content)
{
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
}

std::string endingOf(const std::string& path)
{
  return std::filesystem::path(path).extension().string();
}

std::string writeXML(RandomSource& random, vtkDataObject* object, const std::string& path)
{
  vtkSmartPointer<vtkXMLWriterBase> writer;
  if (object->IsA("vtkMultiBlockDataSet"))
  {
    writer = vtkSmartPointer<vtkXMLMultiBlockDataWriter>::New();
  }
  else if (object->IsA("vtkOverlappingAMR"))
  {
    writer = vtkSmartPointer<vtkXMLUniformGridAMRWriter>::New();
  }
  else
  {
    writer.TakeReference(vtkXMLDataObjectWriter::NewWriter(object->GetDataObjectType()));
  }
  if (!writer)
  {
    return {};
  }
  const std::string name = path + "." + writer->GetDefaultFileExtension();
  writer->SetInputDataObject(object);
  writer->SetFileName(name.c_str());
  if (random.Chance(0.75))
  {
    writer->SetDataModeToAscii();
  }
  else
  {
    writer->SetDataModeToBinary();
    writer->SetCompressorTypeToNone();
  }
  writer->Write();
  return name;
}

template <class Writer>
std::string writeBy(vtkDataObject* object, const std::string& name)
{
  vtkNew<Writer> writer;
  writer->SetInputDataObject(object);
  writer->SetFileName(name.c_str());
  writer->Write();
  return name;
}

// Of writers that write text or binary.
template <class Writer>
std::string writeBy(vtkDataObject* object, const std::string& name, bool asText)
{
  vtkNew<Writer> writer;
  writer->SetInputDataObject(object);
  writer->SetFileName(name.c_str());
  writer->SetFileType(asText ? VTK_ASCII : VTK_BINARY);
  writer->Write();
  return name;
}

std::string writeLegacy(RandomSource& random, vtkDataObject* object, const std::string& path)
{
  return writeBy<vtkGenericDataObjectWriter>(object, path + ".vtk", random.Chance(0.7));
}

std::string writeSurface(RandomSource& random, vtkDataObject* object, const std::string& path)
{
  const bool asText = random.Chance(0.6);
  switch (random.Whole(0, 2))
  {
    case 0:
      return writeBy<vtkSTLWriter>(object, path + ".stl", asText);
    case 1:
      return writeBy<vtkPLYWriter>(object, path + ".ply", asText);
    default:
      return writeBy<vtkOBJWriter>(object, path + ".obj");
  }
}

// A header and numbers as text.
std::string writeNrrd(vtkImageData* image, const std::string& path)
{
  const std::string name = path + ".nrrd";
  std::ofstream file(name);
  const int* n = image->GetDimensions();
  file << "NRRD0004\ntype: float\ndimension: 3\nspace: left-posterior-superior\nsizes: " << n[0]
       << ' ' << n[1] << ' ' << n[2] << "\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
       << "space origin: (0,0,0)\nencoding: ascii\n\n";
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    file << 1 + i % 4 << (i % 8 == 7 ? '\n' : ' ');
  }
  return name;
}

std::string writeImage(RandomSource& random, vtkImageData* image, const std::string& path)
{
  vtkNew<vtkImageData> bytes; // what all of these writers take
  bytes->CopyStructure(image);
  bytes->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  bytes->GetPointData()->GetScalars()->Fill(3.0);
  switch (random.Whole(0, 4))
  {
    case 0:
      return writeBy<vtkPNGWriter>(bytes, path + ".png");
    case 1:
      return writeBy<vtkTIFFWriter>(bytes, path + ".tif");
    case 2:
      return writeNrrd(image, path);
    default:
      return writeBy<vtkMetaImageWriter>(bytes, path + ".mha");
  }
}

struct Part
{
  std::size_t First;
  std::size_t Length;
};

// Numbers, and words that name types.
std::vector<Part> partsOf(const std::string& content)
{
  std::vector<Part> parts;
  const auto isWord = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '+' || c == '.';
  };
  for (std::size_t at = 0; at < content.size();)
  {
    std::size_t end = at;
    while (end < content.size() && isWord(content[end]))
    {
      ++end;
    }
    if (end == at)
    {
      ++at;
      continue;
    }
    const bool starts = at == 0 || content[at - 1] != '<'; // of an element's name nothing is left
    if (starts &&
      (std::isdigit(static_cast<unsigned char>(content[at])) || content[at] == '-' || end - at > 2))
    {
      parts.push_back({ at, end - at });
    }
    at = end;
  }
  return parts;
}

bool isNumber(const std::string& word)
{
  return std::isdigit(static_cast<unsigned char>(word[0])) || word[0] == '-';
}

void replacePart(RandomSource& random, std::string& content, std::string& text)
{
  const std::vector<Part> parts = partsOf(content);
  if (parts.empty())
  {
    return;
  }
  const Part part =
    parts[static_cast<std::size_t>(random.Whole(0, static_cast<std::int64_t>(parts.size()) - 1))];
  const std::string before = content.substr(part.First, part.Length);
  std::string after;
  if (isNumber(before) || random.Chance(0.2))
  {
    after = drawBadNumber(random);
  }
  else
  {
    after = random.Of<const char*>({ "Float32", "Float64", "Int8", "UInt8", "Int64", "String",
      "Bit", "double", "char", "bit", "string", "long", "vtkIdType", "unsigned_char", "uchar", "",
      "nothing", "binary", "ascii", "appended", "SCALARS", "POLYGONS" });
  }
  content.replace(part.First, part.Length, after);
  text +=
    ", '" + before.substr(0, 20) + "' at " + std::to_string(part.First) + " is '" + after + "'";
}

void replaceBytes(RandomSource& random, std::string& content, std::string& text)
{
  const std::size_t count = random.Of<std::size_t>({ 1, 2, 4, 8 });
  if (content.size() < 16)
  {
    return;
  }
  const auto at =
    static_cast<std::size_t>(random.Whole(0, static_cast<std::int64_t>(content.size() - count)));
  const char byte = random.Of<char>({ '\0', '\xff', '\x7f', '\x80', '\x01' });
  std::fill_n(content.begin() + static_cast<std::ptrdiff_t>(at), count, byte);
  text += ", " + std::to_string(count) + " bytes at " + std::to_string(at);
}

// A line that is missing, or there twice.
void changeLines(RandomSource& random, std::string& content, std::string& text)
{
  const auto at =
    static_cast<std::size_t>(random.Whole(0, static_cast<std::int64_t>(content.size()) - 1));
  std::size_t first = content.rfind('\n', at);
  first = first == std::string::npos ? 0 : first;
  std::size_t last = content.find('\n', first + 1);
  last = last == std::string::npos ? content.size() : last;
  if (random.Chance(0.5))
  {
    text += ", without the line at " + std::to_string(first);
    content.erase(first, last - first);
  }
  else
  {
    text += ", with the line at " + std::to_string(first) + " twice";
    content.insert(first, content.substr(first, last - first));
  }
}

// A file that others name, or one of those that it names.
std::string fileToDamage(RandomSource& random, const std::string& path)
{
  std::vector<std::string> parts;
  std::error_code ignored;
  const std::filesystem::path whole(path);
  const std::filesystem::path folder = whole.parent_path() / whole.stem();
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
  {
    parts.push_back(entry.path().string());
  }
  std::sort(parts.begin(), parts.end());
  return parts.empty() || random.Chance(0.5)
    ? path
    : parts[static_cast<std::size_t>(random.Whole(0, static_cast<std::int64_t>(parts.size()) - 1))];
}

vtkSmartPointer<vtkDataObject> readGrids(const std::string& path)
{
  vtkNew<vtkXMLUniformGridAMRReader> reader;
  reader->SetFileName(path.c_str());
  reader->SetMaximumLevelsToReadByDefault(0); // all
  reader->Update();
  return reader->GetOutputDataObject(0);
}

template <class Reader>
vtkSmartPointer<vtkDataObject> readBy(const std::string& path)
{
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutputDataObject(0);
}

} // namespace

std::string drawBadNumber(RandomSource& random)
{
  return random.Of<const char*>({ "-1", "0", "1", "2", "3", "7", "255", "256", "-7", "1000",
    "2147483647", "-2147483648", "4294967296", "9223372036854775807", "-9223372036854775808",
    "1099511627776", "nan", "inf", "-inf", "1e300", "-1e300", "1e-320", "1e20", "0.5", "x", "" });
}

std::string writeFile(RandomSource& random, vtkDataObject* object, const std::string& path)
{
  auto* image = vtkImageData::SafeDownCast(object);
  if (image && random.Chance(0.4))
  {
    return writeImage(random, image, path);
  }
  auto* surface = vtkPolyData::SafeDownCast(object);
  if (surface && surface->GetNumberOfPolys() > 0 && random.Chance(0.4))
  {
    return writeSurface(random, object, path);
  }
  return vtkDataSet::SafeDownCast(object) && random.Chance(0.35) ? writeLegacy(random, object, path)
                                                                 : writeXML(random, object, path);
}

void damageFile(RandomSource& random, const std::string& whole, std::string& text)
{
  const std::string path = fileToDamage(random, whole);
  std::string content = contentOf(path);
  if (content.empty())
  {
    return;
  }
  const std::string ending = endingOf(path);
  const bool binary = ending == ".png" || ending == ".tif" || content.find('\0') < content.size();
  const std::int64_t changes = random.Of({ 1, 1, 1, 2, 3 });
  for (std::int64_t i = 0; i < changes; ++i)
  {
    if (binary && random.Chance(0.6))
    {
      replaceBytes(random, content, text);
    }
    else if (random.Chance(0.9))
    {
      replacePart(random, content, text);
    }
    else if (random.Chance(0.7) && !content.empty())
    {
      changeLines(random, content, text);
    }
    else
    {
      content.resize(
        static_cast<std::size_t>(random.Whole(0, static_cast<std::int64_t>(content.size()))));
      text += ", cut after " + std::to_string(content.size()) + " bytes";
    }
  }
  replaceContent(path, content);
}

vtkSmartPointer<vtkDataObject> readFile(const std::string& path)
{
  const std::string ending = endingOf(path);
  return ending == ".vtk" ? readBy<vtkGenericDataObjectReader>(path)
    : ending == ".stl"    ? readBy<vtkSTLReader>(path)
    : ending == ".ply"    ? readBy<vtkPLYReader>(path)
    : ending == ".obj"    ? readBy<vtkOBJReader>(path)
    : ending == ".png"    ? readBy<vtkPNGReader>(path)
    : ending == ".tif"    ? readBy<vtkTIFFReader>(path)
    : ending == ".nrrd"   ? readBy<vtkNrrdReader>(path)
    : ending == ".mha"    ? readBy<vtkMetaImageReader>(path)
    : ending == ".vth"    ? readGrids(path)
    : ending == ".htg"    ? readBy<vtkXMLHyperTreeGridReader>(path)
                          : readBy<vtkXMLGenericDataObjectReader>(path);
}

} // namespace Campaign
