// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportSVGWriter.h"

#include "Core/Drawing/DrawingFormats.h"

#include "vtkObjectFactory.h"

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkTransportSVGWriter);

//------------------------------------------------------------------------------
std::unique_ptr<RectifiedTransport::Drawing> vtkTransportSVGWriter::NewDrawing(
  RectifiedTransport::OutputFile& file) const
{
  return RectifiedTransport::newSvgDrawing(file);
}

//------------------------------------------------------------------------------
void vtkTransportSVGWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
VTK_ABI_NAMESPACE_END
