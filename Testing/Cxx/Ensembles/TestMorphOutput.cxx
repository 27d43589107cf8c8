// SPDX-License-Identifier: BSD-3-Clause
// vtkTransportInterpolator: both ends reproduce the inputs, mass is exact on the way, and particles
// go straight from where one flow takes them to where the other does.
#include "BlendTest.h"

#include "vtkMassSplatter.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <functional>
#include <set>

namespace
{

// The density of the particles alone.
Values splatParticles(vtkTransportInterpolator* morph)
{
  morph->Update();
  vtkNew<vtkMassSplatter> splatter;
  splatter->SetInputData(morph->GetParticles());
  splatter->SetReferenceData(morph->GetDensity());
  splatter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Mass");
  splatter->SetAssociation(morph->GetDensity()->GetCellData()->GetScalars()
      ? vtkMassSplatter::CELLS
      : vtkMassSplatter::POINTS);
  splatter->Update();
  return imageValues(splatter->GetOutput(), "Density");
}

// How far the particles of both ends are from the inputs, block by block.
double errorOfEnds(
  vtkTransportInterpolator* morph, vtkImageData* source, vtkImageData* target, const Counts& values)
{
  morph->SetParameter(0.0);
  const double first = blockError(splatParticles(morph), imageValues(source, "Density"), values);
  morph->SetParameter(1.0);
  const double last = blockError(splatParticles(morph), imageValues(target, "Density"), values);
  return std::max(first, last);
}

void checkEnds(Checks& checks, const Counts& values, const std::array<int, 3>& perCell, int line)
{
  for (const bool cells : { true, false })
  {
    auto source = makeDensity(values, cells, smoothDensity(values[0], values[1], values[2]));
    auto target = makeDensity(values, cells, otherDensity(values[0], values[1], values[2]));
    auto morph = makeMorph(source, target);
    std::array<double, 3> errors{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      morph->SetParticlesPerCell(perCell[i]);
      errors[i] = errorOfEnds(morph, source, target, values);
    }
    std::ostringstream detail;
    detail << errors[0] << " " << errors[1] << " " << errors[2];
    checks.That(errors[1] <= 0.05, "particles are as the inputs", line, detail.str());
    checks.That(errors[1] < 0.75 * errors[0] && errors[2] < errors[1], "more particles are nearer",
      line, detail.str());
  }
}

void checkEnds(Checks& checks)
{
  checkEnds(checks, { 64, 48, 1 }, { 1, 4, 16 }, __LINE__);
  checkEnds(checks, { 20, 24, 16 }, { 1, 8, 27 }, __LINE__);
  checkEnds(checks, { 200, 1, 1 }, { 1, 4, 16 }, __LINE__);
}

double expectedMass(int mode, double t, double first, double last)
{
  switch (mode)
  {
    case vtkTransportBlend::MASS_LINEAR:
      return (1.0 - t) * first + t * last;
    case vtkTransportBlend::MASS_GEOMETRIC:
      return std::exp((1.0 - t) * std::log(first) + t * std::log(last));
    case vtkTransportBlend::MASS_SOURCE:
      return first;
    default:
      return 1.0;
  }
}

void checkMass(Checks& checks, vtkImageData* source, vtkImageData* target)
{
  auto morph = makeMorph(source, target);
  morph->SetRadius(1.7);
  const double first = massOf(source);
  const double last = massOf(target);
  for (int mode = 0; mode < 4; ++mode)
  {
    morph->SetMassMode(mode);
    for (int kernel = 0; kernel < 4; ++kernel)
    {
      morph->SetKernel(kernel);
      for (const double t : { 0.0, 0.2, 0.5, 0.99, 1.0 })
      {
        morph->SetParameter(t);
        morph->Update();
        const double total = fieldValue(morph->GetDensity(), "TotalMass");
        const double wanted = expectedMass(mode, t, first, last);
        CHECK_NEAR(checks, total, wanted, 1e-12 * wanted);
        CHECK_NEAR(checks, massOf(morph->GetDensity()), total, 1e-12 * total);
        CHECK(checks, fieldValue(morph->GetParticles(), "TotalMass") == total);
        CHECK_NEAR(checks, sumOf(particleValues(morph, "Mass")), total, 1e-12 * total);
      }
    }
  }
}

void checkMass(Checks& checks)
{
  auto source = makeDensity({ 30, 20, 1 }, true, smoothDensity(30, 20));
  auto target = makeDensity({ 17, 40, 1 }, false, [](vtkIdType i) { return 9.0 * bumpy(i); });
  target->SetSpacing(1.5, 0.5, 7.0);
  target->SetOrigin(12.0, -3.0, 0.0);
  checkMass(checks, source, target);
  checkMass(checks, makeDensity({ 8, 9, 10 }, false, bumpy), makeDensity({ 5, 9, 7 }, true, bumpy));
  checkMass(checks, makeDensity({ 1, 50, 1 }, true, bumpy), makeDensity({ 1, 20, 1 }, true, bumpy));
}

// The mean of |Target - Source|^2, on both ports, whatever the parameter is.
void checkCost(Checks& checks)
{
  auto source = makeDensity({ 30, 20, 1 }, true, smoothDensity(30, 20));
  auto target = makeDensity({ 30, 20, 1 }, true, otherDensity(30, 20));
  target->SetOrigin(3.0, -1.0, 0.0);
  auto morph = makeMorph(source, target);
  morph->SetParticlesPerCell(4);
  double cost = 0.0;
  for (const double t : { 0.0, 0.3, 1.0 })
  {
    morph->SetParameter(t);
    morph->Update();
    const Values from = particleValues(morph, "SourcePosition");
    const Values to = particleValues(morph, "TargetPosition");
    double squares = 0.0;
    for (std::size_t i = 0; i < from.size(); ++i)
    {
      squares += (to[i] - from[i]) * (to[i] - from[i]);
    }
    const double mean = squares / static_cast<double>(from.size() / 3);
    cost = fieldValue(morph->GetDensity(), "TransportCost");
    CHECK_NEAR(checks, cost, mean, 1e-12 * mean);
    CHECK(checks, fieldValue(morph->GetParticles(), "TransportCost") == cost);
  }
  // The same mass elsewhere has the square of the way between; new maps have a cost of their own.
  auto moved = makeDensity({ 30, 20, 1 }, true, smoothDensity(30, 20));
  moved->SetOrigin(3.0, -4.0, 0.0);
  morph->SetTargetData(moved);
  morph->Update();
  CHECK_NEAR(checks, fieldValue(morph->GetDensity(), "TransportCost"), 25.0, 1e-11);
  morph->SetTargetData(source);
  morph->Update();
  CHECK(checks, fieldValue(morph->GetDensity(), "TransportCost") == 0.0);
  morph->SetTargetData(target);
  morph->Update();
  CHECK(checks, fieldValue(morph->GetDensity(), "TransportCost") == cost);
}

// The places that a sampler takes the particles of the pivot to: the centres of the cells of a grid
// over the domain of an image of cells.
Values sampleOf(vtkImageData* image, const Counts& grid)
{
  Values seeds;
  double bounds[6];
  image->GetBounds(bounds);
  for (int k = 0; k < grid[2]; ++k)
  {
    for (int j = 0; j < grid[1]; ++j)
    {
      for (int i = 0; i < grid[0]; ++i)
      {
        const int at[3] = { i, j, k };
        for (int a = 0; a < 3; ++a)
        {
          seeds.push_back(
            bounds[2 * a] + (bounds[2 * a + 1] - bounds[2 * a]) * (at[a] + 0.5) / grid[a]);
        }
      }
    }
  }
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  sampler->SetSeedsData(makePoints(seeds));
  return sampleCoordinates(sampler);
}

void checkPlaces(Checks& checks)
{
  auto source = makeDensity({ 30, 20, 1 }, true, smoothDensity(30, 20));
  auto target = makeDensity({ 12, 25, 1 }, true, otherDensity(12, 25));
  target->SetOrigin(40.0, -7.0, 0.0);
  target->SetSpacing(2.0, 3.0, 1.0);
  auto morph = makeMorph(source, target);
  morph->SetDimensions(33, 21, 0);
  morph->Update();
  const Values from = particleValues(morph, "SourcePosition");
  const Values to = particleValues(morph, "TargetPosition");
  CHECK(checks, from.size() == 3u * 33 * 21);
  CHECK_NEAR(checks, largestDifference(from, sampleOf(source, { 33, 21, 1 })), 0.0, 1e-9);
  CHECK_NEAR(checks, largestDifference(to, sampleOf(target, { 33, 21, 1 })), 0.0, 1e-9);

  for (const double t : { 0.0, 0.3, 0.5, 1.0 })
  {
    morph->SetParameter(t);
    morph->Update();
    Values straight = from;
    for (std::size_t i = 0; i < straight.size(); ++i)
    {
      straight[i] = (1.0 - t) * from[i] + t * to[i];
    }
    CHECK_NEAR(checks, largestDifference(particlePlaces(morph), straight), 0.0, 1e-12);
    CHECK(checks, particleValues(morph, "SourcePosition") == from);
    CHECK(checks, particleValues(morph, "TargetPosition") == to);
    if (t == 0.0 || t == 1.0)
    {
      CHECK(checks, particlePlaces(morph) == (t == 0.0 ? from : to));
    }
  }

  // A lattice of the sampler on the grid of the source itself.
  auto same = makeMorph(source, source);
  same->Update();
  vtkNew<vtkTransportSampler> lattice;
  lattice->SetInputData(source);
  lattice->SetSeedPatternToLattice();
  lattice->SetSamplesPerCell(1);
  CHECK_NEAR(checks,
    largestDifference(particleValues(same, "SourcePosition"), sampleCoordinates(lattice)), 0.0,
    1e-9);
  same->SetParticlesPerCell(9);
  same->Update();
  lattice->SetSamplesPerCell(3);
  CHECK_NEAR(checks,
    largestDifference(particleValues(same, "TargetPosition"), sampleCoordinates(lattice)), 0.0,
    1e-9);
}

// The flow to a uniform density leaves the particles of the pivot where they are: as many in each
// cell of the output, none twice.
void checkPivot(Checks& checks)
{
  auto uniform = makeDensity({ 12, 10, 1 }, true, [](vtkIdType) { return 2.0; });
  auto morph = makeMorph(uniform, makeDensity({ 8, 9, 1 }, true, bumpy), 0.0);
  morph->SetDimensions(12, 10, 0);
  for (int perCell = 1; perCell <= 9; ++perCell)
  {
    morph->SetParticlesPerCell(perCell);
    morph->Update();
    const Values places = particleValues(morph, "SourcePosition");
    std::vector<int> counts(120, 0);
    std::set<std::pair<double, double>> different;
    for (std::size_t i = 0; i < places.size(); i += 3)
    {
      ++counts.at(
        static_cast<std::size_t>(places[i]) + 12 * static_cast<std::size_t>(places[i + 1]));
      different.insert({ places[i], places[i + 1] });
    }
    CHECK(checks, std::count(counts.begin(), counts.end(), perCell) == 120);
    CHECK(checks, different.size() == 120u * static_cast<std::size_t>(perCell));
  }
}

// A copy elsewhere: the pivot is the unit box, so that all particles go the same way.
void checkTranslation(Checks& checks)
{
  const Counts grid = { 24, 18, 1 };
  auto source = makeDensity(grid, true, smoothDensity(grid[0], grid[1]));
  vtkNew<vtkImageData> target;
  target->ShallowCopy(source);
  const double shift[3] = { 8.0, -4.0, 0.0 };
  target->SetOrigin(shift);
  auto morph = makeMorph(source, target, 0.0);
  constexpr int columns = 32;
  morph->SetDimensions(columns, 22, 1); // with the spacing of both
  // Particles between the ends, and the densities themselves at both.
  for (const auto& [begin, t] :
    { std::pair(0.25, 0.5), std::pair(0.25, 0.75), std::pair(0.0, 1.0) })
  {
    morph->SetParameter(begin);
    const Values start = runDensity(morph);
    CHECK(checks, start.size() == columns * 22u);
    morph->SetParameter(t);
    const int right = static_cast<int>((t - begin) * shift[0]);
    const int up = static_cast<int>((t - begin) * shift[1]);
    const int before[2] = { static_cast<int>(begin * shift[0]),
      static_cast<int>(begin * shift[1]) };
    const Values found = runDensity(morph);
    // Away from the first and last cells, whose kernels the borders of the box cut.
    double largest = 0.0;
    for (int j = 2; j < grid[1] - 2; ++j)
    {
      for (int i = 2; i < grid[0] - 2; ++i)
      {
        const int at = i + before[0] + columns * (j + 4 + before[1]);
        const auto from = static_cast<std::size_t>(at);
        const auto to = static_cast<std::size_t>(at + right + columns * up);
        largest = std::max(largest, std::abs(found[to] - start[from]));
      }
    }
    CHECK_NEAR(checks, largest, 0.0, 1e-11);
    const Values from = particleValues(morph, "SourcePosition");
    const Values to = particleValues(morph, "TargetPosition");
    double off = 0.0;
    for (std::size_t i = 0; i < from.size(); ++i)
    {
      off = std::max(off, std::abs(to[i] - from[i] - shift[i % 3]));
    }
    CHECK_NEAR(checks, off, 0.0, 1e-12);
  }
}

// Backwards is the other way round.
void checkReverse(Checks& checks)
{
  auto a = makeDensity({ 20, 15, 1 }, true, smoothDensity(20, 15));
  auto b = makeDensity({ 20, 15, 1 }, true, otherDensity(20, 15));
  auto forth = makeMorph(a, b, 0.25);
  auto back = makeMorph(b, a, 0.75);
  CHECK_NEAR(checks, largestDifference(runDensity(forth), runDensity(back)), 0.0, 1e-12);
}

void checkArrays(Checks& checks)
{
  auto source = makeDensity({ 9, 8, 1 }, true, bumpy);
  vtkNew<vtkStringArray> note;
  note->SetName("Note");
  note->InsertNextValue("kept");
  source->GetFieldData()->AddArray(note);
  auto target = makeDensity({ 9, 8, 1 }, false, bumpy);
  for (const bool swap : { false, true })
  {
    auto morph = swap ? makeMorph(target, source) : makeMorph(source, target);
    morph->Update();
    vtkImageData* image = morph->GetDensity();
    auto* with = image->GetAttributes(swap ? vtkDataObject::POINT : vtkDataObject::CELL);
    auto* without = image->GetAttributes(swap ? vtkDataObject::CELL : vtkDataObject::POINT);
    CHECK(checks, with->GetNumberOfArrays() == 1 && without->GetNumberOfArrays() == 0);
    vtkDataArray* density = with->GetScalars();
    CHECK(checks, density && density->GetName() == std::string("Density"));
    CHECK(checks, density && density->GetDataType() == VTK_DOUBLE);
    CHECK(checks, swap || image->GetFieldData()->GetAbstractArray("Note"));

    vtkPolyData* particles = morph->GetParticles();
    const vtkIdType count = particles->GetNumberOfPoints();
    CHECK(checks, density && count == density->GetNumberOfTuples());
    CHECK(checks, particles->GetNumberOfVerts() == count && particles->GetNumberOfCells() == count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      vtkIdType size = 0;
      const vtkIdType* points = nullptr;
      particles->GetCellPoints(i, size, points);
      CHECK(checks, size == 1 && points[0] == i);
    }
    CHECK(checks, particles->GetPoints()->GetDataType() == VTK_DOUBLE);
    CHECK(checks, particles->GetPointData()->GetNumberOfArrays() == 4);
    vtkDataArray* ways = particles->GetPointData()->GetVectors();
    CHECK(checks, ways && ways == pointArray(particles, "Displacement"));
    Values expected = particleValues(morph, "TargetPosition");
    const Values from = particleValues(morph, "SourcePosition");
    std::transform(
      expected.begin(), expected.end(), from.begin(), expected.begin(), std::minus<>());
    CHECK(checks, particleValues(morph, "Displacement") == expected);
    for (const char* name : { "SourcePosition", "TargetPosition", "Displacement", "Mass" })
    {
      vtkDataArray* array = pointArray(particles, name);
      CHECK(checks, array && array->GetNumberOfTuples() == count);
      CHECK(checks, array && array->GetDataType() == VTK_DOUBLE);
      CHECK(
        checks, array && array->GetNumberOfComponents() == (name == std::string("Mass") ? 1 : 3));
    }
  }
}

// Arrays of their own names; a component of one.
void checkChoice(Checks& checks)
{
  auto source = makeDensity({ 9, 8, 1 }, true, bumpy);
  auto target = makeDensity({ 9, 8, 1 }, false, smoothDensity(9, 8));
  const Values expected = runDensity(makeMorph(source, target));
  const auto rename = [](vtkImageData* image, vtkDataSetAttributes* data, const char* name) {
    vtkDataArray* array = data->GetScalars();
    array->SetName(name);
    vtkNew<vtkDoubleArray> other;
    other->SetName("Other");
    other->SetNumberOfTuples(array->GetNumberOfTuples());
    other->Fill(3.0);
    data->AddArray(other);
    data->SetActiveScalars("Other");
    image->Modified();
  };
  rename(source, source->GetCellData(), "A");
  rename(target, target->GetPointData(), "B");
  auto morph = makeMorph(source, target);
  const Values uniform = runDensity(morph);
  CHECK(checks, !uniform.empty() && uniform != expected);
  constexpr int points = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  constexpr int cells = vtkDataObject::FIELD_ASSOCIATION_CELLS;
  morph->SetInputArrayToProcess(0, 0, 0, cells, "A");
  morph->SetInputArrayToProcess(1, 1, 0, points, "B");
  CHECK(checks, runDensity(morph) == expected);
  // As ParaView gives it.
  auto same = makeMorph(source, target);
  same->SetInputArrayToProcess(0, 1, 0, points, "B");
  same->SetInputArrayToProcess(0, 0, 0, cells, "A");
  CHECK(checks, runDensity(same) == expected);
  // By attribute.
  source->GetCellData()->SetActiveScalars("A");
  target->GetPointData()->SetActiveScalars("B");
  same = makeMorph(source, target);
  same->SetInputArrayToProcess(1, 1, 0, points, vtkDataSetAttributes::SCALARS);
  CHECK(checks, runDensity(same) == expected);
}

// The name of the inputs' arrays, Density where they differ or have none, or what is asked for;
// also before the data.
void checkArrayName(Checks& checks)
{
  const auto named = [](const char* name) {
    auto image = makeDensity({ 9, 8, 1 }, true, bumpy);
    image->GetCellData()->GetScalars()->SetName(name);
    return image;
  };
  const auto check = [&](vtkTransportBlend* blend, const char* expected, int line) {
    blend->Update();
    vtkDataArray* array = densityOf(blend->GetDensity());
    checks.That(array && array->GetName() == std::string(expected), expected, line);
    CHECK(checks, blend->GetDensity()->GetCellData()->GetNumberOfArrays() == 1);
  };
  check(makeMorph(named("rho"), named("rho")), "rho", __LINE__);
  check(makeMorph(named("rho"), named("mass")), "Density", __LINE__);
  check(makeMorph(named(nullptr), named(nullptr)), "Density", __LINE__);
  auto rho = named("rho");
  auto other = named("rho");
  auto mass = named("mass");
  check(makeBarycenter({ rho, other }), "rho", __LINE__);
  check(makeBarycenter({ rho, other, mass }), "Density", __LINE__);
  auto morph = makeMorph(rho, other);
  CHECK(checks, morph->GetResultArrayName() == std::string());
  check(morph, "rho", __LINE__);
  const vtkMTimeType tables = morph->GetTableBuildTime();
  morph->SetResultArrayName("sigma");
  morph->UpdateInformation();
  vtkInformation* announced =
    vtkDataObject::GetActiveFieldInformation(morph->GetOutputInformation(0),
      vtkDataObject::FIELD_ASSOCIATION_CELLS, vtkDataSetAttributes::SCALARS);
  CHECK(checks, announced && announced->Get(vtkDataObject::FIELD_NAME()) == std::string("sigma"));
  check(morph, "sigma", __LINE__);
  morph->SetResultArrayName(nullptr);
  check(morph, "rho", __LINE__);
  CHECK(checks, morph->GetTableBuildTime() == tables);
}

// Blanked cells have no mass, and what comes out is not blanked.
void checkGhosts(Checks& checks)
{
  auto source = makeDensity({ 12, 10, 1 }, true, [](vtkIdType) { return 1.0; });
  vtkUnsignedCharArray* flags = source->AllocateCellGhostArray();
  for (vtkIdType i = 0; i < 120; ++i)
  {
    flags->SetValue(i, i % 12 < 6 ? 0 : vtkDataSetAttributes::HIDDENCELL);
  }
  auto target = makeDensity({ 12, 10, 1 }, true, bumpy);
  auto morph = makeMorph(source, target, 0.0);
  morph->Update();
  CHECK_NEAR(checks, fieldValue(morph->GetDensity(), "TotalMass"), 60.0, 1e-12);
  CHECK(checks, morph->GetDensity()->GetCellGhostArray() == nullptr);
  const Values places = particlePlaces(morph);
  double right = 0.0;
  for (std::size_t i = 0; i < places.size(); i += 3)
  {
    right = std::max(right, places[i]);
  }
  CHECK_NEAR(checks, right, 6.0, 0.51);
}

} // namespace

int TestMorphOutput(int, char*[])
{
  return runChecks({ checkEnds, checkMass, checkCost, checkPlaces, checkPivot, checkTranslation,
    checkReverse, checkArrays, checkChoice, checkArrayName, checkGhosts });
}
