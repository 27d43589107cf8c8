// SPDX-License-Identifier: BSD-3-Clause
// Area Preserving Parameterization and Sample Surface.
#include "DrawnInputs.h"
#include "Kinds.h"
#include "OutputChecks.h"

#include "vtkAreaPreservingParameterization.h"
#include "vtkCellData.h"
#include "vtkIdList.h"
#include "vtkPointData.h"
#include "vtkSurfaceSampler.h"
#include "vtkTriangle.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>

namespace Campaign
{

namespace
{

// Of the surface at hand; a wrong number is wrong for any.
template <class T>
void drawCorners(
  RandomSource& random, std::vector<vtkIdType> boundary, Settings& settings, Input& input)
{
  std::vector<vtkIdType> corners;
  bool inRange = true;
  if (random.Chance(0.4))
  {
    for (int i = 0; i < 4; ++i)
    {
      const auto place = random.Whole(0, static_cast<std::int64_t>(boundary.size()) - 1);
      corners.push_back(boundary[static_cast<std::size_t>(place)]);
      boundary.erase(boundary.begin() + place);
    }
    switch (random.Whole(0, 19))
    {
      case 0:
        corners.resize(static_cast<std::size_t>(random.Of({ 1, 3, 5 })), 0);
        inRange = false;
        break;
      case 1:
        corners[2] = corners[0];
        input.Worsen(State::Faulty);
        break;
      case 2:
        corners[3] = random.Of({ vtkIdType{ -1 }, vtkIdType{ 100000 }, VTK_ID_MAX, VTK_ID_MIN });
        input.Worsen(State::Faulty);
        break;
      default:
        break;
    }
  }
  std::string text;
  for (const vtkIdType corner : corners)
  {
    text += std::to_string(corner) + " ";
  }
  settings.Add(
    "Corners", text,
    [corners](vtkAlgorithm* filter) {
      auto* owner = static_cast<T*>(filter);
      owner->SetNumberOfCorners(static_cast<int>(corners.size()));
      for (std::size_t i = 0; i < corners.size(); ++i)
      {
        owner->SetCorner(static_cast<int>(i), corners[i]);
      }
    },
    inRange);
}

//------------------------------------------------------------------------------
using Parameterization = vtkAreaPreservingParameterization;

void drawParameterization(Settings& settings)
{
  settings.Draw<Parameterization, int>("Resolution", &Parameterization::SetResolution,
    { 1, 2, 3, 8, 33, 64 }, { 0, -1, 16385, std::numeric_limits<int>::max() }, 1.0);
  settings.Draw<Parameterization, vtkTypeBool>(
    "Polish", &Parameterization::SetPolish, { 1, 0, 0 }, {}, 0.4);
  settings.Draw<Parameterization, int>(
    "Seams", &Parameterization::SetSeams, { Parameterization::SEAMS_NONE }, { -1, 2 }, 1.0);
  drawThreading<Parameterization>(settings);
}

Inputs drawParameterizationInputs(RandomSource& random, Settings& settings)
{
  Inputs inputs(1);
  std::vector<vtkIdType> boundary;
  inputs[0] = { drawDisk(random, boundary) };
  drawCorners<Parameterization>(random, boundary, settings, inputs[0][0]);
  return inputs;
}

State expectDisk(vtkAlgorithm*, const Inputs& inputs)
{
  return inputs[0][0].Condition;
}

void checkPositions(vtkPointData* data, const char* name, vtkIdType points, Findings& findings)
{
  vtkDataArray* positions = requireArray(data, name, 2, points, findings);
  for (vtkIdType i = 0; positions && i < 2 * points; ++i)
  {
    const double x = positions->GetComponent(i / 2, static_cast<int>(i % 2));
    if (!(x >= 0.0 && x <= 1.0))
    {
      findings.That(false, std::string(name) + " " + textOf(x));
      return;
    }
  }
}

// All of the square is covered once.
void checkAreas(vtkPolyData* output, vtkDataArray* distortions, Findings& findings)
{
  double total = 0.0;
  double covered = 0.0;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
  {
    if (output->GetCellType(cell) == VTK_TRIANGLE)
    {
      double x[3][3];
      output->GetCellPoints(cell, ids);
      for (int i = 0; i < 3; ++i)
      {
        output->GetPoint(ids->GetId(i), x[i]);
      }
      const double area = vtkTriangle::TriangleArea(x[0], x[1], x[2]);
      total += area;
      covered += area * distortions->GetComponent(cell, 0);
    }
  }
  findings.Near(covered, total, 1e-6, "the covered area");
}

// The surface in the square.
void checkFlat(vtkPolyData* output, vtkPolyData* flat, Findings& findings)
{
  vtkDataArray* positions = output->GetPointData()->GetArray("AreaPreservingExact");
  const vtkIdType points = output->GetNumberOfPoints();
  bool isFlat = positions && flat->GetNumberOfPoints() == points;
  for (vtkIdType i = 0; isFlat && i < points; ++i)
  {
    double x[3];
    flat->GetPoint(i, x);
    isFlat =
      x[0] == positions->GetComponent(i, 0) && x[1] == positions->GetComponent(i, 1) && x[2] == 0.0;
  }
  findings.That(isFlat, "the points of Flat");
  findings.That(flat->GetPolys() == output->GetPolys(), "the triangles of Flat");
  requirePassed(output->GetPointData(), flat->GetPointData(), {}, findings);
  requirePassed(output->GetCellData(), flat->GetCellData(), {}, findings);
}

void checkParameterization(vtkAlgorithm* filter, const Inputs& inputs, Findings& findings)
{
  auto* output = Parameterization::SafeDownCast(filter)->GetOutput();
  auto* input = vtkPolyData::SafeDownCast(inputs[0][0].Data);
  const vtkIdType points = input->GetNumberOfPoints();
  findings.That(output->GetPoints() == input->GetPoints(), "the points");
  findings.That(output->GetVerts() == input->GetVerts() ||
      (output->GetNumberOfVerts() == 0 && input->GetNumberOfVerts() == 0),
    "the vertices");
  findings.That(output->GetLines() == input->GetLines() ||
      (output->GetNumberOfLines() == 0 && input->GetNumberOfLines() == 0),
    "the lines");
  findings.That(output->GetPolys()->IsHomogeneous() == 3, "triangles");
  requirePassed(input->GetPointData(), output->GetPointData(),
    { "AreaPreserving", "AreaPreservingExact", "Conformal" }, findings);
  checkPositions(output->GetPointData(), "AreaPreserving", points, findings);
  checkPositions(output->GetPointData(), "AreaPreservingExact", points, findings);
  checkPositions(output->GetPointData(), "Conformal", points, findings);
  findings.That(
    output->GetPointData()->GetTCoords() == output->GetPointData()->GetArray("AreaPreserving"),
    "the active texture coordinates");

  const vtkIdType cells = output->GetNumberOfCells();
  vtkCellData* data = output->GetCellData();
  for (int i = 0; i < input->GetCellData()->GetNumberOfArrays(); ++i)
  {
    findings.That(data->HasArray(input->GetCellData()->GetArrayName(i)) != 0, "a cell array");
  }
  vtkDataArray* areas = requireArray(data, "AreaDistortion", 1, cells, findings);
  vtkDataArray* angles = requireArray(data, "AngleDistortion", 1, cells, findings);
  auto* flipped = vtkUnsignedCharArray::SafeDownCast(data->GetArray("Flipped"));
  const bool isWhole = areas && angles && flipped && flipped->GetNumberOfTuples() == cells;
  findings.That(isWhole, "arrays of cells");
  if (!isWhole)
  {
    return;
  }
  for (vtkIdType cell = 0; cell < cells; ++cell)
  {
    const double area = areas->GetComponent(cell, 0);
    const double angle = angles->GetComponent(cell, 0);
    findings.That(flipped->GetValue(cell) == (area > 0.0 ? 0 : 1), "Flipped of " + textOf(area));
    findings.That(angle >= 1.0 && angle <= 1000.0, "AngleDistortion " + textOf(angle));
  }
  findings.Near(
    requireField(output, "FlippedCount", findings), sumOf(flipped), 1e-12, "FlippedCount");
  findings.That(requireField(output, "AreaDistortionRMS", findings) >= 0.0, "AreaDistortionRMS");
  findings.That(
    requireField(output, "AngleDistortionMean", findings) >= 1.0 - 1e-9, "AngleDistortionMean");
  checkFlat(output, Parameterization::SafeDownCast(filter)->GetFlat(), findings);
  if (inputs[0][0].Condition == State::Sound)
  {
    checkAreas(output, areas, findings);
  }
}

//------------------------------------------------------------------------------
using Sampler = vtkSurfaceSampler;

void drawSampler(Settings& settings)
{
  settings.Draw<Sampler, vtkIdType>("NumberOfParticles", &Sampler::SetNumberOfParticles,
    { 1, 2, 10, 333, 1000 }, { 0, -1 }, 1.0,
    { 1000000000000, std::numeric_limits<vtkIdType>::max() });
  settings.Draw<Sampler, int>("Method", &Sampler::SetMethod, { 0, 1 }, { -1, 2 }, 1.0);
  settings.Draw<Sampler, int>(
    "RelaxationIterations", &Sampler::SetRelaxationIterations, { 0, 1, 5, 20 }, { -1, 1001 }, 0.5);
  settings.Draw<Sampler, int>("Resolution", &Sampler::SetResolution, { 1, 2, 3, 8, 33, 64 },
    { 0, -1, 16385, std::numeric_limits<int>::max() }, 1.0);
  settings.Draw<Sampler, int>(
    "SeedPattern", &Sampler::SetSeedPattern, { 0, 1, 2, 3, 4 }, { -1, 5 });
  settings.Draw<Sampler, int>("RandomSeed", &Sampler::SetRandomSeed,
    { 0, 1, -1, 77, std::numeric_limits<int>::max(), std::numeric_limits<int>::min() }, {}, 0.3);
  drawFlowSettings<Sampler>(settings);
}

// A density, none, or one that is not there.
void drawSurfaceDensity(RandomSource& random, Settings& settings, Input& input)
{
  auto* surface = vtkPolyData::SafeDownCast(input.Data);
  const bool onPoints = random.Chance(0.5);
  const vtkIdType count = onPoints ? surface->GetNumberOfPoints() : surface->GetNumberOfCells();
  const bool hasOne = random.Chance(0.6) && count > 0;
  if (hasOne)
  {
    std::string text;
    const auto array = drawArray(random, count, 1, text);
    array->SetName("Density");
    if (onPoints)
    {
      surface->GetPointData()->AddArray(array);
    }
    else
    {
      surface->GetCellData()->AddArray(array);
    }
    input.Describe("Density " + text);
  }
  const std::string name = hasOne ? random.Of({ "", "Density", "Density", "Density", "Own" })
                                  : random.Of({ "", "", "", "None", "None", "Density", "Own" });
  const int association = random.Of({ onPoints ? 0 : 1, onPoints ? 0 : 1, 0, 1, 3 });
  settings.Add(
    "Array", name + " " + std::to_string(association), [name, association](vtkAlgorithm* filter) {
      filter->SetInputArrayToProcess(0, 0, 0, association, name.c_str());
    });
  if (!name.empty() && name != "None")
  {
    input.Worsen(State::Odd);
  }
}

// Only the flow needs a disk.
State expectSurface(vtkAlgorithm* filter, const Inputs& inputs)
{
  const State disk = expectDisk(filter, inputs);
  const bool needsDisk = Sampler::SafeDownCast(filter)->GetMethod() == Sampler::FLOW;
  return disk == State::Faulty && !needsDisk ? State::Odd : disk;
}

Inputs drawSamplerInputs(RandomSource& random, Settings& settings)
{
  Inputs inputs(1);
  std::vector<vtkIdType> boundary;
  inputs[0] = { drawDisk(random, boundary) };
  drawCorners<Sampler>(random, boundary, settings, inputs[0][0]);
  drawSurfaceDensity(random, settings, inputs[0][0]);
  return inputs;
}

void checkSampler(vtkAlgorithm* filter, const Inputs& inputs, Findings& findings)
{
  auto* sampler = Sampler::SafeDownCast(filter);
  auto* input = vtkPolyData::SafeDownCast(inputs[0][0].Data);
  vtkPolyData* output = sampler->GetOutput();
  const vtkIdType count = output->GetNumberOfPoints();
  findings.That(
    (sampler->GetMethod() == Sampler::FLOW && sampler->GetSeedPattern() == Sampler::LATTICE) ||
      count == sampler->GetNumberOfParticles(),
    "NumberOfParticles");
  requireFinitePoints(output, findings);
  requireVertices(output, findings);
  vtkPointData* data = output->GetPointData();
  vtkDataArray* masses = requireArray(data, "Mass", 1, count, findings);
  findings.Near(sumOf(masses), requireField(output, "TotalMass", findings), 1e-9, "sum of Mass");
  vtkDataArray* normals = requireArray(data, "Normal", 3, count, findings);
  vtkDataArray* ids = requireArray(data, "SeedId", 1, count, findings);
  vtkDataArray* cells = requireArray(data, "CellId", 1, count, findings);
  if (!masses || !normals || !ids || !cells)
  {
    return;
  }
  const vtkIdType first = input->GetNumberOfVerts() + input->GetNumberOfLines();
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double* n = normals->GetTuple3(i);
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    const auto cell = static_cast<vtkIdType>(cells->GetComponent(i, 0));
    const bool isThere = cell >= first && cell < input->GetNumberOfCells();
    findings.That(ids->GetComponent(i, 0) == static_cast<double>(i), "SeedId");
    findings.That(std::abs(length - 1.0) < 1e-12, "Normal of length " + textOf(length));
    findings.That(isThere, "CellId " + std::to_string(cell));
    if (!isThere)
    {
      return;
    }
    input->GetCellPoints(cell, corners);
    double x[3];
    output->GetPoint(i, x);
    for (int a = 0; a < 3; ++a)
    {
      double low = Infinity;
      double high = -Infinity;
      for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k)
      {
        double corner[3];
        input->GetPoint(corners->GetId(k), corner);
        low = std::min(low, corner[a]);
        high = std::max(high, corner[a]);
      }
      const double slack = 1e-12 * std::max(std::abs(low), std::abs(high));
      findings.That(x[a] >= low - slack && x[a] <= high + slack, "a particle in its cell");
    }
  }
  const auto requireSampled = [&](vtkFieldData* from, bool ofPoints) {
    for (int i = 0; i < from->GetNumberOfArrays(); ++i)
    {
      const char* name = from->GetArrayName(i);
      vtkDataArray* sampled = data->GetArray(name);
      const bool isId = ofPoints && from->GetArray(i)->IsA("vtkIdTypeArray");
      findings.That(
        isId || (sampled && sampled->GetNumberOfTuples() == count), std::string("array ") + name);
    }
  };
  requireSampled(input->GetPointData(), true);
  requireSampled(input->GetCellData(), false);
}

//------------------------------------------------------------------------------
void quickParameterization(RandomSource&, vtkAlgorithm* filter)
{
  Parameterization::SafeDownCast(filter)->SetResolution(8);
}

void quickSampler(RandomSource&, vtkAlgorithm* filter)
{
  auto* sampler = Sampler::SafeDownCast(filter);
  sampler->SetNumberOfParticles(20);
  sampler->SetResolution(8);
}

} // namespace

void addSurfaceKinds(std::vector<FilterKind>& kinds)
{
  kinds.push_back({ "Parameterization", make<Parameterization>, drawParameterization,
    drawParameterizationInputs, expectDisk, checkParameterization, quickParameterization });
  kinds.push_back({ "SurfaceSampler", make<Sampler>, drawSampler, drawSamplerInputs, expectSurface,
    checkSampler, quickSampler });
}

} // namespace Campaign
