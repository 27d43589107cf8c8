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

constexpr int Decimals = 4; // of millimetres
constexpr std::size_t BufferSize = std::size_t{ 1 } << 16;

void appendAttribute(std::string& text, const char* name, double value)
{
  text += ' ';
  text += name;
  text += "=\"";
  appendDecimal(text, value, Decimals);
  text += '"';
}

class SvgDrawing final : public Drawing
{
public:
  explicit SvgDrawing(OutputFile& file)
    : File(file)
  {
  }

  double LongestSide() const override { return 1e6; }

  void Begin(const DrawingPage& page) override
  {
    const PagePoint& size = page.Size;
    this->Height = size[1];
    this->StrokeWidth = page.StrokeWidth;
    std::string& text = this->Text;
    text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
           "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"";
    appendDecimal(text, size[0], Decimals);
    text += "mm\" height=\"";
    appendDecimal(text, size[1], Decimals);
    text += "mm\" viewBox=\"0 0 ";
    appendDecimal(text, size[0], Decimals);
    text += ' ';
    appendDecimal(text, size[1], Decimals);
    text += "\">\n";
    this->IsClipped = page.ClippedMargin > 0.0;
    if (this->IsClipped)
    {
      text += "<clipPath id=\"inside\"><rect";
      appendAttribute(text, "x", page.ClippedMargin);
      appendAttribute(text, "y", page.ClippedMargin);
      appendAttribute(text, "width", size[0] - 2.0 * page.ClippedMargin);
      appendAttribute(text, "height", size[1] - 2.0 * page.ClippedMargin);
      text += "/></clipPath>\n<g clip-path=\"url(#inside)\">\n";
    }
  }

  void FillDisc(const PagePoint& centre, double radius, Colour colour) override
  {
    this->EnterGroup(Group::Fills);
    this->Text += "<circle";
    appendAttribute(this->Text, "cx", centre[0]);
    appendAttribute(this->Text, "cy", this->Height - centre[1]);
    appendAttribute(this->Text, "r", radius);
    this->AppendColour("fill", colour);
    this->Text += "/>\n";
    this->Flush();
  }

  void FillPolygons(const std::vector<PagePath>& polygons, FillRule rule, Colour colour) override
  {
    this->EnterGroup(Group::Fills);
    if (polygons.size() == 1)
    {
      this->Text += "<polygon points=\"";
      this->AppendPoints(polygons.front());
    }
    else
    {
      this->Text += "<path d=\"";
      for (const PagePath& corners : polygons)
      {
        this->Text += 'M';
        this->AppendPoints(corners);
        this->Text += 'z';
      }
    }
    this->Text += rule == FillRule::Odd ? "\" fill-rule=\"evenodd\"" : "\"";
    this->AppendColour("fill", colour);
    this->Text += "/>\n";
    this->Flush();
  }

  void Stroke(const PagePath& path, bool isClosed, Colour colour) override
  {
    this->EnterGroup(Group::Strokes);
    this->Text += isClosed ? "<polygon points=\"" : "<polyline points=\"";
    this->AppendPoints(path);
    this->Text += '"';
    this->AppendColour("stroke", colour);
    this->Text += "/>\n";
    this->Flush();
  }

  void End() override
  {
    this->EnterGroup(Group::None);
    this->Text += this->IsClipped ? "</g>\n</svg>\n" : "</svg>\n";
    this->File.Write(this->Text);
  }

private:
  enum class Group
  {
    None,
    Fills,
    Strokes
  };

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
    if (group == Group::Fills)
    {
      this->Text += "<g fill=\"#000000\" stroke=\"none\">\n";
    }
    if (group == Group::Strokes)
    {
      this->Text += "<g fill=\"none\" stroke=\"#000000\" stroke-linecap=\"round\" "
                    "stroke-linejoin=\"round\"";
      appendAttribute(this->Text, "stroke-width", this->StrokeWidth);
      this->Text += ">\n";
    }
    this->Open = group;
  }

  // What differs from the group's opaque black.
  void AppendColour(const std::string& paint, Colour colour)
  {
    if (colour.Red + colour.Green + colour.Blue > 0)
    {
      char value[8];
      std::snprintf(value, sizeof(value), "#%02x%02x%02x", colour.Red, colour.Green, colour.Blue);
      this->Text += " " + paint + "=\"" + value + "\"";
    }
    if (colour.Opacity < 255)
    {
      appendAttribute(this->Text, (paint + "-opacity").c_str(), colour.Opacity / 255.0);
    }
  }

  void AppendPoints(const PagePath& points)
  {
    for (const PagePoint& point : points)
    {
      appendDecimal(this->Text, point[0], Decimals);
      this->Text += ',';
      appendDecimal(this->Text, this->Height - point[1], Decimals);
      this->Text += ' ';
    }
    this->Text.pop_back();
  }

  void Flush()
  {
    if (this->Text.size() >= BufferSize)
    {
      this->File.Write(this->Text);
      this->Text.clear();
    }
  }

  OutputFile& File;
  std::string Text;
  double Height = 0.0;
  double StrokeWidth = 0.0;
  bool IsClipped = false;
  Group Open = Group::None;
};

} // namespace

std::unique_ptr<Drawing> newSvgDrawing(OutputFile& file)
{
  return std::make_unique<SvgDrawing>(file);
}

} // namespace RectifiedTransport
