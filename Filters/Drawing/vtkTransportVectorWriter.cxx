// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportVectorWriter.h"

#include "Bridge/Blocks/DensityBlocks.h"
#include "Bridge/Blocks/OptionalArray.h"
#include "Bridge/Drawing/TransportVectorWriter.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/ArrayList.h"
#include "Bridge/Run/Inputs/InputBlock.h"
#include "Core/Drawing/Drawing.h"
#include "Core/Drawing/OutputFile.h"
#include "Core/Messages/Failure.h"
#include "Core/Messages/PropertyCheck.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkScalarsToColors.h"

#include <algorithm>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

namespace
{

// The enumeration of the class indexes these.
constexpr const char* OrderTexts[] = { "File", "Path" };

// The array that is chosen for all blocks, in one of them; counts the blocks that have it.
vtkAbstractArray* arrayOf(const OptionalArray& found, int& count)
{
  count += found.Array || !found.IsChosen ? 1 : 0;
  return found.Array;
}

void requireArray(int count, const char* property, const std::string& name, vtkPolyData* data)
{
  if (count == 0)
  {
    fail("The input has no ", property, " '", name, "'; it has ",
      listArrays(data->GetPointData(), "point"), " and ", listArrays(data->GetCellData(), "cell"));
  }
}

} // namespace

//------------------------------------------------------------------------------
vtkTransportVectorWriter::vtkTransportVectorWriter()
{
  this->AddInputPort(PORT_GATHERED_DENSITY, { "vtkPolyData", "vtkCompositeDataSet" });
}

//------------------------------------------------------------------------------
vtkTransportVectorWriter::~vtkTransportVectorWriter()
{
  this->SetFileName(nullptr);
  this->SetLookupTable(nullptr);
}

//------------------------------------------------------------------------------
vtkCxxSetObjectMacro(vtkTransportVectorWriter, LookupTable, vtkScalarsToColors);

//------------------------------------------------------------------------------
const char* vtkTransportVectorWriter::GetOrderAsString()
{
  return choiceText(OrderTexts, this->Order);
}

//------------------------------------------------------------------------------
int vtkTransportVectorWriter::Write()
{
  this->Modified(); // also without a change
  return this->GetExecutive()->Update() && !this->HasFailed() ? 1 : 0;
}

//------------------------------------------------------------------------------
int vtkTransportVectorWriter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  requireChoice("Order", this->Order, OrderTexts);
  if (!this->FileName || !*this->FileName)
  {
    throw Failure("FileName is empty; it must be the file to write");
  }
  TransportVectorWriter writer{ { this->Width, this->PageMargin, {}, this->LineWidth },
    this->PointRadius, this->FillOutlines != 0, this->Order == ORDER_PATH, this->LookupTable };
  std::copy_n(this->PageBounds, writer.Page.Bounds.size(), writer.Page.Bounds.begin());
  writer.Check();
  AlgorithmProgress progress(this, this->Threading);

  std::vector<LayerData> data;
  int withColours = 0;
  int withRadii = 0;
  int withLayers = 0;
  const std::vector<DensityBlock> blocks = densityBlocks(vtkDataObject::GetData(inputVector[0]));
  for (const DensityBlock& block : blocks)
  {
    auto* shapes = requireBlock<vtkPolyData>(
      block.Data, "The input", "a vtkPolyData, as Extract Surface makes one of it");
    const OptionalArray colours =
      findOptionalArray(this->GetInputArrayInformation(0), shapes, "ColorArray");
    const OptionalArray radii =
      findOptionalArray(this->GetInputArrayInformation(1), shapes, "RadiusArray");
    const OptionalArray layers =
      findOptionalArray(this->GetInputArrayInformation(2), shapes, "LayerArray");
    data.push_back({ PolyDataShapes(shapes, "input"), arrayOf(colours, withColours),
      colours.OnPoints, vtkDataArray::SafeDownCast(arrayOf(radii, withRadii)),
      { arrayOf(layers, withLayers), layers.OnPoints, layers.Name } });
    if (&block == &blocks.back())
    {
      requireArray(withColours, "ColorArray", colours.Name, shapes);
      requireArray(withRadii, "RadiusArray", radii.Name, shapes);
      requireArray(withLayers, "LayerArray", layers.Name, shapes);
    }
  }

  OutputFile file(this->FileName);
  const std::unique_ptr<Drawing> drawing = this->NewDrawing(file);
  writer.Run(data, *drawing, progress);
  file.Close();
  return 1;
}

//------------------------------------------------------------------------------
void vtkTransportVectorWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Width: " << this->Width << "\n";
  os << indent << "PageMargin: " << this->PageMargin << "\n";
  os << indent << "PageBounds:";
  for (const double bound : this->PageBounds)
  {
    os << " " << bound;
  }
  os << "\n";
  os << indent << "PointRadius: " << this->PointRadius << "\n";
  os << indent << "LineWidth: " << this->LineWidth << "\n";
  os << indent << "FillOutlines: " << (this->FillOutlines ? "On" : "Off") << "\n";
  os << indent << "Order: " << this->GetOrderAsString() << "\n";
  os << indent << "LookupTable: " << (this->LookupTable ? "set" : "(none)") << "\n";
}
VTK_ABI_NAMESPACE_END
