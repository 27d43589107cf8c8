// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Drawing/DecimalText.h"
#include "Core/Drawing/DrawingFormats.h"
#include "Core/Drawing/OutputFile.h"

#include <algorithm>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <cstdio>

namespace RectifiedTransport
{

namespace
{

constexpr double PointsPerMillimetre = 72.0 / 25.4;
// Streams of this size, one MiB, compress well and need little memory.
constexpr std::size_t ContentSize = std::size_t{ 1 } << 20;

// The unit disc as four cubic Bezier curves; with control points at 0.55228 their radius is exact
// to 3e-4.
constexpr const char* unitDisc = "1 0 m\n"
                                 "1 0.55228 0.55228 1 0 1 c\n"
                                 "-0.55228 1 -1 0.55228 -1 0 c\n"
                                 "-1 -0.55228 -0.55228 -1 0 -1 c\n"
                                 "0.55228 -1 1 -0.55228 1 0 c\n"
                                 "f\n";

// An indirect reference to an object, of generation 0.
std::string reference(std::size_t object)
{
  return std::to_string(object) + " 0 R ";
}

// The name of the graphics state with an opacity.
std::string opacityName(std::size_t opacity)
{
  return "/Opacity" + std::to_string(opacity);
}

// A text as hexadecimal digits; a mark begins those in UTF-8 (ISO 32000-2, 7.9.2.2).
std::string hexadecimal(std::string_view text)
{
  const auto isAscii = [](char byte) { return static_cast<unsigned char>(byte) < 0x80; };
  std::string digits = std::all_of(text.begin(), text.end(), isAscii) ? "<" : "<EFBBBF";
  for (const unsigned char byte : text)
  {
    digits += { "0123456789ABCDEF"[byte / 16], "0123456789ABCDEF"[byte % 16] };
  }
  return digits + '>';
}

// VTK's libharu has neither compression nor shapes that are drawn many times, and keeps the page in
// memory: a disc takes 260 bytes instead of about 7.
class PdfDrawing final : public Drawing
{
public:
  PdfDrawing(OutputFile& file, Compress* compress)
    : File(file)
    , Pack(compress)
  {
  }

  double LongestSide() const override { return 5080.0; } // 14400 points: Annex C

  void Begin(const DrawingPage& page) override
  {
    this->Size = page.Size;
    this->File.Write("%PDF-1.4\n%\xE2\xE3\xCF\xD3\n"); // the second line marks a binary file
    // The unit disc is a form that each disc draws with its own matrix.
    this->Disc = this->NewObject();
    this->WriteStream(
      this->Disc, "/Type /XObject /Subtype /Form /BBox [-1 -1 1 1] /Resources << >>", unitDisc);
    // The user space becomes millimetres (72 / 25.4 points), with round ends and joins of lines.
    appendAll(this->Text, "2.834646 0 0 2.834646 0 0 cm\n", page.StrokeWidth, " w 1 J 1 j\n");
    const double margin = page.ClippedMargin;
    if (margin > 0.0)
    {
      appendAll(this->Text, margin, ' ', margin, ' ', page.Size[0] - 2.0 * margin, ' ',
        page.Size[1] - 2.0 * margin, " re W n\n");
    }
  }

  // A layer is an optional content group, which readers list and can hide (ISO 32000-1, 8.11).
  void BeginLayer(const std::string& label) override
  {
    this->Text += this->Layers.empty() ? "" : "EMC\n";
    this->Layers.push_back(this->NewObject());
    this->WriteObject(this->Layers.back(), "<< /Type /OCG /Name " + hexadecimal(label) + " >>");
    this->Text += "/OC /Layer" + std::to_string(this->Layers.back()) + " BDC\n";
  }

  void FillDisc(const PagePoint& centre, double radius, Colour colour) override
  {
    this->UseColour(colour, false);
    // The matrix scales the unit disc to its radius and moves it to its centre; q and Q restore the
    // state.
    appendAll(this->Text, "q ", radius, " 0 0 ", radius, ' ', centre[0], ' ', centre[1],
      " cm /Disc Do Q\n");
    this->Flush();
  }

  void FillPolygons(const std::vector<PagePath>& polygons, FillRule rule, Colour colour) override
  {
    this->UseColour(colour, false);
    for (const PagePath& corners : polygons)
    {
      this->AppendPath(corners);
      this->Text += "h\n";
    }
    // f* is the even-odd rule, f the nonzero winding rule.
    this->Text += rule == FillRule::Odd ? "f*\n" : "f\n";
    this->Flush();
  }

  void Stroke(const PagePath& path, bool isClosed, Colour colour) override
  {
    this->UseColour(colour, true);
    this->AppendPath(path);
    this->Text += isClosed ? "s\n" : "S\n";
    this->Flush();
  }

  void End() override
  {
    this->Text += this->Layers.empty() ? "" : "EMC\n";
    this->WriteContent();
    // An extended graphics state for each opacity in use; PDF 1.4 has transparency only there.
    std::string states;
    for (std::size_t opacity = 0; opacity < this->Opacities.size(); ++opacity)
    {
      if (this->Opacities[opacity])
      {
        const double value = static_cast<double>(opacity) / 255.0;
        appendAll(states, opacityName(opacity), " << /ca ", value, " /CA ", value, " >>\n");
      }
    }
    // Numbers are taken before the objects are written, because page and page tree refer to each
    // other.
    const std::size_t pages = this->NewObject();
    const std::size_t page = this->NewObject();
    std::string layers;
    std::string named;
    for (const std::size_t layer : this->Layers)
    {
      layers += reference(layer);
      named += "/Layer" + std::to_string(layer) + ' ' + reference(layer);
    }
    std::string contents;
    for (const std::size_t content : this->Contents)
    {
      contents += reference(content);
    }
    std::string text = "<< /Type /Page /Parent ";
    appendAll(text, reference(pages), "/MediaBox [0 0 ", PointsPerMillimetre * this->Size[0], ' ',
      PointsPerMillimetre * this->Size[1], " \n]\n/Resources << /XObject << /Disc ",
      reference(this->Disc), ">> /ExtGState <<\n", states, ">> /Properties << ", named,
      ">> >>\n/Contents [", contents, "] >>");
    this->WriteObject(page, text);
    this->WriteObject(pages, "<< /Type /Pages /Count 1 /Kids [" + reference(page) + "] >>");
    const std::size_t root = this->NewObject();
    const std::string optional =
      "/Version /1.5 /OCProperties << /OCGs [" + layers + "] /D << /Order [" + layers + "] >> >> ";
    this->WriteObject(root,
      "<< /Type /Catalog /Pages " + reference(pages) + (layers.empty() ? "" : optional) + ">>");
    this->WriteTable(root);
  }

private:
  // Objects are numbered from 1. They may be written in any order.
  std::size_t NewObject()
  {
    this->Offsets.push_back(0);
    return this->Offsets.size();
  }

  void WriteObject(std::size_t number, std::string_view text)
  {
    this->Offsets[number - 1] = this->File.Size();
    this->File.Write(std::to_string(number) + " 0 obj\n");
    this->File.Write(text);
    this->File.Write("\nendobj\n");
  }

  // Writes a compressed stream; `entries` are those of its dictionary.
  void WriteStream(std::size_t number, const std::string& entries, std::string_view data)
  {
    // The length of the compressed data is known before it is written.
    const std::string packed = this->Pack(data);
    this->WriteObject(number,
      "<< " + entries + " /Filter /FlateDecode /Length " + std::to_string(packed.size()) +
        " >>\nstream\n" + packed + "\nendstream");
  }

  // Writes the cross-reference table, with the offset of each object, and the trailer (ISO 32000-1,
  // 7.5.4).
  void WriteTable(std::size_t root)
  {
    const std::int64_t table = this->File.Size();
    const std::string count = std::to_string(this->Offsets.size() + 1);
    // Entry 0 heads the list of free objects.
    std::string text = "xref\n0 " + count + "\n0000000000 65535 f \n";
    for (const std::int64_t offset : this->Offsets)
    {
      char entry[32]; // 20 bytes, as the format demands
      std::snprintf(entry, sizeof(entry), "%010lld 00000 n \n", static_cast<long long>(offset));
      text += entry;
    }
    text += "trailer\n<< /Size " + count + " /Root " + reference(root) + ">>\nstartxref\n" +
      std::to_string(table) + "\n%%EOF\n";
    this->File.Write(text);
  }

  // Writes the opacity and the colour only where they change.
  void UseColour(Colour colour, bool ofStrokes)
  {
    if (colour.Opacity != this->Opacity)
    {
      this->Text += opacityName(colour.Opacity) + " gs\n";
      this->Opacity = colour.Opacity;
      this->Opacities.set(colour.Opacity);
    }
    Colour& current = ofStrokes ? this->StrokeColour : this->FillColour;
    current.Opacity = colour.Opacity;
    if (colour == current)
    {
      return;
    }
    current = colour;
    const double red = colour.Red / 255.0;
    const double green = colour.Green / 255.0;
    const double blue = colour.Blue / 255.0;
    if (red == green && green == blue) // prints with black ink alone
    {
      appendAll(this->Text, red, ofStrokes ? " G\n" : " g\n");
    }
    else
    {
      appendAll(this->Text, red, ' ', green, ' ', blue, ofStrokes ? " RG\n" : " rg\n");
    }
  }

  void AppendPath(const PagePath& path)
  {
    // The first point moves, the others draw lines.
    const char* operation = " m\n";
    for (const PagePoint& point : path)
    {
      appendAll(this->Text, point[0], ' ', point[1], operation);
      operation = " l\n";
    }
  }

  // Writes the content so far, if it is long enough to compress well.
  void Flush()
  {
    if (this->Text.size() >= ContentSize)
    {
      this->WriteContent();
    }
  }

  void WriteContent()
  {
    this->Contents.push_back(this->NewObject());
    this->WriteStream(this->Contents.back(), "", this->Text);
    this->Text.clear();
  }

  OutputFile& File;
  Compress* const Pack;
  std::vector<std::int64_t> Offsets; // offset of each object in the file
  std::vector<std::size_t> Contents; // the page's streams
  std::vector<std::size_t> Layers;
  std::string Text; // content of the next stream
  PagePoint Size{};
  // The graphics state of the content so far.
  Colour FillColour;
  Colour StrokeColour;
  std::uint8_t Opacity = 255;
  std::bitset<256> Opacities; // opacities that are used
  std::size_t Disc = 0;       // the object of the unit disc
};

} // namespace

std::unique_ptr<Drawing> newPdfDrawing(OutputFile& file, Compress* compress)
{
  return std::make_unique<PdfDrawing>(file, compress);
}

} // namespace RectifiedTransport
