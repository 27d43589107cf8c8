// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDensityEqualizingWarp.h"

#include "Bridge/Density/DensityImage.h"
#include "Bridge/Density/FlowCache.h"
#include "Bridge/Points/PointInput.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/PropertyCheck.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkDensityEqualizingWarp);

namespace
{
using namespace RectifiedTransport;

// What RequestData has fetched and checked.
struct WarpRun
{
  Progress& Work;
  DensityImage& Density;
  FlowCache& Cache;
  FlowOptions Options;
  vtkPointSet* Input;
  double Blend;
};

// Progress at the ends of the stages, in proportion to the times that they take.
struct WarpStages
{
  double Tables;
  double Reading;
  double Flow;
};

WarpStages planStages(const WarpRun& run)
{
  const ImageGrid& geometry = run.Density.Geometry();
  const double points = static_cast<double>(run.Input->GetNumberOfPoints());
  const double evaluations = run.Blend == 0.0
    ? 0.0
    : run.Options.NumberOfSteps * (run.Options.Method == Integrator::RungeKutta4 ? 4.0 : 1.0);
  // Nanoseconds, as measured for the sampler.
  const double tables =
    run.Cache.IsOutdated(run.Density) ? 10.0 * static_cast<double>(geometry.NumberOfCells()) : 0.0;
  const double reading = tables + 20.0 * points;
  const double flow = reading + points * evaluations * (geometry.Dimension() == 3 ? 60.0 : 15.0);
  const double all = flow + 20.0 * points;
  return { tables / all, reading / all, flow / all };
}

// The points of a warp: in index space, moved to the border if they are outside, and in physical
// space. In 3D index space has the memory of the displacements.
template <int D>
class WarpedPoints
{
public:
  explicit WarpedPoints(const WarpRun& run)
    : Run(run)
    , Geometry(run.Density.Geometry())
    , Count(run.Input->GetNumberOfPoints())
    , Purpose("the " + std::to_string(this->Count) + " points")
  {
    constexpr double real = sizeof(double);
    const double scratch = D == 3 ? 0.0 : real * D;
    requireMemory(this->Purpose, static_cast<double>(this->Count) * (6 * real + scratch));
    this->Points = newArray<vtkDoubleArray>("Points", 3, this->Count);
    this->Displacements = newArray<vtkDoubleArray>("Displacement", 3, this->Count);
    withMemory(this->Purpose, static_cast<double>(this->Count) * scratch,
      [&]() { this->Separate = LargeBuffer<double>(D == 3 ? 0 : this->Count * D); });
    this->Index = D == 3 ? this->Displacements->GetPointer(0) : this->Separate.data();
  }

  // Returns how many points are outside of the domain.
  std::int64_t Read()
  {
    double* points = this->Points->GetPointer(0);
    const double tolerance = this->Geometry.BorderTolerance();
    std::atomic<std::int64_t> outside{ 0 };
    visitPoints(
      this->Run.Input, "input point set", this->Run.Work, [&](std::int64_t i, const double* x) {
        std::copy_n(x, 3, points + i * 3);
        double offset[D];
        this->Geometry.template ToIndex<D>(x, offset);
        double* index = this->Index + i * D;
        std::copy_n(offset, D, index);
        if (this->Geometry.template ClampToDomain<D>(index))
        {
          return;
        }
        for (int a = 0; a < D; ++a)
        {
          offset[a] -= index[a];
        }
        double v[3];
        this->Geometry.template VectorToPhysical<D>(offset, v);
        if (std::hypot(v[0], v[1], v[2]) > tolerance)
        {
          ++outside;
        }
      });
    return outside;
  }

  void Flow()
  {
    withMemory(this->Purpose, static_cast<double>(this->Count) * sizeof(std::int64_t), [&]() {
      const PointSpan<D> points(this->Index, this->Count);
      this->Run.Cache.template Flow<D>().Backward(
        points, points, this->Run.Options, this->Run.Work.Stage());
    });
  }

  // Index space is gone afterwards.
  void Write(vtkPointSet* output)
  {
    constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
    double* points = this->Points->GetPointer(0);
    double* displacements = this->Displacements->GetPointer(0);
    this->Run.Work.For(this->Count, grain, [=](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i)
      {
        double* x = points + i * 3;
        double way[D];
        this->Geometry.template ToIndex<D>(x, way);
        this->Geometry.template ClampToDomain<D>(way);
        for (int a = 0; a < D; ++a)
        {
          way[a] = this->Run.Blend * (this->Index[i * D + a] - way[a]);
        }
        double* displacement = displacements + i * 3;
        this->Geometry.template VectorToPhysical<D>(way, displacement);
        for (int r = 0; r < 3; ++r)
        {
          x[r] += displacement[r];
        }
      }
    });
    vtkNew<vtkPoints> moved;
    moved->SetDataTypeToDouble();
    moved->SetData(this->Points);
    output->SetPoints(moved);
    output->GetPointData()->SetVectors(this->Displacements);
  }

private:
  const WarpRun& Run;
  const ImageGrid& Geometry;
  const std::int64_t Count;
  const std::string Purpose;
  vtkSmartPointer<vtkDoubleArray> Points;
  vtkSmartPointer<vtkDoubleArray> Displacements;
  LargeBuffer<double> Separate;
  double* Index;
};

// Returns how many points are outside of the domain.
template <int D>
std::int64_t warp(const WarpRun& run, vtkPointSet* output)
{
  const WarpStages stages = planStages(run);
  WarpedPoints<D> points(run);
  run.Cache.Update(run.Density, run.Work, stages.Tables);
  run.Work.BeginStage(stages.Reading);
  const std::int64_t outside = points.Read();
  if (run.Blend > 0.0)
  {
    run.Work.BeginStage(stages.Flow);
    points.Flow();
  }
  run.Work.BeginStage(1.0);
  points.Write(output);
  return outside;
}
} // namespace

//------------------------------------------------------------------------------
vtkDensityEqualizingWarp::vtkDensityEqualizingWarp()
  : vtkTransportAlgorithm(1)
  , Blend(1.0)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(1);
}

//------------------------------------------------------------------------------
vtkDensityEqualizingWarp::~vtkDensityEqualizingWarp() = default;

//------------------------------------------------------------------------------
void vtkDensityEqualizingWarp::SetDensityConnection(vtkAlgorithmOutput* density)
{
  this->SetInputConnection(1, density);
}

//------------------------------------------------------------------------------
void vtkDensityEqualizingWarp::SetDensityData(vtkDataObject* density)
{
  this->SetInputData(1, density);
}

//------------------------------------------------------------------------------
vtkPointSet* vtkDensityEqualizingWarp::GetOutput()
{
  return vtkPointSet::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
int vtkDensityEqualizingWarp::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkPointSet" : "vtkImageData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkDensityEqualizingWarp::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPointSet");
  return 1;
}

//------------------------------------------------------------------------------
int vtkDensityEqualizingWarp::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkGuardedAlgorithm::MakeOutputLike(inputVector[0], outputVector, 0);
  return 1;
}

//------------------------------------------------------------------------------
// Where a point goes depends on that point alone: the pieces that are asked for will do.
bool vtkDensityEqualizingWarp::NeedsWhole(int port)
{
  return port == 1;
}

//------------------------------------------------------------------------------
int vtkDensityEqualizingWarp::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  requireThat(this->Blend >= 0.0 && this->Blend <= 1.0, "Blend", this->Blend, "from 0 to 1");
  const FlowOptions options = this->GetFlowOptions();
  std::unique_ptr<Executor> executor(this->NewExecutor());
  vtkPointSet* input = pointSetOf(inputVector[0]);
  const std::unique_ptr<DensityImage> density(this->NewDensity(inputVector));
  if (!density || !input || input->GetNumberOfPoints() == 0)
  {
    return 1;
  }
  AlgorithmProgress progress(this, std::move(executor));
  const WarpRun run{ progress, *density, this->GetFlowCache(), options, input, this->Blend };
  vtkPointSet* output = vtkPointSet::GetData(outputVector);
  output->CopyStructure(input);
  output->GetPointData()->PassData(input->GetPointData());
  output->GetCellData()->PassData(input->GetCellData());
  const int dimension = density->Geometry().Dimension();
  const std::int64_t outside = dimension == 1 ? warp<1>(run, output)
    : dimension == 2                          ? warp<2>(run, output)
                                              : warp<3>(run, output);
  if (outside > 0)
  {
    vtkWarningMacro(<< outside << " of " << input->GetNumberOfPoints()
                    << " points outside the domain of the density moved as its border does");
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkDensityEqualizingWarp::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Blend: " << this->Blend << "\n";
}
VTK_ABI_NAMESPACE_END
