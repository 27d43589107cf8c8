// SPDX-License-Identifier: BSD-3-Clause
// PrintSelf names every property and its value; enumerations have texts; every setter shows in
// them.
#include "TestData.h"

#include "vtkAreaPreservingParameterization.h"
#include "vtkBlueNoiseRelaxation.h"
#include "vtkDensityEqualizingWarp.h"
#include "vtkEqualMassCells.h"
#include "vtkMassSplatter.h"
#include "vtkSolidDensity.h"
#include "vtkSurfaceSampler.h"
#include "vtkTransportBarycenter.h"
#include "vtkTransportInterpolator.h"
#include "vtkTransportMap.h"
#include "vtkTransportQuality.h"
#include "vtkUniformSeedSource.h"

#include <sstream>

namespace
{

void expectLines(Checks& checks, vtkObject* object, const std::vector<std::string>& lines)
{
  std::ostringstream os;
  object->Print(os);
  for (const std::string& line : lines)
  {
    checks.That(contains(os.str(), line + "\n"), line.c_str(), __LINE__);
  }
}

} // namespace

int TestPrintSelf(int, char*[])
{
  Checks checks;
  vtkNew<vtkTransportSampler> sampler;
  expectLines(checks, sampler,
    { "Component: -1", "InvertDensity: Off", "NegativeValues: Error", "Integrator: Multistep",
      "NumberOfSteps: 32", "Tolerance: 0.01", "TableLookup: Interpolated", "FlowMaps: Auto",
      "Threading: Auto", "TableBuildTime: 0", "NumberOfParticles: 8192", "SeedPattern: BlueNoise",
      "RandomSeed: 1", "SamplesPerCell: 0", "FlowTime: 1", "OutputPaths: Off", "Tables: Auto",
      "SampleArrays: On" });
  sampler->SetComponent(2);
  sampler->InvertDensityOn();
  sampler->SetNegativeValuesToClamp();
  sampler->SetIntegratorToRungeKutta4();
  sampler->SetNumberOfSteps(7);
  sampler->SetTolerance(0.5);
  sampler->SetTableLookupToNearest();
  sampler->SetFlowMapsToOff();
  sampler->SetTablesToWhole();
  sampler->SetThreadingToOpenMP();
  sampler->SetNumberOfParticles(12345678901);
  sampler->SetSeedPatternToLowDiscrepancy();
  sampler->SetRandomSeed(-4);
  sampler->SetSamplesPerCell(3);
  sampler->SetFlowTime(0.25);
  sampler->OutputPathsOn();
  sampler->SampleArraysOff();
  expectLines(checks, sampler,
    { "Component: 2", "InvertDensity: On", "NegativeValues: Clamp", "Integrator: RungeKutta4",
      "NumberOfSteps: 7", "Tolerance: 0.5", "TableLookup: Nearest", "FlowMaps: Off",
      "Threading: OpenMP", "NumberOfParticles: 12345678901", "SeedPattern: LowDiscrepancy",
      "RandomSeed: -4", "SamplesPerCell: 3", "FlowTime: 0.25", "OutputPaths: On", "Tables: Whole",
      "SampleArrays: Off" });

  const char* const integrators[] = { "Multistep", "RungeKutta4", "Euler", "Adaptive" };
  const char* const threadings[] = { "Auto", "VTK", "OpenMP", "Serial" };
  for (int i = 0; i < 4; ++i)
  {
    sampler->SetIntegrator(i);
    CHECK(checks, sampler->GetIntegratorAsString() == std::string(integrators[i]));
    sampler->SetThreading(i);
    CHECK(checks, sampler->GetThreadingAsString() == std::string(threadings[i]));
  }
  sampler->SetIntegrator(44);
  CHECK(checks, sampler->GetIntegratorAsString() == std::string("Unknown"));

  vtkNew<vtkTransportMap> map;
  expectLines(
    checks, map, { "Direction: UniformToDensity", "SampleDimensions: 0 0 0", "Component: -1" });
  map->SetDirectionToDensityToUniform();
  map->SetSampleDimensions(4, 5, 6);
  expectLines(checks, map, { "Direction: DensityToUniform", "SampleDimensions: 4 5 6" });
  map->SetDirection(2);
  CHECK(checks, map->GetDirectionAsString() == std::string("Unknown"));

  vtkNew<vtkDensityEqualizingWarp> warp;
  expectLines(checks, warp, { "DensityPort: 1", "Blend: 1" });
  warp->SetBlend(0.5);
  expectLines(checks, warp, { "Blend: 0.5" });

  vtkNew<vtkEqualMassCells> cells;
  expectLines(checks, cells,
    { "Resolution: 512", "NormExponent: 2", "CostExponent: 2", "Shape: Flow",
      "Integrator: Multistep", "NumberOfSteps: 32", "Tolerance: 0.01", "TableLookup: Interpolated",
      "FlowMaps: Auto", "Threading: Auto" });
  cells->SetResolution(77);
  cells->SetNormExponent(4.0);
  cells->SetCostExponent(1.5);
  cells->SetShapeToPower();
  cells->SetIntegratorToAdaptive();
  cells->SetNumberOfSteps(64);
  cells->SetTolerance(0.25);
  cells->SetTableLookupToNearest();
  cells->SetFlowMapsToOff();
  cells->SetThreadingToVTK();
  expectLines(checks, cells,
    { "Resolution: 77", "NormExponent: 4", "CostExponent: 1.5", "Shape: Power",
      "Integrator: Adaptive", "NumberOfSteps: 64", "Tolerance: 0.25", "TableLookup: Nearest",
      "FlowMaps: Off", "Threading: VTK" });

  vtkNew<vtkMassSplatter> splatter;
  expectLines(checks, splatter,
    { "Dimensions: 128 128 128", "Association: Points", "Kernel: CloudInCell", "Radius: 1",
      "Boundary: Renormalize", "DivideByVolume: On", "Threading: Auto" });
  splatter->SetDimensions(4, 5, 6);
  splatter->SetAssociationToCells();
  splatter->SetKernelToTriangularShapedCloud();
  splatter->SetRadius(2.5);
  splatter->SetBoundaryToDrop();
  splatter->DivideByVolumeOff();
  splatter->SetThreadingToSerial();
  expectLines(checks, splatter,
    { "Dimensions: 4 5 6", "Association: Cells", "Kernel: TriangularShapedCloud", "Radius: 2.5",
      "Boundary: Drop", "DivideByVolume: Off", "Threading: Serial" });
  splatter->SetAssociation(-1);
  CHECK(checks, splatter->GetAssociationAsString() == std::string("Unknown"));

  vtkNew<vtkSolidDensity> solid;
  expectLines(checks, solid,
    { "Resolution: 64", "Supersampling: 2", "Padding: 0.05", "Association: Points",
      "Threading: Auto" });
  solid->SetResolution(77);
  solid->SetSupersampling(5);
  solid->SetPadding(0.5);
  solid->SetAssociationToCells();
  solid->SetThreadingToSerial();
  expectLines(checks, solid,
    { "Resolution: 77", "Supersampling: 5", "Padding: 0.5", "Association: Cells",
      "Threading: Serial" });
  solid->SetAssociation(9);
  CHECK(checks, solid->GetAssociationAsString() == std::string("Unknown"));

  vtkNew<vtkAreaPreservingParameterization> parameterization;
  expectLines(checks, parameterization,
    { "Corners: automatic", "Resolution: 512", "Polish: On", "Threading: Auto" });
  parameterization->SetCorner(1, 12345678901);
  parameterization->SetResolution(77);
  parameterization->PolishOff();
  parameterization->SetThreadingToVTK();
  expectLines(checks, parameterization,
    { "Corners: -1 12345678901", "Resolution: 77", "Polish: Off", "Threading: VTK" });

  vtkNew<vtkSurfaceSampler> surface;
  expectLines(checks, surface,
    { "NumberOfParticles: 8192", "Resolution: 1024", "SeedPattern: BlueNoise", "RandomSeed: 1",
      "Corners: automatic", "Integrator: Multistep", "NumberOfSteps: 32", "Tolerance: 0.01",
      "TableLookup: Interpolated", "FlowMaps: Auto", "Threading: Auto" });
  surface->SetNumberOfParticles(12345678901);
  surface->SetResolution(77);
  surface->SetSeedPatternToJittered();
  surface->SetRandomSeed(-4);
  surface->SetCorner(0, 12345678901);
  surface->SetIntegratorToEuler();
  surface->SetNumberOfSteps(7);
  surface->SetTolerance(0.5);
  surface->SetTableLookupToNearest();
  surface->SetFlowMapsToOff();
  surface->SetThreadingToSerial();
  expectLines(checks, surface,
    { "NumberOfParticles: 12345678901", "Resolution: 77", "SeedPattern: Jittered", "RandomSeed: -4",
      "Corners: 12345678901", "Integrator: Euler", "NumberOfSteps: 7", "Tolerance: 0.5",
      "TableLookup: Nearest", "FlowMaps: Off", "Threading: Serial" });

  vtkNew<vtkTransportInterpolator> morph;
  expectLines(checks, morph,
    { "Dimensions: 0 0 0", "ParticlesPerCell: 1", "MassMode: Linear", "Kernel: CloudInCell",
      "Radius: 1", "Parameter: 0.5", "PublishTime: Off", "NumberOfTimeSteps: 11",
      "NumberOfSteps: 32", "Component: -1" });
  morph->SetDimensions(7, 8, 9);
  morph->SetParticlesPerCell(5);
  morph->SetMassModeToNormalize();
  morph->SetKernelToGaussian();
  morph->SetRadius(2.5);
  morph->SetParameter(0.125);
  morph->PublishTimeOn();
  morph->SetNumberOfTimeSteps(31);
  expectLines(checks, morph,
    { "Dimensions: 7 8 9", "ParticlesPerCell: 5", "MassMode: Normalize", "Kernel: Gaussian",
      "Radius: 2.5", "Parameter: 0.125", "PublishTime: On", "NumberOfTimeSteps: 31" });
  morph->SetMassMode(4);
  morph->SetKernel(-1);
  CHECK(checks, morph->GetMassModeAsString() == std::string("Unknown"));
  CHECK(checks, morph->GetKernelAsString() == std::string("Unknown"));

  vtkNew<vtkTransportBarycenter> barycenter;
  expectLines(checks, barycenter, { "Weights: equal", "ParticlesPerCell: 1", "MassMode: Linear" });
  barycenter->SetWeight(1, 0.5);
  expectLines(checks, barycenter, { "Weights: 0 0.5" });

  vtkNew<vtkTransportQuality> quality;
  expectLines(
    checks, quality, { "DensityPort: 1", "BlockSize: 0", "Tables: Auto", "TableBuildTime: 0" });
  quality->SetBlockSize(5);
  quality->SetTablesToTiled();
  expectLines(checks, quality, { "BlockSize: 5", "Tables: Tiled" });

  vtkNew<vtkBlueNoiseRelaxation> relaxation;
  expectLines(checks, relaxation,
    { "DensityPort: 1", "TableBuildTime: 0", "Method: GaussianBlueNoise", "MaximumIterations: 50",
      "Tolerance: 0" });
  relaxation->SetMethodToOptimalTransport();
  relaxation->SetMaximumIterations(7);
  relaxation->SetTolerance(0.25);
  expectLines(
    checks, relaxation, { "Method: OptimalTransport", "MaximumIterations: 7", "Tolerance: 0.25" });
  relaxation->SetMethod(2);
  CHECK(checks, relaxation->GetMethodAsString() == std::string("Unknown"));

  vtkNew<vtkUniformSeedSource> source;
  expectLines(checks, source,
    { "Bounds: 0 1 0 1 0 1", "Dimension: 2", "NumberOfPoints: 8192", "Pattern: BlueNoise",
      "RandomSeed: 1" });
  const char* const patterns[] = { "BlueNoise", "Lattice", "Jittered", "LowDiscrepancy", "Random" };
  for (int i = 0; i < 5; ++i)
  {
    source->SetPattern(i);
    CHECK(checks, source->GetPatternAsString() == std::string(patterns[i]));
    surface->SetSeedPattern(i);
    CHECK(checks, surface->GetSeedPatternAsString() == std::string(patterns[i]));
    sampler->SetSeedPattern(i);
    CHECK(checks, sampler->GetSeedPatternAsString() == std::string(patterns[i]));
  }
  return checks.Result();
}
