// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportQuality.h"

#include "Bridge/Data/GhostFlags.h"
#include "Bridge/Data/PointInput.h"
#include "Bridge/Density/InputDensity.h"
#include "Bridge/Plan/FlowCache.h"
#include "Bridge/Ranks/DistributedPoints.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/Settings/TransportSettings.h"
#include "Bridge/Samples/DensityAgreement.h"
#include "Bridge/Samples/TransportQuality.h"
#include "Core/Messages/PropertyCheck.h"
#include "Core/Parallel/Stages.h"

#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <memory>

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkTransportQuality);

namespace
{
using namespace RectifiedTransport;
using namespace RectifiedTransport::Bridge;

template <class ArrayT, class Value>
void addColumn(vtkTable* table, const char* name, Value value)
{
  vtkNew<ArrayT> column;
  column->SetName(name);
  column->InsertNextValue(value);
  table->AddColumn(column);
}
} // namespace

//------------------------------------------------------------------------------
vtkTransportQuality::vtkTransportQuality()
  : vtkDensityAlgorithm(1)
{
  this->AddInputPort(PORT_PARTITIONED_POINTS, { "vtkPointSet" });
  this->AddDensityPort(PORT_PARTITIONED_DENSITY);
  this->AddOutputPort("vtkTable");
}

//------------------------------------------------------------------------------
const char* vtkTransportQuality::GetTablesAsString()
{
  return choiceText(TablesTexts, this->Tables);
}

//------------------------------------------------------------------------------
int vtkTransportQuality::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  requireThat(this->BlockSize >= 0, "BlockSize", this->BlockSize,
    "at least 1, or 0 for blocks of about 64 particles");
  TransportQuality measure{};
  measure.BlockSize = this->BlockSize;
  measure.Tables = tableSetting(this->Tables);
  const Ranks& ranks = this->GetRanks();
  AlgorithmProgress progress(this, this->Threading, ranks);
  Stages stages(progress, { { "reading", 5 }, { "quality", 95 } });
  vtkPointSet* input = pointSetOf(inputVector[0]);
  const std::unique_ptr<InputDensity> density = this->ReadDensity(inputVector, stages["reading"]);
  if (!density)
  {
    return 1;
  }
  const DistributedPoints particles(input, ghostPoint, ranks);
  if (particles.All() == 0)
  {
    return 1;
  }
  const ParticleQuality quality =
    measure.Run(particles, *density, this->GetFlowCache(), stages["quality"]);
  vtkTable* output = vtkTable::GetData(outputVector);
  addReadings(output, { density->HowRead() });
  this->WarnOnFirstRank(disagreementWarning(quality.Correlation, this->InvertDensity != 0));
  if (!ranks.IsFirst())
  {
    return 1;
  }
  addColumn<vtkIdTypeArray>(output, "Particles", static_cast<vtkIdType>(quality.Particles));
  addColumn<vtkDoubleArray>(output, "TotalMass", quality.TotalMass);
  addColumn<vtkIdTypeArray>(output, "InEmptyCells", static_cast<vtkIdType>(quality.InEmptyCells));
  addColumn<vtkIdTypeArray>(output, "Outside", static_cast<vtkIdType>(quality.Outside));
  addColumn<vtkDoubleArray>(output, "DensityError", quality.DensityError);
  addColumn<vtkDoubleArray>(output, "LargestBlockError", quality.Blocks.Largest);
  addColumn<vtkDoubleArray>(output, "TransportCost", quality.TransportCost);
  addColumn<vtkDoubleArray>(output, "SmallestSpacing", quality.SmallestSpacing);
  addColumn<vtkDoubleArray>(output, "MeanSpacing", quality.MeanSpacing);
  return 1;
}

//------------------------------------------------------------------------------
void vtkTransportQuality::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tables: " << this->GetTablesAsString() << "\n";
  os << indent << "BlockSize: " << this->BlockSize << "\n";
}
VTK_ABI_NAMESPACE_END
