// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Drawing/DecimalText.h"
#include "Core/Drawing/DrawingFormats.h"
#include "Core/Drawing/OutputFile.h"

#include <cstddef>
#include <cstdio>

namespace RectifiedTransport
{

namespace
{

// The text is written in pieces of this size, so that memory stays small for millions of shapes.
constexpr std::size_t BufferSize = std::size_t{ 1 } << 16;

class SvgDrawing final : public Drawing
{
public:
  explicit SvgDrawing(OutputFile& file)
    : File(file)
  {
  }

  // Millimetres; all readers take numbers of this size.
  double LongestSide() const override { return 1e6; }

  void Begin(const DrawingPage& page) override
  {
    // The user unit is a millimetre: the view box has the size of the page.
    const PagePoint& size = page.Size;
    this->Height = size[1];
    this->StrokeWidth = page.StrokeWidth;
    appendAll(this->Text,
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"",
      size[0], "mm\" height=\"", size[1], "mm\" viewBox=\"0 0 ", size[0], ' ', size[1], "\">\n");
    // A clip path hides what reaches into the margin.
    const double margin = page.ClippedMargin;
    this->IsClipped = margin > 0.0;
    // The page has its origin at the lower left; SVG has it at the upper left, so that y becomes
    // height - y.
    if (this->IsClipped)
    {
      appendAll(this->Text, "<clipPath id=\"inside\"><rect x=\"", margin, "\" y=\"", margin,
        "\" width=\"", size[0] - 2.0 * margin, "\" height=\"", size[1] - 2.0 * margin,
        "\"/></clipPath>\n");
    }
  }

  // Programs for plotters take the groups of the first level as layers, so that each one is
  // clipped.
  void BeginLayer(const std::string& label) override
  {
    this->EnterGroup(Group::None);
    this->Text += this->HasLayer ? "</g>\n" : "";
    this->Text += "<g xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" "
                  "inkscape:groupmode=\"layer\" inkscape:label=\"";
    for (const char character : label)
    {
      const bool isMarkup = std::string_view("&<\"").find(character) != std::string_view::npos;
      const bool isControl = static_cast<unsigned char>(character) < ' ';
      this->Text += isMarkup ? "&#" + std::to_string(character) + ';'
                             : std::string(1, isControl ? ' ' : character);
    }
    this->Text += this->IsClipped ? "\" clip-path=\"url(#inside)\">\n" : "\">\n";
    this->HasLayer = true;
  }

  void FillDisc(const PagePoint& centre, double radius, Colour colour) override
  {
    this->EnterGroup(Group::Fills);
    appendAll(this->Text, "<circle cx=\"", centre[0], "\" cy=\"", this->Height - centre[1],
      "\" r=\"", radius, '"');
    this->EndShape("fill", colour);
  }

  void FillPolygons(const std::vector<PagePath>& polygons, FillRule rule, Colour colour) override
  {
    this->EnterGroup(Group::Fills);
    // One polygon element is shorter than a path; several polygons with a common fill rule need one
    // path.
    if (polygons.size() == 1)
    {
      this->Text += "<polygon points=\"";
      this->AppendPoints(polygons.front());
    }
    else
    {
      // One path with a subpath for each polygon: no seams show between them.
      this->Text += "<path d=\"";
      for (const PagePath& corners : polygons)
      {
        this->Text += 'M';
        this->AppendPoints(corners);
        this->Text += 'z';
      }
    }
    this->Text += rule == FillRule::Odd ? "\" fill-rule=\"evenodd\"" : "\"";
    this->EndShape("fill", colour);
  }

  void Stroke(const PagePath& path, bool isClosed, Colour colour) override
  {
    this->EnterGroup(Group::Strokes);
    // A closed line is a polygon without a fill, which joins its ends.
    this->Text += isClosed ? "<polygon points=\"" : "<polyline points=\"";
    this->AppendPoints(path);
    this->Text += '"';
    this->EndShape("stroke", colour);
  }

  // Closes the elements that are open, and writes what is left in the buffer.
  void End() override
  {
    this->EnterGroup(Group::None);
    this->Text += this->HasLayer ? "</g>\n</svg>\n" : "</svg>\n";
    this->File.Write(this->Text);
  }

private:
  // The kind of shapes in the open group.
  enum class Group
  {
    None,
    Fills,
    Strokes
  };

  // Shapes of a kind share a group with their common attributes, which keeps files small.
  void EnterGroup(Group group)
  {
    if (group == this->Open)
    {
      return;
    }
    if (this->Open != Group::None)
    {
      this->Text += "</g>\n";
    }
    if (this->IsClipped && !this->HasLayer)
    {
      this->Text += "<g clip-path=\"url(#inside)\">\n";
      this->HasLayer = true;
    }
    // Opaque black is the default of both groups, since most drawings have it.
    if (group == Group::Fills)
    {
      this->Text += "<g fill=\"#000000\" stroke=\"none\">\n";
    }
    if (group == Group::Strokes)
    {
      appendAll(this->Text,
        "<g fill=\"none\" stroke=\"#000000\" stroke-linecap=\"round\" "
        "stroke-linejoin=\"round\" stroke-width=\"",
        this->StrokeWidth, "\">\n");
    }
    this->Open = group;
  }

  // Ends a shape with the attributes that differ from the group's opaque black.
  void EndShape(const char* paint, Colour colour)
  {
    if (colour.Red + colour.Green + colour.Blue > 0)
    {
      // Seven characters, #rrggbb, and the end.
      char value[8];
      std::snprintf(value, sizeof(value), "#%02x%02x%02x", colour.Red, colour.Green, colour.Blue);
      appendAll(this->Text, ' ', paint, "=\"", value, '"');
    }
    if (colour.Opacity < 255)
    {
      appendAll(this->Text, ' ', paint, "-opacity=\"", colour.Opacity / 255.0, '"');
    }
    this->Text += "/>\n";
    if (this->Text.size() >= BufferSize)
    {
      this->File.Write(this->Text);
      this->Text.clear();
    }
  }

  // Appends "x,y " for each point, without the last blank.
  void AppendPoints(const PagePath& points)
  {
    for (const PagePoint& point : points)
    {
      appendAll(this->Text, point[0], ',', this->Height - point[1], ' ');
    }
    this->Text.pop_back();
  }

  OutputFile& File;
  // The text waits here until there is a buffer of it. Height is that of the page, in millimetres.
  std::string Text;
  double Height = 0.0;
  double StrokeWidth = 0.0;
  bool IsClipped = false;
  bool HasLayer = false; // whether a group around those of shapes is open
  Group Open = Group::None;
};

} // namespace

std::unique_ptr<Drawing> newSvgDrawing(OutputFile& file)
{
  return std::make_unique<SvgDrawing>(file);
}

} // namespace RectifiedTransport
