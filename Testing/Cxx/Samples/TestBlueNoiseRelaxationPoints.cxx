// SPDX-License-Identifier: BSD-3-Clause
// Which points are moved before the first iteration, which never, and points that are few, on each
// other, or where the density is zero; when the iterations end.
#include "RelaxationTest.h"

#include "vtkDataSetAttributes.h"
#include "vtkUnsignedCharArray.h"

#include <set>

namespace
{

constexpr unsigned char duplicate = vtkDataSetAttributes::DUPLICATEPOINT;
constexpr unsigned char hidden = vtkDataSetAttributes::HIDDENPOINT;

vtkSmartPointer<vtkImageData> flatDensity()
{
  return makeImage(9, 7, 1, true, bumpy); // [0,8] x [0,6], z = 0
}

// Without iterations points stay where they are, to the last bit, but those outside and off the
// plane.
void checkNoIterations(Checks& checks)
{
  const double third = 1.0 / 3.0;
  for (int method = 0; method < 2; ++method)
  {
    auto image = flatDensity();
    image->SetOrigin(0.1, 0.7, -third);
    auto relaxation = makeRelaxation(method,
      makePoints({ third, 0.9, -third, 9.5, 2.0, -third, 3.0 + third, 2.0, 5.0, 4.3, -3.0, -9.0 }),
      image);
    relaxation->SetMaximumIterations(0);
    Messages messages(relaxation);
    const Values x = relaxedCoordinates(relaxation);
    CHECK(
      checks, x.size() == 12 && Values(x.begin(), x.begin() + 3) == Values({ third, 0.9, -third }));
    const Values nearest{ 8.1, 2.0, -third, 3.0 + third, 2.0, -third, 4.3, 0.7, -third };
    CHECK_NEAR(checks, largestDifference(Values(x.begin() + 3, x.end()), nearest), 0.0, 1e-12);
    CHECK(checks, energies(relaxation).size() == 1);
    expectEnergy(checks, relaxation, __LINE__);
    CHECK(checks, messages.Errors.empty() && messages.Warnings.size() == 1);
    CHECK(checks,
      contains(messages.Warnings[0],
        "3 of 4 points outside the domain of the density moved to its border"));
  }
}

void setGhosts(vtkPointSet* points, const std::vector<unsigned char>& flags)
{
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  for (const unsigned char flag : flags)
  {
    ghosts->InsertNextValue(flag);
  }
  points->GetPointData()->AddArray(ghosts);
}

// Ghosts stay, also outside, and the others do not see them.
void checkGhosts(Checks& checks)
{
  const Values own{ 1, 1, 0, 3, 2, 0, 7, 5, 0, 2, 5.5, 0, 6, 1, 0 };
  const Values others{ 3, 2, 0, -4, 2, 0, 6.5, 1, 3 };
  Values all = own;
  all.insert(all.begin() + 3, others.begin(), others.begin() + 6);
  all.insert(all.end(), others.begin() + 6, others.end());
  for (int method = 0; method < 2; ++method)
  {
    const Values expected =
      relaxedCoordinates(makeRelaxation(method, makePoints(own), flatDensity()));
    auto points = makePoints(all, true);
    setGhosts(points, { 0, duplicate, hidden, 0, 0, 0, 0, duplicate });
    auto relaxation = makeRelaxation(method, points, flatDensity());
    Messages messages(relaxation);
    const Values found = relaxedCoordinates(relaxation);
    CHECK(checks, found.size() == all.size() && messages.Warnings.empty());
    Values moved;
    for (std::size_t i = 0; i < found.size(); i += 3)
    {
      const std::size_t point = i / 3;
      if (point == 1 || point == 2 || point == 7)
      {
        CHECK(checks, std::equal(found.begin() + i, found.begin() + i + 3, all.begin() + i));
        continue;
      }
      moved.insert(moved.end(), found.begin() + i, found.begin() + i + 3);
    }
    CHECK(checks, moved == expected);

    setGhosts(points, std::vector<unsigned char>(8, hidden));
    points->Modified();
    CHECK(checks, relaxedCoordinates(relaxation) == all && energies(relaxation).empty());
    CHECK(checks, messages.Errors.empty());
  }
}

// Points that no diagram needs three of; all of them, some, or none at one place.
void checkFew(Checks& checks)
{
  const Values places[] = { { 3, 2, 0 }, { 3, 2, 0, 5, 4, 0 }, { 3, 2, 0, 3, 2, 0 },
    { 3, 2, 0, 3, 2, 0, 3, 2, 0, 3, 2, 0, 3, 2, 0 },
    { 3, 2, 0, 1, 1, 0, 3, 2, 0, 0, 0, 0, 0, 0, 0 }, { 1, 1, 0, 2, 1, 0, 3, 1, 0, 4, 1, 0 },
    { 0, 0, 0, 8, 0, 0, 0, 6, 0, 8, 6, 0 } };
  for (int method = 0; method < 2; ++method)
  {
    for (const Values& x : places)
    {
      auto relaxation = makeRelaxation(method, makePoints(x), flatDensity());
      ErrorTest(checks, relaxation).ExpectNone(__LINE__);
      const Values found = coordinates(relaxation->GetOutput());
      CHECK(checks, found.size() == x.size());
      std::set<Values> different;
      for (std::size_t i = 0; i < found.size(); i += 3)
      {
        different.insert({ found[i], found[i + 1], found[i + 2] });
        CHECK(checks, found[i] >= 0 && found[i] <= 8 && found[i + 1] >= 0 && found[i + 1] <= 6);
      }
      CHECK(checks, 3 * different.size() == found.size());
      expectEnergy(checks, relaxation, __LINE__);
    }
  }
}

// Mass in a corner, in dots and in a frame, and most or all points where there is none.
void checkHoles(Checks& checks)
{
  const double bounds[6] = { 0, 5, 0, 6, 0, 0 };
  const std::function<double(vtkIdType)> masses[] = { [](vtkIdType i) {
                                                       return i == 47 ? 1.0 : 0.0;
                                                     },
    [](vtkIdType i) { return i % 8 > 5 ? 1.0 : 0.0; },
    [](vtkIdType i) { return i % 5 == 0 ? 1.0 : 0.0; },
    [](vtkIdType i) { return i % 8 == 0 || i % 8 == 7 || i < 8 || i > 39 ? 2.0 : 0.0; } };
  for (int method = 0; method < 2; ++method)
  {
    for (const auto& mass : masses)
    {
      auto relaxation = makeRelaxation(
        method, makePoints(randomCoordinates(bounds, 40)), makeImage(9, 7, 1, true, mass));
      relaxation->SetMaximumIterations(6);
      ErrorTest(checks, relaxation).ExpectNone(__LINE__);
      const Values found = coordinates(relaxation->GetOutput());
      CHECK(checks, found.size() == 120);
      for (std::size_t i = 0; i < found.size(); i += 3)
      {
        CHECK(checks, found[i] >= 0 && found[i] <= 8 && found[i + 1] >= 0 && found[i + 1] <= 6);
      }
      expectEnergy(checks, relaxation, __LINE__);
      CHECK(checks, energies(relaxation).back() < energies(relaxation)[0]);
    }
  }
}

// A large tolerance ends it before the last iteration, and a run of more iterations begins as one
// of fewer.
void checkEnd(Checks& checks)
{
  const double bounds[6] = { 0, 8, 0, 6, 0, 0 };
  for (int method = 0; method < 2; ++method)
  {
    auto relaxation =
      makeRelaxation(method, makePoints(randomCoordinates(bounds, 50)), flatDensity());
    relaxation->SetMaximumIterations(8);
    relaxation->Update();
    const Values all = energies(relaxation);
    CHECK(checks, all.size() == 9);
    relaxation->SetMaximumIterations(4);
    relaxation->Update();
    CHECK(checks, energies(relaxation) == Values(all.begin(), all.begin() + 5));
    relaxation->SetMaximumIterations(1000);
    relaxation->SetTolerance(0.1);
    relaxation->Update();
    CHECK(checks, energies(relaxation).size() < 100);
    expectEnergy(checks, relaxation, __LINE__);
  }
}

} // namespace

int TestBlueNoiseRelaxationPoints(int, char*[])
{
  return runChecks({ checkNoIterations, checkGhosts, checkFew, checkHoles, checkEnd });
}
