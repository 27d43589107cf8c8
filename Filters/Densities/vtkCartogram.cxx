// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCartogram.h"

#include "Bridge/Blocks/DensityBlocks.h"
#include "Bridge/Cartogram/Cartogram.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/Settings/MissingData.h"
#include "Core/Cartogram/MapProjection.h"
#include "Core/Messages/PropertyCheck.h"
#include "Core/Parallel/Stages.h"

#include "vtkCompositeDataSet.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkCartogram);

using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

namespace
{
// The name of a chosen array; empty for none. The mass of a region is one value, and a point is in
// several regions: an array that is chosen among points or field data is an error.
std::string arrayName(vtkInformation* choice, const char* title)
{
  const char* name = choice->Get(vtkDataObject::FIELD_NAME());
  // ParaView gives None another association.
  if (name && *name != '\0' && std::string(name) != "None" &&
    choice->Get(vtkDataObject::FIELD_ASSOCIATION()) != vtkDataObject::FIELD_ASSOCIATION_CELLS)
  {
    fail(title, " '", name,
      "' is not chosen among cell arrays; a region's mass is a value of its "
      "cells");
  }
  return name ? name : "";
}

// The optional overlay, which has no information object without a connection.
vtkDataObject* overlayOf(vtkInformationVector* port)
{
  return port->GetNumberOfInformationObjects() > 0 ? vtkDataObject::GetData(port) : nullptr;
}
} // namespace

// What depends on the shapes of the regions alone is kept: another array of masses reuses it.
struct vtkCartogram::vtkInternals
{
  MapCache Cache;
};

//------------------------------------------------------------------------------
vtkCartogram::vtkCartogram()
  : Internals(new vtkInternals)
{
  this->AddInputPort(
    PORT_GATHERED_DENSITY, { "vtkPolyData", "vtkUnstructuredGrid", "vtkCompositeDataSet" });
  this->AddInputPort(
    PORT_GATHERED_POINTS, { "vtkPointSet", "vtkCompositeDataSet" }, PORT_OPTIONAL_INPUT);
  this->AddOutputPort("vtkPolyData");
  this->AddOutputPort("vtkPolyData");
  this->AddOutputPort("vtkDataObject");
}

//------------------------------------------------------------------------------
vtkCartogram::~vtkCartogram() = default;

//------------------------------------------------------------------------------
const char* vtkCartogram::GetProjectionAsString()
{
  return choiceText(ProjectionTexts, this->Projection);
}

//------------------------------------------------------------------------------
const char* vtkCartogram::GetEmptyCellsAsString()
{
  return choiceText(EmptyCellsTexts, this->EmptyCells);
}

//------------------------------------------------------------------------------
// Output 2 has the type of the overlay, which the executive cannot know. An object of that type
// stays. The other outputs are of the types of their ports.
int vtkCartogram::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  // As the overlay; without one, or before the executive turns it down, some type is needed.
  vtkDataObject* const overlay = overlayOf(inputVector[1]);
  const bool isAny =
    overlay && (overlay->IsA("vtkPointSet") || overlay->IsA("vtkCompositeDataSet"));
  const auto made = vtkSmartPointer<vtkDataObject>::Take(
    isAny ? overlay->NewInstance() : static_cast<vtkDataObject*>(vtkPolyData::New()));
  vtkDataObject* const output = vtkDataObject::GetData(outputVector, 2);
  if (!output || output->GetDataObjectType() != made->GetDataObjectType())
  {
    outputVector->GetInformationObject(2)->Set(vtkDataObject::DATA_OBJECT(), made);
  }
  return 1;
}

//------------------------------------------------------------------------------
// The ports are gathered: with several ranks the first one runs this on the regions of all of them.
int vtkCartogram::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  requireThat(this->Resolution >= 16 && this->Resolution <= 16384, "Resolution", this->Resolution,
    "from 16 to 16384");
  requireThat(this->Margin >= 0.0 && this->Margin <= 10.0, "Margin", this->Margin, "from 0 to 10");
  requireChoice("Projection", this->Projection, ProjectionTexts);
  const EmptyRule sea = emptyRule(this->EmptyCells, this->EmptyValue);
  requireThat(this->Tolerance > 0.0 && this->Tolerance <= 1.0, "Tolerance", this->Tolerance,
    "above 0 and at most 1");
  requireThat(this->MaximumIterations >= 1 && this->MaximumIterations <= 100, "MaximumIterations",
    this->MaximumIterations, "from 1 to 100");
  requireThat(this->MinimumShare >= 0.0 && this->MinimumShare <= 1.0, "MinimumShare",
    this->MinimumShare, "from 0 to 1");
  requireThat(this->Blend >= 0.0 && this->Blend <= 1.0, "Blend", this->Blend, "from 0 to 1");
  CartogramWorker worker{};
  worker.Options.Resolution = this->Resolution;
  worker.Options.Margin = this->Margin;
  constexpr SeaDensity seas[] = { SeaDensity::Zero, SeaDensity::Mean, SeaDensity::Minimum,
    SeaDensity::Value }; // as EmptyCells
  worker.Options.Sea = seas[static_cast<int>(sea.Cells)];
  worker.Options.SeaValue = sea.Value;
  worker.Options.Tolerance = this->Tolerance;
  worker.Options.MaximumPasses = this->MaximumIterations;
  worker.IsInDegrees = this->Projection == PROJECTION_EQUAL_AREA;
  worker.MinimumShare = this->MinimumShare;
  worker.Blend = this->Blend;
  worker.Arrays.Mass = arrayName(this->GetInputArrayInformation(0), "MassArray");
  worker.Arrays.Region = arrayName(this->GetInputArrayInformation(1), "RegionArray");
  AlgorithmProgress progress(this, this->Threading);
  Stages stages(progress, { { "reading", 1 }, { "cartogram", 99 } });

  // An input without regions, as after an abort upstream, gives empty outputs and no error.
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
  const std::vector<DensityBlock> blocks =
    input ? densityBlocks(input, nullptr, &stages["reading"]) : std::vector<DensityBlock>();
  if (blocks.empty())
  {
    return 1;
  }
  CartogramOutputs outputs{ vtkPolyData::GetData(outputVector, 0),
    vtkPolyData::GetData(outputVector, 1), {} };
  if (vtkDataObject* overlay = overlayOf(inputVector[1]))
  {
    outputs.Overlay = overlayParts(overlay, vtkDataObject::GetData(outputVector, 2));
  }
  else
  {
    // VTK has passed on the map's, which an earlier cartogram may have made.
    vtkDataObject::GetData(outputVector, 2)->GetFieldData()->Initialize();
  }
  this->WarnOnFirstRank(worker.Run(blocks, this->Internals->Cache, stages["cartogram"], outputs));
  return 1;
}

//------------------------------------------------------------------------------
void vtkCartogram::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "Margin: " << this->Margin << "\n";
  os << indent << "Projection: " << this->GetProjectionAsString() << "\n";
  os << indent << "EmptyCells: " << this->GetEmptyCellsAsString() << "\n";
  os << indent << "EmptyValue: " << this->EmptyValue << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "MaximumIterations: " << this->MaximumIterations << "\n";
  os << indent << "MinimumShare: " << this->MinimumShare << "\n";
  os << indent << "Blend: " << this->Blend << "\n";
}
VTK_ABI_NAMESPACE_END
