// SPDX-License-Identifier: BSD-3-Clause
// A drawing as PDF 1.4 (ISO 32000-1).
#ifndef RectifiedTransport_PdfDrawing_h
#define RectifiedTransport_PdfDrawing_h

#include "Core/Drawing/Drawing.h"

#include <bitset>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace RectifiedTransport
{

class OutputFile;

// VTK's libharu has neither compression nor shapes that are drawn many times, and keeps the page in
// memory: 260 bytes a disc instead of about 7.
class PdfDrawing final : public Drawing
{
public:
  // Compresses in the format of zlib.
  using Compress = std::string(std::string_view data);

  // The file must outlive this object.
  PdfDrawing(OutputFile& file, Compress* compress)
    : File(file)
    , Pack(compress)
  {
  }

  double LongestSide() const override { return 5080.0; } // 14400 points: Annex C
  void Begin(const DrawingPage& page) override;
  void FillDisc(const PagePoint& centre, double radius, Colour colour) override;
  void FillPolygons(const std::vector<PagePath>& polygons, FillRule rule, Colour colour) override;
  void Stroke(const PagePath& path, bool isClosed, Colour colour) override;
  void End() override;

private:
  // Objects are numbered from 1. They may be written in any order.
  std::size_t NewObject();
  void WriteObject(std::size_t number, std::string_view text);
  // `entries` of the stream's dictionary.
  void WriteStream(std::size_t number, const std::string& entries, std::string_view data);
  void WriteTable(std::size_t root);

  void UseColour(Colour colour, bool ofStrokes);
  void AppendPath(const PagePath& path);
  // Writes the content so far if it is long enough to be compressed well.
  void Flush();
  void WriteContent();

  OutputFile& File;
  Compress* const Pack;
  std::vector<std::int64_t> Offsets; // of the objects in the file
  std::vector<std::size_t> Contents; // the page's streams
  std::string Text;                  // of the next one
  PagePoint Size{};
  // The graphics state of the content so far.
  Colour FillColour;
  Colour StrokeColour;
  std::uint8_t Opacity = 255;
  std::bitset<256> Opacities; // that are used
  std::size_t Disc = 0;       // the object of the unit disc
};

} // namespace RectifiedTransport

#endif
