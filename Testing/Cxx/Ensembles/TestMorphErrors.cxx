// SPDX-License-Identifier: BSD-3-Clause
// What is wrong is reported in one error that names the input; the outputs are then empty, and the
// next run may succeed.
#include "BlendTest.h"

#include <limits>

namespace
{

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

class BlendErrorTest : public ErrorTest
{
public:
  BlendErrorTest(Checks& checks, vtkTransportBlend* blend)
    : ErrorTest(checks, blend)
    , Check(checks)
    , Blend(blend)
  {
  }

  void ExpectNone(std::size_t values, int line)
  {
    this->ErrorTest::ExpectNone(line);
    this->Check.That(densityValues(this->Blend).size() == values, "number of values", line);
  }

private:
  Checks& Check;
  vtkTransportBlend* Blend;
};

void checkProperties(Checks& checks)
{
  auto morph =
    makeMorph(makeDensity({ 6, 5, 1 }, true, bumpy), makeDensity({ 6, 5, 1 }, true, bumpy));
  BlendErrorTest test(checks, morph);
  test.ExpectNone(30, __LINE__);
  morph->SetParameter(1.5);
  test.Expect("Parameter is 1.5; it must be from 0 to 1", __LINE__);
  morph->SetParameter(-0.25);
  test.Expect("Parameter is -0.25; it must be from 0 to 1", __LINE__);
  morph->SetParameter(nan);
  test.Expect("Parameter is nan; it must be from 0 to 1", __LINE__);
  morph->SetParameter(0.5);
  morph->SetNumberOfTimeSteps(1);
  test.Expect("NumberOfTimeSteps is 1; it must be from 2 to 1000000", __LINE__);
  morph->PublishTimeOn();
  test.Expect("NumberOfTimeSteps is 1; it must be from 2 to 1000000", __LINE__);
  // It is published as a list before the error.
  morph->SetNumberOfTimeSteps(std::numeric_limits<int>::max());
  test.Expect("NumberOfTimeSteps is 2147483647; it must be from 2 to 1000000", __LINE__);
  morph->SetNumberOfTimeSteps(1000000);
  test.ExpectNone(30, __LINE__);
  morph->PublishTimeOff();
  morph->SetNumberOfTimeSteps(2);
  morph->SetParticlesPerCell(-1);
  test.Expect("ParticlesPerCell is -1; it must be at least 1, or 0 for Auto", __LINE__);
  morph->SetParticlesPerCell(1);
  for (const int wrong : { -1, 4 })
  {
    const std::string is = " is " + std::to_string(wrong) + "; it must be 0 (";
    morph->SetMassMode(wrong);
    test.Expect("MassMode" + is + "Linear), 1 (Geometric), 2 (Source) or 3 (Normalize)", __LINE__);
    morph->SetMassModeToLinear();
    morph->SetKernel(wrong);
    test.Expect(
      "Kernel" + is + "CloudInCell), 1 (NearestCell), 2 (TriangularShapedCloud) or 3 (Gaussian)",
      __LINE__);
    morph->SetKernelToCloudInCell();
  }
  for (const double wrong : { 0.0, -1.0, nan, HUGE_VAL })
  {
    morph->SetRadius(wrong);
    std::ostringstream text;
    text << "Radius is " << wrong << "; it must be above 0";
    test.Expect(text.str(), __LINE__);
  }
  morph->SetRadius(1.0);
  expectFlowErrors(test, morph.Get(), __LINE__);
  morph->SetNegativeValues(2);
  test.Expect("NegativeValues is 2; it must be 0 (Error) or 1 (Clamp)", __LINE__);
  morph->SetNegativeValues(0);
  morph->SetComponent(1);
  test.Expect("Source: Component is 1, but the density array 'Density' has 1 component", __LINE__);
  morph->SetComponent(-1);
  test.ExpectNone(30, __LINE__);
}

void checkDimensions(Checks& checks)
{
  auto source = makeDensity({ 6, 5, 1 }, true, bumpy);
  auto target = makeDensity({ 6, 5, 1 }, true, bumpy);
  for (const bool sameBox : { true, false })
  {
    target->SetOrigin(sameBox ? 0.0 : 1.5, 0.0, 0.0);
    auto morph = makeMorph(source, target);
    BlendErrorTest test(checks, morph);
    test.ExpectNone(sameBox ? 30 : 24, __LINE__);
    morph->SetDimensions(4, -1, 0);
    test.Expect("Dimensions is 4 -1 0; it must be 0 (as many as ", __LINE__);
    morph->SetDimensions(4, 4, 4);
    test.Expect(
      "Dimensions is 4 4 4; it must be 0 or 1 along z, where the input has one point", __LINE__);
    morph->SetDimensions(std::numeric_limits<int>::max(), 1, 1);
    test.Expect(
      "Dimensions is 2147483647 1 1; it must be at most 1073741824 along every axis", __LINE__);
    morph->SetDimensions(1 << 30, 1 << 30, 1);
    test.Expect("Not enough memory for ", __LINE__);
    morph->SetDimensions(1, 3, 1);
    test.ExpectNone(3, __LINE__);
  }
  auto points =
    makeMorph(makeDensity({ 6, 1, 5 }, false, bumpy), makeDensity({ 6, 1, 5 }, false, bumpy));
  BlendErrorTest test(checks, points);
  points->SetDimensions(1, 3, 1);
  test.Expect(
    "Dimensions is 1 3 1; it must be 0 or at least 2 along x: points have no axis where", __LINE__);
  points->SetDimensions(3, 1, 2);
  test.ExpectNone(6, __LINE__);
}

// More than any machine has: what is asked for, and by which property.
void checkMemory(Checks& checks)
{
  auto source = makeDensity({ 40, 30, 1 }, true, bumpy);
  auto target = makeDensity({ 40, 30, 1 }, true, bumpy);
  auto morph = makeMorph(source, target);
  BlendErrorTest test(checks, morph);
  test.ExpectNone(1200, __LINE__);
  morph->SetParticlesPerCell(std::numeric_limits<int>::max());
  test.Expect("Not enough memory for 2576980376400 particles (see ParticlesPerCell and Dimensions)",
    __LINE__);
  morph->SetParticlesPerCell(1);
  morph->SetDimensions(1 << 30, 1 << 30, 1);
  test.Expect("Not enough memory for 1152921504606846976 particles", __LINE__);
  morph->SetDimensions(0, 0, 0);

  // Two boxes far apart: no more cells than one of them has.
  target->SetOrigin(1e15, 0.0, 0.0);
  test.ExpectNone(1200, __LINE__);
  morph->SetDimensions(50, 30, 1);
  test.ExpectNone(1500, __LINE__);
  morph->SetDimensions(0, 0, 0);
  target->SetOrigin(0.0, 0.0, 0.0);
  test.ExpectNone(1200, __LINE__);

  // One axis may have as many particles as memory holds, cells as many as the core counts.
  auto line =
    makeMorph(makeDensity({ 10, 1, 1 }, true, bumpy), makeDensity({ 10, 1, 1 }, true, bumpy));
  BlendErrorTest ofLine(checks, line);
  line->SetParticlesPerCell(std::numeric_limits<int>::max());
  ofLine.Expect("Not enough memory for 21474836470 particles", __LINE__);
}

void checkGeometries(Checks& checks)
{
  auto flat = makeDensity({ 6, 5, 1 }, true, bumpy);
  auto morph = makeMorph(flat, makeDensity({ 6, 5, 4 }, true, bumpy));
  BlendErrorTest test(checks, morph);
  test.Expect("Source has the axes x and y, Target has the axes x and y and z; all must have the "
              "same number of dimensions, along the same axes",
    __LINE__);
  morph->SetTargetData(makeDensity({ 6, 1, 1 }, true, bumpy));
  test.Expect("Target has the axes x; all must have", __LINE__);
  morph->SetTargetData(makeDensity({ 6, 1, 5 }, true, bumpy));
  test.Expect("Target has the axes x and z; all must have", __LINE__);
  morph->SetTargetData(makeDensity({ 1, 1, 1 }, true, bumpy));
  test.Expect("Target: The input image has one point along every axis", __LINE__);

  auto other = makeDensity({ 6, 5, 1 }, true, bumpy);
  other->SetOrigin(0.0, 0.0, 2.0);
  morph->SetTargetData(other);
  test.Expect(
    "Source lies at z = 0, Target at z = 2; images that are flat along an axis must lie in "
    "one plane",
    __LINE__);
  other->SetOrigin(0.0, 0.0, 0.0);
  const double turned[9] = { 0, -1, 0, 1, 0, 0, 0, 0, 1 };
  other->SetDirectionMatrix(turned);
  test.Expect(
    "Source and Target have different direction matrices; all must have the same one", __LINE__);
  const double singular[9] = { 1, 1, 0, 0, 0, 0, 0, 0, 1 };
  other->SetDirectionMatrix(singular);
  test.Expect("Target: The image's spacing is (1, 1, 1)", __LINE__);
  const double straight[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  other->SetDirectionMatrix(straight);
  other->SetSpacing(-1.0, 1.0, 1.0);
  test.Expect(
    "Along x the spacing of Source is 1 and that of Target is -1; both must have the same "
    "sign",
    __LINE__);
  other->SetSpacing(0.0, 1.0, 1.0);
  test.Expect("Target: The image's spacing is (0, 1, 1)", __LINE__);
  other->SetSpacing(1.0, 1.0, 1.0);
  test.ExpectNone(30, __LINE__);

  // Different boxes along a direction that no point has.
  const double without[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 0 };
  auto near = makeDensity({ 6, 5, 1 }, true, bumpy);
  near->SetDirectionMatrix(without);
  other->SetDirectionMatrix(without);
  other->SetOrigin(1.0, 0.0, 0.0);
  morph->SetInputData(near);
  test.Expect("Source has a direction matrix without an inverse, and its geometry is not that of "
              "Target; give "
              "axes of one point a direction of their own",
    __LINE__);
}

void checkDensities(Checks& checks)
{
  const Counts values = { 6, 5, 1 };
  auto good = makeDensity(values, true, bumpy);
  const auto bad = [&](double value) {
    return makeDensity(values, true, [=](vtkIdType i) { return i == 3 ? value : bumpy(i); });
  };
  auto morph = makeMorph(good, bad(-1.0));
  BlendErrorTest test(checks, morph);
  test.Expect("Target: The density array 'Density' has 1 negative value; NegativeValues = Clamp "
              "takes them as 0, ValidRange as missing (the first at index 3)",
    __LINE__);
  morph->SetNegativeValuesToClamp();
  test.ExpectNone(30, __LINE__);
  morph->SetInputData(bad(nan));
  test.Expect(
    "Source: The density array 'Density' has 1 value that is NaN or infinite; NaNValues = Empty "
    "takes NaN as empty cells (the first at index 3)",
    __LINE__);
  morph->SetInputData(good);
  morph->SetTargetData(makeDensity(values, true, [](vtkIdType) { return 0.0; }));
  test.Expect("Target: The density array 'Density' has a total mass of zero", __LINE__);
  morph->SetTargetData(good);
  morph->SetInputData(makeDensity(values, true, [](vtkIdType) { return 0.0; }));
  test.Expect("Source: The density array 'Density' has a total mass of zero", __LINE__);
  morph->SetInputData(makeDensity(values, true, [](vtkIdType) { return 1e308; }));
  test.Expect(
    "Source: The density array 'Density' has a total mass past the largest double", __LINE__);
  morph->SetInputData(good);
  morph->SetInputArrayToProcess(1, 1, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Missing");
  test.Expect("Target: The input image has no density array 'Missing'; it has no point arrays and "
              "Density (cell)",
    __LINE__);
  morph->SetInputArrayToProcess(1, 1, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Density");
  test.Expect(
    "Target: The input image has no density array 'Density'; it has no point arrays and", __LINE__);
  morph->SetInputArrayToProcess(1, 1, 0, vtkDataObject::FIELD_ASSOCIATION_NONE, "Density");
  test.Expect("Target: The field association of the density array is ", __LINE__);
  morph->SetInputArrayToProcess(1, 1, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Density");
  test.ExpectNone(30, __LINE__);
  const auto huge = [](double slope) {
    auto line = makeDensity(
      { 40, 1, 1 }, true, [=](vtkIdType i) { return 50.0 + slope * static_cast<double>(i); });
    line->SetSpacing(1e155, 1.0, 1.0);
    return line;
  };
  morph->SetInputData(huge(1.0));
  morph->SetTargetData(huge(-1.0));
  test.Expect("TransportCost, the mean of the squared displacements, passes the largest double; "
              "the spacing of the density must be smaller",
    __LINE__);
}

// Nothing upstream yet is no error.
void checkEmpty(Checks& checks)
{
  auto good = makeDensity({ 6, 5, 1 }, true, bumpy);
  vtkNew<vtkImageData> empty;
  auto morph = makeMorph(empty, good);
  BlendErrorTest test(checks, morph);
  test.ExpectNone(0, __LINE__);
  CHECK(checks, isEmpty(morph));
  morph->SetInputData(good);
  test.ExpectNone(30, __LINE__);
  morph->SetTargetData(empty);
  test.ExpectNone(0, __LINE__);
  CHECK(checks, isEmpty(morph));
  morph->SetInputData(empty);
  test.ExpectNone(0, __LINE__);
  morph->PublishTimeOn();
  test.ExpectNone(0, __LINE__);
}

// One number of steps takes some particles to where nothing is.
void checkWarning(Checks& checks)
{
  auto lines = makeDensity(
    { 40, 40, 1 }, false, [](vtkIdType i) { return i % 40 == 7 || i / 40 == 30 ? 1.0 : 0.0; });
  auto morph = makeMorph(lines, makeDensity({ 40, 40, 1 }, false, bumpy));
  Messages messages(morph);
  morph->SetIntegratorToEuler();
  morph->SetNumberOfSteps(1);
  morph->Update();
  CHECK(checks, messages.Errors.empty() && messages.Warnings.size() == 1);
  CHECK(checks,
    !messages.Warnings.empty() &&
      contains(
        messages.Warnings[0], " particles in empty cells moved to the nearest cell with mass"));
  // They have been moved once.
  messages.Clear();
  morph->SetParameter(0.75);
  morph->Update();
  CHECK(checks, messages.Warnings.empty());
}

} // namespace

int TestMorphErrors(int, char*[])
{
  return runChecks({ checkProperties, checkDimensions, checkMemory, checkGeometries, checkDensities,
    checkEmpty, checkWarning });
}
