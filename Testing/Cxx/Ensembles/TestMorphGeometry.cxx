// SPDX-License-Identifier: BSD-3-Clause
// Where an image lies in space does not change what happens in it.
#include "BlendTest.h"

namespace
{

struct Result
{
  Values Density;
  Values Places;
};

Result run(vtkImageData* source, vtkImageData* target)
{
  auto morph = makeMorph(source, target, 0.375);
  morph->SetParticlesPerCell(3);
  Result result;
  result.Density = runDensity(morph);
  result.Places = particlePlaces(morph);
  return result;
}

// In each plane, or along each axis, the same bits.
void checkAxes(Checks& checks)
{
  for (const bool cells : { true, false })
  {
    const Result xy = run(makeDensity({ 14, 11, 1 }, cells, smoothDensity(14, 11)),
      makeDensity({ 14, 11, 1 }, cells, otherDensity(14, 11)));
    const Result xz = run(makeDensity({ 14, 1, 11 }, cells, smoothDensity(14, 11)),
      makeDensity({ 14, 1, 11 }, cells, otherDensity(14, 11)));
    const Result yz = run(makeDensity({ 1, 14, 11 }, cells, smoothDensity(14, 11)),
      makeDensity({ 1, 14, 11 }, cells, otherDensity(14, 11)));
    CHECK(checks, xy.Density.size() == 14u * 11 && xy.Places.size() == 9u * 14 * 11);
    CHECK(checks, xz.Density == xy.Density && yz.Density == xy.Density);
    bool same = xz.Places.size() == xy.Places.size() && yz.Places.size() == xy.Places.size();
    for (std::size_t i = 0; same && i < xy.Places.size(); i += 3)
    {
      const double* x = xy.Places.data() + i;
      const double* inXZ = xz.Places.data() + i;
      const double* inYZ = yz.Places.data() + i;
      same = x[2] == 0.0 && inXZ[0] == x[0] && inXZ[1] == 0.0 && inXZ[2] == x[1] &&
        inYZ[0] == 0.0 && inYZ[1] == x[0] && inYZ[2] == x[1];
    }
    CHECK(checks, same);

    const Result x = run(makeDensity({ 40, 1, 1 }, cells, smoothDensity(40, 1)),
      makeDensity({ 40, 1, 1 }, cells, otherDensity(40, 1)));
    for (const Counts& line : { Counts{ 1, 40, 1 }, Counts{ 1, 1, 40 } })
    {
      const Result other = run(makeDensity(line, cells, smoothDensity(40, 1)),
        makeDensity(line, cells, otherDensity(40, 1)));
      CHECK(checks, !x.Density.empty() && other.Density == x.Density);
    }
  }
}

// An extent that begins elsewhere, with an origin that makes up for it.
void checkExtent(Checks& checks)
{
  auto source = makeDensity({ 9, 8, 7 }, false, smoothDensity(9, 8, 7));
  auto target = makeDensity({ 9, 8, 7 }, false, otherDensity(9, 8, 7));
  const Result plain = run(source, target);
  source->SetExtent(-4, 4, 10, 17, 3, 9);
  source->SetOrigin(4.0, -10.0, -3.0);
  const Result shifted = run(source, target);
  CHECK_NEAR(checks, largestDifference(plain.Density, shifted.Density), 0.0, 1e-12);
  CHECK_NEAR(checks, largestDifference(plain.Places, shifted.Places), 0.0, 1e-12);
  target->SetExtent(1, 9, 1, 8, 1, 7);
  target->SetOrigin(-1.0, -1.0, -1.0);
  const Result both = run(source, target);
  CHECK_NEAR(checks, largestDifference(plain.Density, both.Density), 0.0, 1e-12);
}

// What is turned about the origin of space ends turned, also where the boxes differ.
void checkDirection(Checks& checks)
{
  const double turned[9] = { 0, -1, 0, 0.6, 0, 0.8, -0.8, 0, 0.6 };
  const auto turn = [&](const double* x, double* out) {
    for (int r = 0; r < 3; ++r)
    {
      out[r] = turned[3 * r] * x[0] + turned[3 * r + 1] * x[1] + turned[3 * r + 2] * x[2];
    }
  };
  auto source = makeDensity({ 9, 8, 7 }, true, smoothDensity(9, 8, 7));
  auto target = makeDensity({ 6, 9, 7 }, true, otherDensity(6, 9, 7));
  const double corner[3] = { 5.0, -2.0, 1.0 };
  target->SetOrigin(corner);
  const Result plain = run(source, target);
  double corners[3];
  turn(corner, corners);
  source->SetDirectionMatrix(turned);
  target->SetDirectionMatrix(turned);
  target->SetOrigin(corners);
  const Result found = run(source, target);
  CHECK_NEAR(checks, largestDifference(plain.Density, found.Density), 0.0, 1e-11);
  Values expected(plain.Places.size());
  for (std::size_t i = 0; i < expected.size(); i += 3)
  {
    turn(plain.Places.data() + i, expected.data() + i);
  }
  CHECK_NEAR(checks, largestDifference(expected, found.Places), 0.0, 1e-12);

  // A flat axis needs no direction.
  const double flat[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 0 };
  auto a = makeDensity({ 14, 11, 1 }, true, smoothDensity(14, 11));
  auto b = makeDensity({ 14, 11, 1 }, true, otherDensity(14, 11));
  const Result whole = run(a, b);
  a->SetDirectionMatrix(flat);
  b->SetDirectionMatrix(flat);
  const Result without = run(a, b);
  CHECK(checks, !whole.Density.empty() && without.Density == whole.Density);
}

// Against the axes: the mirror image, whose sites are at minus x.
void checkNegativeSpacing(Checks& checks)
{
  auto source = makeDensity({ 14, 11, 1 }, true, smoothDensity(14, 11));
  auto target = makeDensity({ 14, 11, 1 }, true, otherDensity(14, 11));
  target->SetOrigin(3.0, 0.0, 0.0);
  const Result plain = run(source, target);
  source->SetSpacing(-1.0, 1.0, 1.0);
  target->SetSpacing(-1.0, 1.0, 1.0);
  target->SetOrigin(-3.0, 0.0, 0.0);
  const Result found = run(source, target);
  CHECK_NEAR(checks, largestDifference(plain.Density, found.Density), 0.0, 1e-12);
  Values expected = plain.Places;
  for (std::size_t i = 0; i < expected.size(); i += 3)
  {
    expected[i] = -expected[i];
  }
  CHECK_NEAR(checks, largestDifference(expected, found.Places), 0.0, 1e-12);
}

// Of another spacing: the flow is that of index space.
void checkScale(Checks& checks)
{
  auto source = makeDensity({ 14, 11, 1 }, true, smoothDensity(14, 11));
  auto target = makeDensity({ 14, 11, 1 }, true, otherDensity(14, 11));
  const Result plain = run(source, target);
  source->SetSpacing(4.0, 0.5, 1.0);
  target->SetSpacing(4.0, 0.5, 1.0);
  const Result scaled = run(source, target);
  CHECK_NEAR(checks, largestDifference(plain.Density, scaled.Density), 0.0, 1e-12);
  Values expected = plain.Places;
  for (std::size_t i = 0; i < expected.size(); i += 3)
  {
    expected[i] *= 4.0;
    expected[i + 1] *= 0.5;
  }
  CHECK_NEAR(checks, largestDifference(expected, scaled.Places), 0.0, 1e-12);
}

} // namespace

int TestMorphGeometry(int, char*[])
{
  return runChecks({ checkAxes, checkExtent, checkDirection, checkNegativeSpacing, checkScale });
}
