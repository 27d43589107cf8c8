// SPDX-License-Identifier: BSD-3-Clause
// A drawing as SVG 1.1.
#ifndef RectifiedTransport_SvgDrawing_h
#define RectifiedTransport_SvgDrawing_h

#include "Core/Drawing/Drawing.h"

#include <string>

namespace RectifiedTransport
{

class OutputFile;

class SvgDrawing final : public Drawing
{
public:
  // The file must outlive this object.
  explicit SvgDrawing(OutputFile& file)
    : File(file)
  {
  }

  double LongestSide() const override { return 1e6; }
  void Begin(const DrawingPage& page) override;
  void FillDisc(const PagePoint& centre, double radius, Colour colour) override;
  void FillPolygons(const std::vector<PagePath>& polygons, FillRule rule, Colour colour) override;
  void Stroke(const PagePath& path, bool isClosed, Colour colour) override;
  void End() override;

private:
  enum class Group
  {
    None,
    Fills,
    Strokes
  };
  void EnterGroup(Group group);
  // What differs from the group's opaque black.
  void AppendColour(const std::string& paint, Colour colour);
  void AppendPoints(const PagePath& points);
  void Flush();

  OutputFile& File;
  std::string Text;
  double Height = 0.0;
  double StrokeWidth = 0.0;
  bool IsClipped = false;
  Group Open = Group::None;
};

} // namespace RectifiedTransport

#endif
