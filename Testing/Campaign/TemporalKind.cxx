// SPDX-License-Identifier: BSD-3-Clause
// Transport Temporal Interpolator, of an input without time steps, which comes out as it is. Series
// are tested in ../Python/TestTemporal.py.
#include "DrawnInputs.h"
#include "Kinds.h"
#include "OutputChecks.h"

#include "vtkCellData.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTransportTemporalInterpolator.h"

#include <vector>

namespace Campaign
{

namespace
{

using Temporal = vtkTransportTemporalInterpolator;

void drawTemporal(Settings& settings)
{
  settings.Draw<Temporal, int>("Method", &Temporal::SetMethod, { 0, 1 }, { -1, 2 }, 0.3);
  settings.Draw<Temporal, int>("Resample", &Temporal::SetResample, { 0, 1, 5 }, { -1 }, 0.1);
  settings.Draw<Temporal, vtkTypeBool>("Chain", &Temporal::SetChain, { 0, 1 }, {}, 0.3);
  settings.Draw<Temporal, vtkTypeBool>("CarryArrays", &Temporal::SetCarryArrays, { 0, 1 }, {}, 0.3);
  settings.Draw<Temporal, int>(
    "ParticlesPerCell", &Temporal::SetParticlesPerCell, { 1, 2, 4, 8 }, { 0, -1 }, 0.3);
  settings.Draw<Temporal, int>("Kernel", &Temporal::SetKernel, { 0, 1, 2, 3 }, { -1, 4 }, 0.3);
  settings.Draw<Temporal, double>("Radius", &Temporal::SetRadius, { 0.5, 1.0, 2.0 }, {}, 0.3);
  drawThreading<Temporal>(settings);
  drawDensitySettings(settings);
}

Inputs drawTemporalInputs(RandomSource& random, Settings& settings)
{
  return { { drawDensityOn(random, settings, 0) } };
}

State expectTemporal(vtkAlgorithm* filter, const Inputs& inputs)
{
  return densityState(filter, inputs[0][0]);
}

void checkTemporal(vtkAlgorithm* filter, const Inputs& inputs, Findings& findings)
{
  auto* temporal = Temporal::SafeDownCast(filter);
  vtkImageData* image = temporal->GetDensity();
  vtkPolyData* particles = temporal->GetParticles();
  requireFinitePoints(particles, findings);
  requireVertices(particles, findings);
  const vtkIdType count = particles->GetNumberOfPoints();
  vtkDataArray* mass = requireArray(particles->GetPointData(), "Mass", 1, count, findings);
  requireArray(particles->GetPointData(), "Velocity", 3, count, findings);
  const double total = requireField(image, "TotalMass", findings);
  findings.Near(requireField(particles, "TotalMass", findings), total, 0.0, "TotalMass of both");
  vtkDataArray* density = image->GetPointData()->GetScalars() ? image->GetPointData()->GetScalars()
                                                              : image->GetCellData()->GetScalars();
  findings.That(density != nullptr, "a density");
  if (density && densityState(filter, inputs[0][0]) == State::Sound)
  {
    findings.Near(sumOf(mass), total, 1e-9, "sum of Mass");
    findings.Near(sumOf(density) * cellMeasure(image), total, 1e-9, "sum of the density");
    findings.Near(total, massOf(inputs[0][0]), 1e-9, "TotalMass");
  }
}

void quickTemporal(RandomSource&, vtkAlgorithm* filter)
{
  Temporal::SafeDownCast(filter)->SetParticlesPerCell(1);
}

} // namespace

FilterKind temporalKind()
{
  return { "Temporal", make<Temporal>, drawTemporal, drawTemporalInputs, expectTemporal,
    checkTemporal, quickTemporal };
}

} // namespace Campaign
