// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportPDFWriter.h"

#include "Bridge/Drawing/PdfDrawing.h"

#include "vtkObjectFactory.h"

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkTransportPDFWriter);

//------------------------------------------------------------------------------
std::unique_ptr<RectifiedTransport::Bridge::Drawing> vtkTransportPDFWriter::NewDrawing(
  RectifiedTransport::Bridge::OutputFile& file) const
{
  return std::make_unique<RectifiedTransport::Bridge::PdfDrawing>(file);
}

//------------------------------------------------------------------------------
void vtkTransportPDFWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
VTK_ABI_NAMESPACE_END
