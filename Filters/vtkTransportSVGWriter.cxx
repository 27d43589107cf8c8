// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportSVGWriter.h"

#include "Bridge/Drawing/SvgDrawing.h"

#include "vtkObjectFactory.h"

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkTransportSVGWriter);

//------------------------------------------------------------------------------
std::unique_ptr<RectifiedTransport::Bridge::Drawing> vtkTransportSVGWriter::NewDrawing(
  RectifiedTransport::Bridge::OutputFile& file) const
{
  return std::make_unique<RectifiedTransport::Bridge::SvgDrawing>(file);
}

//------------------------------------------------------------------------------
void vtkTransportSVGWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
VTK_ABI_NAMESPACE_END
