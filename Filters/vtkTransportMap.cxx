// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportMap.h"

#include "Bridge/Density/DensityImage.h"
#include "Bridge/Density/FlowCache.h"
#include "Bridge/Flow/MapField.h"
#include "Bridge/Image/GridText.h"
#include "Bridge/Image/ImageGrids.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/FieldValue.h"
#include "Bridge/Run/PropertyCheck.h"

#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <memory>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkTransportMap);

namespace
{
using namespace RectifiedTransport;

const char* const DirectionTexts[] = { "UniformToDensity", "DensityToUniform" };

// What RequestData has fetched and checked.
struct MapRun
{
  Progress& Work;
  DensityImage& Density;
  FlowCache& Cache;
  FlowOptions Options;
  bool Backward;
  vtkImageData* Input;
  const ImageGrid& Grid;
  vtkImageData* Output;
};

struct MapResult
{
  double Cost;
  std::int64_t Samples;
  std::int64_t MovedToMass;
};

// Progress at the ends of the stages, in proportion to the times that they take.
struct MapStages
{
  double Tables;
  double Flow;
};

MapStages planStages(const MapRun& run, double samples)
{
  const ImageGrid& geometry = run.Density.Geometry();
  const bool space = geometry.Dimension() == 3;
  const double evaluations =
    run.Options.NumberOfSteps * (run.Options.Method == Integrator::RungeKutta4 ? 4.0 : 1.0);
  // Nanoseconds, as measured.
  const double tables =
    run.Cache.IsOutdated(run.Density) ? 10.0 * static_cast<double>(geometry.NumberOfCells()) : 0.0;
  const double flow = tables + samples * evaluations * (space ? 60.0 : 15.0);
  const double all = flow + samples * (run.Backward && space ? 150.0 : 50.0);
  return { tables / all, flow / all };
}

template <int D>
GridSize<D> latticeOf(const std::array<int, 3>& values, vtkImageData* input)
{
  int dimensions[3];
  input->GetDimensions(dimensions);
  GridSize<D> lattice{};
  int axis = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (dimensions[i] > 1 && axis < D)
    {
      lattice[axis++] = values[i];
    }
  }
  return lattice;
}

// The output without its map.
void shapeOutput(const MapRun& run)
{
  applyGrid(run.Grid, run.Output);
  if (run.Grid.Extent() == run.Density.Geometry().Extent())
  {
    run.Output->GetPointData()->PassData(run.Input->GetPointData());
    run.Output->GetCellData()->PassData(run.Input->GetCellData());
  }
}

template <int D>
MapResult makeMap(const MapRun& run)
{
  const bool onPoints = run.Density.IsOnPoints();
  const GridSize<D> lattice = latticeOf<D>(run.Grid.NumberOfValues(), run.Input);
  const std::string purpose =
    "a map of " + describeSize<D>(lattice) + " samples (see SampleDimensions)";
  const double samples = numberOfCells<D>(lattice);
  const MapStages stages = planStages(run, samples);
  MapField<D> field(run.Density.Geometry(), lattice, purpose);
  shapeOutput(run);

  run.Cache.Update(run.Density, run.Work, stages.Tables);
  run.Work.BeginStage(stages.Flow);
  const RectifiedFlow<D>& flow = run.Cache.Flow<D>();
  const FlowReport report = run.Backward
    ? flow.BackwardLattice(lattice, field.Positions(), run.Options, run.Work.Stage())
    : flow.ForwardLattice(lattice, field.Positions(), run.Options, run.Work.Stage());
  vtkDataSetAttributes* attributes =
    run.Output->GetAttributes(onPoints ? vtkDataObject::POINT : vtkDataObject::CELL);
  const double cost = field.Write(run.Backward ? &flow : nullptr, run.Work, 1.0, attributes);
  return { cost, field.Count(), report.MovedToMass };
}
} // namespace

//------------------------------------------------------------------------------
vtkTransportMap::vtkTransportMap()
  : Direction(UNIFORM_TO_DENSITY)
  , SampleDimensions{ 0, 0, 0 }
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(1);
}

//------------------------------------------------------------------------------
vtkTransportMap::~vtkTransportMap() = default;

//------------------------------------------------------------------------------
const char* vtkTransportMap::GetDirectionAsString()
{
  return choiceText(DirectionTexts, this->Direction);
}

//------------------------------------------------------------------------------
vtkImageData* vtkTransportMap::GetOutput()
{
  return vtkImageData::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
int vtkTransportMap::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkTransportMap::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkImageData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkTransportMap::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* inputInformation = inputVector[0]->GetInformationObject(0);
  vtkInformation* outputInformation = outputVector->GetInformationObject(0);
  const ImageGrid inputGrid =
    announcedGrid(inputInformation, this->IsDensityOnPoints(inputInformation));
  announceGrid(inputGrid, outputInformation);
  if (inputGrid.IsEmpty())
  {
    return 1;
  }
  const ImageGrid grid = gridWithValues(inputGrid, this->SampleDimensions, "SampleDimensions");
  announceGrid(grid, outputInformation);
  if (grid.Extent() == inputGrid.Extent())
  {
    // The input's scalars are passed on.
    for (auto* key : { vtkDataObject::POINT_DATA_VECTOR(), vtkDataObject::CELL_DATA_VECTOR() })
    {
      if (inputInformation->Has(key))
      {
        outputInformation->CopyEntry(inputInformation, key, 1);
      }
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkTransportMap::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  requireChoice("Direction", this->Direction, DirectionTexts);
  const FlowOptions options = this->GetFlowOptions();
  std::unique_ptr<Executor> executor(this->NewExecutor());

  // All samples are in the first piece, whatever pieces a consumer asks for.
  vtkInformation* outputInformation = outputVector->GetInformationObject(0);
  if (vtkGuardedAlgorithm::IsLaterPiece(request, outputVector))
  {
    return 1;
  }
  vtkImageData* input = vtkImageData::GetData(inputVector[0], 0);
  const std::unique_ptr<DensityImage> density(this->NewDensity(inputVector));
  if (!density)
  {
    return 1;
  }
  const ImageGrid grid =
    gridWithValues(density->Geometry(), this->SampleDimensions, "SampleDimensions");
  vtkImageData* output = vtkImageData::GetData(outputVector);
  announceGrid(grid, outputInformation); // which array it is, is not always known before the data

  AlgorithmProgress progress(this, std::move(executor));
  const MapRun run{ progress, *density, this->GetFlowCache(), options,
    this->Direction == DENSITY_TO_UNIFORM, input, grid, output };
  const int dimension = density->Geometry().Dimension();
  const MapResult result = dimension == 1 ? makeMap<1>(run)
    : dimension == 2                      ? makeMap<2>(run)
                                          : makeMap<3>(run);
  addFieldValue(output, "TotalMass", run.Cache.TotalMass());
  addFieldValue(output, "TransportCost", result.Cost);
  if (result.MovedToMass > 0)
  {
    vtkWarningMacro(<< result.MovedToMass << " of " << result.Samples
                    << " samples in empty cells moved to the nearest cell with mass (more "
                       "NumberOfSteps may spare them that)");
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkTransportMap::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Direction: " << this->GetDirectionAsString() << "\n";
  os << indent << "SampleDimensions: " << this->SampleDimensions[0] << " "
     << this->SampleDimensions[1] << " " << this->SampleDimensions[2] << "\n";
}
VTK_ABI_NAMESPACE_END
