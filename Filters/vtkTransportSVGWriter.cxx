// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportSVGWriter.h"

#include "Core/Drawing/SvgDrawing.h"

#include "vtkObjectFactory.h"

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkTransportSVGWriter);

//------------------------------------------------------------------------------
std::unique_ptr<RectifiedTransport::Drawing> vtkTransportSVGWriter::NewDrawing(
  RectifiedTransport::OutputFile& file) const
{
  return std::make_unique<RectifiedTransport::SvgDrawing>(file);
}

//------------------------------------------------------------------------------
void vtkTransportSVGWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
VTK_ABI_NAMESPACE_END
