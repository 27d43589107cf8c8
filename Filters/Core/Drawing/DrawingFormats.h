// SPDX-License-Identifier: BSD-3-Clause
// The formats of a drawing.
#ifndef RectifiedTransport_DrawingFormats_h
#define RectifiedTransport_DrawingFormats_h

#include "Core/Drawing/Drawing.h"

#include <memory>
#include <string>
#include <string_view>

namespace RectifiedTransport
{

class OutputFile;

// Compresses in the format of zlib.
using Compress = std::string(std::string_view data);

// Drawings in SVG 1.1 and PDF 1.4, or 1.5 with layers (ISO 32000-1). The file must outlive the
// drawing.
std::unique_ptr<Drawing> newSvgDrawing(OutputFile& file);
std::unique_ptr<Drawing> newPdfDrawing(OutputFile& file, Compress* compress);

} // namespace RectifiedTransport

#endif
