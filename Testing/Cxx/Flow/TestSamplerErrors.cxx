// SPDX-License-Identifier: BSD-3-Clause
// What is wrong is reported in one error that names the array or property, the value and what would
// be right; the output is then empty, and the next run may succeed.
#include "../../SeedPatterns.h"
#include "TestData.h"

#include "vtkFloatArray.h"
#include "vtkStringArray.h"

#include <limits>

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

class SamplerErrorTest : public ErrorTest
{
public:
  SamplerErrorTest(Checks& checks, vtkTransportSampler* sampler)
    : ErrorTest(checks, sampler)
  {
    sampler->SetNumberOfParticles(50);
    sampler->SetInputData(makeImage(6, 5, 1, true, bumpy));
  }
};

void checkProperties(Checks& checks)
{
  vtkNew<vtkTransportSampler> s;
  SamplerErrorTest test(checks, s);
  for (const vtkIdType count : { 0, -3 })
  {
    s->SetNumberOfParticles(count);
    test.Expect({ "NumberOfParticles is " + std::to_string(count), "at least 1" }, __LINE__);
  }
  s->SetNumberOfParticles(50);
  for (const double time : { -0.5, 1.5, infinity, notANumber })
  {
    s->SetFlowTime(time);
    test.Expect({ "FlowTime is ", "from 0 to 1" }, __LINE__);
  }
  s->SetFlowTime(1.5);
  test.Expect({ "FlowTime is 1.5;" }, __LINE__);
  s->SetFlowTime(std::nextafter(1.0, 2.0));
  test.Expect({ "FlowTime is 1.0000000000000002;" }, __LINE__);
  s->SetFlowTime(1.0);
  s->SetSeedPattern(RectifiedTransport::numberOfSeedPatterns);
  test.Expect({ "SeedPattern is 5", "0 (BlueNoise)", "4 (Random)" }, __LINE__);
  s->SetSeedPattern(0);
  s->SetSamplesPerCell(-1);
  test.Expect({ "SamplesPerCell is -1", "0 (not used) or greater" }, __LINE__);
  s->SetSamplesPerCell(0);
  s->SetIntegrator(-1);
  test.Expect({ "Integrator is -1", "0 (Multistep)", "3 (Adaptive)" }, __LINE__);
  s->SetIntegrator(0);
  for (const int steps : { -1, 10001, -7 })
  {
    s->SetNumberOfSteps(steps);
    test.Expect({ "NumberOfSteps is " + std::to_string(steps), "from 1 to 10000" }, __LINE__);
  }
  s->SetNumberOfSteps(32);
  for (const double tolerance : { 0.0, -1.0, infinity, notANumber })
  {
    s->SetTolerance(tolerance);
    test.Expect({ "Tolerance is ", "positive number of cells" }, __LINE__);
  }
  s->SetTolerance(0.01);
  s->SetTableLookup(2);
  test.Expect({ "TableLookup is 2", "0 (Interpolated) or 1 (Nearest)" }, __LINE__);
  s->SetTableLookup(0);
  s->SetMethod(2);
  test.Expect({ "Method is 2", "0 (RectifiedFlow)", "1 (Optimal)" }, __LINE__);
  s->SetMethod(0);
  for (const double tolerance : { 0.0, -1.0, 1.0, notANumber })
  {
    s->SetOptimalityTolerance(tolerance);
    test.Expect({ "OptimalityTolerance is ", "above 0 and below 1" }, __LINE__);
  }
  s->SetOptimalityTolerance(0.001);
  s->SetTablesToTiled();
  s->SetMethodToOptimal();
  test.Expect({ "Tables is Tiled", "the optimal map (Method Optimal)", "Whole" }, __LINE__);
  s->SetMethodToRectifiedFlow();
  s->CertifyOn();
  test.Expect({ "Tables is Tiled", "a bound of the cost (Certify)", "Whole" }, __LINE__);
  s->CertifyOff();
  s->SetTablesToAuto();
  s->SetFlowMaps(3);
  test.Expect({ "FlowMaps is 3", "0 (Auto)", "2 (Off)" }, __LINE__);
  s->SetFlowMaps(0);
  s->SetTables(3);
  test.Expect({ "Tables is 3", "0 (Auto), 1 (Whole) or 2 (Tiled)" }, __LINE__);
  s->SetTablesToTiled();
  s->SetIntegratorToEuler();
  test.Expect({ "Tables is Tiled", "Integrator Multistep", "Tables = Whole" }, __LINE__);
  s->SetIntegratorToMultistep();
  s->SetFlowTime(0.5);
  test.Expect({ "Tables is Tiled", "FlowTime other than 1" }, __LINE__);
  s->SetFlowTime(1.0);
  s->OutputPathsOn();
  test.Expect({ "Tables is Tiled", "OutputPaths" }, __LINE__);
  s->OutputPathsOff();
  s->SetNumberOfSteps(2);
  test.Expect({ "Tables is Tiled", "NumberOfSteps 2" }, __LINE__);
  s->SetNumberOfSteps(32);
  s->SetTablesToAuto();
  s->SetDevice(2);
  test.Expect({ "Device is 2", "0 (CPU) or 1 (OpenCL)" }, __LINE__);
  s->SetDeviceToCPU();
  s->SetThreading(4);
  test.Expect({ "Threading is 4", "0 (Auto)", "3 (Serial)" }, __LINE__);
  s->SetThreading(0);
  s->SetNegativeValues(2);
  test.Expect({ "NegativeValues is 2", "0 (Error) or 1 (Clamp)" }, __LINE__);
  s->SetNegativeValues(0);
  for (const int component : { -4, 1 })
  {
    s->SetComponent(component);
    test.Expect({ "Component is " + std::to_string(component), "'Density'", "1 component",
                  "-1 (Auto), -2 (luminance), -3 (magnitude) or 0" },
      __LINE__);
  }
  s->SetComponent(-1);
  test.ExpectNone(__LINE__);
  CHECK(checks, s->GetOutput()->GetNumberOfPoints() == 50);
}

void checkComponents(Checks& checks)
{
  vtkNew<vtkTransportSampler> sampler;
  SamplerErrorTest test(checks, sampler);
  // Bytes are colours, which have four components at most.
  sampler->SetInputData(makeImage<vtkUnsignedCharArray>(6, 5, 1, true, bumpy, 9));
  test.Expect({ "Component is -1", "'Density'", "9 components",
                "must be -3 (magnitude) or an index from 0 to 8" },
    __LINE__);
  sampler->SetComponent(8);
  test.ExpectNone(__LINE__);
  sampler->SetInputData(makeImage(6, 5, 1, true, bumpy, 3));
  test.Expect({ "Component is 8", "3 components",
                "-1 (Auto), -2 (luminance), -3 (magnitude) or an index from 0 to 2" },
    __LINE__);
}

void checkArrays(Checks& checks)
{
  vtkNew<vtkTransportSampler> s;
  SamplerErrorTest test(checks, s);
  using Object = vtkDataObject;
  s->SetInputArrayToProcess(0, 0, 0, Object::FIELD_ASSOCIATION_POINTS, "Missing");
  test.Expect({ "no density array 'Missing'", "no point arrays", "Density (cell)" }, __LINE__);
  s->SetInputArrayToProcess(0, 0, 0, Object::FIELD_ASSOCIATION_POINTS, "Density");
  test.Expect({ "no density array 'Density'", "Density (cell)" }, __LINE__);
  s->SetInputArrayToProcess(0, 0, 0, Object::FIELD_ASSOCIATION_NONE, "Density");
  test.Expect({ "field association", "0 (points), 1 (cells)" }, __LINE__);
  s->SetInputArrayToProcess(0, 0, 0, Object::FIELD_ASSOCIATION_CELLS, "Density");
  test.ExpectNone(__LINE__);

  vtkNew<vtkImageData> image;
  image->SetDimensions(6, 5, 1);
  vtkNew<vtkStringArray> words;
  words->SetName("Words");
  words->SetNumberOfValues(30);
  image->GetPointData()->AddArray(words);
  s->SetInputData(image);
  s->SetInputArrayToProcess(0, 0, 0, Object::FIELD_ASSOCIATION_POINTS, "Words");
  test.Expect({ "'Words' is not numeric" }, __LINE__);
  s->SetInputArrayToProcess(0, 0, 0, Object::FIELD_ASSOCIATION_POINTS_THEN_CELLS, 0);
  test.Expect({ "no active scalars", "no numeric point arrays and no cell arrays" }, __LINE__);

  vtkNew<vtkFloatArray> brief;
  brief->SetName("Brief");
  brief->SetNumberOfTuples(29);
  image->GetPointData()->SetScalars(brief);
  test.Expect({ "'Brief' has 29 tuples", "30 points" }, __LINE__);
}

void checkValues(Checks& checks)
{
  vtkNew<vtkTransportSampler> sampler;
  SamplerErrorTest test(checks, sampler);
  const auto use = [&](const std::function<double(vtkIdType)>& value) {
    sampler->SetInputData(makeImage(6, 5, 1, false, value));
  };
  use([](vtkIdType i) {
    return i == 4 ? notANumber : i == 9 ? infinity : i == 7 ? -infinity : 1.0;
  });
  test.Expect(
    { "'Density' has 3 values that are NaN or infinite", "first at index 4", "NaNValues = Empty" },
    __LINE__);
  sampler->SetNegativeValuesToClamp(); // minus infinity is not negative, it is wrong
  test.Expect({ "has 3 values that are NaN or infinite" }, __LINE__);
  sampler->InvertDensityOn();
  test.Expect({ "has 3 values that are NaN or infinite", "first at index 4" }, __LINE__);
  sampler->InvertDensityOff();
  use([](vtkIdType i) { return i == 11 ? notANumber : 1.0; });
  test.Expect({ "has 1 value that is NaN", "first at index 11" }, __LINE__);
  sampler->SetNegativeValuesToError();
  use([](vtkIdType i) { return i > 27 ? -1e-300 : 1.0; });
  test.Expect({ "'Density' has 2 negative values", "first at index 28", "Clamp" }, __LINE__);
  sampler->SetNegativeValuesToClamp();
  test.ExpectNone(__LINE__);
  use([](vtkIdType) { return -1.0; });
  test.Expect({ "'Density' has a total mass of zero", "at least one value" }, __LINE__);
  use([](vtkIdType) { return 0.0; });
  test.Expect({ "'Density' has a total mass of zero" }, __LINE__);
  use([](vtkIdType) { return 1e308; });
  test.Expect({ "'Density' has a total mass past the largest double" }, __LINE__);

  // The cells' sum is a double, the mass is not.
  auto image = makeImage(6, 5, 1, false, [](vtkIdType) { return 1e300; });
  image->SetSpacing(1e5, 1e5, 1.0);
  sampler->SetInputData(image);
  test.Expect({ "'Density' has a total mass past the largest double" }, __LINE__);
  image->GetPointData()->GetScalars()->SetName(nullptr);
  test.Expect({ "density array (which has no name)" }, __LINE__);
}

void checkGeometry(Checks& checks)
{
  vtkNew<vtkTransportSampler> sampler;
  SamplerErrorTest test(checks, sampler);
  sampler->SetInputData(makeImage(1, 1, 1, false, bumpy));
  test.Expect({ "one point along every axis" }, __LINE__);
  sampler->SetInputData(makeImage(1, 1, 1, true, bumpy));
  test.Expect({ "one point along every axis" }, __LINE__);
  auto image = makeImage(6, 5, 1, true, bumpy);
  sampler->SetInputData(image);
  for (const double spacing : { 0.0, notANumber, infinity })
  {
    image->SetSpacing(spacing, 1.0, 1.0);
    test.Expect({ "spacing is (", "not 0" }, __LINE__);
  }
  image->SetSpacing(1.0, 1.0, 1.0);
  const double flat[9] = { 1, 1, 0, 0, 0, 0, 0, 0, 1 };
  image->SetDirectionMatrix(flat);
  test.Expect({ "direction of its own" }, __LINE__);
}

// Nothing upstream yet is no error.
void checkEmpty(Checks& checks)
{
  vtkNew<vtkTransportSampler> sampler;
  SamplerErrorTest test(checks, sampler);
  vtkNew<vtkImageData> empty;
  sampler->SetInputData(empty);
  test.ExpectNone(__LINE__);
  CHECK(checks, sampler->GetOutput() != nullptr);
  CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 0);
}

} // namespace

int TestSamplerErrors(int, char*[])
{
  return runChecks(
    { checkProperties, checkComponents, checkArrays, checkValues, checkGeometry, checkEmpty });
}
