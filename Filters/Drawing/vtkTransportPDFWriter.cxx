// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportPDFWriter.h"

#include "Core/Drawing/DrawingFormats.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkZLibDataCompressor.h"

#include <string>
#include <string_view>

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkTransportPDFWriter);

namespace
{
std::string compress(std::string_view data)
{
  vtkNew<vtkZLibDataCompressor> compressor;
  std::string packed(compressor->GetMaximumCompressionSpace(data.size()), '\0');
  packed.resize(compressor->Compress(reinterpret_cast<const unsigned char*>(data.data()),
    data.size(), reinterpret_cast<unsigned char*>(packed.data()), packed.size()));
  return packed;
}
} // namespace

//------------------------------------------------------------------------------
std::unique_ptr<RectifiedTransport::Drawing> vtkTransportPDFWriter::NewDrawing(
  RectifiedTransport::OutputFile& file) const
{
  return RectifiedTransport::newPdfDrawing(file, compress);
}

//------------------------------------------------------------------------------
void vtkTransportPDFWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
VTK_ABI_NAMESPACE_END
