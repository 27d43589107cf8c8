// SPDX-License-Identifier: BSD-3-Clause
#include "vtkUniformSeedSource.h"

#include "Bridge/Points/ParticleCells.h"
#include "Bridge/Points/UnitSeeds.h"
#include "Bridge/Run/AlgorithmProgress.h"
#include "Bridge/Run/ExceptionBarrier.h"
#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Bridge/Run/PropertyCheck.h"
#include "Bridge/Run/SMPExecutor.h"
#include "Core/Parallel/LargeBuffer.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
vtkStandardNewMacro(vtkUniformSeedSource);

namespace
{
using namespace RectifiedTransport;

void requireBounds(const double* bounds, int dimension)
{
  const char axes[] = { 'x', 'y', 'z' };
  for (int a = 0; a < 3; ++a)
  {
    const double low = bounds[2 * a];
    const double high = bounds[2 * a + 1];
    const bool flat = a >= dimension && low == high;
    if (!std::isfinite(high - low) || (!(low < high) && !flat))
    {
      std::ostringstream message;
      message << "Bounds are " << low << " to " << high << " in " << axes[a]
              << "; they must be finite, the second greater than the first";
      throw Failure(message.str());
    }
  }
}

// Fills a box with points, uniformly.
template <int D>
void fillBox(
  const UnitSeeds<D>& seeds, const double* bounds, Progress& progress, vtkPolyData* output)
{
  constexpr double bytesPerPoint = 3 * sizeof(double) + 2 * sizeof(vtkIdType);
  const std::string purpose = "the points (see NumberOfPoints)";
  requireMemory(purpose, seeds.Count() * bytesPerPoint);
  const vtkIdType count = static_cast<vtkIdType>(seeds.Count());

  auto coordinates = newArray<vtkDoubleArray>("Points", 3, count);
  double* points = coordinates->GetPointer(0);
  LargeBuffer<double> separate;
  progress.BeginStage(0.6);
  withMemory(purpose, seeds.Count() * D * sizeof(double), [&]() {
    separate = LargeBuffer<double>(D == 3 ? 0 : count * D);
    seeds.Generate({ D == 3 ? points : separate.data(), count }, progress.Stage());
  });
  const double* unit = D == 3 ? points : separate.data();

  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  progress.BeginStage(0.8);
  progress.For(count, grain, [=](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      for (int a = 0; a < D; ++a)
      {
        const double low = bounds[2 * a];
        const double high = bounds[2 * a + 1];
        points[3 * i + a] = std::min(low + (high - low) * unit[i * D + a], high);
      }
      if (D == 2)
      {
        points[3 * i + 2] = bounds[4];
      }
    }
  });
  progress.BeginStage(1.0);
  vtkNew<vtkPoints> pointSet;
  pointSet->SetDataTypeToDouble();
  pointSet->SetData(coordinates);
  output->SetPoints(pointSet);
  output->SetVerts(newParticleCells(count, 1, progress));
}
} // namespace

//------------------------------------------------------------------------------
vtkUniformSeedSource::vtkUniformSeedSource()
  : Bounds{ 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 }
  , Dimension(2)
  , NumberOfPoints(8192)
  , Pattern(BLUE_NOISE)
  , RandomSeed(1)
{
  this->SetNumberOfInputPorts(0);
}

//------------------------------------------------------------------------------
vtkUniformSeedSource::~vtkUniformSeedSource() = default;

//------------------------------------------------------------------------------
const char* vtkUniformSeedSource::GetPatternAsString()
{
  return choiceText(SeedPatternTexts, this->Pattern);
}

//------------------------------------------------------------------------------
int vtkUniformSeedSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  return runBehindBarrier(this, outputVector, [&]() {
    requireThat(
      this->Dimension == 2 || this->Dimension == 3, "Dimension", this->Dimension, "2 or 3");
    requireThat(this->NumberOfPoints >= 1, "NumberOfPoints", this->NumberOfPoints, "at least 1");
    requireChoice("Pattern", this->Pattern, SeedPatternTexts);
    requireBounds(this->Bounds, this->Dimension);

    const auto pattern = static_cast<SeedPattern>(this->Pattern);
    const Point<3> lengths{ this->Bounds[1] - this->Bounds[0], this->Bounds[3] - this->Bounds[2],
      this->Bounds[5] - this->Bounds[4] };
    AlgorithmProgress progress(this, makeExecutor(Threading::Auto));
    vtkPolyData* output = vtkPolyData::GetData(outputVector);
    if (this->Dimension == 2)
    {
      const UnitSeeds<2> seeds(
        pattern, { lengths[0], lengths[1] }, this->NumberOfPoints, this->RandomSeed);
      fillBox<2>(seeds, this->Bounds, progress, output);
    }
    else
    {
      const UnitSeeds<3> seeds(pattern, lengths, this->NumberOfPoints, this->RandomSeed);
      fillBox<3>(seeds, this->Bounds, progress, output);
    }
    return 1;
  });
}

//------------------------------------------------------------------------------
void vtkUniformSeedSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Bounds: " << this->Bounds[0] << " " << this->Bounds[1] << " " << this->Bounds[2]
     << " " << this->Bounds[3] << " " << this->Bounds[4] << " " << this->Bounds[5] << "\n";
  os << indent << "Dimension: " << this->Dimension << "\n";
  os << indent << "NumberOfPoints: " << this->NumberOfPoints << "\n";
  os << indent << "Pattern: " << this->GetPatternAsString() << "\n";
  os << indent << "RandomSeed: " << this->RandomSeed << "\n";
}
VTK_ABI_NAMESPACE_END
