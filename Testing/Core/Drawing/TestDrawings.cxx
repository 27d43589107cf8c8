// SPDX-License-Identifier: BSD-3-Clause
// Pages of SVG and PDF in files, and what is joined to one area.
#include "Core/Drawing/DrawingFormats.h"
#include "Core/Drawing/OutputFile.h"
#include "Core/Drawing/PolygonBatch.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace RectifiedTransport
{
namespace
{

constexpr Colour black{};
constexpr Colour red{ 255, 0, 0, 255 };

std::filesystem::path place()
{
  return std::filesystem::temp_directory_path() /
    ("rectifiedtransport-drawing-" + std::to_string(getpid()));
}

std::string takeText()
{
  std::string text;
  {
    std::ifstream file(place(), std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(file), {});
  }
  std::filesystem::remove(place());
  return text;
}

// A page of 20 x 10 mm with a disc, a square and a line.
void draw(Drawing& drawing)
{
  drawing.Begin({ { 20.0, 10.0 }, 0.0, 0.25 });
  drawing.FillDisc({ 5.0, 2.5 }, 1.0, red);
  drawing.FillPolygons({ { { 1.0, 1.0 }, { 2.0, 1.0 }, { 2.0, 2.0 } } }, FillRule::Odd, black);
  drawing.Stroke({ { 0.0, 0.0 }, { 20.0, 10.0 } }, false, { 0, 0, 0, 51 });
  drawing.End();
}

TEST(Drawings, Svg)
{
  OutputFile file(place().string());
  draw(*newSvgDrawing(file));
  EXPECT_FALSE(std::filesystem::exists(place()));
  file.Close();
  EXPECT_EQ(takeText(),
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"20mm\" height=\"10mm\" "
    "viewBox=\"0 0 20 10\">\n"
    "<g fill=\"#000000\" stroke=\"none\">\n"
    "<circle cx=\"5\" cy=\"7.5\" r=\"1\" fill=\"#ff0000\"/>\n"
    "<polygon points=\"1,9 2,9 2,8\" fill-rule=\"evenodd\"/>\n"
    "</g>\n"
    "<g fill=\"none\" stroke=\"#000000\" stroke-linecap=\"round\" stroke-linejoin=\"round\" "
    "stroke-width=\"0.25\">\n"
    "<polyline points=\"0,10 20,0\" stroke-opacity=\"0.2\"/>\n"
    "</g>\n"
    "</svg>\n");
}

// The table at the end has the place of every object.
TEST(Drawings, Pdf)
{
  OutputFile file(place().string());
  draw(*newPdfDrawing(file, [](std::string_view data) { return std::string(data); }));
  file.Close();
  const std::string text = takeText();
  EXPECT_NE(text.find("1 0 0 rg\nq 1 0 0 1 5 2.5 cm /Disc Do Q\n"), std::string::npos);
  EXPECT_NE(text.find("0 g\n1 1 m\n2 1 l\n2 2 l\nh\nf*\n"), std::string::npos);
  EXPECT_NE(text.find("/Opacity51 gs\n0 0 m\n20 10 l\nS\n"), std::string::npos);
  const std::size_t table = text.find("xref\n0 6\n");
  ASSERT_NE(table, std::string::npos);
  EXPECT_NE(text.find("startxref\n" + std::to_string(table) + "\n%%EOF\n"), std::string::npos);
  for (std::size_t object = 1; object < 6; ++object)
  {
    const std::string begin = std::to_string(object) + " 0 obj\n";
    const std::size_t entry = table + 9 + 20 * object;
    EXPECT_EQ(text.compare(std::stoul(text.substr(entry, 10)), begin.size(), begin), 0) << object;
  }
}

// Two layers on a page with a margin, the second with a shape of each group.
void drawLayers(Drawing& drawing)
{
  drawing.Begin({ { 20.0, 10.0 }, 1.0, 0.25 });
  drawing.BeginLayer("Pen 1");
  drawing.FillDisc({ 5.0, 2.5 }, 1.0, black);
  drawing.BeginLayer("\xC3\xA9 & \xF0\x9F\x96\x8A");
  drawing.FillDisc({ 5.0, 2.5 }, 1.0, black);
  drawing.Stroke({ { 0.0, 0.0 }, { 20.0, 10.0 } }, false, black);
  drawing.End();
}

TEST(Drawings, SvgLayers)
{
  OutputFile file(place().string());
  drawLayers(*newSvgDrawing(file));
  file.Close();
  const std::string layer = "<g xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" "
                            "inkscape:groupmode=\"layer\" inkscape:label=";
  const std::string disc = "<g fill=\"#000000\" stroke=\"none\">\n"
                           "<circle cx=\"5\" cy=\"7.5\" r=\"1\"/>\n</g>\n";
  const std::string text = takeText();
  EXPECT_EQ(text.substr(text.find("</clipPath>\n") + 12),
    layer + "\"Pen 1\" clip-path=\"url(#inside)\">\n" + disc + "</g>\n" + layer +
      "\"\xC3\xA9 &#38; \xF0\x9F\x96\x8A\" clip-path=\"url(#inside)\">\n" + disc +
      "<g fill=\"none\" stroke=\"#000000\" stroke-linecap=\"round\" stroke-linejoin=\"round\" "
      "stroke-width=\"0.25\">\n<polyline points=\"0,10 20,0\"/>\n</g>\n</g>\n</svg>\n");
}

TEST(Drawings, PdfLayers)
{
  OutputFile file(place().string());
  drawLayers(*newPdfDrawing(file, [](std::string_view data) { return std::string(data); }));
  file.Close();
  const std::string text = takeText();
  EXPECT_NE(text.find("/OC /Layer2 BDC\nq 1 0 0 1 5 2.5 cm /Disc Do Q\nEMC\n/OC /Layer3 BDC\n"),
    std::string::npos);
  EXPECT_NE(text.find("S\nEMC\n"), std::string::npos);
  EXPECT_NE(text.find("2 0 obj\n<< /Type /OCG /Name <50656E2031> >>\n"), std::string::npos);
  EXPECT_NE(text.find("/Name <EFBBBFC3A9202620F09F968A>"), std::string::npos);
  EXPECT_NE(text.find("/Properties << /Layer2 2 0 R /Layer3 3 0 R >>"), std::string::npos);
  EXPECT_NE(text.find("/Version /1.5 /OCProperties << /OCGs [2 0 R 3 0 R ] /D << /Order [2 0 R "
                      "3 0 R ] >> >>"),
    std::string::npos);
}

TEST(Drawings, FilesThatAreNotClosedAreRemoved)
{
  {
    OutputFile file(place().string());
    file.Write("a part");
  }
  EXPECT_FALSE(std::filesystem::exists(place()));
  EXPECT_THROW(OutputFile((place() / "missing").string()), std::runtime_error);
}

// Only counts what is filled.
class FillCounter final : public Drawing
{
public:
  double LongestSide() const override { return 1.0; }
  void Begin(const DrawingPage&) override {}
  void BeginLayer(const std::string&) override {}
  void FillDisc(const PagePoint&, double, Colour) override {}
  void FillPolygons(const std::vector<PagePath>& polygons, FillRule, Colour) override
  {
    this->Areas.push_back(polygons);
  }
  void Stroke(const PagePath&, bool, Colour) override {}
  void End() override {}

  std::vector<std::vector<PagePath>> Areas;
};

TEST(Drawings, PolygonsOfOneColourAreOneArea)
{
  const PagePath left{ { 0.0, 0.0 }, { 1.0, 0.0 }, { 0.0, 1.0 } };
  const PagePath right{ { 0.0, 0.0 }, { 0.0, 1.0 }, { 1.0, 0.0 } };
  FillCounter page;
  PolygonBatch areas(page);
  areas.Add(left, black);
  areas.Add(right, black);
  areas.Add(left, red);
  ASSERT_EQ(page.Areas.size(), 1u);
  EXPECT_EQ(page.Areas[0], (std::vector<PagePath>{ left, left })) << "all turn the same way";
  const Colour glass{ 0, 0, 255, 100 };
  areas.Add(left, glass);
  areas.Add(left, glass);
  EXPECT_EQ(page.Areas.size(), 4u) << "transparent ones overlap";
  areas.Draw();
  EXPECT_EQ(page.Areas.size(), 4u);
}

} // namespace
} // namespace RectifiedTransport
